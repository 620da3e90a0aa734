// SPDX-License-Identifier: MIT
// The beam tracer: Scene + Camera -> direct light, seen straight and in ideal mirrors, without sampling: visibility,
// shadows and mirror images are exact polygons, and so are their edges in the picture. No diffuse light between
// surfaces. Method: beam_tree.h; rules and units are those of the path tracer (path_tracer.h).
//
// It takes opaque flat polygons, few enough, and flat mirrors; anything else is refused. Rectangles that shine are
// lattices of points, each with hard shadows.
#pragma once

#include <functional>
#include <memory>

#include "conelight/renderer.h"
#include "conelight/scene.h"
#include "reference/path_tracer.h"

namespace conelight::reference {

struct BeamSettings {
    int bounces = -1;  // mirrors in a row; -1: as many as leave a five-hundredth of the light, at most 32
    PixelFilter filter = PixelFilter::Center;
    bool emissiveQuads = true;  // as light.emissive_quads: flat emissive quads are lamps
    int lampPoints = 4;         // of a rectangle that shines, along each side; 1..16
    int threads = 0;            // 0: all cores
};

struct BeamStats {
    std::size_t polygons = 0, orderedParts = 0;  // of the scene; in the partition that orders them
    std::size_t beams = 0, parts = 0;            // of the eye and mirrors; what they end on
    std::size_t lampBeams = 0, litParts = 0;
    double cpuSeconds = 0, wallSeconds = 0;
};

// As of PathTracedPicture: direct, and light that came by mirrors, `mirrored`; full is their sum.
struct BeamPicture {
    Image full, direct, mirrored;
    BeamStats stats;
    bool stopped = false;
};

// `onProgress` gets the part that is done; when it returns false the picture so far is returned. Throws Error(BadInput)
// as Scene::validate and for what beams cannot show, Error(Usage) for arguments out of range.
BeamPicture traceBeams(const Scene& scene, const Camera& camera, int width, int height,
                       const BeamSettings& settings, const std::function<bool(double)>& onProgress = {});

}  // namespace conelight::reference

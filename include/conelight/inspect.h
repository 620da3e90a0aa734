// SPDX-License-Identifier: MIT
// How the light of one pixel was gathered: every cone or ray, step by step, written down by the same shader
// functions that draw the picture (Renderer::inspectPixel). Lengths in m, radiance in W/(sr m^2), irradiance
// divided by pi (the radiance that a white diffuse surface would show), world coordinates.
//
// A part of the picture is scale * value, and value is the sum of weight * radiance over the part's paths.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "conelight/export.h"
#include "conelight/settings.h"

namespace conelight {

enum class PathKind {
    DiffuseCone,
    SpecularCone,
    OcclusionCone,  // radiance is the open part, 0..1
    CosineRay,      // cosine-sampled
    LightRay,       // light-sampled
    SpecularRay,
    OcclusionRay,  // radiance is the open part, 0..1
    CacheFace      // no ray: a face of the cache that was read at the pixel
};
enum class PathEnd {
    Open,   // left the grid or reached its length: the rest sees the sky
    Full,   // the cone became opaque
    Face,   // a face was met
    Unused  // weight 0: would start below the surface, or did not reach its light face
};
enum class StepKind {
    Sample,  // a cone read the volume
    Empty,   // a ray crossed empty bricks
    Voxel,   // a ray crossed a voxel that has no face towards it
    Tested,  // a ray was tested against a voxel's faces
    Hit      // the face that it met
};

struct InspectedStep {
    StepKind kind = StepKind::Sample;
    glm::vec3 position{0};
    float distance = 0;     // from the path's origin
    float size = 0;         // edge of the texel that was read, or of the space that was crossed
    float level = 0;        // of the volume; 0: voxels. Rays: log2 of size in voxels
    float opacity = 0;      // that the step adds
    float total = 0;        // opacity so far
    glm::vec3 radiance{0};  // that the step adds to its path
};

struct InspectedFace {
    glm::ivec3 voxel{0};
    int direction = 0;  // +x -x +y -y +z -z
    glm::vec3 normal{0};
    float plane = 0;     // n.(p - voxel centre) of the points p of the plane, voxels
    float coverage = 0;  // share of the voxel's side, may exceed 1
    glm::vec3 albedo{0};
    glm::vec3 radiance{0};    // emission and reflected direct light
    glm::vec3 irradiance{0};  // indirect, / pi
    int updates = 0;  // cache age: updates behind the irradiance, rounded down to a power of 2; -1: inside a
                      // closed object
};

struct InspectedPath {
    PathKind kind = PathKind::DiffuseCone;
    PathEnd end = PathEnd::Open;
    glm::vec3 origin{0};
    glm::vec3 direction{0};  // unit
    float aperture = 0;      // full angle, rad; 0: a ray
    float distance = 0;      // where it ended; unused: 0
    glm::vec3 weight{0};     // in its part
    glm::vec3 radiance{0};   // that arrives along it
    float opacity = 0;       // gathered over the steps
    std::optional<InspectedFace> face;
    std::vector<InspectedStep> steps;
};

struct InspectedPart {
    bool used = false;
    glm::vec3 value{0};  // sum of weight * radiance: irradiance / pi, radiance of the lobe, or openness
    glm::vec3 scale{1};  // what the surface makes of it: reflectance; 1 for occlusion
    glm::vec3 shown() const { return scale * value; }
};

struct PixelInspection {
    int x = 0, y = 0;  // from the upper left corner
    Mode mode = Mode::Traced;
    glm::vec4 picture{0};   // the pixel of readImage()
    bool seen = false;      // a surface is seen
    glm::vec3 position{0};  // of the surface
    glm::vec3 normal{0};    // for shading
    float depth = 0;        // along the view axis
    // Before the edge-stopping filter, as means over the passes of the picture. In mode traced a surface
    // without rays of its own into the lobe reflects its irradiance: specular.value is diffuse.value then.
    InspectedPart diffuse, specular, occlusion;
    std::vector<InspectedPath> paths;
    bool complete = true;  // false: more paths or steps than are kept
};

// "diffuse cone", "face" ...: for tables and files.
CONELIGHT_API const char* nameOf(PathKind kind);
CONELIGHT_API const char* nameOf(PathEnd end);
CONELIGHT_API const char* nameOf(StepKind kind);
// The part that paths of this kind add to.
enum class PathPart { Diffuse, Specular, Occlusion };
CONELIGHT_API PathPart partOf(PathKind kind);

}  // namespace conelight

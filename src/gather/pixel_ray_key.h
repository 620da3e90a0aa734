// SPDX-License-Identifier: MIT
// Variants of the shaders that gather by rays at pixels (gather/ray_diffuse, gather/ray_specular).
#pragma once

#include <vector>

#include "gl/program.h"
#include "light/light_key.h"

namespace conelight::gather {

enum class RayPicture { Diffuse, Specular, Coat, Occlusion, Lamps };
// Whether rays go into lobes of listed pixels: those of surfaces, or of the clear coats above them.
inline bool isOfLobes(RayPicture kind) { return kind == RayPicture::Specular || kind == RayPicture::Coat; }
// Surfaces are their coats then.
inline gl::Defines surfaceDefines(bool coats) {
    return coats ? gl::Defines{{"SURFACE_COATS", "1"}} : gl::Defines{};
}

// What has moved since the picture so far (MOTION of lib/temporal.glsl): nothing but the view, instances, or what vectors
// of pixels say.
enum class Motion { None, Instances, Vectors };

struct PixelRayKey {
    RayPicture kind = RayPicture::Diffuse;
    Motion motion = Motion::None;
    bool counts = false;     // lookups
    bool listed = false;     // of lobes: of the pixels in LobeList, else of all
    bool triangles = false;  // rays meet triangles: of lobes all over, else near their start
    bool aims = false;       // of lobes: as many rays again at voxels that send light
    bool records = false;    // steps of one pixel, for the inspector
    light::HitKey hits;
    light::LampKey lamps;  // of kind Lamps

    gl::ProgramDesc desc() const;
    static std::vector<PixelRayKey> all();
};

// The edge-stopping filter over a picture, of a level: 1, 2, 4, 8 pixels between samples.
struct EdgeFilterKey {
    int step = 1;
    bool specular = false;
    bool coats = false;  // of specular ones

    gl::ProgramDesc desc() const;
    static std::vector<EdgeFilterKey> all();
};

}  // namespace conelight::gather

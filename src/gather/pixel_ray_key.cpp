// SPDX-License-Identifier: MIT
#include "gather/pixel_ray_key.h"

#include <utility>

#include "gather/step_recorder.h"

namespace conelight::gather {
namespace {

// Passes of one kind, as they follow what has moved, count or record.
void addPasses(std::vector<PixelRayKey>& keys, PixelRayKey key) {
    key.listed = isOfLobes(key.kind);
    for (const bool counts : {false, true}) {
        key.counts = counts;
        for (const Motion motion : {Motion::None, Motion::Instances, Motion::Vectors}) {
            key.motion = motion;
            keys.push_back(key);
        }
    }
    // Coats and lamps are not recorded.
    if (key.kind == RayPicture::Coat || key.kind == RayPicture::Lamps) return;
    key.motion = Motion::None;
    key.counts = key.listed = false;
    key.records = true;
    keys.push_back(key);
}

}  // namespace

gl::ProgramDesc PixelRayKey::desc() const {
    gl::ProgramDesc desc;
    if (kind == RayPicture::Lamps) {
        desc = {{"gather/ray_lamps.comp.glsl"}, {{"MOTION", std::to_string(static_cast<int>(motion))}}};
        if (counts) desc.defines.emplace_back("COUNT_LOOKUPS", "1");
        for (auto& define : lamps.defines()) desc.defines.push_back(std::move(define));
        return desc;
    }
    desc.files = {isOfLobes(kind) ? "gather/ray_specular.comp.glsl" : "gather/ray_diffuse.comp.glsl"};
    desc.defines = {{"MOTION", std::to_string(static_cast<int>(motion))}};
    if (!isOfLobes(kind)) desc.defines.emplace_back("OCCLUSION", kind == RayPicture::Occlusion ? "1" : "0");
    if (aims) desc.defines.emplace_back("AIMED_RAYS", "1");
    if (listed) desc.defines.emplace_back("LOBE_LISTED", "1");
    if (counts) desc.defines.emplace_back("COUNT_LOOKUPS", "1");
    for (auto& define : hits.defines()) desc.defines.push_back(std::move(define));
    if (triangles) desc.defines.emplace_back(isOfLobes(kind) ? "TRIANGLE_HITS" : "NEAR_TRIANGLES", "1");
    for (auto& define : surfaceDefines(kind == RayPicture::Coat)) desc.defines.push_back(std::move(define));
    return records ? StepRecorder::variant(std::move(desc)) : desc;
}

std::vector<PixelRayKey> PixelRayKey::all() {
    std::vector<PixelRayKey> keys;
    for (const light::LampKey& lamps : light::LampKey::all())
        addPasses(keys, {.kind = RayPicture::Lamps, .hits = {}, .lamps = lamps});
    for (const bool triangles : {false, true}) {
        // Occlusion asks for no light.
        addPasses(keys, {.kind = RayPicture::Occlusion, .triangles = triangles});
        for (const light::HitKey& hits : light::HitKey::all(0))
            for (const RayPicture kind : {RayPicture::Diffuse, RayPicture::Specular, RayPicture::Coat})
                for (const bool aims : {false, true})
                    if (isOfLobes(kind) || !aims)
                        addPasses(keys, {.kind = kind, .triangles = triangles, .aims = aims, .hits = hits});
    }
    return keys;
}

gl::ProgramDesc EdgeFilterKey::desc() const {
    gl::ProgramDesc desc{{"gather/edge_filter.comp.glsl"},
                         {{"FILTER_STEP", std::to_string(step)}, {"SPECULAR", specular ? "1" : "0"}}};
    for (auto& define : surfaceDefines(coats)) desc.defines.push_back(std::move(define));
    return desc;
}

std::vector<EdgeFilterKey> EdgeFilterKey::all() {
    std::vector<EdgeFilterKey> keys;
    for (const int step : {1, 2, 4, 8})
        for (const auto& [specular, coats] : {std::pair{false, false}, {true, false}, {true, true}})
            keys.push_back({step, specular, coats});
    return keys;
}

}  // namespace conelight::gather

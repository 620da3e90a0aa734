// SPDX-License-Identifier: MIT
#include "gather/pixel_visibility.h"

#include <algorithm>
#include <array>

#include "gather/pixel_lights.h"
#include "gather/pixel_list.h"
#include "gl/gl.h"
#include "gl/picture_pass.h"
#include "shared/visibility_list.h"

namespace conelight::gather {
namespace {

// Which kinds of lights there are.
struct VisibilityKey {
    bool point = false, spot = false, directional = false;
    bool cascades = false;
    bool counts = false;  // lookups

    gl::ProgramDesc desc() const;
    static std::vector<VisibilityKey> all();
};

constexpr std::array<std::uint32_t, 6> kEmptyList{VISIBILITY_GROUPS_X, 0, 1, 0, 0, 0};

gl::ProgramDesc VisibilityKey::desc() const {
    const light::LightKey lights{.point = point ? 1 : 0,
                                 .spot = spot ? 1 : 0,
                                 .directional = directional ? 1 : 0,
                                 .fixed = false,
                                 .shadows = true,
                                 .cascades = cascades};
    gl::ProgramDesc desc{{"gather/visibility_maps.comp.glsl"}, lights.defines()};
    if (counts) desc.defines.emplace_back("COUNT_LOOKUPS", "1");
    return desc;
}

// `veils`: they do not count.
gl::ProgramDesc rayDesc(bool counts, bool veils) {
    gl::ProgramDesc desc{{"gather/visibility_rays.comp.glsl"}, {}};
    if (veils) desc.defines.emplace_back("VEILS", "1");
    if (counts) desc.defines.emplace_back("COUNT_LOOKUPS", "1");
    return desc;
}

std::vector<VisibilityKey> VisibilityKey::all() {
    std::vector<VisibilityKey> keys;
    for (int bits = 2; bits < 16; ++bits)
        for (const bool cascades : {false, (bits & 8) != 0})
            keys.push_back({(bits & 2) != 0, (bits & 4) != 0, (bits & 8) != 0, cascades, (bits & 1) != 0});
    return keys;
}

}  // namespace

void VisibilityInputs::declare(gl::Inputs& inputs) const {
    inputs.add(scene).add(lights).add(surfaces).add(voxels);
    voxels.surface().declareTriangles(inputs);
}

bool PixelVisibility::serves(const scene::GpuScene& scene, const light::Lights& lights) {
    constexpr std::uint32_t kBoth = INSTANCE_CASTS_SHADOW | INSTANCE_VOXELIZED;
    return lights.key().hasSharpShadows() &&
           std::none_of(scene.instances().begin(), scene.instances().end(),
                        [](const gpu::Instance& i) { return (i.flags & kBoth) == INSTANCE_CASTS_SHADOW; });
}

base::Steps PixelVisibility::lookInSteps(const gl::Device& device, const VisibilityInputs& inputs,
                                         const gl::Buffer* lookupCounters) {
    constexpr const char* kPass = "visibility of lights";
    const int width = inputs.surfaces.width(), height = inputs.surfaces.height();
    if (!seen_ || seen_.width() != width || seen_.height() != height) {
        seen_ = gl::Texture({GL_TEXTURE_2D, GL_R32UI, width, height}, "lights that pixels see");
        seen_.parameter(GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        seen_.parameter(GL_TEXTURE_MAG_FILTER, GL_NEAREST);
        const auto pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
        open_ = gl::Buffer(sizeof kEmptyList + 8 * pixels, "pixels that see lights by rays");
    }
    open_.update(kEmptyList);
    const glm::uvec4& ends = inputs.lights.ends();
    const VisibilityKey key{ends.x > 0, ends.y > ends.x, ends.z > ends.y,
                            lightsOfPixels(inputs.lights, inputs.surfaces).cascades,
                            lookupCounters != nullptr};
    gl::Inputs given;
    given.add(inputs).image("result", seen_, gl::ImageUse::ReadWrite).storage("VisibilityList", open_);
    if (lookupCounters != nullptr) given.storage("LookupTable", *lookupCounters);
    const gl::ProgramDesc maps = key.desc();
    co_await gl::dispatchPicture(device, {kPass, maps, given, {width, height}});
    gl::barrier(gl::Access::ShaderStorage | gl::Access::ImageAccess | gl::Access::Indirect |
                gl::Access::Update);
    const gl::ProgramDesc rays = rayDesc(key.counts, inputs.lights.hasVeils());
    co_await dispatchListed(device, {kPass, rays, given, open_});
    gl::barrier(gl::Access::TextureFetch);
}

std::vector<gl::ProgramDesc> PixelVisibility::programDescs() {
    std::vector<gl::ProgramDesc> descs{rayDesc(false, false), rayDesc(true, false), rayDesc(false, true),
                                       rayDesc(true, true)};
    for (const VisibilityKey& key : VisibilityKey::all()) descs.push_back(key.desc());
    return descs;
}

}  // namespace conelight::gather

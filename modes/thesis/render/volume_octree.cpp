// SPDX-License-Identifier: MIT
// The thesis's volume in an octree: sums of voxels -> nodes, and bricks of every level.
#include "gl/gl.h"
#include "thesis/render/volume.h"

namespace conelight::thesis {
namespace {

gl::ProgramDesc octreeMarkDesc() { return {{"thesis/shaders/octree_mark.comp.glsl"}, {}}; }

gl::ProgramDesc octreeMipDesc(const ThesisDefects& d, bool ofAreas) {
    gl::Defines defines{{"OCTREE", "1"}};
    if (ofAreas) defines.emplace_back("AREAS", "1");
    if (!ofAreas && ThesisVolume::hasAreas(d)) defines.emplace_back("SEEN", "1");
    if (!ofAreas && d.clippedRadiance) defines.emplace_back("CLIPPED_RADIANCE", "1");
    if (d.volumeMips) defines.emplace_back("VOLUME_MIPS", "1");
    return {{"thesis/shaders/mip.comp.glsl"}, defines};
}

}  // namespace

// Nodes for the voxels that have sums, and zero in the bricks of all that hang on them.
void ThesisVolume::growOctree(const gl::Device& device, const ThesisVolumeOptions& options) {
    const std::size_t markBytes = 4 * std::max<std::size_t>(brickCount_, 4);
    if (brickMarks_.bytes() < markBytes) brickMarks_ = gl::Buffer(markBytes, "thesis brick marks");
    brickMarks_.clear();
    const gather::RadianceOctree::Shape shape{glm::ivec3(static_cast<int>(grid_.size)),
                                              static_cast<int>(grid_.maxLevel), 1};
    octree_.build(device, shape, [&](const gl::Inputs& tree) {
        gl::Inputs given = tree;
        given.uniform("ThesisGridBlock", constants_)
            .storage("SumTable", sums_)
            .storage("BrickList", brickList_)
            .storage("BrickMarks", brickMarks_);
        device.get(octreeMarkDesc()).dispatchIndirect(given, brickList_, 16);
    });

    const std::uint32_t format = options.defects.clippedRadiance ? GL_RGBA8 : GL_RGBA16F;
    const auto fit = [&](gl::Texture& texture, bool wanted, std::uint32_t as, const char* label) {
        if (wanted)
            octree_.fitBricks(texture, as, label);
        else
            texture.reset();
    };
    fit(texture_, true, format, "thesis bricks");
    for (gl::Texture& areas : areas_) fit(areas, hasAreas(options.defects), GL_RGBA8, "thesis area bricks");
    lit_ = -1;
    for (int i = 0; i < 2; ++i) fit(bounced_[i], options.bounces > i + 1, format, "thesis bounce bricks");
    fit(albedo_, options.bounces > 1, GL_RGBA8, "thesis albedo bricks");
    fit(normal_, options.bounces > 1, GL_RGBA8, "thesis normal bricks");
    if (options.bounces > 1 && !bounceConstants_)
        bounceConstants_ = gl::Buffer(sizeof(gpu::ThesisConstants), "thesis bounce constants");
}

void ThesisVolume::buildOctreeMips(const gl::Device& device, const ThesisDefects& defects,
                                   const gl::Texture& texture) {
    for (int level = 1; level <= static_cast<int>(grid_.maxLevel); ++level) {
        gl::Inputs given = bricks();
        octree_.declareFill(given, level);
        given.image("fine", texture, gl::ImageUse::Read).image("coarse", texture, gl::ImageUse::Write);
        const bool ofAreas = areAreas(texture);
        if (!ofAreas && areas_[0])
            given.image("areasPlus", areas_[0], gl::ImageUse::Read)
                .image("areasMinus", areas_[1], gl::ImageUse::Read);
        device.get(octreeMipDesc(defects, ofAreas))
            .dispatchLinear(given, std::size_t{OCTREE_BRICK_TEXELS} * octree_.brickCount(level));
        gl::barrier(gl::Access::ImageAccess);
    }
}

std::vector<gl::ProgramDesc> ThesisVolume::octreeDescs() {
    ThesisDefects mended, published;
    published.clippedRadiance = published.volumeMips = published.isotropicOpacity = true;
    std::vector<gl::ProgramDesc> descs{octreeMarkDesc()};
    for (const ThesisDefects& defects : {mended, published})
        for (const bool ofAreas : {false, true}) descs.push_back(octreeMipDesc(defects, ofAreas));
    return descs;
}

}  // namespace conelight::thesis

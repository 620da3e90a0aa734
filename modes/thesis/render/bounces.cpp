// SPDX-License-Identifier: MIT
// More bounces in the thesis's volume: surfaces of its voxels, and light that they pass on by the mode's diffuse
// cones. Jacobi iteration of the rendering equation (theory 0.1): the volume with n bounces is made of what
// voxels have by themselves and of the volume with n - 1.
#include "gl/gl.h"
#include "thesis/render/cones.h"
#include "thesis/render/volume.h"

namespace conelight::thesis {

void ThesisVolume::allocateBounces(const ThesisVolumeOptions& options) {
    const gl::TextureDesc desc = texture_.desc();
    const auto make = [&](gl::Texture& texture, std::uint32_t format, int levels, const char* label) {
        if (texture && texture.desc().width == desc.width && texture.desc().format == format &&
            texture.desc().levels == levels)
            return;
        texture.reset();
        texture = gl::Texture({GL_TEXTURE_3D, format, desc.width, desc.width, desc.width, levels}, label);
        filledSize_ = glm::ivec3(0);
    };
    lit_ = -1;
    for (int i = 0; i < 2; ++i) {
        if (options.bounces > i + 1)
            make(bounced_[i], desc.format, desc.levels, "thesis bounces");
        else
            bounced_[i].reset();
    }
    if (options.bounces > 1) {
        make(albedo_, GL_RGBA8, 1, "thesis albedo");
        make(normal_, GL_RGBA8, 1, "thesis normals");
        if (!bounceConstants_)
            bounceConstants_ = gl::Buffer(sizeof(gpu::ThesisConstants), "thesis bounce constants");
    } else {
        albedo_.reset();
        normal_.reset();
    }
}

void ThesisVolume::clearOthers(int level, const glm::ivec3& first, const glm::ivec3& size) {
    for (gl::Texture* texture : {&areas_[0], &areas_[1], &bounced_[0], &bounced_[1], &albedo_, &normal_})
        if (*texture && level < texture->desc().levels)
            texture->clearRegion(level, first, size, GL_RGBA, GL_FLOAT);
}

// The voxelizer's sums once more, of albedo and of normals in place of light.
void ThesisVolume::sumSurfaces(const gl::Device& device, const Inputs& inputs,
                               const ThesisVolumeOptions& options) {
    gpu::ThesisGrid grid = grid_;
    grid.sumScale = 16777216.0f;  // 2^24: both are at most 1
    constants_.update(grid);
    // Means, without opacity: 8 bits, 1 where anything is.
    ThesisDefects mean = options.defects;
    mean.clippedRadiance = mean.binaryOpacity = mean.isotropicOpacity = true;
    mean.racingStores = false;
    for (const Content content : {Content::Albedo, Content::Normal}) {
        drawTriangles(device, inputs, options, content);
        resolve(device, mean, content == Content::Albedo ? albedo_ : normal_);
    }
    constants_.update(grid_);
    gl::barrier(gl::Access::TextureFetch);
}

void ThesisVolume::bounce(const gl::Device& device, const Inputs& inputs,
                          const ThesisVolumeOptions& options) {
    bounceConstants_.update(thesisConstants(options.cones, grid_, options.size));
    for (int bounces = 2; bounces <= options.bounces; ++bounces) {
        const int target = bounces % 2;
        gl::Inputs given = bricks();
        given.add(inputs.lights)
            .uniform("ThesisBlock", bounceConstants_)
            .texture("volume", texture(), &sampler_)
            .texture("ownLight", texture_)
            .texture("surfaceAlbedo", albedo_)
            .texture("surfaceNormal", normal_)
            .image("bounced", bounced_[target], gl::ImageUse::Write);
        if (isOctree_) given.add(octree_);
        device.get(bounceDesc(options.cones, inputs.lights.hasEnvironment()))
            .dispatchIndirect(given, brickList_, 16);
        gl::barrier(gl::Access::ImageAccess);
        buildMips(device, options.defects, bounced_[target]);
        gl::barrier(gl::Access::TextureFetch);
        lit_ = target;
    }
}

}  // namespace conelight::thesis

// SPDX-License-Identifier: MIT
#include "scene/host_texture.h"

#include "base/log.h"
#include "gl/gl.h"
#include "gl/pass.h"

namespace conelight::scene {
namespace {

struct HostTextureKey {
    bool halves;
    gl::ProgramDesc desc() const {
        return {{"scene/host_texture.comp.glsl"}, {{"HALVES", halves ? "1" : "0"}}};
    }
};

}  // namespace

void requireUsable(const HostTexture& texture) {
    const gl::TextureShape found = gl::shapeOfForeign(texture.texture);
    if (found.width < 1 || found.height < 1)
        base::fail(
            ErrorKind::BadInput,
            "texture '%s' of the host: %u is no GL_TEXTURE_2D with texels; the name of one would be right",
            texture.name.c_str(), texture.texture);
    if (!found.floats)
        base::fail(
            ErrorKind::BadInput,
            "texture '%s' of the host: %u holds integers or depths; floats or normalized numbers would be "
            "right",
            texture.name.c_str(), texture.texture);
}

Texture whiteTexel(const std::string& name) {
    return {.name = name, .width = 1, .height = 1, .rgba = {255, 255, 255, 255}};
}

void HostTextureImport::copy(const gl::Device& device, const HostTexture& texture, gl::Texture& array,
                             int layer) {
    const gl::PassScope pass(device.profiler, "host texture");
    const int edge = array.width();
    if (!linear_) {
        linear_ = gl::Texture({GL_TEXTURE_2D, GL_RGBA32F, edge, edge, 1, 0}, "host texture, linear");
        encoded_ = gl::Texture({GL_TEXTURE_2D, GL_R32UI, edge, edge, 1, 0}, "host texture, encoded");
        nearest_ = gl::Sampler({GL_NEAREST, GL_NEAREST, GL_CLAMP_TO_EDGE}, "host texture");
    }
    // What the host's shaders and draw calls wrote.
    gl::barrier(gl::Access::TextureFetch);
    for (int level = 0; level < array.desc().levels; ++level) {
        gl::Inputs inputs;
        inputs.image("linearLevel", linear_, gl::ImageUse::Write, level)
            .image("encodedLevel", encoded_, gl::ImageUse::Write, level);
        if (level == 0)
            inputs.foreignTexture("hostTexture", texture.texture, nearest_);
        else
            inputs.texture("linearLevels", linear_);
        device.get(HostTextureKey{level > 0}.desc()).dispatch(inputs, array.width(level), array.width(level));
        gl::barrier(gl::Access::TextureFetch | gl::Access::Update);
        array.copyLayer(level, layer, encoded_);
    }
}

std::vector<gl::ProgramDesc> HostTextureImport::programDescs() {
    return {HostTextureKey{false}.desc(), HostTextureKey{true}.desc()};
}

}  // namespace conelight::scene

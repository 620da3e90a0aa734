// SPDX-License-Identifier: MIT
#include "gl/inputs.h"

#include "base/assert.h"

namespace conelight::gl {

Inputs& Inputs::uniform(ResourceName block, const Buffer& buffer) {
    CONELIGHT_ASSERT(buffer, "Inputs::uniform: an empty buffer");
    items_.push_back({.name = block, .kind = ResourceKind::Uniform, .object = buffer.name()});
    return *this;
}

Inputs& Inputs::storage(ResourceName block, const Buffer& buffer) {
    CONELIGHT_ASSERT(buffer, "Inputs::storage: an empty buffer");
    items_.push_back({.name = block, .kind = ResourceKind::Storage, .object = buffer.name()});
    return *this;
}

Inputs& Inputs::texture(ResourceName name, const Texture& texture, const Sampler* sampler) {
    CONELIGHT_ASSERT(texture, "Inputs::texture: an empty texture");
    items_.push_back({.name = name,
                      .kind = ResourceKind::Texture,
                      .object = texture.name(),
                      .sampler = sampler != nullptr ? sampler->name() : 0});
    return *this;
}

Inputs& Inputs::foreignTexture(ResourceName name, Name texture, const Sampler& sampler) {
    CONELIGHT_ASSERT(texture != 0 && sampler, "Inputs::foreignTexture: no texture or no sampler");
    items_.push_back(
        {.name = name, .kind = ResourceKind::Texture, .object = texture, .sampler = sampler.name()});
    return *this;
}

Inputs& Inputs::image(ResourceName name, const Texture& texture, ImageUse use, int level) {
    CONELIGHT_ASSERT(texture, "Inputs::image: an empty texture");
    items_.push_back({.name = name,
                      .kind = ResourceKind::Image,
                      .object = texture.name(),
                      .format = texture.desc().format,
                      .level = level,
                      .use = use});
    return *this;
}

Inputs& Inputs::perDraw(ResourceName name) {
    items_.push_back({.name = name, .kind = ResourceKind::Texture});
    return *this;
}

}  // namespace conelight::gl

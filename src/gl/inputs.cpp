// SPDX-License-Identifier: MIT
#include "gl/inputs.h"

#include <mutex>
#include <set>
#include <string>

#include "base/assert.h"
#include "base/log.h"
#include "gl/gl.h"

namespace conelight::gl {
namespace {

// What every driver gives (OpenGL 4.5, table 23.64); larger blocks have to be asked for.
constexpr std::size_t kSmallestBlockLimit = std::size_t{1} << 27;

// A buffer may be larger than the driver's limit for blocks. It is no error then, and Mesa's drivers give
// shaders all of it, but no driver has to: that is said, once per block.
void warnOfBlockSize(ResourceName block, const Buffer& buffer) {
    if (buffer.bytes() <= kSmallestBlockLimit) return;
    GLint64 limit = 0;
    glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &limit);
    if (buffer.bytes() <= static_cast<std::size_t>(limit)) return;
    static std::mutex mutex;
    static std::set<std::uint64_t> said;
    const std::lock_guard lock(mutex);
    if (!said.insert(block.hash()).second) return;
    base::log(
        LogLevel::Warning,
        base::format("OpenGL: storage block '%s' of %.1f MiB, beyond the driver's %.1f MiB: the picture may "
                     "be wrong; fewer voxels or triangles would be right",
                     std::string(block.text()).c_str(), static_cast<double>(buffer.bytes()) / (1 << 20),
                     static_cast<double>(limit) / (1 << 20)));
}

}  // namespace

Inputs& Inputs::uniform(ResourceName block, const Buffer& buffer) {
    CONELIGHT_ASSERT(buffer, "Inputs::uniform: an empty buffer");
    items_.push_back({.name = block, .kind = ResourceKind::Uniform, .object = buffer.name()});
    return *this;
}

Inputs& Inputs::storage(ResourceName block, const Buffer& buffer) {
    CONELIGHT_ASSERT(buffer, "Inputs::storage: an empty buffer");
    warnOfBlockSize(block, buffer);
    items_.push_back({.name = block, .kind = ResourceKind::Storage, .object = buffer.name()});
    return *this;
}

Inputs& Inputs::foreignStorage(ResourceName block, Name buffer) {
    items_.push_back({.name = block, .kind = ResourceKind::Storage, .object = buffer});
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

// SPDX-License-Identifier: MIT
#include "gl/host_slots.h"

#include <algorithm>
#include <cstddef>

#include "base/log.h"
#include "gl/debug.h"
#include "gl/gl.h"

namespace conelight::gl {
namespace {

void requireRange(const char* what, int first, std::size_t count, GLenum most) {
    GLint limit = 0;
    glGetIntegerv(most, &limit);
    if (first < 0 || static_cast<long>(first) + static_cast<long>(count) > static_cast<long>(limit))
        base::fail(ErrorKind::Usage, "%s from %d on; 0 to %d would be right", what, first,
                   limit - static_cast<int>(count));
}

const Inputs::Item* itemOf(const Inputs& given, ResourceName name, ResourceKind kind) {
    const auto found = std::find_if(
        given.items().begin(), given.items().end(),
        [&](const Inputs::Item& item) { return item.kind == kind && item.name.hash() == name.hash(); });
    return found == given.items().end() ? nullptr : &*found;
}

}  // namespace

void bindForHost(const Inputs& given, const HostSlots& slots) {
    if (!hasCurrentContext())
        base::fail(ErrorKind::NoGl,
                   "OpenGL: no context is current on this thread; the host's would be right");
    requireRange("binding points of uniform blocks", slots.firstBlock, slots.blocks.size(),
                 GL_MAX_UNIFORM_BUFFER_BINDINGS);
    requireRange("texture units", slots.firstTexture, slots.textures.size(),
                 GL_MAX_COMBINED_TEXTURE_IMAGE_UNITS);
    auto point = static_cast<GLuint>(slots.firstBlock);
    for (const ResourceName name : slots.blocks) {
        const Inputs::Item* item = itemOf(given, name, ResourceKind::Uniform);
        glBindBufferBase(GL_UNIFORM_BUFFER, point++, item != nullptr ? item->object : 0);
    }
    auto unit = static_cast<GLuint>(slots.firstTexture);
    for (const ResourceName name : slots.textures) {
        const Inputs::Item* item = itemOf(given, name, ResourceKind::Texture);
        glBindTextureUnit(unit, item != nullptr ? item->object : 0);
        glBindSampler(unit++, item != nullptr ? item->sampler : 0);
    }
}

}  // namespace conelight::gl

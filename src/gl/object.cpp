// SPDX-License-Identifier: MIT
#include "gl/object.h"

#include <algorithm>
#include <map>
#include <mutex>

#include "gl/gl.h"

namespace conelight::gl {
namespace {

struct Registry {
    std::mutex mutex;
    std::map<std::pair<ObjectType, Name>, std::pair<std::uint64_t, LiveObject>> objects;
    std::uint64_t next = 0;
};

Registry& registry() {
    static Registry* const instance = new Registry;  // outlives every owner, also static ones
    return *instance;
}

GLenum identifier(ObjectType type) {
    switch (type) {
        case ObjectType::Buffer: return GL_BUFFER;
        case ObjectType::Texture: return GL_TEXTURE;
        case ObjectType::Sampler: return GL_SAMPLER;
        case ObjectType::Program: return GL_PROGRAM;
        case ObjectType::VertexArray: return GL_VERTEX_ARRAY;
        case ObjectType::Framebuffer: return GL_FRAMEBUFFER;
        case ObjectType::Query: return GL_QUERY;
    }
    return GL_NONE;
}

}  // namespace

std::vector<LiveObject> liveObjects() {
    Registry& all = registry();
    const std::lock_guard lock(all.mutex);
    std::vector<std::pair<std::uint64_t, LiveObject>> sorted;
    for (const auto& [key, entry] : all.objects) sorted.push_back(entry);
    std::sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<LiveObject> result;
    for (auto& entry : sorted) result.push_back(std::move(entry.second));
    return result;
}

std::size_t liveObjectCount() {
    Registry& all = registry();
    const std::lock_guard lock(all.mutex);
    return all.objects.size();
}

namespace detail {

void created(ObjectType type, Name name, const std::string& label, std::size_t bytes) {
    glObjectLabel(identifier(type), name, static_cast<GLsizei>(label.size()), label.c_str());
    Registry& all = registry();
    const std::lock_guard lock(all.mutex);
    all.objects[{type, name}] = {all.next++, LiveObject{type, name, label, bytes}};
}

void deleteName(ObjectType type, Name name) noexcept {
    switch (type) {
        case ObjectType::Buffer: glDeleteBuffers(1, &name); break;
        case ObjectType::Texture: glDeleteTextures(1, &name); break;
        case ObjectType::Sampler: glDeleteSamplers(1, &name); break;
        case ObjectType::Program: glDeleteProgram(name); break;
        case ObjectType::VertexArray: glDeleteVertexArrays(1, &name); break;
        case ObjectType::Framebuffer: glDeleteFramebuffers(1, &name); break;
        case ObjectType::Query: glDeleteQueries(1, &name); break;
    }
    Registry& all = registry();
    const std::lock_guard lock(all.mutex);
    all.objects.erase({type, name});
}

}  // namespace detail
}  // namespace conelight::gl

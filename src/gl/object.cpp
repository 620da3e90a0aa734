// SPDX-License-Identifier: MIT
#include "gl/object.h"

#include <algorithm>
#include <atomic>
#include <map>
#include <mutex>
#include <utility>

#include "gl/gl.h"
#include "gl/storage.h"

namespace conelight::gl {
namespace {

struct Registry {
    std::mutex mutex;
    std::map<std::uint32_t, LiveObject> objects;  // by key: in order of creation
    std::uint32_t next = 1;
    std::size_t bytes = 0;  // of all
};

Registry& registry() {
    static Registry* const instance = new Registry;  // outlives every owner, also static ones
    return *instance;
}

thread_local int forgetting = 0;
thread_local std::uint32_t currentOwner = 0;

GLenum identifier(ObjectType type) {
    switch (type) {
        case ObjectType::Buffer:
            return GL_BUFFER;
        case ObjectType::Texture:
            return GL_TEXTURE;
        case ObjectType::Sampler:
            return GL_SAMPLER;
        case ObjectType::Program:
            return GL_PROGRAM;
        case ObjectType::VertexArray:
            return GL_VERTEX_ARRAY;
        case ObjectType::Framebuffer:
            return GL_FRAMEBUFFER;
        case ObjectType::Query:
            return GL_QUERY;
    }
    return GL_NONE;
}

}  // namespace

std::vector<LiveObject> liveObjects() {
    Registry& all = registry();
    const std::lock_guard lock(all.mutex);
    std::vector<LiveObject> result;
    for (const auto& [key, object] : all.objects) result.push_back(object);
    return result;
}

std::size_t liveObjectCount() {
    Registry& all = registry();
    const std::lock_guard lock(all.mutex);
    return all.objects.size();
}

std::size_t liveBytes() {
    Registry& all = registry();
    const std::lock_guard lock(all.mutex);
    return all.bytes;
}

std::uint32_t newOwner() {
    static std::atomic<std::uint32_t> last{0};
    return ++last;
}

OwnerScope::OwnerScope(std::uint32_t owner) : outer_(std::exchange(currentOwner, owner)) {}
OwnerScope::~OwnerScope() { currentOwner = outer_; }

ForgetNames::ForgetNames() { ++forgetting; }
ForgetNames::~ForgetNames() { --forgetting; }
bool namesAreForgotten() { return forgetting > 0; }

namespace detail {

std::uint32_t created(ObjectType type, Name name, const std::string& label, std::size_t bytes) {
    // GL_MAX_LABEL_LENGTH is at least 256, its terminator included; a longer label would be an error, and
    // names of textures come from files.
    constexpr std::size_t kMaxLabel = 255;
    glObjectLabel(identifier(type), name, static_cast<GLsizei>(std::min(label.size(), kMaxLabel)),
                  label.c_str());
    Registry& all = registry();
    const std::lock_guard lock(all.mutex);
    all.objects.emplace(all.next, LiveObject{type, name, label, bytes, currentOwner});
    all.bytes += bytes;
    return all.next++;
}

static void deleteFromContext(ObjectType type, Name name) {
    switch (type) {
        case ObjectType::Buffer:
            glDeleteBuffers(1, &name);
            break;
        case ObjectType::Texture:
            glDeleteTextures(1, &name);
            break;
        case ObjectType::Sampler:
            glDeleteSamplers(1, &name);
            break;
        case ObjectType::Program:
            glDeleteProgram(name);
            break;
        case ObjectType::VertexArray:
            glDeleteVertexArrays(1, &name);
            break;
        case ObjectType::Framebuffer:
            glDeleteFramebuffers(1, &name);
            break;
        case ObjectType::Query:
            glDeleteQueries(1, &name);
            break;
    }
}

void deleteName(ObjectType type, Name name, std::uint32_t key) noexcept {
    if (forgetting == 0) deleteFromContext(type, name);
    Registry& all = registry();
    const std::lock_guard lock(all.mutex);
    const auto found = all.objects.find(key);
    if (found == all.objects.end()) return;
    all.bytes -= found->second.bytes;
    all.objects.erase(found);
}

}  // namespace detail
}  // namespace conelight::gl

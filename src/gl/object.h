// SPDX-License-Identifier: MIT
// Move-only ownership of one GL name, and the list of what is alive (with bytes and labels).
// Default-constructed and moved-from objects are empty: name 0, the other fields unspecified. Constructors
// and destructors need the context current that owns the name; the list is process-wide and thread-safe, also
// with several contexts.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace conelight::gl {

using Name = std::uint32_t;  // GLuint, without the GL header

enum class ObjectType { Buffer, Texture, Sampler, Program, VertexArray, Framebuffer, Query };

struct LiveObject {
    ObjectType type;
    Name name;
    std::string label;    // in full; the driver gets the first 255 bytes
    std::size_t bytes;    // storage of buffers and textures, else 0
    std::uint32_t owner;  // whose it is (OwnerScope); 0: nobody's in particular
};

// Everything alive in this process, in order of creation. Empty after the last owner died. The profiler's
// queries count too: none is alive between Profiler::endFrame and the next PassScope.
std::vector<LiveObject> liveObjects();
std::size_t liveObjectCount();

// Whose objects are: a number that no other owner of the process has.
std::uint32_t newOwner();
// While one lives, what is made on this thread belongs to `owner`. Scopes nest.
class OwnerScope {
  public:
    explicit OwnerScope(std::uint32_t owner);
    ~OwnerScope();
    OwnerScope(const OwnerScope&) = delete;
    OwnerScope& operator=(const OwnerScope&) = delete;

  private:
    std::uint32_t outer_;
};

// While one lives, owners on this thread forget their names instead of deleting them: for when the context is gone.
class ForgetNames {
  public:
    ForgetNames();
    ~ForgetNames();
    ForgetNames(const ForgetNames&) = delete;
    ForgetNames& operator=(const ForgetNames&) = delete;
};

bool namesAreForgotten();

namespace detail {
// Labels `name` and puts it on the list; the result is its key there.
std::uint32_t created(ObjectType type, Name name, const std::string& label, std::size_t bytes);
void deleteName(ObjectType type, Name name, std::uint32_t key) noexcept;
}  // namespace detail

// Owns one name. The public types (Buffer, Texture ...) derive from it.
template <ObjectType Type>
class Object {
  public:
    Object() = default;
    Object(Object&& other) noexcept
        : name_(std::exchange(other.name_, 0)), key_(std::exchange(other.key_, 0)) {}
    Object& operator=(Object&& other) noexcept {
        if (this != &other) {
            reset();
            name_ = std::exchange(other.name_, 0);
            key_ = std::exchange(other.key_, 0);
        }
        return *this;
    }
    Object(const Object&) = delete;
    Object& operator=(const Object&) = delete;
    ~Object() { reset(); }

    Name name() const { return name_; }
    explicit operator bool() const { return name_ != 0; }
    void reset() noexcept {
        if (name_ != 0) detail::deleteName(Type, std::exchange(name_, 0), std::exchange(key_, 0));
    }

  protected:
    // Owns `name` from here on, whatever the caller throws later.
    void adopt(Name name, const std::string& label, std::size_t bytes) {
        reset();
        name_ = name;
        key_ = detail::created(Type, name, label, bytes);
    }

  private:
    Name name_ = 0;
    std::uint32_t key_ = 0;  // GL names repeat between contexts, keys do not
};

}  // namespace conelight::gl

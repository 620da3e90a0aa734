// SPDX-License-Identifier: MIT
// A number that changes when anything of a scene changes that a picture could show: the name under which
// reference pictures are kept.
#pragma once

#include <cstdint>
#include <string>

#include "conelight/scene.h"

namespace conelight::program {

// FNV-1a over 64 bits (Fowler, Noll, Vo 1991), eight bytes at a time with a final mix. Fast enough for large
// scenes; not for adversaries.
class Hash {
  public:
    void add(const void* bytes, std::size_t count);
    void add(const std::string& text);
    void add(std::uint64_t value);
    void add(std::int64_t value) { add(static_cast<std::uint64_t>(value)); }
    void add(int value) { add(static_cast<std::int64_t>(value)); }
    void add(std::uint32_t value) { add(static_cast<std::uint64_t>(value)); }
    void add(bool value) { add(static_cast<std::uint64_t>(value)); }
    void add(double value);
    void add(float value) { add(static_cast<double>(value)); }
    void add(const glm::vec2& v);
    void add(const glm::vec3& v);
    void add(const glm::vec4& v);
    std::string hex() const;  // 16 digits

  private:
    std::uint64_t state_ = 0xcbf29ce484222325u;
};

// Geometry, materials, textures, instances, lights, sky; no names, cameras, settings or notes.
void addScene(Hash& hash, const Scene& scene);
// Of that what does not move, with the places of instances in the list: the name under which baked light is kept.
void addStatics(Hash& hash, const Scene& scene);
void addCamera(Hash& hash, const Camera& camera);

}  // namespace conelight::program

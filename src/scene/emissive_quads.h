// SPDX-License-Identifier: MIT
// Flat emitters: instances that are one untextured emissive parallelogram (two triangles) are rectangular
// lights of the same radiance. Which ones they are decides what is "direct light", in the GL modes and in the
// path tracer. No GL.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "conelight/scene.h"

namespace conelight::scene {

// Double-sided emitters give two entries, one for each side.
struct EmissiveQuad {
    std::size_t instance;
    Light light;
};
std::vector<EmissiveQuad> emissiveQuads(const Scene& scene);

// The light of two triangles of the object that make up a parallelogram, placed in the world and shining from its front;
// of others none. Lengths below 1e-5 `size` are none.
std::optional<Light> quadLight(const std::array<glm::vec3, 6>& corners, float size, const Instance& instance,
                               const Material& material);

// Whether an instance is seen and emits the same everywhere.
bool isPlainEmitter(const Scene& scene, const Instance& instance);

}  // namespace conelight::scene

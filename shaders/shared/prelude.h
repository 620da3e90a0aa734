// SPDX-License-Identifier: MIT
// First include of every header below shaders/shared: these are compiled as C++ (types of GLM, namespace
// conelight::gpu) and as GLSL. Allowed members: float int uint vec2 vec4 ivec4 uvec4 mat4, and vec3 only if a
// 4-byte scalar follows; arrays only of 16-byte multiples; every row of 16 bytes is filled. Under this rule
// std140, std430 and C++ agree; tests/gl/layout_test.cpp asks the driver.
#pragma once
#ifdef __cplusplus
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#define CONELIGHT_SHARED_BEGIN \
    namespace conelight::gpu { \
    using glm::vec2;           \
    using glm::vec3;           \
    using glm::vec4;           \
    using glm::ivec4;          \
    using glm::uvec4;          \
    using glm::mat4;           \
    using uint = std::uint32_t;
#define CONELIGHT_SHARED_END }
#else
#define CONELIGHT_SHARED_BEGIN
#define CONELIGHT_SHARED_END
#endif

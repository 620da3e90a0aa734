// SPDX-License-Identifier: MIT
// The layout of GLM's types that the library is built with. Macros of GLM can change it, and then host and library
// would read each other's memory wrongly; here that is an error of the compiler.
#pragma once

#include <glm/glm.hpp>

static_assert(
    sizeof(glm::vec2) == 8 && sizeof(glm::vec3) == 12 && sizeof(glm::vec4) == 16 && sizeof(glm::mat3) == 36 &&
        sizeof(glm::mat4) == 64 && alignof(glm::vec3) == 4 && alignof(glm::vec4) == 4 &&
        alignof(glm::mat4) == 4,
    "Conelight needs GLM's packed float types: do not define GLM_FORCE_DEFAULT_ALIGNED_GENTYPES (nor "
    "GLM_FORCE_ALIGNED_GENTYPES with it) in files that include conelight/*.h");

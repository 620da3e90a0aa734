// SPDX-License-Identifier: MIT
// The packed numbers of face records (shared/voxels.h), as tests and readers on the CPU see them.
// GLSL twin: shaders/lib/voxel_record.glsl; each function gives the same bits there.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "shared/voxels.h"

namespace conelight::voxels {

// Number of the direction -> unit vector: +x -x +y -y +z -z.
glm::vec3 directionVector(int direction);

// Plane offset n.(c - centre)/h in [-1,1] (a plane that meets the voxel has at most sqrt(3)/2) and coverage
// W in [0,4): more than four sheets of surface in one voxel and direction are counted as four.
std::uint32_t packOffsetWeight(float offset, float weight);
float unpackOffset(std::uint32_t bits);
float unpackWeight(std::uint32_t bits);

// Corners in voxel units [0,1]; min is rounded down, max up, so that the box never shrinks.
std::uint32_t packBounds(const glm::vec3& min, const glm::vec3& max);
void unpackBounds(std::uint32_t bits, glm::vec3& min, glm::vec3& max);

// 11 | 11 | 10 bit unorm. Linear, not square roots: in a closed room of albedo a, light is 1/(1-a), so the
// error of bright albedos counts most.
std::uint32_t packAlbedo(const glm::vec3& albedo);
glm::vec3 unpackAlbedo(std::uint32_t bits);

// Shared-exponent colour (OpenGL 4.5 core, 8.5.2); 0..65408, relative error of the largest channel 0.2 %.
std::uint32_t packRgb9e5(const glm::vec3& color);
glm::vec3 unpackRgb9e5(std::uint32_t bits);

// Emission as halves (0..65504, relative error 0.05 %) and area / h^2 in [0,4), 16 bit: of the surface what
// is the face's own, (n.k)^2 of it. `lobe`: as packed.
gpu::FaceMaterial packFaceMaterial(const glm::vec3& albedo, const glm::vec3& emission, float area,
                                   std::uint32_t lobe = 0);
glm::vec3 unpackEmission(const gpu::FaceMaterial& material);
float unpackArea(const gpu::FaceMaterial& material);

}  // namespace conelight::voxels

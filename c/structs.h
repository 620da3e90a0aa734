// SPDX-License-Identifier: MIT
// The structs of conelight.h as those of the library, and back. What the structs do not have stays as it was.
#pragma once

#include "calls.h"
#include "conelight/host_mesh.h"
#include "conelight/host_texture.h"
#include "conelight/scene.h"

struct conelight_scene {
    conelight::Scene scene;
};

namespace conelight::c {

// Structs of the version without coat and sheen are taken, too.
void assign(Material& material, const conelight_material* values, const char* what);
void assign(Light& light, const conelight_light& values);
// Of the version without top_first, too; null: the defaults.
conelight_renderer_options optionsOf(const conelight_renderer_options* given);
Instance instanceOf(const conelight_instance& values);
Mesh meshOf(const conelight_mesh& values);
HostMesh hostMeshOf(const conelight_host_mesh& values);
HostTexture hostTextureOf(const conelight_host_texture& values);
Texture textureOf(const conelight_texture& values);
// Throws Error(Usage) for a camera that sees nothing.
Camera cameraOf(const conelight_camera& values);
conelight_light valuesOf(const Light& light);
conelight_instance valuesOf(const Instance& instance);
conelight_camera valuesOf(const Camera& camera);

glm::mat4 matrixOf(const float* columns);

}  // namespace conelight::c

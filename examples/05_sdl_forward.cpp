// SPDX-License-Identifier: MIT
// A forward renderer in an SDL2 window, with shaders of its own that look indirect light up where they shade: no
// G-buffer is handed over. A box rises, and another one comes.
//   example_05_sdl_forward [OUT.png]
// With OUT.png it draws 48 frames, writes the last and ends; it needs no display then.
#include <conelight/light_field.h>

#include <cstdio>
#include <glm/gtc/matrix_transform.hpp>
#include <vector>

#include "host_renderer.h"
#include "io/image_file.h"
#include "io/scene_file.h"
#include "sdl_window.h"

namespace {

constexpr int kWidth = 480, kHeight = 360;
constexpr conelight::LookupSlots kSlots{.firstBlock = 0, .firstTexture = 0};

// Of the lamp what arrives unshadowed, by a ray; of all other light what the library knows.
// [shader]
const char* const kForward = R"(
layout(location = 0) uniform mat4 worldFromObject;
layout(location = 1) uniform mat4 clipFromWorld;
#ifdef VERTEX
layout(location = 0) in vec3 position;
layout(location = 0) out vec3 world;
void main() { gl_Position = clipFromWorld * vec4(world = (worldFromObject * vec4(position, 1)).xyz, 1); }
#else
layout(location = 2) uniform vec3 albedo;
layout(location = 3) uniform vec3 lamp;
layout(location = 4) uniform vec3 intensity;
layout(location = 0) in vec3 world;
layout(location = 0) out vec4 color;
void main() {
    vec3 normal = normalize(cross(dFdx(world), dFdy(world)));
    vec3 start = world + 0.3 * conelight_voxelSize(world) * normal;
    vec3 toLamp = lamp - start;
    float met;
    conelight_trace(start, toLamp, met);
    bool seen = met < 0 || met > length(toLamp);
    vec3 light = conelight_irradiance(world, normal);
    if (seen) light += intensity / 3.14159 * max(dot(normal, normalize(toLamp)), 0) / dot(toLamp, toLamp);
    color = vec4(pow(1 - exp(-albedo * light), vec3(1 / 2.2)), 1);
}
#endif
)";
// [/shader]

void draw(const Host& host, GLuint program, const conelight::Scene& scene, const glm::mat4& clipFromWorld) {
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glEnable(GL_DEPTH_TEST);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glUseProgram(program);
    glUniformMatrix4fv(1, 1, GL_FALSE, &clipFromWorld[0][0]);
    glUniform3fv(3, 1, &scene.lights[0].position[0]);
    glUniform3fv(4, 1, &scene.lights[0].intensity[0]);
    host.drawInstances(scene);
}

void run(const char* path, const Window& window) {
    conelight::Scene scene = conelight::io::loadScene("builtin:cornell-point");
    const conelight::Camera& camera = scene.cameras[0];
    const glm::mat4 clipFromWorld =
        glm::perspective(camera.fovY, float(kWidth) / float(kHeight), 0.05f, 20.0f) *
        glm::lookAt(camera.eye, camera.target, camera.up);
    const Host host(kWidth, kHeight);
    // [frame]
    const GLuint program = programOf("#version 450 core\n" + conelight::lookupsGlsl(kSlots) + kForward);
    conelight::LightField field;
    conelight::Settings settings = conelight::realtimeSettings();
    settings.voxels.size = 48;
    field.setSettings(settings);
    field.setScene(scene);
    field.update({.updates = 8});  // while loading
    const std::size_t box = scene.instances.size() - 1;
    conelight::Instance guest = scene.instances[box];
    guest.worldFromObject = glm::translate(glm::mat4(1), {-0.3f, 0.5f, -0.2f}) *
                            glm::scale(guest.worldFromObject, glm::vec3(0.4f));
    for (int frame = 0; path == nullptr || frame < 48; ++frame) {
        if (frame < 24) scene.instances[box].worldFromObject[3].y += 0.004f;
        field.setInstance(box, scene.instances[box]);
        if (frame == 20) scene.instances.push_back(guest), field.addInstance(guest);
        field.update({.updates = 4, .milliseconds = 30});
        field.bindLookups(kSlots);
        draw(host, program, scene, clipFromWorld);
        // [/frame]
        if (path == nullptr && !window.show()) return;
    }
    conelight::io::writePng(path, {kWidth, kHeight, 3, shownPixels(kWidth, kHeight)});
    std::printf("picture at %s\n", path);
}

}  // namespace

int main(int argc, char** argv) try {
    const Window window("Forward", kWidth, kHeight, SDL_GL_CONTEXT_PROFILE_CORE);
    run(argc > 1 ? argv[1] : nullptr, window);
    return 0;
} catch (const conelight::Error& error) {
    std::fprintf(stderr, "05_sdl_forward: %s\n", error.what());
    return 1;
}

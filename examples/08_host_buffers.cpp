// SPDX-License-Identifier: MIT
// A mesh that never leaves the GPU: a compute shader of the host bends a glowing blob in the host's own buffer. The
// light field reads it there. example_08_host_buffers [OUT.png] writes the last frame.
#include <conelight/error.h>
#include <conelight/light_field.h>

#include <cstdio>
#include <glm/gtc/matrix_transform.hpp>

#include "host_renderer.h"
#include "io/image_file.h"
#include "io/scene_file.h"
#include "platform/headless_context.h"

namespace {

constexpr int kWidth = 320, kHeight = 240, kColumns = 96, kRows = 48;
constexpr int kVertices = (kColumns + 1) * (kRows + 1), kIndices = 6 * kColumns * kRows;
const glm::vec3 kGlow{8, 5, 2};

const char* const kBend = R"(#version 450 core
layout(local_size_x = 64) in;
layout(location = 0) uniform float time;
layout(std430, binding = 0) writeonly buffer Vertices { vec4 vertices[]; };
void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= 97u * 49u) return;
    vec2 turn = vec2(i % 97u, i / 97u) / vec2(96, 48) * vec2(6.28319, 3.14159);
    vec3 outward = vec3(sin(turn.x) * sin(turn.y), cos(turn.y), cos(turn.x) * sin(turn.y));
    float wave = sin(5 * outward.x + time) + sin(6 * outward.y - 2 * time) + sin(5 * outward.z + 3 * time);
    vertices[i] = vec4((0.22 + 0.045 * wave) * outward, 1);
}
)";
const char* const kGlowing = R"(#version 450 core
#ifdef VERTEX
layout(location = 0) in vec3 position;
layout(location = 0) uniform mat4 worldFromObject;
layout(location = 1) uniform mat4 clipFromWorld;
void main() { gl_Position = clipFromWorld * vec4((worldFromObject * vec4(position, 1)).xyz, 1); }
#else
layout(location = 2) uniform vec3 glow;
layout(location = 0) out vec4 radiance;
void main() { radiance = vec4(glow, 1); }
#endif
)";

// Quads whose corners a shader places.
struct Blob {
    GLuint buffers[2] = {}, bend = 0, glowing = programOf(kGlowing);

    Blob() {
        std::vector<std::uint32_t> indices;
        for (std::uint32_t row = 0; row < kRows; ++row)
            for (std::uint32_t column = 0; column < kColumns; ++column) {
                const std::uint32_t a = row * (kColumns + 1) + column, below = a + kColumns + 1;
                indices.insert(indices.end(), {a, below, a + 1, a + 1, below, below + 1});
            }
        glCreateBuffers(2, buffers);
        glNamedBufferStorage(buffers[0], 16 * kVertices, nullptr, 0);
        glNamedBufferStorage(buffers[1], 4 * kIndices, indices.data(), 0);
        bend = glCreateShaderProgramv(GL_COMPUTE_SHADER, 1, &kBend);
    }
    void move(float time) const {
        glUseProgram(bend);
        glUniform1f(0, time);
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, buffers[0]);
        glDispatchCompute((kVertices + 63) / 64, 1, 1);
        glMemoryBarrier(GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT);
    }
    void draw(const Host& host, GLuint framebuffer) const {
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
        glEnable(GL_DEPTH_TEST);
        glVertexArrayVertexBuffer(host.array, 0, buffers[0], 0, 16);
        glVertexArrayElementBuffer(host.array, buffers[1]);
        glDrawElements(GL_TRIANGLES, kIndices, GL_UNSIGNED_INT, nullptr);
    }
};

void drawFrames(const Host& host, conelight::Scene& scene) {
    const conelight::Camera& camera = scene.cameras[0];
    const Blob blob;
    scene.lights[0].intensity *= 0.02f;
    conelight::LightField field;
    conelight::Settings settings = conelight::realtimeSettings();
    settings.voxels.size = 64;
    field.setSettings(settings);
    field.setScene(scene);
    // [blob]
    conelight::HostMesh mesh;
    mesh.vertexCount = kVertices;
    mesh.indexCount = kIndices;
    mesh.positions = {.buffer = blob.buffers[0], .offset = 0, .stride = 16};
    mesh.indices = blob.buffers[1];
    mesh.bounds = {glm::vec3(-0.4f), glm::vec3(0.4f)};  // whatever shape it takes
    blob.move(0);
    const conelight::Material material{.emission = kGlow};
    conelight::Instance instance;
    instance.mesh = int(field.addMesh(mesh));
    instance.material = int(field.addMaterial(material));
    instance.worldFromObject = glm::translate(glm::mat4(1), scene.bounds().center() + glm::vec3(0, 0.1f, 0)) *
                               glm::scale(glm::mat4(1), glm::vec3(0.4f));
    field.addInstance(instance);
    // [/blob]
    const int view = field.addView();
    conelight::HostSurfaces surfaces{
        .width = kWidth, .height = kHeight, .depth = host.depth, .normal = host.normal};
    surfaces.viewFromWorld = glm::lookAt(camera.eye, camera.target, camera.up);
    surfaces.clipFromView = glm::perspective(camera.fovY, float(kWidth) / float(kHeight), 0.05f, 20.0f);
    const glm::mat4 clipFromWorld = surfaces.clipFromView * surfaces.viewFromWorld;
    for (int frame = 1; frame <= 24; ++frame) {
        // [frame]
        blob.move(0.05f * float(frame));                  // the host's compute shader
        field.setMesh(std::size_t(instance.mesh), mesh);  // read where it lies
        field.update({.updates = 8});
        // [/frame]
        host.drawSurfaces(scene, clipFromWorld);
        glUniformMatrix4fv(0, 1, GL_FALSE, &instance.worldFromObject[0][0]);
        blob.draw(host, host.target[0]);
        host.drawPicture(scene.lights[0], clipFromWorld, field.gather(view, surfaces).diffuse);
        glUseProgram(blob.glowing);
        glUniformMatrix4fv(0, 1, GL_FALSE, &instance.worldFromObject[0][0]);
        glUniformMatrix4fv(1, 1, GL_FALSE, &clipFromWorld[0][0]);
        glUniform3fv(2, 1, &kGlow[0]);
        blob.draw(host, host.target[1]);
    }
}

}  // namespace

int main(int argc, char** argv) try {
    const char* path = argc > 1 ? argv[1] : "08_host_buffers.png";
    const conelight::platform::HeadlessContext context;
    conelight::Scene scene = conelight::io::loadScene("builtin:cornell-point");
    Host host(kWidth, kHeight);
    host.split = 0;
    glNamedFramebufferTexture(host.target[1], GL_DEPTH_ATTACHMENT, host.depth, 0);
    glDepthFunc(GL_LEQUAL);
    drawFrames(host, scene);
    conelight::Image image{kWidth, kHeight, std::vector<glm::vec4>(std::size_t(kWidth * kHeight))};
    for (int y = 0; y < kHeight; ++y)  // the first row on top
        glGetTextureSubImage(host.picture, 0, 0, kHeight - 1 - y, 0, kWidth, 1, 1, GL_RGBA, GL_FLOAT,
                             16 * kWidth, &image.pixels[y * kWidth]);
    conelight::io::writePng(path, {kWidth, kHeight, 3, conelight::toneMapped(image, {})});
    std::printf("picture at %s\n", path);
    return 0;
} catch (const conelight::Error& error) {
    std::fprintf(stderr, "08_host_buffers: %s\n", error.what());
    return 1;
}

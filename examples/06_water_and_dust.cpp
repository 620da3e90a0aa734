// SPDX-License-Identifier: MIT
// Water and dust, which are in no G-buffer, look their light up in their own shaders. The room behind them is drawn
// as in example 04.
//   example_06_water_and_dust [OUT.png]
#include <conelight/error.h>
#include <conelight/light_field.h>

#include <cstdio>
#include <glm/gtc/matrix_transform.hpp>
#include <random>

#include "host_renderer.h"
#include "io/image_file.h"
#include "io/scene_file.h"
#include "platform/headless_context.h"

namespace {

constexpr int kWidth = 480, kHeight = 360, kGrains = 1500;
constexpr conelight::LookupSlots kSlots{.firstBlock = 2, .firstTexture = 4};

// A square, with waves in its normal. Mirrored light by Schlick's share, and what the ray meets that goes on.
// [water]
const char* const kWater = R"(
layout(location = 0) uniform mat4 clipFromWorld;
layout(location = 1) uniform vec3 eye;
layout(location = 2) uniform vec4 level;  // middle and half edge
#ifdef VERTEX
layout(location = 0) out vec3 world;
void main() {
    vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2 - 1;
    gl_Position = clipFromWorld * vec4(world = level.xyz + level.w * vec3(corner.x, 0, -corner.y), 1);
}
#else
layout(location = 0) in vec3 world;
layout(location = 0) out vec4 radiance;
void main() {
    vec2 slope = 0.04 * vec2(sin(61 * world.x + 23 * world.z), sin(47 * world.z - 31 * world.x));
    vec3 normal = normalize(vec3(-slope.x, 1, -slope.y));
    vec3 ray = normalize(world - eye);
    float share = 0.02 + 0.98 * pow(1 - max(dot(-ray, normal), 0), 5);
    float depth;
    vec3 below = conelight_trace(world, refract(ray, normal, 1 / 1.33), depth);
    vec3 through = below * exp(-max(depth, 0) * vec3(2.0, 0.5, 0.3));
    radiance = vec4(mix(through, conelight_trace(world, reflect(ray, normal)), share), 1);
}
#endif
)";
// [/water]

// The vertex shader asks for the light of a grain: from all sides, and of the lamp where a ray reaches it.
// [dust]
const char* const kDust = R"(
#ifdef VERTEX
layout(location = 0) uniform mat4 clipFromWorld;
layout(location = 1) uniform vec3 lamp;
layout(location = 2) uniform vec3 intensity;
layout(location = 0) in vec3 grain;
layout(location = 0) flat out vec3 light;
void main() {
    vec3 toLamp = lamp - grain;
    float met;
    conelight_trace(grain, toLamp, met);
    bool seen = met < 0 || met > length(toLamp);
    light = conelight_irradiance(grain, vec3(0));
    if (seen) light += intensity / (4 * 3.14159) / dot(toLamp, toLamp);
    gl_Position = clipFromWorld * vec4(grain, 1);
    gl_PointSize = 2;
}
#else
layout(location = 0) flat in vec3 light;
layout(location = 0) out vec4 radiance;
void main() { radiance = vec4(light, 0.6); }
#endif
)";
// [/dust]

// In the air between the walls.
GLuint grainsIn(const conelight::Aabb& room) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> share(0.05f, 0.95f);
    std::vector<glm::vec3> grains(kGrains);
    for (glm::vec3& grain : grains)
        grain = room.min + glm::vec3(share(random), share(random), share(random)) * room.extent();
    GLuint buffer = 0;
    glCreateBuffers(1, &buffer);
    glNamedBufferStorage(buffer, GLsizeiptr(12 * grains.size()), grains.data(), 0);
    return buffer;
}

void drawOver(const Host& host, const conelight::Scene& scene, const glm::mat4& clipFromWorld) {
    const conelight::Aabb room = scene.bounds();
    const std::string head = "#version 450 core\n" + conelight::lookupsGlsl(kSlots);
    glNamedFramebufferTexture(host.target[1], GL_DEPTH_ATTACHMENT, host.depth, 0);
    glEnable(GL_DEPTH_TEST);
    glEnable(GL_PROGRAM_POINT_SIZE);
    glVertexArrayVertexBuffer(host.array, 0, grainsIn(room), 0, 12);
    glUseProgram(programOf(head + kWater));
    glUniformMatrix4fv(0, 1, GL_FALSE, &clipFromWorld[0][0]);
    glUniform3fv(1, 1, &scene.cameras[0].eye[0]);
    const glm::vec3 middle = room.center();
    glUniform4f(2, middle.x, room.min.y + 0.24f * room.extent().y, middle.z, 0.5f * room.extent().x);
    glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
    glUseProgram(programOf(head + kDust));
    glUniformMatrix4fv(0, 1, GL_FALSE, &clipFromWorld[0][0]);
    glUniform3fv(1, 1, &scene.lights[0].position[0]);
    glUniform3fv(2, 1, &scene.lights[0].intensity[0]);
    glEnable(GL_BLEND);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    glDrawArrays(GL_POINTS, 0, kGrains);
}

}  // namespace

int main(int argc, char** argv) try {
    const char* path = argc > 1 ? argv[1] : "06_water_and_dust.png";
    const conelight::platform::HeadlessContext context;
    conelight::Scene scene = conelight::io::loadScene("builtin:cornell-point");
    conelight::Camera& camera = scene.cameras[0];
    camera.eye.y = 0.85f, camera.target.y = 0.0f;
    Host host(kWidth, kHeight);
    host.split = 0;
    conelight::LightField field;
    field.setScene(scene);
    field.update({.updates = 32});
    conelight::HostSurfaces surfaces{
        .width = kWidth, .height = kHeight, .depth = host.depth, .normal = host.normal};
    surfaces.viewFromWorld = glm::lookAt(camera.eye, camera.target, camera.up);
    surfaces.clipFromView = glm::perspective(camera.fovY, float(kWidth) / float(kHeight), 0.05f, 20.0f);
    const glm::mat4 clipFromWorld = surfaces.clipFromView * surfaces.viewFromWorld;
    host.drawSurfaces(scene, clipFromWorld);
    const int view = field.addView();
    for (int pass = 0; pass < 16; ++pass) field.gather(view, surfaces);
    host.drawPicture(scene.lights[0], clipFromWorld, field.gather(view, surfaces).diffuse);
    field.bindLookups(kSlots);
    drawOver(host, scene, clipFromWorld);
    conelight::Image image{kWidth, kHeight, std::vector<glm::vec4>(std::size_t(kWidth * kHeight))};
    glGetTextureImage(host.picture, 0, GL_RGBA, GL_FLOAT, GLsizei(16 * image.pixels.size()),
                      image.pixels.data());
    for (int y = 0; y < kHeight / 2; ++y)  // the first row on top
        std::swap_ranges(&image.pixels[y * kWidth], &image.pixels[(y + 1) * kWidth],
                         &image.pixels[(kHeight - 1 - y) * kWidth]);
    const conelight::ImageSettings look{.exposure = {false, -1.0f}};
    conelight::io::writePng(path, {kWidth, kHeight, 3, conelight::toneMapped(image, look)});
    std::printf("picture at %s\n", path);
    return 0;
} catch (const conelight::Error& error) {
    std::fprintf(stderr, "06_water_and_dust: %s\n", error.what());
    return 1;
}

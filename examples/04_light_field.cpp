// SPDX-License-Identifier: MIT
// Indirect light for a renderer of one's own: this one draws depth, normals and colours with its own shaders,
// asks a LightField what arrives at each pixel, and shades. A box rises while frames pass.
//   example_04_light_field [OUT.png]
// Writes the last frame: to the left without, to the right with indirect light.
#include <conelight/error.h>
#include <conelight/light_field.h>
#include <epoxy/gl.h>

#include <cstdio>
#include <glm/gtc/matrix_transform.hpp>

#include "io/image_file.h"
#include "io/scene_file.h"
#include "platform/headless_context.h"

namespace {

constexpr int kWidth = 320, kHeight = 240;

const char* const kSurfaces = R"(#version 450 core
#ifdef VERTEX
layout(location = 0) in vec3 position;
layout(location = 0) out vec3 world;
layout(location = 0) uniform mat4 worldFromObject;
layout(location = 1) uniform mat4 clipFromWorld;
void main() { world = (worldFromObject * vec4(position, 1)).xyz; gl_Position = clipFromWorld * vec4(world, 1); }
#else
layout(location = 0) in vec3 world;
layout(location = 0) out vec4 normal;
layout(location = 1) out vec4 albedo;
layout(location = 2) uniform vec3 color;
void main() { normal = vec4(normalize(cross(dFdx(world), dFdy(world))), 1); albedo = vec4(color, 1); }
#endif
)";
const char* const kShade = R"(#version 450 core
#ifdef VERTEX
void main() { gl_Position = vec4(4 * (gl_VertexID & 1) - 1, 2 * (gl_VertexID & 2) - 1, 0, 1); }
#else
layout(binding = 0) uniform sampler2D depth;
layout(binding = 1) uniform sampler2D normal;
layout(binding = 2) uniform sampler2D albedo;
layout(binding = 3) uniform sampler2D indirect;
layout(location = 0) uniform mat4 worldFromClip;
layout(location = 1) uniform vec3 lamp;
layout(location = 2) uniform vec3 intensity;
layout(location = 0) out vec4 radiance;
void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec2 size = vec2(textureSize(depth, 0));
    vec4 world = worldFromClip * vec4(vec3(gl_FragCoord.xy / size, texelFetch(depth, pixel, 0).x) * 2 - 1, 1);
    vec3 toLamp = lamp - world.xyz / world.w;
    float cosine = max(dot(texelFetch(normal, pixel, 0).xyz, normalize(toLamp)), 0);
    vec3 direct = intensity / 3.14159 * cosine / dot(toLamp, toLamp);
    vec3 light = direct + (pixel.x < size.x / 2 ? vec3(0) : texelFetch(indirect, pixel, 0).rgb);
    radiance = vec4(texelFetch(albedo, pixel, 0).rgb * light, 1);
}
#endif
)";

GLuint programOf(std::string text) {
    const GLuint program = glCreateProgram();
    for (const GLenum stage : {GL_VERTEX_SHADER, GL_FRAGMENT_SHADER}) {
        std::string source = text;
        if (stage == GL_VERTEX_SHADER) source.insert(source.find('\n') + 1, "#define VERTEX\n");
        const char* const data = source.c_str();
        const GLuint shader = glCreateShader(stage);
        glShaderSource(shader, 1, &data, nullptr);
        glCompileShader(shader);
        glAttachShader(program, shader);
    }
    glLinkProgram(program);
    return program;
}

GLuint textureOf(GLenum format) {
    GLuint texture = 0;
    glCreateTextures(GL_TEXTURE_2D, 1, &texture);
    glTextureStorage2D(texture, 1, format, kWidth, kHeight);
    return texture;
}

// What the host draws with.
struct Host {
    GLuint surfaces = programOf(kSurfaces), shade = programOf(kShade);
    GLuint depth = textureOf(GL_DEPTH_COMPONENT32F), normal = textureOf(GL_RGBA16F);
    GLuint albedo = textureOf(GL_RGBA8), picture = textureOf(GL_RGBA32F);
    GLuint target[2] = {}, array = 0;

    Host() {
        glCreateFramebuffers(2, target);
        glNamedFramebufferTexture(target[0], GL_DEPTH_ATTACHMENT, depth, 0);
        glNamedFramebufferTexture(target[0], GL_COLOR_ATTACHMENT0, normal, 0);
        glNamedFramebufferTexture(target[0], GL_COLOR_ATTACHMENT1, albedo, 0);
        const GLenum both[2] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
        glNamedFramebufferDrawBuffers(target[0], 2, both);
        glNamedFramebufferTexture(target[1], GL_COLOR_ATTACHMENT0, picture, 0);
        glCreateVertexArrays(1, &array);
        glEnableVertexArrayAttrib(array, 0);
        glVertexArrayAttribFormat(array, 0, 3, GL_FLOAT, GL_FALSE, 0);
        glBindVertexArray(array);
        glViewport(0, 0, kWidth, kHeight);
    }

    void drawSurfaces(const conelight::Scene& scene, const glm::mat4& clipFromWorld) const {
        glBindFramebuffer(GL_FRAMEBUFFER, target[0]);
        glEnable(GL_DEPTH_TEST);
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        glUseProgram(surfaces);
        glUniformMatrix4fv(1, 1, GL_FALSE, &clipFromWorld[0][0]);
        for (const conelight::Instance& instance : scene.instances) {
            const conelight::Mesh& mesh = scene.meshes[std::size_t(instance.mesh)];
            GLuint buffers[2];
            glCreateBuffers(2, buffers);
            glNamedBufferStorage(buffers[0], GLsizeiptr(12 * mesh.positions.size()), mesh.positions.data(),
                                 0);
            glNamedBufferStorage(buffers[1], GLsizeiptr(4 * mesh.indices.size()), mesh.indices.data(), 0);
            glVertexArrayVertexBuffer(array, 0, buffers[0], 0, 12);
            glVertexArrayElementBuffer(array, buffers[1]);
            glUniformMatrix4fv(0, 1, GL_FALSE, &instance.worldFromObject[0][0]);
            glUniform3fv(2, 1, &scene.materials[std::size_t(instance.material)].baseColor[0]);
            glDrawElements(GL_TRIANGLES, GLsizei(mesh.indices.size()), GL_UNSIGNED_INT, nullptr);
            glDeleteBuffers(2, buffers);
        }
    }

    void drawPicture(const conelight::Light& lamp, const glm::mat4& clipFromWorld, GLuint indirect) const {
        const glm::mat4 worldFromClip = glm::inverse(clipFromWorld);
        glBindFramebuffer(GL_FRAMEBUFFER, target[1]);
        glDisable(GL_DEPTH_TEST);
        glUseProgram(shade);
        glUniformMatrix4fv(0, 1, GL_FALSE, &worldFromClip[0][0]);
        glUniform3fv(1, 1, &lamp.position[0]);
        glUniform3fv(2, 1, &lamp.intensity[0]);
        const GLuint read[4] = {depth, normal, albedo, indirect};
        glBindTextures(0, 4, read);
        glDrawArrays(GL_TRIANGLES, 0, 3);
    }
};

std::vector<glm::vec4> drawFrames(int frames) {
    conelight::Scene scene = conelight::io::loadScene("builtin:cornell-point");
    const conelight::Camera& camera = scene.cameras[0];
    const Host host;

    // [load]
    conelight::LightField field;
    field.setScene(scene);
    const int view = field.addView();
    conelight::HostSurfaces surfaces{.width = kWidth, .height = kHeight};
    surfaces.viewFromWorld = glm::lookAt(camera.eye, camera.target, camera.up);
    surfaces.clipFromView = glm::perspective(camera.fovY, float(kWidth) / float(kHeight), 0.05f, 20.0f);
    surfaces.depth = host.depth;
    surfaces.normal = host.normal;
    // [/load]
    const glm::mat4 clipFromWorld = surfaces.clipFromView * surfaces.viewFromWorld;
    const std::size_t box = scene.instances.size() - 1;
    for (int frame = 0; frame < frames; ++frame) {
        // [frame]
        scene.instances[box].worldFromObject[3].y += 0.004f;
        field.setInstance(box, scene.instances[box]);
        field.update({.updates = 2});  // of the light of all voxel faces
        host.drawSurfaces(scene, clipFromWorld);
        const conelight::GatheredLight light = field.gather(view, surfaces);  // a pass of rays
        host.drawPicture(scene.lights[0], clipFromWorld, light.diffuse);      // albedo * (direct + diffuse)
        // [/frame]
    }
    std::vector<glm::vec4> pixels(std::size_t(kWidth * kHeight));
    glGetTextureImage(host.picture, 0, GL_RGBA, GL_FLOAT, GLsizei(16 * pixels.size()), pixels.data());
    return pixels;
}

}  // namespace

int main(int argc, char** argv) try {
    const char* path = argc > 1 ? argv[1] : "04_light_field.png";
    const conelight::platform::HeadlessContext context;
    const std::vector<glm::vec4> pixels = drawFrames(24);
    conelight::Image image{kWidth, kHeight, {}};
    for (int y = kHeight - 1; y >= 0; --y)
        image.pixels.insert(image.pixels.end(), pixels.begin() + y * kWidth,
                            pixels.begin() + (y + 1) * kWidth);
    conelight::io::writePng(path, {kWidth, kHeight, 3, conelight::toneMapped(image, {})});
    std::printf("picture at %s\n", path);
    return 0;
} catch (const conelight::Error& error) {
    std::fprintf(stderr, "04_light_field: %s\n", error.what());
    return 1;
}

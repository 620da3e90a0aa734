// SPDX-License-Identifier: MIT
// A small renderer in OpenGL of a host, of which Conelight knows nothing: what examples are lit in.
#pragma once

#include <conelight/scene.h>
#include <epoxy/gl.h>

#include <cstdint>
#include <string>
#include <vector>

inline const char* const kSurfaces = R"(#version 450 core
#ifdef VERTEX
layout(location = 0) in vec3 position;
layout(location = 0) out vec3 world;
layout(location = 0) uniform mat4 worldFromObject;
layout(location = 1) uniform mat4 clipFromWorld;
void main() { gl_Position = clipFromWorld * vec4(world = (worldFromObject * vec4(position, 1)).xyz, 1); }
#else
layout(location = 0) in vec3 world;
layout(location = 0) out vec4 normal;
layout(location = 1) out vec4 albedo;
layout(location = 2) uniform vec3 color;
void main() { normal = vec4(normalize(cross(dFdx(world), dFdy(world))), 1); albedo = vec4(color, 1); }
#endif
)";
inline const char* const kShade = R"(#version 450 core
#ifdef VERTEX
void main() { gl_Position = vec4(4 * (gl_VertexID & 1) - 1, 2 * (gl_VertexID & 2) - 1, 0, 1); }
#else
layout(binding = 0) uniform sampler2D maps[4];  // depth, normal, albedo, indirect
layout(location = 0) uniform mat4 worldFromClip;
layout(location = 1) uniform vec3 lamp;
layout(location = 2) uniform vec3 intensity;
layout(location = 3) uniform float split;  // no indirect light left of it
layout(location = 0) out vec4 radiance;
void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec2 size = vec2(textureSize(maps[0], 0));
    vec4 world = worldFromClip * vec4(vec3(gl_FragCoord.xy / size, texelFetch(maps[0], pixel, 0).x) * 2 - 1, 1);
    vec3 toLamp = lamp - world.xyz / world.w;
    float cosine = max(dot(texelFetch(maps[1], pixel, 0).xyz, normalize(toLamp)), 0);
    vec3 light = intensity / 3.14159 * cosine / dot(toLamp, toLamp);
    if (pixel.x >= split * size.x) light += texelFetch(maps[3], pixel, 0).rgb;
    radiance = vec4(texelFetch(maps[2], pixel, 0).rgb * light, 1);
}
#endif
)";

inline GLuint programOf(std::string text) {
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

inline GLuint textureOf(GLenum format, int width, int height) {
    GLuint texture = 0;
    glCreateTextures(GL_TEXTURE_2D, 1, &texture);
    glTextureStorage2D(texture, 1, format, width, height);
    return texture;
}

// What the default framebuffer shows: r g b, first row on top.
inline std::vector<std::uint8_t> shownPixels(int width, int height) {
    const auto row = 3 * static_cast<std::size_t>(width);
    std::vector<std::uint8_t> rows(row * static_cast<std::size_t>(height)), picture;
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE, rows.data());
    for (std::size_t end = rows.size(); end > 0; end -= row)
        picture.insert(picture.end(), &rows[end - row], &rows[end - row] + row);
    return picture;
}

// Depth, normals and colours of a scene in textures, and a picture made of them.
struct Host {
    GLuint surfaces = programOf(kSurfaces), shade = programOf(kShade);
    GLuint depth, normal, albedo, picture;
    GLuint target[2] = {}, array = 0;
    float split = 0.5f;

    Host(int width, int height)
        : depth(textureOf(GL_DEPTH_COMPONENT32F, width, height)),
          normal(textureOf(GL_RGBA16F, width, height)),
          albedo(textureOf(GL_RGBA8, width, height)),
          picture(textureOf(GL_RGBA32F, width, height)) {
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
        glViewport(0, 0, width, height);
    }

    void drawSurfaces(const conelight::Scene& scene, const glm::mat4& clipFromWorld) const {
        glBindFramebuffer(GL_FRAMEBUFFER, target[0]);
        glEnable(GL_DEPTH_TEST);
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        glUseProgram(surfaces);
        glUniformMatrix4fv(1, 1, GL_FALSE, &clipFromWorld[0][0]);
        drawInstances(scene);
    }

    // With the program in use: its uniforms 0 and 2 are the matrix and the colour.
    void drawInstances(const conelight::Scene& scene) const {
        glBindVertexArray(array);
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
        glUniform1f(3, split);
        const GLuint read[4] = {depth, normal, albedo, indirect};
        glBindTextures(0, 4, read);
        glDrawArrays(GL_TRIANGLES, 0, 3);
    }
};

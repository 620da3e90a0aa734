// SPDX-License-Identifier: MIT
#include "support/light_field_rig.h"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "gl/gl.h"
#include "support/scenes.h"
#include "view/camera.h"

namespace conelight::test {

// A room of edge 2 without gloss, but for a box of white metal; boxes turned out of the grid's axes.
Scene hostRoom() {
    const Material wall = diffuseMaterial(glm::vec3(0.7f));
    Scene scene = closedBox(wall);
    scene.materials[0].baseColor = {0.8f, 0.1f, 0.1f, 1};
    scene.cameras.clear();
    Material metal;
    metal.baseColor = glm::vec4(1);
    metal.metallic = 1;
    metal.roughness = 0.3f;
    const auto placed = [](const glm::vec3& position, float angle) {
        return glm::translate(glm::mat4(1), position) * glm::rotate(glm::mat4(1), angle, glm::vec3(0, 1, 0)) *
               glm::scale(glm::mat4(1), glm::vec3(0.25f));
    };
    addInstance(scene, boxMesh(), metal, placed({-0.35f, -0.75f, -0.2f}, 0.4f));
    addInstance(scene, boxMesh(), wall, placed({0.45f, -0.75f, 0.1f}, -0.3f));
    scene.lights.push_back({.intensity = glm::vec3(1.5f), .position = {0.2f, 0.8f, 0.3f}});
    scene.cameras.push_back({.eye = {0.3f, 0.2f, 0.95f}, .target = {-0.1f, -0.4f, -1}, .fovY = 1.3f});
    return scene;
}

Settings hostSettings() {
    Settings settings = realtimeSettings();
    settings.traced.budgeted = false;
    settings.traced.passes = 4;
    settings.voxels.size = 32;
    settings.light.shadowSize = 256;
    return settings;
}

HostPicture::HostPicture(const Scene& scene, const glm::mat4& clipFromView, bool reversed)
    : reversed_(reversed),
      depth_({GL_TEXTURE_2D, GL_DEPTH_COMPONENT32F, kHostWidth, kHostHeight}, "host depth"),
      normal_({GL_TEXTURE_2D, GL_RGBA32F, kHostWidth, kHostHeight}, "host normal"),
      face_({GL_TEXTURE_2D, GL_RGBA32F, kHostWidth, kHostHeight}, "host face normal"),
      material_({GL_TEXTURE_2D, GL_RGBA32F, kHostWidth, kHostHeight}, "host material"),
      ids_({GL_TEXTURE_2D, GL_R32UI, kHostWidth, kHostHeight}, "host ids"),
      target_({&normal_, &face_, &material_, &ids_}, &depth_, "host") {
    surfaces_ = {.width = kHostWidth,
                 .height = kHostHeight,
                 .viewFromWorld = view::viewFromWorld(scene.cameras.front()),
                 .clipFromView = clipFromView,
                 .clipDepthZeroToOne = reversed,
                 .depth = depth_.name(),
                 .background = reversed ? 0.0f : 1.0f,
                 .normal = normal_.name(),
                 .geometricNormal = face_.name(),
                 .roughness = material_.name(),
                 .reflectance = 0,
                 .instances = ids_.name()};
    surfaces_.roughnessChannel = 3;
    surfaces_.reflectance = material_.name();
}

namespace {

struct Corner {
    glm::vec3 position;
    float roughness;
    glm::vec3 normal;
    std::uint32_t id;
};

std::vector<Corner> cornersOf(const Scene& scene) {
    std::vector<Corner> corners;
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        const Instance& instance = scene.instances[i];
        const Mesh& mesh = scene.meshes[static_cast<std::size_t>(instance.mesh)];
        const Material& material = scene.materials[static_cast<std::size_t>(instance.material)];
        for (std::size_t k = 0; k + 2 < mesh.indices.size(); k += 3) {
            glm::vec3 p[3];
            for (std::size_t c = 0; c < 3; ++c)
                p[c] =
                    glm::vec3(instance.worldFromObject * glm::vec4(mesh.positions[mesh.indices[k + c]], 1));
            const glm::vec3 n = glm::normalize(glm::cross(p[1] - p[0], p[2] - p[0]));
            const float roughness = material.metallic > 0 ? material.roughness : 1.0f;
            for (const glm::vec3& at : p)
                corners.push_back({at, roughness, n, static_cast<std::uint32_t>(i)});
        }
    }
    return corners;
}

const char* const kVertexShader = R"(#version 450 core
layout(location = 0) in vec3 position;
layout(location = 1) in float roughness;
layout(location = 2) in vec3 normal;
layout(location = 3) in uint id;
layout(location = 0) flat out vec4 facing;
layout(location = 1) flat out uint outId;
layout(std140) uniform HostBlock { mat4 clipFromWorld; };
void main() {
    gl_Position = clipFromWorld * vec4(position, 1.0);
    facing = vec4(normal, roughness);
    outId = id;
}
)";
const char* const kFragmentShader = R"(#version 450 core
layout(location = 0) flat in vec4 facing;
layout(location = 1) flat in uint id;
layout(location = 0) out vec4 outNormal;
layout(location = 1) out vec4 outFace;
layout(location = 2) out vec4 outMaterial;
layout(location = 3) out uint outId;
void main() {
    outNormal = vec4(facing.xyz, 1.0);
    outFace = outNormal;
    outMaterial = vec4(vec3(facing.w < 1.0 ? 1.0 : 0.0), facing.w);
    outId = id;
}
)";

}  // namespace

void HostPicture::draw(const Scene& scene, const gl::Program& program) {
    const std::vector<Corner> corners = cornersOf(scene);
    const gl::Buffer vertices(corners, "host vertices");
    const std::vector<std::uint32_t> none{0};
    const gl::VertexArray array(vertices, sizeof(Corner),
                                {{0, 3, GL_FLOAT, false, offsetof(Corner, position)},
                                 {1, 1, GL_FLOAT, false, offsetof(Corner, roughness)},
                                 {2, 3, GL_FLOAT, false, offsetof(Corner, normal)},
                                 {3, 1, GL_UNSIGNED_INT, true, offsetof(Corner, id)}},
                                gl::Buffer(none, "host indices"), "host");
    gl::RasterState state;
    state.framebuffer = &target_;
    state.reversedDepth = reversed_;
    gl::apply(state);
    for (const int attachment : {0, 1, 2}) target_.clearColor(attachment, 0, 0, 0, 0);
    target_.clearColorUint(3, 0);
    target_.clearDepth(reversed_ ? 0.0f : 1.0f);
    const glm::mat4 clip = surfaces_.clipFromView * surfaces_.viewFromWorld;
    const gl::Buffer block(&clip, sizeof clip, "host block");
    gl::Inputs inputs;
    program.use(inputs.uniform("HostBlock", block));
    array.bind();
    glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(corners.size()));
}

// relRMSE over the pixels that `counts` takes, by their instance.
double hostDifference(const std::vector<glm::vec4>& image, const std::vector<glm::vec4>& truth,
                      const PixelFilter& counts) {
    double squares = 0, sum = 0, pixels = 0;
    for (std::size_t i = 0; i < image.size(); ++i) {
        if (!counts(i)) continue;
        const glm::dvec3 d = glm::dvec3(image[i]) - glm::dvec3(truth[i]);
        squares += glm::dot(d, d) / 3;
        sum += (glm::dvec3(truth[i]).x + glm::dvec3(truth[i]).y + glm::dvec3(truth[i]).z) / 3;
        ++pixels;
    }
    return std::sqrt(squares / pixels) / (sum / pixels);
}

double hostMean(const std::vector<glm::vec4>& image) {
    double sum = 0;
    for (const glm::vec4& pixel : image) sum += static_cast<double>(pixel.r + pixel.g + pixel.b) / 3;
    return sum / static_cast<double>(image.size());
}

void LightFieldRig::SetUp() {
    GlTest::SetUp();
    addShader("test/host.vert.glsl", kVertexShader);
    addShader("test/host.frag.glsl", kFragmentShader);
}

glm::mat4 LightFieldRig::lens() const {
    return view::clipFromView(scene_.cameras.front(), kHostWidth, kHostHeight);
}

void LightFieldRig::drawn(HostPicture& host) {
    const gl::HostStateGuard guard;
    host.draw(scene_, programs().get({{"test/host.vert.glsl", "test/host.frag.glsl"}, {}}));
}

std::vector<glm::vec4> LightFieldRig::pixelsOf(std::uint32_t texture) {
    std::vector<glm::vec4> pixels(static_cast<std::size_t>(kHostWidth * kHostHeight));
    glGetTextureImage(texture, 0, GL_RGBA, GL_FLOAT, static_cast<GLsizei>(pixels.size() * sizeof pixels[0]),
                      pixels.data());
    return pixels;
}

std::vector<glm::vec4> LightFieldRig::diffuseOf(LightField& field, HostPicture& host) {
    return pixelsOf(field.gather(field.addView(), host.surfaces()).diffuse);
}

std::size_t LightFieldRig::instanceAt(std::size_t pixel) {
    if (ids_.empty()) {
        HostPicture host(scene_, lens());
        drawn(host);
        ids_.resize(static_cast<std::size_t>(kHostWidth * kHostHeight));
        glGetTextureImage(host.surfaces().instances, 0, GL_RED_INTEGER, GL_UNSIGNED_INT,
                          static_cast<GLsizei>(4 * ids_.size()), ids_.data());
    }
    return ids_[pixel];
}

PixelFilter LightFieldRig::onMetal(bool wanted) {
    return [this, wanted](std::size_t i) { return (instanceAt(i) == kHostMetal) == wanted; };
}

}  // namespace conelight::test

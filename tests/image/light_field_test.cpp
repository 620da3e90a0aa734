// SPDX-License-Identifier: MIT
// LightField: a host draws depth, normals and so on with shaders of its own; what it is told of the light at its
// pixels is what Renderer shows of the same scene.
#include "conelight/light_field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include <glm/gtc/matrix_transform.hpp>
#include "conelight/error.h"
#include "conelight/renderer.h"

#include "gl/draw.h"
#include "gl/gl.h"
#include "support/gl_fixture.h"
#include "support/scenes.h"
#include "view/camera.h"

namespace conelight::test {
namespace {

constexpr int kWidth = 60, kHeight = 44;
constexpr std::size_t kMetal = 6;  // instance of the box that mirrors

// A room of edge 2 without gloss, but for a box of white metal; boxes turned out of the grid's axes.
Scene roomScene() {
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

Settings smallSettings() {
    Settings settings = realtimeSettings();
    settings.traced.budgeted = false;
    settings.traced.passes = 4;
    settings.voxels.size = 32;
    settings.light.shadowSize = 256;
    return settings;
}

// What a host has: its own program, its own targets.
class Host {
  public:
    Host(const Scene& scene, const glm::mat4& clipFromView, bool reversed)
        : reversed_(reversed),
          depth_({GL_TEXTURE_2D, GL_DEPTH_COMPONENT32F, kWidth, kHeight}, "host depth"),
          normal_({GL_TEXTURE_2D, GL_RGBA32F, kWidth, kHeight}, "host normal"),
          face_({GL_TEXTURE_2D, GL_RGBA32F, kWidth, kHeight}, "host face normal"),
          material_({GL_TEXTURE_2D, GL_RGBA32F, kWidth, kHeight}, "host material"),
          ids_({GL_TEXTURE_2D, GL_R32UI, kWidth, kHeight}, "host ids"),
          target_({&normal_, &face_, &material_, &ids_}, &depth_, "host") {
        surfaces_ = {.width = kWidth,
                     .height = kHeight,
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
    void draw(const Scene& scene, const gl::Program& program);
    HostSurfaces& surfaces() { return surfaces_; }

  private:
    bool reversed_;
    gl::Texture depth_, normal_, face_, material_, ids_;
    gl::Framebuffer target_;
    HostSurfaces surfaces_;
};

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

void Host::draw(const Scene& scene, const gl::Program& program) {
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

// relRMSE over the pixels that `counts` takes, by their instance.
double difference(const std::vector<glm::vec4>& image, const std::vector<glm::vec4>& truth,
                  const std::function<bool(std::size_t)>& counts) {
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

double meanOf(const std::vector<glm::vec4>& image) {
    double sum = 0;
    for (const glm::vec4& pixel : image) sum += static_cast<double>(pixel.r + pixel.g + pixel.b) / 3;
    return sum / static_cast<double>(image.size());
}

class LightFieldTest : public GlTest {
  protected:
    void SetUp() override {
        GlTest::SetUp();
        addShader("test/host.vert.glsl", kVertexShader);
        addShader("test/host.frag.glsl", kFragmentShader);
    }
    glm::mat4 lens() const { return view::clipFromView(scene_.cameras.front(), kWidth, kHeight); }
    void drawn(Host& host) {
        const gl::HostStateGuard guard;
        host.draw(scene_, programs().get({{"test/host.vert.glsl", "test/host.frag.glsl"}, {}}));
    }
    static std::vector<glm::vec4> pixelsOf(std::uint32_t texture) {
        std::vector<glm::vec4> pixels(static_cast<std::size_t>(kWidth * kHeight));
        glGetTextureImage(texture, 0, GL_RGBA, GL_FLOAT,
                          static_cast<GLsizei>(pixels.size() * sizeof pixels[0]), pixels.data());
        return pixels;
    }
    // Irradiance over pi, and the radiance of lobes, as Renderer has them; the lowest row first.
    std::vector<glm::vec4> truth(const Settings& settings, Component component) {
        Renderer renderer;
        renderer.setScene(scene_);
        Settings shown = settings;
        shown.component = component;
        shown.light.emissiveQuads = false;
        renderer.render(scene_.cameras.front(), kWidth, kHeight, shown);
        const Image image = renderer.readImage();
        std::vector<glm::vec4> pixels;
        for (int y = kHeight - 1; y >= 0; --y)
            pixels.insert(pixels.end(), image.pixels.begin() + y * kWidth,
                          image.pixels.begin() + (y + 1) * kWidth);
        if (component == Component::Diffuse)
            for (std::size_t i = 0; i < pixels.size(); ++i)
                pixels[i] /= scene_.materials[instanceAt(i)].baseColor;
        return pixels;
    }
    // Of the host's picture, by casting nothing: read back once.
    std::size_t instanceAt(std::size_t pixel) {
        if (ids_.empty()) {
            Host host(scene_, lens(), false);
            drawn(host);
            ids_.resize(static_cast<std::size_t>(kWidth * kHeight));
            glGetTextureImage(host.surfaces().instances, 0, GL_RED_INTEGER, GL_UNSIGNED_INT,
                              static_cast<GLsizei>(4 * ids_.size()), ids_.data());
        }
        return ids_[pixel];
    }
    std::function<bool(std::size_t)> onMetal(bool wanted) {
        return [this, wanted](std::size_t i) { return (instanceAt(i) == kMetal) == wanted; };
    }

    Scene scene_ = roomScene();

  private:
    std::vector<std::uint32_t> ids_;
};

// The same pixels, drawn by others: differences are those of depths and rounding.
TEST_F(LightFieldTest, TellsWhatRendererShows) {
    const Settings settings = smallSettings();
    LightField field;
    field.setScene(scene_);
    field.setSettings(settings);
    field.update();
    Host host(scene_, lens(), false);
    drawn(host);
    const GatheredLight light = field.gather(field.addView(), host.surfaces());
    EXPECT_EQ(light.width, kWidth);
    const double diffuse =
        difference(pixelsOf(light.diffuse), truth(settings, Component::Diffuse), onMetal(false));
    const double specular =
        difference(pixelsOf(light.specular), truth(settings, Component::Specular), onMetal(true));
    RecordProperty("diffuse", std::to_string(diffuse));
    RecordProperty("specular", std::to_string(specular));
    EXPECT_LT(diffuse, 1e-3);
    EXPECT_LT(specular, 1e-3);
}

// Matrices of other kinds see the same: reversed and infinite depth in [0,1]; normals of triangles from depths.
TEST_F(LightFieldTest, TakesTheHostsMatrices) {
    LightField field;
    field.setScene(scene_);
    field.setSettings(smallSettings());
    field.update();
    Host plain(scene_, lens(), false);
    drawn(plain);
    const std::vector<glm::vec4> expected = pixelsOf(field.gather(field.addView(), plain.surfaces()).diffuse);

    glm::mat4 infinite = lens();
    infinite[2][2] = 0;
    infinite[3][2] = scene_.cameras.front().zNear;
    Host reversed(scene_, infinite, true);
    drawn(reversed);
    const auto all = [](std::size_t) { return true; };
    EXPECT_LT(difference(pixelsOf(field.gather(field.addView(), reversed.surfaces()).diffuse), expected, all),
              2e-3);

    plain.surfaces().geometricNormal = 0;
    EXPECT_LT(difference(pixelsOf(field.gather(field.addView(), plain.surfaces()).diffuse), expected, all),
              2e-2);
}

// With rays for a quarter of the pixels the others take what their neighbours found.
TEST_F(LightFieldTest, FillsInWhatIsReduced) {
    LightField field;
    field.setScene(scene_);
    field.setSettings(smallSettings());
    field.update();
    Host host(scene_, lens(), false);
    drawn(host);
    const std::vector<glm::vec4> whole = pixelsOf(field.gather(field.addView(), host.surfaces()).diffuse);
    for (const int reduction : {2, 3}) {
        const GatheredLight light = field.gather(field.addView(), host.surfaces(), {.reduction = reduction});
        EXPECT_EQ(light.height, kHeight);
        const double error = difference(pixelsOf(light.diffuse), whole, onMetal(false));
        RecordProperty("reduction" + std::to_string(reduction), std::to_string(error));
        EXPECT_LT(error, 0.09) << reduction;
    }
}

// By one update and one pass a call it comes to the same light, and follows a lamp that goes out.
TEST_F(LightFieldTest, ComesToTheSameByABudget) {
    const Settings finished = smallSettings();
    Settings budgeted = finished;
    budgeted.traced.budgeted = true;
    LightField field;
    field.setScene(scene_);
    field.setSettings(finished);
    field.update();
    Host host(scene_, lens(), false);
    drawn(host);
    const std::vector<glm::vec4> expected = pixelsOf(field.gather(field.addView(), host.surfaces()).diffuse);

    LightField slow;
    slow.setScene(scene_);
    slow.setSettings(budgeted);
    const int view = slow.addView();
    GatheredLight light;
    EXPECT_EQ(slow.update({.updates = 3}), 3);
    for (int frame = 0; frame < 40; ++frame) {
        slow.update({.updates = 2, .faces = 4000});
        light = slow.gather(view, host.surfaces());
    }
    EXPECT_LT(difference(pixelsOf(light.diffuse), expected, onMetal(false)), 0.05);

    slow.setLights({});
    for (int frame = 0; frame < 20; ++frame) {
        slow.update({.updates = 4});
        light = slow.gather(view, host.surfaces());
    }
    EXPECT_LT(meanOf(pixelsOf(light.diffuse)), 0.05 * meanOf(expected));
}

// The room bends: the light is that of a field which has never seen it straight.
TEST_F(LightFieldTest, FollowsMeshesThatBend) {
    const Settings settings = smallSettings();
    LightField field;
    field.setScene(scene_);
    field.setSettings(settings);
    field.update();
    for (glm::vec3& p : scene_.meshes[kMetal].positions) p.y = p.y > 0 ? 3 * p.y : p.y;
    field.setMesh(kMetal, scene_.meshes[kMetal]);
    field.update();
    Host host(scene_, lens(), false);
    drawn(host);
    const std::vector<glm::vec4> image = pixelsOf(field.gather(field.addView(), host.surfaces()).diffuse);
    LightField fresh;
    fresh.setScene(scene_);
    fresh.setSettings(settings);
    fresh.update();
    const auto all = [](std::size_t) { return true; };
    EXPECT_LT(difference(image, pixelsOf(fresh.gather(fresh.addView(), host.surfaces()).diffuse), all), 0.03);
}

// A normal that is not a number is that of the triangle.
TEST_F(LightFieldTest, TakesSliversWithoutNormals) {
    LightField field;
    field.setScene(scene_);
    field.setSettings(smallSettings());
    field.update();
    Host host(scene_, lens(), false);
    drawn(host);
    host.surfaces().roughness = 0;
    const std::vector<glm::vec4> expected = pixelsOf(field.gather(field.addView(), host.surfaces()).diffuse);
    host.surfaces().geometricNormal = host.surfaces().normal;
    const float nan[4] = {NAN, NAN, NAN, 1};
    gl::Texture none({GL_TEXTURE_2D, GL_RGBA32F, kWidth, kHeight}, "no normals");
    none.clear(0, GL_RGBA, GL_FLOAT, nan);
    host.surfaces().normal = none.name();
    const std::vector<glm::vec4> image = pixelsOf(field.gather(field.addView(), host.surfaces()).diffuse);
    EXPECT_LT(difference(image, expected, [](std::size_t) { return true; }), 1e-3);
}

TEST_F(LightFieldTest, SaysWhatIsWrong) {
    LightField field;
    const auto refused = [](const char* words, const std::function<void()>& call) {
        try {
            call();
            ADD_FAILURE() << "not refused: " << words;
        } catch (const Error& error) {
            EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
        }
    };
    HostSurfaces surfaces;
    refused("setScene before it", [&] { field.update(); });
    field.setScene(scene_);
    const int view = field.addView();
    refused("update before it", [&] { field.gather(view, surfaces); });
    field.setSettings(smallSettings());
    field.update();
    refused("no view 7", [&] { field.gather(7, surfaces); });
    refused("surfaces of 0 x 0", [&] { field.gather(view, surfaces); });
    Host host(scene_, lens(), false);
    drawn(host);
    refused("reduction of 5", [&] { field.gather(view, host.surfaces(), {.reduction = 5}); });
    surfaces = host.surfaces();
    surfaces.normal = 0;
    refused("no texture of normal", [&] { field.gather(view, surfaces); });
    surfaces = host.surfaces();
    surfaces.clipFromView = glm::mat4(1);
    refused("no perspective", [&] { field.gather(view, surfaces); });
    surfaces.clipFromView[0][0] = NAN;
    refused("no perspective", [&] { field.gather(view, surfaces); });
    refused("budget", [&] { field.update({.updates = -1}); });
    field.removeView(view);
    refused("no view", [&] { field.gather(view, host.surfaces()); });
    refused("no view", [&] { field.removeView(view); });
}

}  // namespace
}  // namespace conelight::test

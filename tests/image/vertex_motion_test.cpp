// SPDX-License-Identifier: MIT
// Means over frames follow surfaces whose vertices move: things that are moved by their vertices look as those that
// are moved by their instance, and shapes that bend get smooth edges.
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "support/traced_rig.h"

namespace conelight::test {
namespace {

using VertexMotionTest = TracedModeTest;

constexpr float kSlide = 0.02f;  // m a frame
constexpr int kSlides = 16;

Material unlit(const glm::vec3& radiance) {
    Material material;
    material.unlit = true;
    material.baseColor = glm::vec4(radiance, 1);
    return material;
}

// A room with a lamp and a turned box in it, which slides.
Scene slidingBox() {
    Scene scene = closedBox(diffuseMaterial(glm::vec3(0.7f)));
    Light light;
    light.position = {0.6f, 0.7f, 0.1f};
    light.intensity = glm::vec3(1);
    scene.lights = {light};
    const glm::mat4 turned = glm::rotate(glm::mat4(1), 0.5f, {0.2f, 1, 0.1f});
    addInstance(scene, boxMesh(), diffuseMaterial({0.9f, 0.6f, 0.4f}),
                glm::scale(glm::translate(glm::mat4(1), {-0.3f, -0.4f, -0.3f}) * turned, glm::vec3(0.3f)));
    return scene;
}

// Thin spokes before a dark wall, all in one mesh.
Scene spokesOfOneMesh() {
    Scene scene;
    addInstance(scene, quadMesh({-6, -6, -2}, {12, 0, 0}, {0, 12, 0}), unlit(glm::vec3(0.05f)));
    Mesh all;
    for (int i = 0; i < 7; ++i) {
        const float angle = 0.2f + 0.44f * static_cast<float>(i),
                    width = 0.1f + 0.03f * static_cast<float>(i);
        const glm::vec3 along(std::cos(angle), std::sin(angle), 0), across(-along.y, along.x, 0);
        const Mesh one = quadMesh(0.3f * along - 0.5f * width * across, 1.5f * along, width * across);
        const auto first = static_cast<std::uint32_t>(all.positions.size());
        all.positions.insert(all.positions.end(), one.positions.begin(), one.positions.end());
        all.normals.insert(all.normals.end(), one.normals.begin(), one.normals.end());
        for (const std::uint32_t index : one.indices) all.indices.push_back(first + index);
    }
    addInstance(scene, all, unlit({1, 0.8f, 0.6f}));
    scene.cameras = {{.eye = {0, 0, 4}, .fovY = 2 * std::atan(0.5f)}};
    return scene;
}

// Black and white.
Mesh stripedBall() {
    constexpr std::uint32_t kRows = 24, kColumns = 32;
    Mesh ball;
    for (std::uint32_t row = 0; row <= kRows; ++row)
        for (std::uint32_t column = 0; column <= kColumns; ++column) {
            const float down = 3.1415927f * static_cast<float>(row) / kRows;
            const float round = 6.2831853f * static_cast<float>(column) / kColumns;
            const glm::vec3 n(std::sin(down) * std::cos(round), std::cos(down),
                              std::sin(down) * std::sin(round));
            ball.positions.push_back(n);
            ball.normals.push_back(n);
            ball.colors.emplace_back(glm::vec3(column / 4 % 2 == 0 ? 1.0f : 0.1f), 1);
        }
    for (std::uint32_t row = 0; row < kRows; ++row)
        for (std::uint32_t column = 0; column < kColumns; ++column) {
            const std::uint32_t a = row * (kColumns + 1) + column, b = a + kColumns + 1;
            for (const std::uint32_t index : {a, a + 1, b, b, a + 1, b + 1}) ball.indices.push_back(index);
        }
    return ball;
}

enum class Moved { Whole, ByVertices };

// The last of some frames in which the scene's last instance slides.
Image slid(Scene scene, Moved how, const Settings& settings) {
    Renderer renderer;
    renderer.setScene(scene);
    Instance& instance = scene.instances.back();
    Mesh& mesh = scene.meshes[static_cast<std::size_t>(instance.mesh)];
    const glm::vec3 step = kSlide * glm::vec3(1, 0.3f, 0.4f);
    const glm::vec3 local = glm::inverse(glm::mat3(instance.worldFromObject)) * step;
    Image image;
    for (int i = 0; i < kSlides; ++i) {
        if (i > 0 && how == Moved::Whole) {
            instance.worldFromObject[3] += glm::vec4(step, 0);
            renderer.setInstance(scene.instances.size() - 1, instance);
        } else if (i > 0) {
            for (glm::vec3& position : mesh.positions) position += local;
            renderer.setMesh(static_cast<std::size_t>(instance.mesh), mesh);
        }
        renderer.render(scene.cameras.front(), kTracedPixels, kTracedPixels, settings);
        image = renderer.readImage();
    }
    return image;
}

Settings smooth(bool on) {
    Settings settings;
    settings.mode = Mode::Phong;
    settings.image.temporal = on ? Toggle::On : Toggle::Off;
    return settings;
}

TEST_F(VertexMotionTest, IndirectLightFollowsAsItFollowsInstances) {
    Settings settings = tracedSettings(Quality::Interactive, Component::Diffuse);
    settings.voxels.size = 24;
    settings.traced.budgeted = true;
    settings.traced.filterLevels = 0;
    // What faces keep goes by how far things have moved, which voxels do not know of vertices.
    settings.traced.bounces = 1;
    const Image whole = slid(slidingBox(), Moved::Whole, settings);
    const double apart = relRmse(slid(slidingBox(), Moved::ByVertices, settings), whole);
    RecordProperty("apart", std::to_string(apart));
    EXPECT_LT(apart, 0.01);
}

TEST_F(VertexMotionTest, EdgesFollowAsTheyFollowInstances) {
    const Image whole = slid(spokesOfOneMesh(), Moved::Whole, smooth(true));
    const double apart = relRmse(slid(spokesOfOneMesh(), Moved::ByVertices, smooth(true)), whole);
    RecordProperty("apart", std::to_string(apart));
    EXPECT_LT(apart, 0.001);
}

// A ball of many triangles turns by its vertices: their order in space, which they are stored in, changes. With normals of
// its own, and flat.
TEST_F(VertexMotionTest, VerticesAreKnownInWhateverOrder) {
    for (const bool flat : {false, true}) {
        const auto turned = [&](Moved how) {
            Scene scene;
            addInstance(scene, quadMesh({-6, -6, -2}, {12, 0, 0}, {0, 12, 0}), unlit(glm::vec3(0.05f)));
            Mesh ball = stripedBall();
            if (flat) ball.normals.clear();
            const Mesh rest = ball;
            addInstance(scene, ball, unlit(glm::vec3(1)));
            Renderer renderer;
            renderer.setScene(scene);
            Image image;
            for (int i = 0; i < kSlides; ++i) {
                const glm::mat4 turn =
                    glm::rotate(glm::mat4(1), 0.05f * static_cast<float>(i), glm::vec3(0.3f, 1, 0.6f));
                if (how == Moved::Whole) {
                    scene.instances.back().worldFromObject = turn;
                    renderer.setInstance(1, scene.instances.back());
                } else {
                    for (std::size_t v = 0; v < rest.positions.size(); ++v) {
                        ball.positions[v] = glm::vec3(turn * glm::vec4(rest.positions[v], 1));
                        if (!flat) ball.normals[v] = glm::mat3(turn) * rest.normals[v];
                    }
                    renderer.setMesh(1, ball);
                }
                renderer.render({.eye = {0, 0, 4}, .fovY = 0.7f}, kTracedPixels, kTracedPixels, smooth(true));
                image = renderer.readImage();
            }
            return image;
        };
        EXPECT_LT(relRmse(turned(Moved::ByVertices), turned(Moved::Whole)), 0.01) << flat;
    }
}

// Sheared by a tenth of a pixel a frame at the spokes' ends.
TEST_F(VertexMotionTest, EdgesOfWhatBendsAreSmooth) {
    const auto sheared = [](bool temporal, bool truth) {
        Scene scene = spokesOfOneMesh();
        Renderer renderer;
        renderer.setScene(scene);
        Mesh& mesh = scene.meshes.back();
        Settings settings = smooth(temporal);
        settings.image.antialiasing = truth ? 64 : 0;
        Image image;
        for (int i = 0; i < kSlides; ++i) {
            for (glm::vec3& position : mesh.positions) position.x += 0.005f * position.y;
            renderer.setMesh(scene.meshes.size() - 1, mesh);
            if (truth && i + 1 < kSlides) continue;
            renderer.render(scene.cameras.front(), kTracedPixels, kTracedPixels, settings);
            image = renderer.readImage();
        }
        return image;
    };
    const Image truth = sheared(false, true);
    const double with = relRmse(sheared(true, false), truth), without = relRmse(sheared(false, false), truth);
    RecordProperty("error", std::to_string(with) + ", without " + std::to_string(without));
    EXPECT_LT(with, 0.5 * without);
}

}  // namespace
}  // namespace conelight::test

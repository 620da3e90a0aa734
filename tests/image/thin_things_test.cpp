// SPDX-License-Identifier: MIT
// Mode `traced` where things are thinner, or closer together, than a voxel: what shuts a lamp in, the two
// sides of a bulb, folds of curtains, the gap below a board.
#include <glm/gtc/matrix_transform.hpp>

#include "io/generated.h"
#include "support/traced_rig.h"

namespace conelight::test {
namespace {

class ThinThings : public TracedModeTest {
  protected:
    double indirectMean(const Scene& scene, bool near = true, int voxels = 128) const {
        Settings settings = tracedSettings(Quality::Interactive, Component::Indirect);
        settings.voxels.size = voxels;
        settings.light.smallLamps = false;  // bulbs shine by their voxels
        settings.traced.exactNear = near;
        // A mean over pixels is asked for: with 4 passes it differs by 2 % from draw to draw, with 16 by 0.5 %.
        settings.traced.passes = 16;
        return meanOf(draw(scene, settings));
    }
};

// A closed pipe with walls of 3 mm lets nothing out, though pipe and bulb share their voxels.
TEST_F(ThinThings, ABulbWithinAPipeLightsNothing) {
    Scene hidden = io::generateScene("parlour?sun=0&sky=0&lamp=0&buried=100");
    Scene open = hidden;
    std::erase_if(open.instances, [](const Instance& i) { return i.name.find("stem") != std::string::npos; });
    ASSERT_LT(open.instances.size(), hidden.instances.size());
    EXPECT_LT(indirectMean(hidden, true, 80), 0.01 * indirectMean(open, true, 80));
}

// Two sides of a closed bulb shine as one does: what shines within meets the bulb.
TEST_F(ThinThings, ABulbOfTwoSidesIsNoBrighter) {
    Scene two = io::generateScene("parlour?sun=0&sky=0&lamp=120");
    Scene one = two;
    for (Material& material : one.materials)
        if (material.name == "bulb") material.doubleSided = false;
    EXPECT_NEAR(indirectMean(two, true, 80) / indirectMean(one, true, 80), 1.0, 0.05);
}

// A lamp hovers three quarters of a voxel below a ceiling, ten times as wide as the gap is high. Its light takes many turns
// to get out of the gap, but is not shut in: the ceiling is lit as if by an endless plane.
TEST_F(ThinThings, ALampBelowACeilingLightsIt) {
    Scene scene;
    addInstance(scene, quadMesh({-1, 1, -1}, {2, 0, 0}, {0, 0, 2}), diffuseMaterial(glm::vec3(0.5f)));
    Mesh lamp = boxMesh();
    for (glm::vec3& p : lamp.positions)
        p = p * glm::vec3(0.0625f, 0.01f, 0.0625f) + glm::vec3(0, 1 - 0.0125f - 0.01f, 0);
    addInstance(scene, lamp, diffuseMaterial(glm::vec3(0), glm::vec3(1)));
    Camera camera;
    camera.eye = {0, 0.994f, 0};
    camera.target = {0.01f, 1, 0};
    camera.fovY = 0.02f;
    scene.cameras = {camera};
    EXPECT_GT(indirectMean(scene), 0.8 * 0.5);
}

// Curtains beside a window, frames on a wall, skirting, a rug: rays that meet triangles near their start come
// closer to the path tracer than those that meet plane pieces alone.
TEST_F(ThinThings, FoldsAndFramesHideLight) {
    Scene scene = io::generateScene("parlour?lamp=0");
    Camera& camera = scene.cameras.at(0);
    camera.eye = {-1.2f, 1.5f, -0.5f};
    camera.target = {-2.2f, 1.45f, -1.3f};
    camera.fovY = 1.1f;
    reference::PathTracerSettings reference;
    reference.samplesPerPixel = 256;
    const reference::PathTracedPicture truth =
        reference::PathTracer(scene).render(scene.cameras.at(0), kTracedPixels, kTracedPixels, reference);
    Settings settings = tracedSettings(Quality::Interactive, Component::Indirect);
    settings.voxels.size = 128;
    settings.traced.passes = 96;
    settings.traced.cacheUpdates = 12;
    settings.traced.filterLevels = 0;
    const double near = indirectError(draw(scene, settings), truth);
    settings.traced.exactNear = false;
    const double far = indirectError(draw(scene, settings), truth);
    EXPECT_LT(near, 0.85 * far) << far;
}

// A board hovers half a voxel above a white floor under an even sky: the floor below it is dark, and a strip
// beside it as wide as the gap gets about half.
TEST_F(ThinThings, GapsBelowAVoxelAreDark) {
    Scene scene;
    addInstance(scene, quadMesh({-1, 0, 1}, {2, 0, 0}, {0, 0, -2}), diffuseMaterial(glm::vec3(0.5f)));
    Material board = diffuseMaterial(glm::vec3(0.05f));
    board.doubleSided = true;
    addInstance(scene, quadMesh({-0.5f, 0.008f, 0}, {1, 0, 0}, {0, 0, -0.8f}), board);
    scene.sky = glm::vec3(1);
    Camera camera;
    camera.eye = {0, 0.004f, 0.3f};
    camera.target = {0, 0.001f, 0};
    camera.fovY = 0.02f;  // the floor at the gap alone
    scene.cameras = {camera};
    const double open = indirectMean([&] {
        Scene without = scene;
        without.instances.pop_back();
        return without;
    }());
    EXPECT_LT(indirectMean(scene), 0.75 * open);
    EXPECT_GT(indirectMean(scene, false), 0.9 * open);
}

// A slope of boards with a gap, a roof closely above them, a dark room below. The sides of the gap share faces with what
// the sky lights, and are as dark as the room.
TEST_F(ThinThings, GapsBetweenBoardsAreDark) {
    Scene scene;
    const glm::mat4 slope = glm::rotate(glm::mat4(1), glm::radians(44.0f), {0, 0, 1});
    Material board = diffuseMaterial(glm::vec3(0.5f)), wall = diffuseMaterial(glm::vec3(0));
    board.doubleSided = wall.doubleSided = true;
    const auto addBoard = [&](float from, float to) {
        Mesh box = boxMesh();
        for (glm::vec3& p : box.positions)
            p = glm::mix(glm::vec3(from, 0, -1), glm::vec3(to, 0.022f, 1), 0.5f * p + 0.5f);
        addInstance(scene, box, board, slope);
    };
    addBoard(-1, -0.002f);
    addBoard(0.002f, 1);
    addInstance(scene, quadMesh({-1, 0.032f, 1}, {2, 0, 0}, {0, 0, -2}), board, slope);
    const glm::vec3 low(-1, -0.6f, -1), wide(2, 0, 0), high(0, 0.63f, 0), deep(0, 0, 2);
    const auto addWall = [&](const glm::vec3& corner, const glm::vec3& u, const glm::vec3& v) {
        addInstance(scene, quadMesh(corner, u, v), wall, slope);
    };
    addWall(low, wide, deep);
    addWall(low, wide, high);
    addWall(low + deep, wide, high);
    addWall(low, deep, high);
    addWall(low + wide, deep, high);
    scene.sky = glm::vec3(1);
    Camera camera;
    camera.eye = slope * glm::vec4(0.1f, -0.1f, 0, 1);
    camera.target = slope * glm::vec4(-0.002f, 0.0015f, 0, 1);
    camera.fovY = 0.006f;  // the side of the gap alone
    scene.cameras = {camera};
    EXPECT_LT(indirectMean(scene, true, 64), 0.01);
}

}  // namespace
}  // namespace conelight::test

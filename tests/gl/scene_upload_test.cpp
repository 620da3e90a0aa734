// SPDX-License-Identifier: MIT
// An edited session in a renderer that is sent what changed, against a renderer that is handed the whole
// scene.
#include "scene_upload.h"

#include <algorithm>
#include <cmath>

#include "conelight/error.h"
#include "conelight/renderer.h"
#include "io/scene_file.h"
#include "session/addition.h"
#include "session/material_edit.h"
#include "session/session.h"
#include "support/gl_fixture.h"

namespace conelight::test {
namespace {

class SceneUploadTest : public GlTest {
  protected:
    void SetUp() override {
        GlTest::SetUp();
        if (IsSkipped()) return;
        Scene scene = io::loadScene("builtin:cornell");
        completeScene(scene);
        settings.mode = Mode::Cones;
        settings.voxels.size = 32;
        settings.cones.bounces = 1;
        const Camera camera = scene.cameras.front();
        session = std::make_unique<program::Session>(std::move(scene), "builtin:cornell", settings, "cones",
                                                     camera);
        renderer = std::make_unique<Renderer>();
        renderer->setProfiling(true, false);
    }
    void TearDown() override {
        renderer.reset();
        GlTest::TearDown();
    }
    Image picture() {
        upload.follow(*renderer, *session);
        renderer->render(session->camera(), 48, 48, settings);
        return renderer->readImage();
    }
    Image pictureOfWhole() {
        Renderer whole;
        whole.setScene(session->scene());
        whole.render(session->camera(), 48, 48, settings);
        return whole.readImage();
    }
    std::size_t object(const std::string& name) const {
        const auto& all = session->scene().instances;
        return static_cast<std::size_t>(
            std::find_if(all.begin(), all.end(), [&](const Instance& one) { return one.name == name; }) -
            all.begin());
    }
    bool ran(const std::string& pass) const {
        const auto& passes = renderer->stats().passes;
        return std::any_of(passes.begin(), passes.end(),
                           [&](const PassStats& one) { return one.name.find(pass) != std::string::npos; });
    }
    static double distance(const Image& a, const Image& b) {
        double sum = 0;
        for (std::size_t i = 0; i < a.pixels.size(); ++i)
            sum += static_cast<double>(glm::length(glm::vec3(a.pixels[i] - b.pixels[i])));
        return sum / static_cast<double>(a.pixels.size());
    }
    void moveBlock() {
        Instance block = session->scene().instances[object("short block")];
        block.worldFromObject[3] += glm::vec4(0.05f, 0, 0, 0);
        session->setInstances({{object("short block"), block}}, "move");
    }

    Settings settings;
    program::SceneUpload upload;
    std::unique_ptr<program::Session> session;
    std::unique_ptr<Renderer> renderer;
};

TEST_F(SceneUploadTest, EditsShowAsIfTheWholeSceneWereUploaded) {
    Image before = picture();
    const auto expectFollowed = [&](const char* what) {
        const Image now = picture();
        EXPECT_GT(distance(before, now), 1e-3) << what << ": the picture changes";
        EXPECT_LT(distance(pictureOfWhole(), now), 1e-4) << what;
        before = now;
    };
    moveBlock();
    expectFollowed("instance");
    Material paint = session->scene().materials[0];
    paint.baseColor = {0.2f, 0.3f, 0.9f, 1};
    session->setMaterials({{0, paint}}, "paint");
    expectFollowed("material");
    Light lamp;
    lamp.type = LightType::Point;
    lamp.position = session->scene().bounds().center();
    lamp.intensity = glm::vec3(3);
    session->setLights({lamp}, "lamp");
    expectFollowed("lights");
    session->setSky({0.5f, 0.6f, 0.7f}, "sky");
    expectFollowed("sky");
    session->undo();
    session->undo();
    session->undo();
    session->undo();
    expectFollowed("undo of all");
}

TEST_F(SceneUploadTest, OnlyWhatChangedIsMadeAnew) {
    picture();
    EXPECT_TRUE(ran("voxelize")) << "the first picture builds the grid";
    picture();
    EXPECT_FALSE(ran("voxelize")) << "nothing changed";
    Light lamp;
    lamp.type = LightType::Point;
    lamp.position = session->scene().bounds().center();
    lamp.intensity = glm::vec3(3);
    session->setLights({lamp}, "lamp");
    picture();
    EXPECT_FALSE(ran("voxelize")) << "a light moves no surface";
    session->select({program::SelectionKind::Instance, 0});
    EXPECT_TRUE(upload.current(*session)) << "looking changes nothing";
    session->askForVoxels();
    picture();
    EXPECT_TRUE(ran("voxelize")) << "asked for";
}

// Shapes, copies and files go behind what the renderer has; the rest is not uploaded again.
TEST_F(SceneUploadTest, WhatIsAddedLeavesTheRestAsItIs) {
    picture();
    const auto expectAdded = [&](const char* what, bool inPlace = true) {
        renderer->setSky({0.25f, 0, 0});  // a whole scene would bring its own
        upload.follow(*renderer, *session);
        EXPECT_EQ(renderer->scene().sky.x, inPlace ? 0.25f : 0.0f) << what;
        renderer->setSky(session->scene().sky);
        EXPECT_LT(distance(pictureOfWhole(), picture()), 1e-4) << what;
    };
    program::addToScene(*session, program::shapeOf("sphere", 0.3f), {0, 0.6f, 0.2f}, "add");
    expectAdded("a shape");
    EXPECT_EQ(program::makeMaterialsSingle(*session, {object("short block")}), 1);
    expectAdded("a material");
    Scene file = program::shapeOf("box", 0.2f);
    file.textures.push_back({"red", 1, 1, true, {}, {}, {}, {200, 10, 10, 255}});
    file.materials[0].baseColorTexture.texture = 0;
    program::addToScene(*session, file, {0.3f, 0.7f, 0.3f}, "import");
    expectAdded("a file with a texture");
    session->undo();
    expectAdded("undo", false);
    // Another mesh in the place of one that is gone, between two pictures.
    program::addToScene(*session, program::shapeOf("box", 0.2f), {0.3f, 0.7f, 0.3f}, "add");
    session->undo();
    program::addToScene(*session, program::shapeOf("torus", 0.2f), {0.3f, 0.7f, 0.3f}, "add");
    expectAdded("the later one");
}

TEST_F(SceneUploadTest, WhatIsRefusedIsNotTriedAgainAndTheRestIsTaken) {
    picture();
    Instance bad = session->scene().instances[object("short block")];
    bad.worldFromObject[0][0] = std::nanf("");
    session->setInstances({{object("short block"), bad}}, "bad");
    session->setSky({1, 1, 1}, "sky");
    EXPECT_THROW(upload.follow(*renderer, *session), Error);
    EXPECT_NO_THROW(upload.follow(*renderer, *session));
    EXPECT_EQ(renderer->scene().sky, glm::vec3(1));
    session->undo();
    session->undo();
    EXPECT_NO_THROW(upload.follow(*renderer, *session));
    EXPECT_TRUE(upload.current(*session));
}

}  // namespace
}  // namespace conelight::test

// SPDX-License-Identifier: MIT
// Both execution profiles: passes as fragments and as compute draw the same picture.
#include <algorithm>

#include "conelight/quality.h"
#include "io/generated.h"
#include "support/light_field_rig.h"
#include "support/truth_rig.h"

namespace conelight::test {
namespace {

Image pictureBy(Execution execution, const Scene& scene, const Settings& settings) {
    Renderer renderer({"", true, execution});
    renderer.setScene(scene);
    renderer.render(scene.cameras.front(), 72, 54, settings);
    return renderer.readImage();
}

class ExecutionTest : public LightFieldRig {};

// Metal in a part of the picture, glass, a sky behind, parts alone: what a picture of mode traced is put together from.
// Fragments read lobes only where the picture has any, in a second draw: there a last bit may differ.
TEST_F(ExecutionTest, PicturesAreTheSame) {
    struct Case {
        const char* scene;
        Quality quality;
        Component component;
    };
    for (const Case& one : {Case{"spheres", Quality::Draft, Component::Full},
                            Case{"glass", Quality::Interactive, Component::Full},
                            Case{"yard", Quality::Draft, Component::Direct},
                            Case{"yard", Quality::Interactive, Component::Diffuse},
                            Case{"spheres", Quality::Interactive, Component::Specular}}) {
        const Scene scene = io::generateScene(one.scene);
        Settings settings;
        applyQuality(settings.traced, one.quality);
        settings.component = one.component;
        settings.voxels.size = 32;
        settings.traced.passes = 1;
        settings.traced.cacheUpdates = 2;
        settings.image.antialiasing = 0;
        const Image processor = pictureBy(Execution::Processor, scene, settings);
        const Image gpu = pictureBy(Execution::Gpu, scene, settings);
        EXPECT_LT(relRmse(gpu, processor), 1e-7) << one.scene << " " << static_cast<int>(one.component);
        EXPECT_GT(meanOf(gpu), 0.001);
    }
}

TEST_F(ExecutionTest, ConesAreTheSame) {
    const Scene scene = io::generateScene("spheres");
    Settings settings;
    settings.mode = Mode::Cones;
    settings.voxels.size = 32;
    settings.image.antialiasing = 0;
    EXPECT_EQ(pictureBy(Execution::Processor, scene, settings).pixels,
              pictureBy(Execution::Gpu, scene, settings).pixels);
}

TEST_F(ExecutionTest, LightForAHostIsTheSameBits) {
    std::vector<glm::vec4> diffuse, specular;
    for (const Execution execution : {Execution::Processor, Execution::Gpu}) {
        LightField field({"", true, execution});
        field.setScene(scene_);
        field.setSettings(hostSettings());
        field.update();
        HostPicture host(scene_, lens());
        drawn(host);
        const GatheredLight light = field.gather(field.addView(), host.surfaces());
        if (execution == Execution::Processor) {
            diffuse = pixelsOf(light.diffuse);
            specular = pixelsOf(light.specular);
            continue;
        }
        EXPECT_EQ(pixelsOf(light.diffuse), diffuse);
        EXPECT_EQ(pixelsOf(light.specular), specular);
    }
}

// Parts of meshes that the view sees, and six sides of lamps: a call for each, or for each change of state.
TEST_F(ExecutionTest, AGpuIsAskedOnceForDrawsOfOneState) {
    const Scene scene = io::generateScene("cafe");
    Settings settings;
    settings.mode = Mode::Phong;
    settings.image.antialiasing = 0;
    std::uint64_t calls = 0;
    std::vector<glm::vec4> pixels;
    for (const Execution execution : {Execution::Processor, Execution::Gpu}) {
        Renderer renderer({"", true, execution});
        renderer.setScene(scene);
        renderer.render(scene.cameras.front(), 72, 54, settings);
        if (execution == Execution::Processor) {
            calls = renderer.stats().drawCalls;
            pixels = renderer.readImage().pixels;
            continue;
        }
        EXPECT_GT(renderer.stats().drawCalls, 1u);
        EXPECT_LT(20 * renderer.stats().drawCalls, calls);
        EXPECT_EQ(renderer.readImage().pixels, pixels);
    }
}

// Counts stay on the GPU, or come a frame later. Finished pictures need those of faces that are sorted: until updates
// search no more, and again when it is known which lie inside of things.
TEST_F(ExecutionTest, FramesWaitForNothing) {
    struct Case {
        Mode mode;
        bool budgeted;
        std::uint64_t moving;  // waits of a frame in which something moves
    };
    for (const Case& one : {Case{Mode::Phong, false, 0}, Case{Mode::Traced, true, 0},
                            Case{Mode::Traced, false, 2}, Case{Mode::Cones, false, 0}}) {
        const Scene scene = io::generateScene("cornell?block=1");
        Renderer renderer({"", true, Execution::Gpu}), processor({"", true, Execution::Processor});
        renderer.setScene(scene);
        processor.setScene(scene);
        Settings settings;
        settings.mode = one.mode;
        applyQuality(settings.traced, Quality::Draft);
        settings.traced.budgeted = one.budgeted;
        settings.voxels.size = 16;
        settings.image.antialiasing = 0;
        Camera camera = scene.cameras.front();
        const auto draw = [&] {
            renderer.render(camera, 48, 36, settings);
            processor.render(camera, 48, 36, settings);
        };
        for (int i = 0; i < (one.budgeted ? 20 : 2); ++i) draw();
        EXPECT_EQ(renderer.stats().waits, 0u) << one.mode.name();
        camera.eye.x += 0.01f;
        draw();
        EXPECT_EQ(renderer.stats().waits, 0u) << one.mode.name();
        Instance moved = scene.instances.back();
        for (int i = 0; i < 3; ++i) {
            moved.worldFromObject[3].x += 0.05f;
            renderer.setInstance(scene.instances.size() - 1, moved);
            processor.setInstance(scene.instances.size() - 1, moved);
            draw();
            EXPECT_EQ(renderer.stats().waits, one.moving) << one.mode.name() << ", " << i;
            EXPECT_GE(processor.stats().waits, one.moving);
        }
        EXPECT_LT(relRmse(renderer.readImage(), processor.readImage()), 1e-7) << one.mode.name();
        draw();  // at rest again
        EXPECT_LT(relRmse(renderer.readImage(), processor.readImage()), 1e-7) << one.mode.name();
    }
}

// The same numbers as if each had been waited for, and the same light.
TEST_F(ExecutionTest, AFieldInMotionWaitsForNothing) {
    std::vector<std::vector<glm::vec4>> diffuse;
    std::vector<std::uint64_t> told;
    for (const Execution execution : {Execution::Processor, Execution::Gpu}) {
        LightField field({"", true, execution});
        field.setScene(scene_);
        Settings settings = realtimeSettings(Quality::Draft);
        settings.voxels.size = 16;
        field.setSettings(settings);
        HostPicture host(scene_, lens());
        drawn(host);
        host.surfaces().roughness = 0;  // no reflections
        const int view = field.addView();
        Instance moved = scene_.instances.back();
        std::vector<std::uint64_t> numbers;
        for (int i = 0; i < 6; ++i) {
            moved.worldFromObject[3].x += 0.04f;
            if (i < 4) field.setInstance(scene_.instances.size() - 1, moved);
            numbers.push_back(static_cast<std::uint64_t>(field.update()));
            const GatheredLight light = field.gather(view, host.surfaces());
            if (i > 0 && execution == Execution::Gpu) {
                EXPECT_EQ(field.stats().waits, 0u) << i;
            }
            if (i % 2 != 0)
                numbers.insert(numbers.end(),
                               {field.stats().voxels, field.stats().faces, field.stats().facesUpdated});
            if (i == 3 || i == 5) diffuse.push_back(pixelsOf(light.diffuse));
        }
        if (execution == Execution::Processor) {
            told = numbers;
        } else {
            EXPECT_EQ(numbers, told);
        }
    }
    EXPECT_EQ(diffuse[0], diffuse[2]);
    EXPECT_EQ(diffuse[1], diffuse[3]);
    EXPECT_NE(diffuse[0], diffuse[1]);
}

std::size_t programCount() {
    const std::vector<gl::LiveObject> all = gl::liveObjects();
    return static_cast<std::size_t>(std::count_if(all.begin(), all.end(), [](const gl::LiveObject& object) {
        return object.type == gl::ObjectType::Program;
    }));
}

// A GPU's driver takes seconds to build what a software driver would rather have for each number of lamps.
TEST_F(ExecutionTest, ALampMoreBuildsNoProgram) {
    for (const Execution execution : {Execution::Gpu, Execution::Processor}) {
        LightField field({"", true, execution});
        field.setScene(scene_);
        Settings settings = hostSettings();
        settings.voxels.size = 16;
        field.setSettings(settings);
        HostPicture host(scene_, lens());
        drawn(host);
        host.surfaces().roughness = 0;  // no reflections
        const int view = field.addView();
        const auto draw = [&](std::size_t lamps) {
            std::vector<Light> lights(lamps, scene_.lights.front());
            for (std::size_t i = 1; i < lamps; ++i) lights[i].position.x -= 0.1f * static_cast<float>(i);
            field.setLights(lights);
            field.update();
            field.gather(view, host.surfaces());
            return programCount();
        };
        const std::size_t one = draw(1);
        const bool counts = execution == Execution::Processor;
        EXPECT_EQ(draw(2) > one, counts);
        if (!counts) {
            EXPECT_EQ(draw(6), one);
        }
    }
}

}  // namespace
}  // namespace conelight::test

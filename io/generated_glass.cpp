// SPDX-License-Identifier: MIT
// Rooms with glass: solids that bend light, panes that let it through, clear, tinted and frosted.
#include "io/generated_textures.h"
#include "io/generated_trial_parts.h"

namespace conelight::io::generated {
namespace {

Material pane(std::string name, glm::vec3 tint, float roughness) {
    Material m = glossy(std::move(name), tint, roughness);
    m.transmission = 1;
    m.doubleSided = true;
    return m;
}

// `color`: of white light after so many metres.
Material solid(std::string name, glm::vec3 color, float metres) {
    Material m = pane(std::move(name), glm::vec3(0.98f), 0);
    m.doubleSided = false;
    m.thickness = 1;
    m.attenuationColor = color;
    m.attenuationDistance = metres;
    return m;
}

int tiledFloor(Scene& scene, float metres) {
    Material m = matte("tiles", glm::vec3(0.75f));
    m.baseColorTexture = repeat(add(scene, textures::tiles(256).color), metres);
    return add(scene, std::move(m));
}

}  // namespace

// A ball, a block and two panes in a closed room under a lamp.
Scene buildGlass(const Values& values) {
    Scene scene;
    const int pale = white(scene);
    const int red = add(scene, matte("red wall", {0.58f, 0.12f, 0.10f}));
    const int blue = add(scene, matte("blue wall", {0.12f, 0.24f, 0.52f}));
    addRoom(scene, {{-1.3f, 0, -1.3f}, {1.3f, 2, 1.5f}},
            {tiledFloor(scene, 0.9f), pale, red, blue, pale, pale});
    addPart(scene, quad({-0.35f, 1.97f, -0.5f}, {0.7f, 0, 0}, {0, 0, 0.7f}), "lamp",
            add(scene, emitter("lamp", float(values["emission"]) * glm::vec3(1.0f, 0.92f, 0.80f))));
    addPart(scene, sphere(0.33f, 96), "glass ball", add(scene, solid("clear glass", glm::vec3(1), 0)))
        .worldFromObject = translation({-0.55f, 0.33f, 0.1f});
    addPart(scene, box({{-0.17f, 0, -0.17f}, {0.17f, 0.6f, 0.17f}}), "glass block",
            add(scene, solid("green glass", {0.25f, 0.75f, 0.45f}, 0.25f)))
        .worldFromObject = translation({0.1f, 0.001f, -0.45f}) * turnAboutY(0.5f);
    addPart(scene, quad({0.35f, 0.0f, 0.25f}, {0.75f, 0, -0.35f}, {0, 0.9f, 0}), "amber pane",
            add(scene, pane("amber glass", {0.95f, 0.60f, 0.15f}, 0)));
    const float frost = float(values["frost"]);
    addPart(scene, quad({-1.15f, 0.0f, -0.75f}, {0.8f, 0, -0.25f}, {0, 1.2f, 0}), "frosted pane",
            add(scene, pane("frosted glass", glm::vec3(0.95f), frost)));
    addPart(scene, box({{-0.12f, 0, -0.12f}, {0.12f, 0.3f, 0.12f}}), "yellow block",
            add(scene, matte("yellow block", {0.70f, 0.55f, 0.12f})))
        .worldFromObject = translation({0.85f, 0, -0.55f}) * turnAboutY(0.3f);
    addPart(scene, box({{-0.1f, 0, -0.1f}, {0.1f, 0.8f, 0.1f}}), "dark post",
            add(scene, matte("dark post", {0.10f, 0.12f, 0.14f})))
        .worldFromObject = translation({-0.75f, 0, -1.1f});
    scene.cameras.push_back(camera("front", {0.15f, 1.05f, 1.42f}, {-0.05f, 0.5f, -0.6f}, 66));
    return scene;
}

// A room behind glass: windows and a skylight with panes, sun and sky outside, a bowl and a vase on a table.
Scene buildConservatory(const Values& values) {
    Scene scene;
    const int pale = white(scene);
    const int wood = add(scene, matte("wood", {0.42f, 0.27f, 0.16f}));
    const int sage = add(scene, matte("sage wall", {0.40f, 0.48f, 0.36f}));
    addRoom(scene, {{-2, 0, -1.8f}, {2, 2.4f, 2}}, {tiledFloor(scene, 1.4f), pale, pale, sage, pale, pale},
            {{{-1.5f, 0.7f, -2.2f}, {-0.3f, 2.0f, -1.7f}},
             {{0.3f, 0.7f, -2.2f}, {1.5f, 2.0f, -1.7f}},
             {{-0.8f, 2.2f, -0.9f}, {0.8f, 2.8f, 0.3f}}});
    const int clear = add(scene, pane("window", glm::vec3(0.98f), 0));
    const int tinted = add(scene, pane("rose window", {0.95f, 0.45f, 0.50f}, 0));
    addPart(scene, quad({-1.55f, 0.65f, -1.9f}, {1.3f, 0, 0}, {0, 1.4f, 0}), "left window", clear);
    addPart(scene, quad({0.25f, 0.65f, -1.9f}, {1.3f, 0, 0}, {0, 1.4f, 0}), "right window", tinted);
    addPart(scene, quad({-0.85f, 2.5f, 0.35f}, {1.7f, 0, 0}, {0, 0, -1.3f}), "skylight", clear);
    addPart(scene, box({{-0.7f, 0.66f, -0.4f}, {0.7f, 0.7f, 0.4f}}), "table top", wood);
    for (int i = 0; i < 4; ++i)
        addPart(scene, box({{-0.03f, 0, -0.03f}, {0.03f, 0.66f, 0.03f}}), "table leg", wood).worldFromObject =
            translation({i & 1 ? 0.62f : -0.62f, 0, i & 2 ? 0.32f : -0.32f});
    addPart(
        scene,
        turned(
            {shapes::line({0, 0}, {0.09f, 0}), shapes::arc({0.09f, 0.12f}, {0.11f, 0.12f}, -1.57f, 1.2f, 12),
             shapes::line({0.13f, 0.232f}, {0.09f, 0.34f}, 4), shapes::line({0.09f, 0.34f}, {0, 0.34f})},
            64),
        "vase", add(scene, solid("cobalt glass", {0.10f, 0.22f, 0.80f}, 0.15f)))
        .worldFromObject = translation({-0.3f, 0.701f, 0.05f});
    addPart(scene, sphere(0.11f, 64), "paperweight", add(scene, solid("crystal", glm::vec3(1), 0)))
        .worldFromObject = translation({0.28f, 0.811f, 0.1f});
    scene.lights.push_back(
        sunLight("sun", {0.35f, -0.75f, 0.56f}, float(values["sun"]) * glm::vec3(1.0f, 0.94f, 0.84f)));
    scene.sky = float(values["sky"]) * glm::vec3(0.58f, 0.77f, 1.0f);
    scene.cameras.push_back(camera("front", {0.9f, 1.35f, 1.92f}, {-0.1f, 0.85f, -0.8f}, 66));
    return scene;
}

}  // namespace conelight::io::generated

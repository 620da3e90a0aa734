// SPDX-License-Identifier: MIT
// Rooms with glass: solids that bend light, panes that let it through, clear, tinted and frosted.
#include <algorithm>
#include <cmath>

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

namespace {

int solidGlass(Scene& scene, const char* name, glm::vec3 color, float metres, float ior,
               float roughness = 0) {
    Material m = solid(name, color, metres);
    m.ior = ior;
    m.roughness = roughness;
    return add(scene, std::move(m));
}

Instance& stand(Scene& scene, Mesh mesh, const char* name, int material, glm::vec3 at) {
    Instance& thing = addPart(scene, std::move(mesh), name, material);
    thing.worldFromObject = translation(at);
    return thing;
}

void addGlasswareRoom(Scene& scene, const Values& values) {
    const int pale = white(scene);
    const int ochre = add(scene, matte("ochre wall", {0.60f, 0.42f, 0.20f}));
    const int teal = add(scene, matte("teal wall", {0.12f, 0.36f, 0.38f}));
    addRoom(scene, {{-1.6f, 0, -1.4f}, {1.6f, 2.2f, 1.9f}},
            {tiledFloor(scene, 0.8f), pale, ochre, teal, pale, pale});
    Material grain = matte("table top", {0.62f, 0.42f, 0.26f});
    grain.baseColorTexture = repeat(add(scene, textures::wood(256)), 0.5f);
    addPart(scene, box({{-0.9f, 0.66f, -0.5f}, {0.9f, 0.7f, 0.5f}}), "table top",
            add(scene, std::move(grain)));
    const int legs = add(scene, matte("table legs", {0.22f, 0.14f, 0.09f}));
    for (int i = 0; i < 4; ++i)
        addPart(scene, box({{-0.03f, 0, -0.03f}, {0.03f, 0.66f, 0.03f}}), "table leg", legs).worldFromObject =
            translation({i & 1 ? 0.8f : -0.8f, 0, i & 2 ? 0.42f : -0.42f});
    addPart(scene, quad({-0.4f, 2.17f, -0.5f}, {0.5f, 0, 0}, {0, 0, 0.5f}), "lamp",
            add(scene, emitter("lamp", float(values["emission"]) * glm::vec3(1.0f, 0.95f, 0.88f))));
    scene.lights.push_back(spotLight("spot", {1.4f, 1.9f, 1.2f}, {0.1f, 0.75f, 0}, 24,
                                     float(values["spot"]) * glm::vec3(1.0f, 0.82f, 0.62f)));
}

void addVessels(Scene& scene) {
    // Walls and bottom 6 mm thick; open at the top.
    stand(scene,
          turned({shapes::line({0, 0}, {0.05f, 0}), shapes::line({0.05f, 0}, {0.062f, 0.17f}, 6),
                  shapes::line({0.062f, 0.17f}, {0.056f, 0.17f}),
                  shapes::line({0.056f, 0.17f}, {0.045f, 0.012f}, 6),
                  shapes::line({0.045f, 0.012f}, {0, 0.012f})},
                 64),
          "tumbler", solidGlass(scene, "soda glass", glm::vec3(1), 0, 1.52f), {-0.62f, 0.7005f, 0.22f});
    stand(
        scene,
        turned({shapes::line({0, 0}, {0.11f, 0}), shapes::arc({0.11f, 0.09f}, {0.05f, 0.09f}, -1.57f, 0, 10),
                shapes::line({0.16f, 0.09f}, {0, 0.09f})},
               64),
        "water", solidGlass(scene, "water", {0.70f, 0.90f, 0.95f}, 0.5f, 1.33f), {-0.33f, 0.7005f, -0.18f});
    Mesh prism;
    shapes::appendHexahedron(prism, {glm::vec3(-0.11f, 0, -0.09f),
                                     {0.11f, 0, -0.09f},
                                     {-0.11f, 0.17f, -0.004f},
                                     {0.11f, 0.17f, -0.004f},
                                     {-0.11f, 0, 0.09f},
                                     {0.11f, 0, 0.09f},
                                     {-0.11f, 0.17f, 0.004f},
                                     {0.11f, 0.17f, 0.004f}});
    stand(scene, std::move(prism), "prism",
          solidGlass(scene, "amber flint", {0.95f, 0.70f, 0.25f}, 0.2f, 1.62f), {-0.13f, 0.7005f, 0.26f})
        .worldFromObject *= turnAboutY(0.35f);
    stand(scene, sphere(0.12f, 96), "flint ball", solidGlass(scene, "flint", glm::vec3(1), 0, 1.75f),
          {0.2f, 0.8201f, 0.16f});
}

void addBlocksAndPanes(Scene& scene) {
    stand(scene, box({{-0.09f, 0, -0.09f}, {0.09f, 0.18f, 0.09f}}), "violet cube",
          solidGlass(scene, "violet glass", {0.55f, 0.35f, 0.85f}, 0.15f, 1.5f), {0.52f, 0.7005f, 0.2f})
        .worldFromObject *= turnAboutY(0.6f);
    stand(scene, sphere(0.075f, 64), "frosted ball",
          solidGlass(scene, "frosted solid", glm::vec3(1), 0, 1.5f, 0.25f), {0.76f, 0.7751f, 0.3f});
    stand(scene,
          turned({shapes::line({0.14f, 0}, {0.14f, 0.16f}, 4),
                  shapes::arc({0, 0.16f}, {0.14f, 0.14f}, 0, 1.5707f, 12)},
                 64),
          "bell jar", add(scene, pane("jar", glm::vec3(0.97f), 0)), {0.24f, 0.7001f, -0.22f});
    stand(scene, sphere(0.07f, 48), "orange", add(scene, matte("orange", {0.75f, 0.32f, 0.06f})),
          {0.24f, 0.77f, -0.22f});
    const glm::vec3 tints[] = {{0.95f, 0.35f, 0.25f}, {0.30f, 0.85f, 0.45f}, {0.35f, 0.50f, 0.95f}};
    for (int i = 0; i < 3; ++i)
        addPart(scene,
                quad({-0.75f + 0.12f * float(i), 0.7f, -0.3f - 0.06f * float(i)}, {0.24f, 0, -0.02f},
                     {0, 0.3f, 0}),
                "pane", add(scene, pane("pane " + std::to_string(i + 1), tints[i], 0)));
    addPart(scene, quad({0.45f, 0.7f, -0.22f}, {0.36f, 0, -0.1f}, {0, 0.34f, 0}), "frosted pane",
            add(scene, pane("frosted pane", glm::vec3(0.95f), 0.2f)));
    stand(scene, box({{-0.05f, 0, -0.05f}, {0.05f, 0.22f, 0.05f}}), "red block",
          add(scene, matte("red block", {0.62f, 0.10f, 0.08f})), {0.66f, 0.7f, -0.4f});
}

}  // namespace

// Glass of several indices and tints on a wooden table: a tumbler with water, a bowl, a prism, a ball of flint, a cube,
// a bell jar and three panes, one before the other. A lamp above, a spot from the side.
Scene buildGlassware(const Values& values) {
    Scene scene;
    addGlasswareRoom(scene, values);
    addVessels(scene);
    addBlocksAndPanes(scene);
    scene.cameras.push_back(camera("front", {0.05f, 1.32f, 1.35f}, {0.03f, 0.78f, 0}, 60));
    scene.cameras.push_back(camera("close", {-0.35f, 1.0f, 0.75f}, {-0.3f, 0.77f, 0}, 55));
    return scene;
}

namespace {

// Threads of white with holes, clear between them: opacity 0.9, 0.45 and 0.
Texture laceTexture(int size) {
    Texture texture;
    texture.name = "lace";
    texture.width = texture.height = size;
    texture.rgba.assign(4 * std::size_t(size) * std::size_t(size), 255);
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            const glm::vec2 at = glm::fract(4.0f * (glm::vec2(x, y) + 0.5f) / float(size)) - 0.5f;
            const float ring = std::abs(glm::length(at) - 0.3f);
            const bool thread = std::max(std::abs(at.x), std::abs(at.y)) > 0.44f;
            texture.rgba[4 * std::size_t(y * size + x) + 3] =
                thread ? std::uint8_t{230} : (ring < 0.1f ? std::uint8_t{115} : std::uint8_t{0});
        }
    return texture;
}

int blendedSheet(Scene& scene, const char* name, glm::vec4 color, int texture = -1) {
    Material m = matte(name, glm::vec3(color));
    m.baseColor.a = color.a;
    m.alphaMode = AlphaMode::Blend;
    m.doubleSided = true;
    if (texture >= 0) m.baseColorTexture = repeat(texture, 1);
    return add(scene, std::move(m));
}

}  // namespace

// Panes of coloured glass, sheets that hide a part of what is behind them, and lace, in the light of a spot and of a
// lamp below the ceiling.
Scene buildVeils(const Values& values) {
    Scene scene;
    const int pale = white(scene);
    const int ochre = add(scene, matte("ochre wall", {0.60f, 0.42f, 0.20f}));
    addRoom(scene, {{-1.6f, 0, -1.4f}, {1.6f, 2.2f, 1.9f}}, {pale, pale, pale, ochre, pale, pale});
    const glm::vec3 tints[] = {{0.95f, 0.25f, 0.20f}, {0.25f, 0.80f, 0.35f}, {0.25f, 0.40f, 0.95f}};
    for (int i = 0; i < 3; ++i)
        addPart(scene, quad({-0.95f + 0.34f * float(i), 0.5f, -0.55f}, {0.42f, 0, 0.06f}, {0, 0.8f, 0.0f}),
                "pane", add(scene, pane("pane " + std::to_string(i + 1), tints[i], 0)));
    const float thin = float(values["opacity"]);
    addPart(scene, quad({0.2f, 0.35f, -0.6f}, {0.5f, 0, 0}, {0, 0.95f, 0.1f}), "thin sheet",
            blendedSheet(scene, "thin sheet", {0.75f, 0.75f, 0.70f, thin}));
    addPart(scene, quad({0.5f, 0.5f, -0.4f}, {0.5f, 0, 0}, {0, 0.95f, 0.1f}), "thick sheet",
            blendedSheet(scene, "thick sheet", {0.30f, 0.45f, 0.70f, 0.7f}));
    const int texture = add(scene, laceTexture(256));
    addPart(scene, quad({-0.55f, 1.0f, 0.9f}, {0.9f, 0, 0}, {0, 0, -0.9f}), "lace",
            blendedSheet(scene, "lace", glm::vec4(0.8f, 0.8f, 0.8f, 1), texture));
    addPart(scene, quad({-0.25f, 2.17f, 0.1f}, {0.5f, 0, 0}, {0, 0, 0.5f}), "lamp",
            add(scene, emitter("lamp", float(values["emission"]) * glm::vec3(1.0f, 0.95f, 0.88f))));
    scene.lights.push_back(spotLight("spot", {0.2f, 2.0f, 1.7f}, {-0.1f, 0.5f, -0.6f}, 38,
                                     float(values["spot"]) * glm::vec3(1.0f, 0.94f, 0.86f)));
    scene.cameras.push_back(camera("front", {0.0f, 1.45f, 1.85f}, {0.0f, 0.75f, -0.8f}, 66));
    return scene;
}

}  // namespace conelight::io::generated

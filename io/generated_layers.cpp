// SPDX-License-Identifier: MIT
// A room of things with a clear coat, and of cloth with sheen. Values -> Scene.
#include "io/generated_textures.h"
#include "io/generated_trial_parts.h"

namespace conelight::io::generated {
namespace {

Material coated(Material m, float coat, float roughness) {
    m.coat = coat;
    m.coatRoughness = roughness;
    return m;
}

Material cloth(std::string name, glm::vec3 color, glm::vec3 sheen, float roughness) {
    Material m = matte(std::move(name), color);
    m.sheenColor = sheen;
    m.sheenRoughness = roughness;
    return m;
}

}  // namespace

// On a varnished table a row of balls: wood, paint and lacquer under coats, and cloth; a cushion before them.
Scene buildCoats(const Values& values) {
    Scene scene;
    const float coat = float(values["coat"]), sheen = float(values["sheen"]);
    const int pale = white(scene);
    const int ochre = add(scene, matte("ochre wall", {0.60f, 0.40f, 0.16f}));
    const int teal = add(scene, matte("teal wall", {0.10f, 0.34f, 0.40f}));
    addRoom(scene, {{-1.7f, 0, -1.3f}, {1.7f, 2.2f, 2.1f}},
            {add(scene, matte("floor", {0.45f, 0.43f, 0.40f})), pale, ochre, teal, pale, pale});
    addPart(scene, quad({-0.6f, 2.17f, -0.3f}, {1.2f, 0, 0}, {0, 0, 0.6f}), "lamp",
            add(scene, emitter("lamp", float(values["emission"]) * glm::vec3(1.0f, 0.93f, 0.82f))));

    const int grain = add(scene, textures::wood(256));
    const auto wood = [&](const char* name, float roughness) {
        Material m = coated(glossy(name, {0.75f, 0.52f, 0.34f}, 0.7f), coat, roughness);
        m.baseColorTexture = repeat(grain, 0.5f);
        return m;
    };
    addPart(scene, box({{-1.3f, 0.55f, -0.55f}, {1.3f, 0.6f, 0.65f}}), "table",
            add(scene, wood("satin varnish", 0.22f)));

    Material paint = coated(glossy("car paint", {0.55f, 0.03f, 0.04f}, 0.45f), coat, 0.02f);
    paint.metallic = 0.6f;
    const Material balls[] = {
        wood("varnished wood", 0), paint, coated(glossy("lacquer", {0.02f, 0.02f, 0.025f}, 0.6f), coat, 0),
        cloth("felt", {0.05f, 0.16f, 0.09f}, sheen * glm::vec3(0.30f, 0.42f, 0.34f), 0.7f),
        cloth("velvet", {0.10f, 0.01f, 0.05f}, sheen * glm::vec3(0.9f, 0.35f, 0.55f), 0.35f)};
    Mesh ball = sphere(0.2f, 64);
    ball.name = "ball";
    const int mesh = add(scene, std::move(ball));
    float x = -1.0f;
    for (const Material& material : balls) {
        place(scene, mesh, add(scene, material), material.name, translation({x, 0.8f, -0.1f}));
        x += 0.5f;
    }
    glm::mat4 pressed = translation({0.62f, 0.69f, 0.35f});
    pressed[0] *= 1.2f;
    pressed[1] *= 0.45f;
    place(scene, mesh,
          add(scene, cloth("cushion", {0.06f, 0.07f, 0.22f}, sheen * glm::vec3(0.55f, 0.6f, 0.95f), 0.5f)),
          "cushion", pressed);
    Mesh ring = torus(0.13f, 0.045f);
    addPart(scene, std::move(ring), "lacquered ring",
            add(scene, coated(glossy("blue lacquer", {0.03f, 0.08f, 0.35f}, 0.5f), coat, 0.08f)))
        .worldFromObject = translation({-0.45f, 0.645f, 0.35f});
    scene.cameras.push_back(camera("front", {0.0f, 1.35f, 1.75f}, {0.0f, 0.78f, -0.15f}, 50));
    scene.cameras.push_back(camera("close", {-0.75f, 1.05f, 0.75f}, {-0.5f, 0.8f, -0.1f}, 50));
    scene.cameras.push_back(camera("cloth", {0.9f, 1.0f, 0.95f}, {0.7f, 0.76f, 0.0f}, 50));
    return scene;
}

}  // namespace conelight::io::generated

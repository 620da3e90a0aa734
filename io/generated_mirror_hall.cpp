// SPDX-License-Identifier: MIT
// builtin:mirror-hall: a closed hall of flat faces with three ideal mirrors and two point lamps, made for mode `beams`:
// chequered floor, coloured walls, three bodies whose shadows cross.
#include "io/generated_trial_parts.h"

#include <cmath>

namespace conelight::io::generated {
namespace {

constexpr Aabb kHall{{-2, 0, -2.5f}, {2, 2.5f, 2.5f}};

// Every second tile of a floor, from the first or the second on, a millimetre above it.
Mesh tiles(int first) {
    constexpr int kAcross = 8, kAlong = 10;
    const glm::vec3 extent = kHall.extent();
    const glm::vec2 size(extent.x / kAcross, extent.z / kAlong);
    Mesh mesh;
    for (int z = 0; z < kAlong; ++z)
        for (int x = 0; x < kAcross; ++x)
            if ((x + z) % 2 == first)
                shapes::appendQuad(
                    mesh, {kHall.min.x + size.x * float(x), 0.001f, kHall.min.z + size.y * float(z + 1)},
                    {size.x, 0, 0}, {0, 0, -size.y});
    return mesh;
}

// A prism with a regular base, narrower at its top by `taper`.
Mesh prism(int sides, float radius, float height, float taper) {
    Mesh mesh;
    const auto corner = [&](int i, float y, float r) {
        const float angle = 6.2831853f * float(i) / float(sides);
        return glm::vec3(r * std::sin(angle), y, r * std::cos(angle));
    };
    for (int i = 0; i < sides; ++i) {
        const float top = radius * taper;
        const glm::vec3 a = corner(i, 0, radius), b = corner(i + 1, 0, radius);
        const glm::vec3 c = corner(i + 1, height, top), d = corner(i, height, top);
        const glm::vec3 normal = glm::normalize(glm::cross(b - a, d - a));
        const auto first = std::uint32_t(mesh.positions.size());
        mesh.positions.insert(mesh.positions.end(), {a, b, c, d, {0, height, 0}, d, c});
        mesh.normals.insert(mesh.normals.end(),
                            {normal, normal, normal, normal, {0, 1, 0}, {0, 1, 0}, {0, 1, 0}});
        mesh.uvs.insert(mesh.uvs.end(), {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0.5f, 0.5f}, {0, 1}, {1, 1}});
        for (const std::uint32_t k : {0u, 1u, 2u, 2u, 3u, 0u, 4u, 5u, 6u}) mesh.indices.push_back(first + k);
    }
    return mesh;
}

}  // namespace

Scene buildMirrorHall(const Values& values) {
    Scene scene;
    const int pale = white(scene);
    const int clay = add(scene, matte("clay wall", {0.58f, 0.27f, 0.16f}));
    const int slate = add(scene, matte("slate wall", {0.24f, 0.34f, 0.48f}));
    const int ochre = add(scene, matte("ochre wall", {0.62f, 0.50f, 0.28f}));
    addRoom(scene, kHall, {pale, pale, slate, clay, ochre, pale});
    addPart(scene, tiles(0), "dark tiles", add(scene, matte("dark tile", glm::vec3(0.09f))));
    addPart(scene, tiles(1), "light tiles", add(scene, matte("light tile", glm::vec3(0.62f))));

    const int silver = add(scene, metal("silver", {0.95f, 0.93f, 0.88f}, float(values["roughness"])));
    addPart(scene, box({{-1.98f, 0.3f, -2.1f}, {-1.94f, 2.1f, 1.5f}}), "left mirror", silver);
    // Turned against the left one, so that the row of images bends.
    addPart(scene, box({{-0.02f, -0.9f, -1.6f}, {0.02f, 0.9f, 1.6f}}), "right mirror", silver)
        .worldFromObject = translation({1.83f, 1.2f, -0.3f}) * turnAboutY(-0.06f);
    addPart(scene, box({{-0.55f, 0, -0.02f}, {0.55f, 1.7f, 0.02f}}), "standing mirror", silver)
        .worldFromObject = translation({-1.05f, 0.05f, -1.75f}) * turnAboutY(0.55f);

    addPart(scene, prism(4, 0.42f, 0.62f, 1), "cube", add(scene, matte("red", {0.62f, 0.09f, 0.07f})))
        .worldFromObject = translation({0.62f, 0, -0.55f}) * turnAboutY(0.5f);
    addPart(scene, prism(6, 0.2f, 1.5f, 1), "column", add(scene, matte("blue", {0.10f, 0.22f, 0.58f})))
        .worldFromObject = translation({0.85f, 0, -1.75f});
    addPart(scene, prism(4, 0.38f, 0.8f, 0.02f), "pyramid",
            add(scene, matte("yellow", {0.72f, 0.55f, 0.08f})))
        .worldFromObject = translation({-0.55f, 0, -0.2f}) * turnAboutY(0.2f);

    const float intensity = float(values["intensity"]);
    scene.lights.push_back(
        pointLight("warm lamp", {0.3f, 2.25f, 0.75f}, intensity * glm::vec3(1, 0.84f, 0.62f)));
    scene.lights.push_back(
        pointLight("cool lamp", {0.15f, 2.0f, -2.0f}, 0.5f * intensity * glm::vec3(0.62f, 0.80f, 1)));
    scene.cameras.push_back(camera("front", {0.25f, 1.45f, 2.4f}, {-0.15f, 0.75f, -1.2f}, 66));
    return scene;
}

}  // namespace conelight::io::generated

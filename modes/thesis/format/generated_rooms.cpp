// SPDX-License-Identifier: MIT
// The thesis's rooms with bodies of our own. Walls, lamps, colours and cameras stand where its scene files
// have them; strengths above what a surface can return are taken back to 1.
#include "thesis/format/generated_rooms.h"

#include <array>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "conelight/thesis/thesis.h"
#include "io/generated.h"
#include "io/generated_scenes.h"
#include "thesis/format/bodies.h"
#include "thesis/format/scene.h"

namespace conelight::thesis {
namespace {

using glm::vec3;
using io::GeneratedParameter;
using io::generated::add;
using io::generated::addPart;
using io::generated::Values;
constexpr GeneratedParameter kDetail = {"detail", 128, 96, 192, true, "cells along a metre of the bodies"};
constexpr GeneratedParameter kFront = {"front", 1,    0,
                                       1,       true, "1: with the front wall, which the eye looks through"};
constexpr GeneratedParameter kRoomParameters[] = {
    kDetail, kFront, {"body", 0, 0, 3, true, "0 statue, 1 rabbit, 2 dragon, 3 none"}};
constexpr GeneratedParameter kComplexParameters[] = {kDetail, kFront};
constexpr GeneratedParameter kShapeParameters[] = {
    kFront,
    {"light", 0, 0, 3, true, "0 point, 1 spot, 2 directional, 3 rectangle"},
    {"falloff", 0, 0, 2, true, "of point and spot: 0 quadratic, 1 linear, 2 constant"}};
constexpr GeneratedParameter kFrontOnly[] = {kFront};
constexpr GeneratedParameter kBallParameters[] = {
    kFront, {"shift", 0, -0.01, 0.01, false, "of the right wall to the right, m"}};

int phong(Scene& scene, const char* name, vec3 color, float shininess, float strength) {
    Material material;
    material.name = name;
    PhongMaterial model;
    model.color = color;
    model.shininess = shininess;
    model.specularStrength = strength;
    setPbrFromPhong(material, model);
    material.phong = model;
    return add(scene, std::move(material));
}

// Six walls of a box of edge 1 about the origin, each with its material.
void addRoom(Scene& scene, const Values& values) {
    constexpr float h = 0.5f;
    const int white = phong(scene, "white wall", vec3(0.85f), 1, 0.01f);
    const int green = phong(scene, "green wall", {0.4f, 0.95f, 0.4f}, 1, 0.01f);
    const int red = phong(scene, "red wall", {0.95f, 0.4f, 0.4f}, 1, 0.01f);
    const auto wall = [&](const char* name, vec3 corner, vec3 u, vec3 v, int material) {
        addPart(scene, io::generated::quad(corner, u, v), name, material);
    };
    wall("TopWall", {-h, h, -h}, {1, 0, 0}, {0, 0, 1}, white);
    wall("BackWall", {-h, -h, -h}, {1, 0, 0}, {0, 1, 0}, white);
    wall("BottomWall", {-h, -h, h}, {1, 0, 0}, {0, 0, -1}, white);
    if (values["front"] != 0) wall("FrontWall", {h, -h, h}, {-1, 0, 0}, {0, 1, 0}, white);
    wall("RightWall", {h, -h, -h}, {0, 0, 1}, {0, 1, 0}, green);
    wall("LeftWall", {-h, -h, h}, {0, 0, -1}, {0, 1, 0}, red);
}

struct Pose {
    vec3 place;
    float scale, turnDeg;  // about y
};

void addBody(Scene& scene, const char* name, Mesh mesh, int material, const Pose& pose) {
    Instance& instance = addPart(scene, std::move(mesh), name, material);
    instance.worldFromObject = glm::scale(
        glm::rotate(glm::translate(glm::mat4(1), pose.place), glm::radians(pose.turnDeg), vec3(0, 1, 0)),
        vec3(pose.scale));
}

void addBall(Scene& scene, const char* name, vec3 centre, float radius, int material) {
    Mesh mesh;
    io::shapes::appendPatch(mesh, io::shapes::uvSphere(centre, vec3(radius), 96, 48));
    addPart(scene, std::move(mesh), name, material);
}

constexpr float kLampRadiance = 4;
// Of lamps that are three: modes without a tone map show the room without clipping most of it.
constexpr float kOfThree = 0.6f;

// A lamp that shows its colour, and its light: neither voxel nor shadow comes of it.
struct Lamp {
    const char* name;
    vec3 place, size, color, lightAt;
    vec3 turnDeg = vec3(0);
};

void addLamp(Scene& scene, const Lamp& lamp) {
    Material glow;
    glow.name = lamp.name;
    glow.unlit = true;
    // As bright as what stands before it, or exposure would make it grey.
    glow.baseColor = glm::vec4(kLampRadiance * lamp.color, 1);
    glow.phong = PhongMaterial{.color = lamp.color};
    Instance& body = addPart(scene, io::generated::box({-0.5f * lamp.size, 0.5f * lamp.size}), lamp.name,
                             add(scene, std::move(glow)));
    glm::mat4 m = glm::translate(glm::mat4(1), lamp.place);
    for (int axis = 0; axis < 3; ++axis) {
        vec3 about(0);
        about[axis] = 1;
        m = glm::rotate(m, glm::radians(lamp.turnDeg[axis]), about);
    }
    body.worldFromObject = m;
    body.voxelized = body.castsShadow = false;
    Light light = io::generated::pointLight(lamp.name, lamp.lightAt, glm::pi<float>() * lamp.color);
    light.customFalloff = true;
    scene.lights.push_back(std::move(light));
}

void addCameras(Scene& scene) {
    scene.format = kSceneFormat;
    scene.cameras = {thesisCamera("pos2", {0, 0, 1.8f}, -90, 0),
                     thesisCamera("pos1", {1.26f, 0.10f, 1.73f}, -126, -4),
                     thesisCamera("start", {0, 0, 3}, -90, 0)};
}

Scene buildRoom(const Values& values) {
    Scene scene;
    addRoom(scene, values);
    const int detail = int(values["detail"]), stone = phong(scene, "stone", vec3(0.85f), 32, 0.5f);
    switch (int(values["body"])) {
        case 0:
            addBody(scene, "statue", statueMesh(detail), stone, {{0, -0.5f, 0}, 0.8f, 0});
            break;
        case 1:
            addBody(scene, "rabbit", rabbitMesh(detail), stone, {{0, -0.5f, 0}, 0.62f, -25});
            break;
        case 2:
            addBody(scene, "dragon", dragonMesh(detail), stone, {{0, -0.5f, 0}, 0.5f, 25});
            break;
        default:
            break;
    }
    addLamp(scene, {"lamp", {0, 0.49f, 0.4f}, {0.2f, 0.02f, 0.2f}, vec3(1), {0, 0.4f, 0.4f}});
    addCameras(scene);
    return scene;
}

Scene buildComplex(const Values& values) {
    Scene scene;
    addRoom(scene, values);
    const int detail = int(values["detail"]);
    const vec3 clay(0.9f, 0.62f, 0.33f);
    addBody(scene, "statue", statueMesh(detail), phong(scene, "stone", vec3(0.85f), 2, 1),
            {{0, -0.5f, 0}, 0.8f, 0});
    addBody(scene, "dragon", dragonMesh(detail), phong(scene, "dragon", clay, 64, 0.1f),
            {{-0.24f, -0.5f, 0.26f}, 0.3f, 35});
    addBody(scene, "rabbit", rabbitMesh(detail), phong(scene, "rabbit", clay, 64, 0.8f),
            {{0.3f, -0.5f, 0.2f}, 0.3f, -20});
    addBall(scene, "mirror ball", {-0.31f, -0.33f, -0.2f}, 0.17f, phong(scene, "mirror", vec3(0.8f), 256, 1));
    addBall(scene, "dull ball", {0.33f, -0.36f, -0.3f}, 0.14f, phong(scene, "dull", vec3(0.85f), 2, 0.6f));
    addLamp(scene, {"blue lamp",
                    {0.3f, 0.3f, -0.2f},
                    vec3(0.12f),
                    kOfThree * vec3(0.3f, 0.8f, 1),
                    {0.3f, 0.3f, -0.2f},
                    {45, 45, 0}});
    addLamp(scene, {"yellow lamp",
                    {0, -0.35f, 0.42f},
                    vec3(0.08f),
                    kOfThree * vec3(1, 0.83f, 0.3f),
                    {0, -0.35f, 0.42f},
                    {55, 37, 0}});
    addLamp(scene, {"red lamp",
                    {-0.4f, 0.4f, 0.3f},
                    vec3(0.05f),
                    kOfThree * vec3(0.7f, 0.18f, 0.02f),
                    {-0.4f, 0.4f, 0.3f},
                    {67, 53, 0}});
    addCameras(scene);
    return scene;
}

Light shapeLight(int type, int falloff) {
    Light light = io::generated::pointLight("lamp", {0.05f, 0.26f, 0.42f}, vec3(glm::pi<float>()));
    light.type = std::array{LightType::Point, LightType::Spot, LightType::Directional,
                            LightType::Rect}[std::size_t(type)];
    light.direction = glm::normalize(type == 2   ? vec3(-0.45f, -1, -0.5f)
                                     : type == 1 ? vec3(-0.05f, -1, -0.62f)
                                                 : vec3(0, -1, 0));
    light.innerAngle = 0.30f;
    light.outerAngle = 0.48f;
    light.customFalloff = type < 2;
    // Each gives what the quadratic one does at 0.6 m.
    const std::array<vec3, 3> falloffs = {vec3(0, 0, 1 / 0.36f), vec3(0, 1 / 0.6f, 0), vec3(1, 0, 0)};
    light.falloff = falloffs[std::size_t(falloff)];
    if (type == 2) light.intensity = vec3(glm::pi<float>());
    if (type == 3) {
        light.intensity = vec3(12);
        light.position.y = 0.495f;
        light.halfU = {0.16f, 0, 0};
        light.halfV = {0, 0, 0.16f};
    }
    return light;
}

Scene buildShapes(const Values& values) {
    Scene scene;
    addRoom(scene, values);
    if (values["light"] == 2)  // the sun needs a way in
        std::erase_if(scene.instances, [](const Instance& i) {
            return i.name == "TopWall" || i.name == "RightWall" || i.name == "FrontWall";
        });
    const int plain = phong(scene, "plain", {0.45f, 0.62f, 0.9f}, 32, 0.5f);
    Instance& cube = addPart(scene, io::generated::box({vec3(-0.11f), vec3(0.11f)}), "cube", plain);
    cube.worldFromObject =
        glm::rotate(glm::translate(glm::mat4(1), vec3(-0.26f, -0.39f, -0.16f)), 0.5f, vec3(0, 1, 0));
    addBall(scene, "ball", {0.26f, -0.36f, -0.18f}, 0.14f,
            phong(scene, "ball", {0.9f, 0.6f, 0.3f}, 64, 0.8f));
    const auto turned = [&](const char* name, std::vector<glm::vec2> profile, vec3 place, int material) {
        Mesh mesh;
        std::vector<io::shapes::Curve> curves;
        for (std::size_t i = 1; i < profile.size(); ++i)
            curves.push_back(io::shapes::line(profile[i - 1], profile[i], 4));
        for (const io::shapes::Patch& patch : io::shapes::lathe(curves, 64, 0.1f))
            io::shapes::appendPatch(mesh, patch);
        addPart(scene, std::move(mesh), name, material).worldFromObject = glm::translate(glm::mat4(1), place);
    };
    turned("cylinder", {{0, 0}, {0.09f, 0}, {0.09f, 0.26f}, {0, 0.26f}}, {-0.18f, -0.5f, 0.17f},
           phong(scene, "cylinder", {0.55f, 0.85f, 0.5f}, 16, 0.4f));
    turned("cone", {{0, 0}, {0.12f, 0}, {0, 0.28f}}, {0.16f, -0.5f, 0.2f},
           phong(scene, "cone", {0.85f, 0.45f, 0.6f}, 8, 0.3f));
    scene.lights.push_back(shapeLight(int(values["light"]), int(values["falloff"])));
    addCameras(scene);
    return scene;
}

// A green body behind a thin red wall, and a lamp on each side.
Scene buildLeak(const Values& values) {
    Scene scene;
    addRoom(scene, values);
    addPart(scene, io::generated::box({{-0.5f, -0.5f, -0.012f}, {0.14f, 0.5f, 0.0f}}), "red screen",
            phong(scene, "red", {0.95f, 0.08f, 0.06f}, 1, 0.01f));
    addBody(scene, "green rabbit", rabbitMesh(128), phong(scene, "green", {0.08f, 0.95f, 0.10f}, 1, 0.01f),
            {{-0.18f, -0.5f, -0.245f}, 0.5f, 0});
    addLamp(scene,
            {"lamp behind", {-0.18f, 0.46f, -0.06f}, {0.1f, 0.02f, 0.06f}, vec3(1), {-0.18f, 0.38f, -0.06f}});
    scene.lights.back().intensity *= 4.0f;  // what hides is well lit
    addLamp(scene, {"lamp before", {0.1f, 0.46f, 0.36f}, {0.1f, 0.02f, 0.1f}, vec3(1), {0.1f, 0.4f, 0.36f}});
    addCameras(scene);
    return scene;
}

// A mirror ball that all but touches the red wall.
Scene buildBall(const Values& values) {
    Scene scene;
    addRoom(scene, values);
    for (Instance& instance : scene.instances)
        if (instance.name == "RightWall")
            instance.worldFromObject = glm::translate(glm::mat4(1), vec3(float(values["shift"]), 0, 0));
    addBall(scene, "mirror ball", {-0.28f, -0.2f, 0.05f}, 0.2f, phong(scene, "mirror", vec3(0.8f), 256, 1));
    addLamp(scene, {"lamp", {0, 0.49f, 0.2f}, {0.2f, 0.02f, 0.2f}, vec3(1), {0, 0.4f, 0.2f}});
    addCameras(scene);
    return scene;
}

}  // namespace

void registerThesisScenes() {
    io::registerGeneratedScene(
        {"thesis-room", "the thesis's room with lamp and statue; cameras pos2, pos1, start", kRoomParameters},
        buildRoom);
    io::registerGeneratedScene(
        {"thesis-complex", "the thesis's room with three lamps, statue, dragon, rabbit, mirror ball",
         kComplexParameters},
        buildComplex);
    io::registerGeneratedScene(
        {"thesis-shapes", "the thesis's room with cube, ball, cylinder and cone under a light of any kind",
         kShapeParameters},
        buildShapes);
    io::registerGeneratedScene(
        {"thesis-leak", "the thesis's room parted by a thin red wall, a green rabbit behind it", kFrontOnly},
        buildLeak);
    io::registerGeneratedScene(
        {"thesis-ball", "the thesis's room with a mirror ball beside the red wall", kBallParameters},
        buildBall);
}

}  // namespace conelight::thesis

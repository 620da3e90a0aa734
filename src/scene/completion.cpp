// SPDX-License-Identifier: MIT
// What a scene lacks to be seen: a camera; light, in a studio or under a ceiling; a ground in the studio.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <optional>

#include "conelight/scene.h"
#include "conelight/studio.h"
#include "scene/enclosure.h"
#include "scene/framing.h"
#include "scene/triangles.h"

namespace conelight {
namespace {

// A white surface that faces the lamp gets a radiance below 1, so that glow and gloss stand out.
constexpr double kLampIrradiance = 0.65 * std::numbers::pi;  // of a surface that faces it, W/m^2
constexpr double kFill = 0.5, kRoom = 0.1;                   // W/(sr m^2)
constexpr double kGroundAlbedo = 0.35;

// Where the lamp stands, seen by a camera that looks along -z: to the left, above and behind it. From there it shows
// shapes, which a light beside the eye hides, and shadows fall behind things.
const glm::vec3 kTowardsLamp = glm::normalize(glm::vec3(-0.5f, 1.25f, 0.65f));
// So far away that the whole ground gets as much, and as large as a softbox looks.
constexpr float kLampDistance = 80;    // radii of the scene
constexpr float kLampHalfSize = 0.2f;  // tangent of the half angle

// Whether an emissive texture makes its surface a lamp rather than giving it a few glowing marks: its mean is
// above a quarter (chosen by eye: instrument lights of models stay near 0.02, lamp shades above 0.5).
bool isMostlyLit(const Scene& scene, const TextureRef& use) {
    if (!use.used()) return true;
    const Texture& texture = scene.textures[static_cast<std::size_t>(use.texture)];
    double sum = 0;
    for (std::size_t i = 0; i < texture.rgba.size(); i += 4)
        sum += std::max({texture.rgba[i], texture.rgba[i + 1], texture.rgba[i + 2]});
    return sum > 0.25 * 255.0 * static_cast<double>(texture.rgba.size()) / 4.0;
}

// Volume that the triangles enclose, m^3: below 0 where they face inwards, as the walls of rooms do.
float enclosedVolume(const Scene& scene, const glm::vec3& center) {
    float sum = 0;
    scene::forTriangles(scene, [&](const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
        sum += glm::dot(a - center, glm::cross(b - center, c - center)) / 6;
    });
    return sum;
}

// Turn about +y that takes -z to where the camera looks, rad.
float headingOf(const Camera& camera) {
    const glm::vec3 ahead = camera.target - camera.eye;
    const bool level = glm::length(glm::vec2(ahead.x, ahead.z)) > 1e-3f * glm::length(ahead);
    const glm::vec3 towards = level ? ahead : camera.up;
    return std::atan2(-towards.x, -towards.z);
}

bool looksUp(const Camera& camera) { return glm::normalize(camera.target - camera.eye).y > 0.3f; }

// From below, things are lit from below.
Light studioLamp(const Camera& camera, const Aabb& bounds) {
    const float heading = headingOf(camera), c = std::cos(heading), s = std::sin(heading);
    glm::vec3 to(c * kTowardsLamp.x + s * kTowardsLamp.z, kTowardsLamp.y,
                 c * kTowardsLamp.z - s * kTowardsLamp.x);
    if (looksUp(camera)) to.y = -to.y;
    const float distance = kLampDistance * std::max(0.5f * glm::length(bounds.extent()), 1e-4f);
    Light light;
    light.name = kStudioLightName;
    light.type = LightType::Rect;
    light.position = bounds.center() + distance * to;
    light.direction = -to;
    light.halfU = kLampHalfSize * distance * glm::normalize(glm::cross(glm::vec3(0, 1, 0), to));
    light.halfV = glm::cross(to, light.halfU);
    // A square of half size s, seen along its axis from the distance 1, has the form factor 4/pi q atan(q).
    const double half = static_cast<double>(kLampHalfSize), q = half / std::sqrt(1 + half * half);
    light.intensity = glm::vec3(float(kLampIrradiance / (4 * q * std::atan(q))));
    return light;
}

// Under the ceiling, so bright that the floor gets what the studio's lamp would give.
Light roomLight(const scene::Enclosure::Lamp& lamp) {
    Light light;
    light.name = "room light";
    light.type = LightType::Point;
    light.position = lamp.position;
    light.intensity = glm::vec3(float(kLampIrradiance) * lamp.height * lamp.height);
    return light;
}

scene::Enclosure::Lamp lampOf(const Aabb& bounds) {
    const float height = bounds.extent().y;
    return {bounds.center() + glm::vec3(0, 0.35f * height, 0), 0.85f * height};
}

// Irradiance of the picture's upper half on the ground, W/m^2.
double irradianceFromAbove(const EnvironmentImage& image) {
    double sum = 0;
    const double cell = 2 * std::numbers::pi / image.width * std::numbers::pi /
                        image.height;  // times the sine of the angle from +y
    for (int y = 0; y < image.height / 2; ++y) {
        const double angle = std::numbers::pi * (y + 0.5) / image.height;
        for (int x = 0; x < image.width; ++x)
            sum += static_cast<double>(image.radiance[static_cast<std::size_t>(y * image.width + x)].g) *
                   cell * std::sin(angle) * std::cos(angle);
    }
    return sum;
}

// Below the horizon the surroundings are what the ground looks like where nothing stands, so its rim is not seen.
// They light the ground as the ground lights them: E = E_0 + E_1 L, L = albedo/pi (E + lamp).
Environment madeStudio() {
    StudioLevels levels{.key = 0, .fill = kFill, .room = kRoom, .floor = 0.1};
    const double low = irradianceFromAbove(*studioPicture(levels));
    levels.floor = 0.2;
    const double perLevel = (irradianceFromAbove(*studioPicture(levels)) - low) / 0.1;
    const double lamp = kLampIrradiance * static_cast<double>(kTowardsLamp.y);
    const double level =
        kGroundAlbedo * (low - 0.1 * perLevel + lamp) / (std::numbers::pi - kGroundAlbedo * perLevel);
    // As a reader of the name will make it.
    char name[96];
    std::snprintf(name, sizeof name, "builtin:studio?key=0&fill=%g&room=%g&floor=%.4f", kFill, kRoom, level);
    levels.floor = std::round(level * 1e4) / 1e4;
    Environment studio;
    studio.file = name;
    studio.image = studioPicture(levels);
    return studio;
}

// All scenes share one picture.
Environment studioSurroundings(float heading) {
    static const Environment made = madeStudio();
    Environment studio = made;
    studio.rotation = heading;
    return studio;
}

// A round sheet a little below the lowest point: where both lay in one plane, each would show through the other.
bool addGround(Scene& scene, const Aabb& bounds) {
    const glm::vec3 size = bounds.extent();
    const float height = bounds.min.y - 1e-3f * glm::length(size);
    if (scene.cameras.front().eye.y <= height) return false;
    // What lies beyond the shade of a lamp so high is as bright as the surroundings. Voxels grow with the ground.
    const float radius =
        std::max(0.65f * glm::length(glm::vec2(size.x, size.z)) + 0.25f * size.y, 0.75f * size.y);
    constexpr unsigned kCorners = 96;
    Mesh mesh;
    mesh.name = kStudioGroundName;
    mesh.positions.emplace_back(0);
    for (unsigned i = 0; i < kCorners; ++i) {
        const float angle = 2 * float(std::numbers::pi) * float(i) / float(kCorners);
        mesh.positions.emplace_back(std::cos(angle), 0.0f, -std::sin(angle));
        mesh.indices.insert(mesh.indices.end(), {0, i + 1, (i + 1) % kCorners + 1});
    }
    mesh.normals.assign(mesh.positions.size(), glm::vec3(0, 1, 0));
    Material material;
    material.name = kStudioGroundName;
    material.baseColor = glm::vec4(glm::vec3(float(kGroundAlbedo)), 1);
    material.specular = 0;  // a sheen would set it off from the surroundings
    Instance instance;
    instance.name = kStudioGroundName;
    instance.mesh = static_cast<int>(scene.meshes.size());
    instance.material = static_cast<int>(scene.materials.size());
    instance.worldFromObject = {
        radius, 0, 0, 0, 0, radius, 0, 0, 0, 0, radius, 0, bounds.center().x, height, bounds.center().z, 1};
    scene.meshes.push_back(std::move(mesh));
    scene.materials.push_back(std::move(material));
    scene.instances.push_back(std::move(instance));
    return true;
}

// A closed room keeps out what comes from outside, and is lit within as well. Things whose triangles are only
// wound the wrong way round pass for rooms; they have the studio outside.
void addStudio(Scene& scene, const Aabb& bounds, bool ground,
               const std::optional<scene::Enclosure::Lamp>& inside) {
    const glm::vec3 size = bounds.extent();
    const bool isRoom = inside || enclosedVolume(scene, bounds.center()) < -0.5f * size.x * size.y * size.z;
    const Camera& camera = scene.cameras.front();
    scene.lights.push_back(studioLamp(camera, bounds));
    if (isRoom) scene.lights.push_back(roomLight(inside.value_or(lampOf(bounds))));
    // Seen from below, a lamp would stand behind the scene: the other side of the studio has none so low.
    const float turn = looksUp(camera) ? float(std::numbers::pi) : 0.0f;
    scene.environment = studioSurroundings(headingOf(camera) + turn);
    const bool stands = ground && !isRoom && addGround(scene, bounds);
    scene.notes.emplace_back(isRoom ? "no light, lamp or sky in the room: one under its ceiling and a studio "
                                      "around it were added"
                             : stands ? "no light, lamp or sky in the scene: a studio with a ground was added"
                                      : "no light, lamp or sky in the scene: a studio was added");
}

bool isOn(const Light& light) { return light.enabled && glm::dot(light.intensity, glm::vec3(1)) > 0; }

bool isLamp(const Scene& scene, const Instance& instance) {
    if (!instance.visible || instance.material < 0) return false;
    const Material& material = scene.materials[static_cast<std::size_t>(instance.material)];
    return !material.unlit && glm::dot(material.emission, glm::vec3(1)) > 0 &&
           isMostlyLit(scene, material.emissiveTexture);
}

bool hasLight(const Scene& scene) {
    return glm::dot(scene.sky, glm::vec3(1)) > 0 || scene.environment.used() ||
           std::any_of(scene.lights.begin(), scene.lights.end(), isOn) ||
           std::any_of(scene.instances.begin(), scene.instances.end(),
                       [&](const Instance& instance) { return isLamp(scene, instance); });
}

// Baked scenes are unlit throughout.
bool needsLight(const Scene& scene) {
    return std::any_of(scene.instances.begin(), scene.instances.end(), [&](const Instance& instance) {
        return instance.visible &&
               (instance.material < 0 || !scene.materials[static_cast<std::size_t>(instance.material)].unlit);
    });
}

// m; of surfaces that shine, one place of each.
struct LampPlaces {
    std::vector<glm::vec3> inside, outside;  // of an enclosure
};

LampPlaces placesOfLamps(const Scene& scene, const scene::Enclosure& enclosure) {
    LampPlaces places;
    for (const Light& light : scene.lights)
        if (isOn(light) && light.type != LightType::Directional)
            (enclosure.contains(light.position) ? places.inside : places.outside).push_back(light.position);
    for (const Instance& instance : scene.instances) {
        if (!isLamp(scene, instance)) continue;
        std::optional<glm::vec3> inside, any;
        scene::forTriangles(scene, instance, [&](const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
            any = (a + b + c) / 3.0f;
            if (!inside && enclosure.contains(*any)) inside = any;
        });
        if (inside)
            places.inside.push_back(*inside);
        else if (any)
            places.outside.push_back(*any);
    }
    return places;
}

bool isLitFromAfar(const Scene& scene) {
    return glm::dot(scene.sky, glm::vec3(1)) > 0 || scene.environment.used() ||
           std::any_of(scene.lights.begin(), scene.lights.end(), [](const Light& light) {
               return isOn(light) && light.type == LightType::Directional;
           });
}

// Rooms have more than a third of their bounds inside. They are seen from there where they have lamps, or something to
// be lit and light that comes in, or will get a lamp. Where it is dark outside, a tenth of the bounds is enough.
std::optional<Camera> cameraInside(const Scene& scene, scene::Enclosure& enclosure, bool lacksLight) {
    const LampPlaces lamps = placesOfLamps(scene, enclosure);
    enclosure.keepRoomsOf(lamps.inside);
    const bool isRoom = enclosure.share() > 1.0f / 3.0f;
    const bool isFurnished = isRoom && enclosure.isFurnished() && (lacksLight || enclosure.hasWindows());
    const bool isDarkOutside = lamps.outside.empty() && !isLitFromAfar(scene);
    const bool isLit = !lamps.inside.empty() && (isRoom || (enclosure.share() > 0.1f && isDarkOutside));
    return isFurnished || isLit ? enclosure.cameraInside(lamps.inside) : std::nullopt;
}

// The camera that a scene lacks, and where a lamp belongs if that stands in a room.
std::optional<scene::Enclosure::Lamp> addCamera(Scene& scene, const Aabb& bounds, const scene::Floor& floor,
                                                bool lacksLight) {
    scene::Enclosure enclosure(scene, bounds);
    if (const std::optional<glm::vec3> side = enclosure.openSide())
        scene.cameras.push_back(scene::frameShape(scene, bounds, floor, *side));
    else if (const std::optional<Camera> inside = cameraInside(scene, enclosure, lacksLight)) {
        scene.cameras.push_back(*inside);
        scene.notes.emplace_back("no camera in the scene: one in its room was added");
        return enclosure.lamp();
    } else
        scene.cameras.push_back(scene::frameShape(scene, bounds, floor));
    scene.notes.emplace_back("no camera in the scene: one that frames it was added");
    return {};
}

}  // namespace

void completeScene(Scene& scene, const CompletionOptions& options) {
    const Aabb bounds = scene.bounds();
    const bool lacksLight = !bounds.empty() && needsLight(scene) && !hasLight(scene);
    if (!lacksLight && !scene.cameras.empty()) return;
    const scene::Floor floor = scene::floorOf(scene, bounds);
    std::optional<scene::Enclosure::Lamp> inside;
    if (scene.cameras.empty()) inside = addCamera(scene, bounds, floor, lacksLight);
    if (lacksLight) addStudio(scene, bounds, options.ground && !floor.carries, inside);
}

void completeScene(Scene& scene) { completeScene(scene, {}); }

}  // namespace conelight

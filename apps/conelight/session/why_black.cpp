// SPDX-License-Identifier: MIT
#include "session/why_black.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace conelight::program {
namespace {

constexpr int kRays = 12;        // per axis of the picture: finds what covers a hundredth of it
constexpr float kAspect = 1.5f;  // between the usual pictures' ones

float brightest(const glm::vec3& v) { return std::max(v.x, std::max(v.y, v.z)); }

struct View {
    std::vector<Pick> picks;
    std::size_t rays = 0;
};

View viewOf(const Session& session, Picker& picker) {
    View view;
    for (int y = 0; y < kRays; ++y)
        for (int x = 0; x < kRays; ++x) {
            ++view.rays;
            if (auto pick = picker.atPixel(session, static_cast<int>(kRays * kAspect), kRays,
                                           static_cast<int>((static_cast<float>(x) + 0.5f) * kAspect), y))
                view.picks.push_back(*pick);
        }
    return view;
}

// Whether the triangle was met from behind (its winding is its front).
bool fromBehind(const Scene& scene, const Camera& camera, const Pick& pick) {
    const Instance& instance = scene.instances[pick.instance];
    const Mesh& mesh = scene.meshes[static_cast<std::size_t>(instance.mesh)];
    glm::vec3 corner[3];
    for (std::size_t c = 0; c < 3; ++c)
        corner[c] = glm::vec3(instance.worldFromObject *
                              glm::vec4(mesh.positions[mesh.indices[3 * pick.triangle + c]], 1));
    glm::vec3 normal = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
    if (glm::determinant(glm::mat3(instance.worldFromObject)) < 0) normal = -normal;
    return glm::dot(normal, pick.position - camera.eye) > 0;
}

bool emits(const Scene& scene, const Instance& instance) {
    if (!instance.visible || instance.material < 0) return false;
    const Material& material = scene.materials[static_cast<std::size_t>(instance.material)];
    return brightest(material.emission) > 0 ||
           (material.unlit && brightest(glm::vec3(material.baseColor)) > 0);
}

// Irradiance of a light at a surface without occlusion, W/m^2; area lights as points: for an estimate.
float irradiance(const Light& light, const glm::vec3& position, const glm::vec3& normal, glm::vec3& toLight,
                 float& distance) {
    toLight = -light.direction;
    distance = 1e9f;
    float strength = brightest(light.intensity);
    if (light.type != LightType::Directional) {
        distance = std::max(glm::distance(light.position, position), 1e-4f);
        toLight = (light.position - position) / distance;
        const float d = distance;
        strength *= light.customFalloff
                        ? 1 / (light.falloff.x + light.falloff.y * d + light.falloff.z * d * d)
                        : 1 / (d * d);
    }
    const float along = glm::dot(-toLight, light.direction);
    if (light.type == LightType::Spot && along < std::cos(light.outerAngle)) return 0;
    const float parallelogram = 4 * glm::length(glm::cross(light.halfU, light.halfV));
    if (light.type == LightType::Rect) strength *= std::max(along, 0.0f) * parallelogram;
    if (light.type == LightType::Disk) strength *= std::max(along, 0.0f) * 0.7853982f * parallelogram;
    if (light.type == LightType::Sphere) strength *= 3.1415927f * glm::dot(light.halfU, light.halfU);
    return strength * std::max(glm::dot(normal, toLight), 0.0f);
}

struct Direct {
    float radiance = 0;                          // of the brightest surface in view, W/(sr m^2)
    std::map<std::string, std::size_t> blocked;  // by which object how often
    std::size_t tried = 0;
};

Direct directLight(const Session& session, Picker& picker, const View& view) {
    const Scene& scene = session.scene();
    const float lift = 1e-4f * std::max(glm::length(scene.bounds().extent()), 1e-3f);
    Direct direct;
    for (const Pick& pick : view.picks) {
        const Material material =
            pick.material < 0 ? Material{} : scene.materials[static_cast<std::size_t>(pick.material)];
        direct.radiance = std::max(direct.radiance, brightest(material.emission));
        const float albedo = brightest(glm::vec3(material.baseColor));
        direct.radiance = std::max(direct.radiance, material.unlit ? albedo : albedo * brightest(scene.sky));
        for (const Light& light : scene.lights) {
            if (!light.enabled) continue;
            glm::vec3 toLight;
            float distance = 0;
            const float e = irradiance(light, pick.position, pick.normal, toLight, distance);
            if (!(e > 0)) continue;
            ++direct.tried;
            const auto between = light.castsShadow
                                     ? picker.along(session, pick.position + lift * pick.normal, toLight)
                                     : std::nullopt;
            // The lamp's own body is as far away as the lamp.
            if (between && between->distance < 0.98f * distance)
                ++direct.blocked[between->object];
            else
                direct.radiance = std::max(direct.radiance, albedo * e / 3.14159265f);
        }
    }
    return direct;
}

// Stops that lift `radiance` to about a fifth of white.
int stopsFor(float radiance) {
    return std::clamp(static_cast<int>(std::ceil(std::log2(0.2f / radiance))), -20, 20);
}

std::string exposureReason(const Session& session, float radiance, const char* where) {
    const std::string now = getSetting(session.settings(), "image.exposure");
    return fmt::format(
        "exposure: {} {:.2g} W/(sr m^2), too dark at image.exposure {}; `set image.exposure {}` "
        "(--set image.exposure={}) would show it",
        where, radiance, now, stopsFor(radiance), stopsFor(radiance));
}

bool tooDark(const Session& session, float radiance) {
    // Below 1/255 in sRGB, which is linear there: 1/12.92 of it.
    const AutoFloat& exposure = session.settings().image.exposure;
    return !exposure.isAuto && radiance * std::exp2(exposure.value) < 2.0f / 255 / 12.92f;
}

void lookAtCamera(const Session& session, const View& view, std::vector<std::string>& reasons) {
    const Scene& scene = session.scene();
    if (view.picks.empty()) {
        if (brightest(scene.sky) <= 0)
            reasons.push_back(
                "camera: nothing is in view and the sky is black; `camera frame OBJECT`, another "
                "--eye and --target, or `sky 1` would help");
        return;
    }
    const float near = 0.01f * glm::length(scene.bounds().extent());
    std::map<std::string, std::size_t> close;
    float nearest = 1e30f;
    for (const Pick& pick : view.picks) {
        const bool behind = fromBehind(scene, session.camera(), pick);
        nearest = std::min(nearest, pick.distance);
        if (behind || pick.distance < near) ++close[pick.object];
    }
    for (const auto& [object, count] : close) {
        if (10 * count < 9 * view.rays) continue;
        reasons.push_back(
            fmt::format("camera: it is inside or right at {}, whose surface is {:.2g} m in front of "
                        "it; `camera frame '{}'` or another --eye would help",
                        object, nearest, object));
    }
}

bool hasLight(const Scene& scene) {
    const bool lamps = std::any_of(scene.lights.begin(), scene.lights.end(), [](const Light& light) {
        return light.enabled && brightest(light.intensity) > 0;
    });
    const bool emitters = std::any_of(scene.instances.begin(), scene.instances.end(),
                                      [&](const Instance& one) { return emits(scene, one); });
    return lamps || emitters || brightest(scene.sky) > 0;
}

void lookAtVoxels(const Session& session, std::vector<std::string>& reasons) {
    const Scene& scene = session.scene();
    const Component component = session.shownSettings().component;
    const std::string mode = session.shownMode();
    if (mode == "phong" || !isSettingsMode(mode)) return;
    const bool needs = component == Component::Indirect || component == Component::Diffuse ||
                       component == Component::Specular || component == Component::Voxels;
    const bool any = std::any_of(scene.instances.begin(), scene.instances.end(),
                                 [](const Instance& one) { return one.visible && one.voxelized; });
    if (needs && !any)
        reasons.push_back(
            "voxels: no visible object is voxelized, so nothing bounces light; `static = false` in "
            "the scene file, or mode reference, would help");
}

}  // namespace

bool isBlack(const Image& image, const ImageSettings& settings) {
    const std::vector<std::uint8_t> bytes = toneMapped(image, settings);
    const auto lit = std::count_if(bytes.begin(), bytes.end(), [](std::uint8_t byte) { return byte > 2; });
    const auto sum = std::accumulate(bytes.begin(), bytes.end(), std::size_t{0});
    return 50 * static_cast<std::size_t>(lit) <= bytes.size() || sum < bytes.size();
}

std::vector<std::string> whyBlack(const Session& session, Picker& picker, const Image* image) {
    const Scene& scene = session.scene();
    std::vector<std::string> reasons;
    float shown = 0;
    if (image != nullptr)
        for (const glm::vec4& pixel : image->pixels)
            if (std::isfinite(brightest(glm::vec3(pixel))))
                shown = std::max(shown, brightest(glm::vec3(pixel)));
    if (shown > 0 && tooDark(session, shown))
        reasons.push_back(exposureReason(session, shown, "the brightest pixel has"));

    if (session.showsNothing())
        reasons.push_back("objects: drawing them is off; `objs` would turn it on");
    else if (std::none_of(scene.instances.begin(), scene.instances.end(),
                          [](const Instance& one) { return one.visible && one.mesh >= 0; }))
        reasons.push_back("objects: none is visible; `toggle NAME` shows one, `list` names them");
    if (!hasLight(scene))
        reasons.push_back(
            "light: every lamp is off or dark, nothing emits and the sky is black; `light add point "
            "lamp`, `material NAME emission 1` or `sky 1` would help");
    const View view = viewOf(session, picker);
    lookAtCamera(session, view, reasons);
    lookAtVoxels(session, reasons);
    if (!reasons.empty() || view.picks.empty()) return reasons;

    const Direct direct = directLight(session, picker, view);
    if (direct.radiance > 0 && tooDark(session, direct.radiance)) {
        reasons.push_back(
            exposureReason(session, direct.radiance, "direct light of what is in view is about"));
        return reasons;
    }
    std::pair<std::string, std::size_t> most;
    for (const auto& one : direct.blocked)
        if (one.second > most.second) most = one;
    const bool emitters = std::any_of(scene.instances.begin(), scene.instances.end(),
                                      [&](const Instance& one) { return emits(scene, one); });
    if (!(direct.radiance > 0) && !emitters && direct.tried > 0)
        reasons.push_back(
            fmt::format("light: no lamp reaches what is in view, {} is between; `light NAME position X "
                        "Y Z` would help",
                        most.first));
    else if (!(direct.radiance > 0) && !emitters)
        reasons.push_back(
            "light: every lamp shines away from what is in view; `light NAME position X Y Z` would "
            "help");
    return reasons;
}

}  // namespace conelight::program

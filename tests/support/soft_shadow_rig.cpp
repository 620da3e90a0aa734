// SPDX-License-Identifier: MIT
#include "support/soft_shadow_rig.h"

#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>

#include "support/truth_rig.h"

namespace conelight::test {
namespace {

const glm::vec3 kLamp(0, 2, 0);
const glm::vec3 kLookedAt(0.8f, 0, 0);  // where the plate's shadow lies

}  // namespace

Scene plateScene(bool withPlate) {
    Scene scene;
    const Material white = diffuseMaterial(glm::vec3(0.8f));
    addInstance(scene, quadMesh({-2, 0, 2}, {4, 0, 0}, {0, 0, -4}), white);
    glm::mat4 place(1);
    place[0][0] = place[2][2] = 0.15f;
    place[1][1] = 0.03f;
    place[3] = glm::vec4(0.5f, 0.75f, 0, 1);
    if (withPlate) addInstance(scene, boxMesh(), white, place);
    Light light;
    light.position = kLamp;
    light.intensity = glm::vec3(10);
    scene.lights = {light};
    scene.cameras = {cameraAbove(kLookedAt, 0.6f, 0.9f)};
    return scene;
}

Light lampOf(float aperture) {
    const float side =
        std::sqrt(glm::pi<float>()) * std::tan(0.5f * aperture) * glm::distance(kLamp, kLookedAt);
    Light light;
    light.type = LightType::Rect;
    light.position = kLamp;
    light.direction = {0, -1, 0};
    light.halfU = {0.5f * side, 0, 0};
    light.halfV = {0, 0, 0.5f * side};
    light.intensity = glm::vec3(10 / (side * side));
    return light;
}

Image drawSmall(const Scene& scene, const Settings& settings) {
    Renderer renderer;
    renderer.setScene(scene);
    renderer.render(scene.cameras.front(), kShadowPixels, kShadowPixels, settings);
    return renderer.readImage();
}

std::vector<float> visible(const Image& shadowed, const Image& open) {
    std::vector<float> shares;
    for (std::size_t i = 0; i < shadowed.pixels.size(); ++i)
        shares.push_back(shadowed.pixels[i].g / open.pixels[i].g);
    return shares;
}

std::vector<float> visibleByCones(const Scene& scene, const Settings& settings) {
    if (settings.component == Component::Occlusion) {
        std::vector<float> shares;
        for (const glm::vec4& pixel : drawSmall(scene, settings).pixels) shares.push_back(pixel.r);
        return shares;
    }
    Scene open = scene;
    for (Light& light : open.lights) light.castsShadow = false;
    return visible(drawSmall(scene, settings), drawSmall(open, settings));
}

std::vector<float> visibleInTruth(const Light& lamp) {
    reference::PathTracerSettings tracer;
    tracer.samplesPerPixel = 128;
    tracer.bounces = 0;
    Image images[2];
    for (const bool withPlate : {true, false}) {
        Scene scene = plateScene(withPlate);
        scene.lights = {lamp};
        images[withPlate ? 0 : 1] = reference::PathTracer(scene)
                                        .render(scene.cameras.front(), kShadowPixels, kShadowPixels, tracer)
                                        .direct;
    }
    return visible(images[0], images[1]);
}

double meanDifference(const std::vector<float>& a, const std::vector<float>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += double(std::abs(a[i] - b[i]));
    return sum / double(a.size());
}

RoomShares sharesInAnEmptyRoom(const Settings& settings) {
    Scene room = closedBox(diffuseMaterial(glm::vec3(0.5f)));
    Light light;
    light.position = {0, 0.85f, 0};
    light.intensity = glm::vec3(1);
    room.lights = {light};
    RoomShares result;
    for (const glm::vec3& target :
         {glm::vec3(0, -1, 0.01f), glm::vec3(1, -0.2f, 0), glm::vec3(0.3f, 0, -1)}) {
        Camera camera;
        camera.eye = {0, 0, 0};
        camera.target = target;
        camera.fovY = 1.4f;
        room.cameras = {camera};
        const std::vector<float> share = visibleByCones(room, settings);
        for (int y = 1; y + 1 < kShadowPixels; ++y)
            for (int x = 1; x + 1 < kShadowPixels; ++x) {
                const auto at = [&](int i, int j) {
                    return share[std::size_t((y + j) * kShadowPixels + x + i)];
                };
                const float around = 0.25f * (at(1, 0) + at(-1, 0) + at(0, 1) + at(0, -1));
                result.least = std::min(result.least, at(0, 0));
                result.jump = std::max(result.jump, std::abs(at(0, 0) - around));
            }
    }
    return result;
}

}  // namespace conelight::test

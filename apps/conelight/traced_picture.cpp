// SPDX-License-Identifier: MIT
#include "traced_picture.h"

#include <fmt/core.h>

#include <cmath>

#include "conelight/error.h"

namespace conelight::program {

std::string timeText(double seconds) {
    const long s = std::lround(seconds);
    if (s < 60) return fmt::format("{} s", s);
    if (s < 3600) return fmt::format("{} min {} s", s / 60, s % 60);
    return fmt::format("{} h {} min", s / 3600, s / 60 % 60);
}

reference::PathTracedPicture trace(const reference::PathTracer& tracer, const Camera& camera,
                                   const Size& size, const reference::PathTracerSettings& settings,
                                   Progress* progress) {
    const StoppableScope stoppable;
    const auto onProgress = [&](const reference::PathTracerProgress& now) {
        if (progress != nullptr) {
            std::string text =
                fmt::format("path tracing: {} of {} samples", now.samplesDone,
                            (settings.noise > 0 ? "at most " : "") + std::to_string(now.samplesPlanned));
            if (now.noise > 0) text += fmt::format(", noise {:.2g} %", 100 * now.noise);
            if (now.secondsLeft >= 0) text += ", " + timeText(now.secondsLeft) + " left";
            progress->show(text);
        }
        return !interrupted();
    };
    return tracer.render(camera, size.width, size.height, settings, onProgress);
}

const Image& imageOf(const reference::PathTracedPicture& picture, Component component) {
    switch (component) {
        case Component::Full:
            return picture.full;
        case Component::Direct:
            return picture.direct;
        case Component::Indirect:
            return picture.indirect;
        case Component::Diffuse:
            return picture.diffuse;
        case Component::Specular:
            return picture.specular;
        default:
            throw Error(ErrorKind::Usage,
                        "mode reference: this component belongs to the other modes; full, direct, indirect, "
                        "diffuse or specular would be right");
    }
}

int bounceLayer(const std::string& name) {
    constexpr int kMost = 64;  // more have no light left: 0.8^64 = 6e-7
    if (name.rfind("bounce", 0) != 0 || name.size() > 8) return 0;
    int value = 0;
    for (const char c : name.substr(6)) {
        if (c < '0' || c > '9') return 0;
        value = 10 * value + (c - '0');
    }
    return value <= kMost ? value : 0;
}

bool isTracedLayer(const std::string& name) {
    return bounceLayer(name) > 0 || name == "half_a" || name == "half_b" || name == "indirect_half_a" ||
           name == "indirect_half_b";
}

std::string tracedLayerNames() {
    return "half_a, half_b, indirect_half_a, indirect_half_b or bounce1 to bounce64";
}

const Image* layerOf(const reference::PathTracedPicture& picture, const std::string& name) {
    const std::pair<const char*, const Image*> named[] = {{"full", &picture.full},
                                                          {"direct", &picture.direct},
                                                          {"indirect", &picture.indirect},
                                                          {"diffuse", &picture.diffuse},
                                                          {"specular", &picture.specular},
                                                          {"half_a", &picture.halfA},
                                                          {"half_b", &picture.halfB},
                                                          {"indirect_half_a", &picture.indirectA},
                                                          {"indirect_half_b", &picture.indirectB}};
    for (const auto& [one, image] : named)
        if (name == one) return image;
    const int bounce = bounceLayer(name);
    if (bounce >= 1 && bounce <= static_cast<int>(picture.bounces.size()))
        return &picture.bounces[static_cast<std::size_t>(bounce - 1)];
    return nullptr;
}

}  // namespace conelight::program

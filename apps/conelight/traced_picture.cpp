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

reference::BeamPicture traceBeams(const Scene& scene, const Camera& camera, const Size& size,
                                  const reference::BeamSettings& settings, Progress* progress) {
    const StoppableScope stoppable;
    const auto onProgress = [&](double done) {
        if (progress != nullptr) progress->show(fmt::format("beam tracing: {:.0f} %", 100 * done));
        return !interrupted();
    };
    return reference::traceBeams(scene, camera, size.width, size.height, settings, onProgress);
}

Image imageOf(const reference::BeamPicture& picture, Component component) {
    switch (component) {
        case Component::Full:
            return picture.full;
        case Component::Direct:
            return picture.direct;
        case Component::Indirect:
        case Component::Specular:
            return picture.mirrored;
        case Component::Diffuse: {
            Image black = picture.full;  // no diffuse light between surfaces
            for (glm::vec4& pixel : black.pixels) pixel = glm::vec4(0, 0, 0, pixel.a);
            return black;
        }
        default:
            throw Error(ErrorKind::Usage,
                        "mode beams: this component belongs to the other modes; full, direct, indirect, "
                        "diffuse or specular would be right");
    }
}

}  // namespace conelight::program

// SPDX-License-Identifier: MIT
#include "static_light.h"

#include <fmt/core.h>

#include <cstdio>

#include "interrupt.h"
#include "traced_picture.h"

namespace conelight::program {

std::shared_ptr<const BakedLight> staticLight(StaticBake& bake, const Scene& scene,
                                              const reference::RadiositySettings& settings,
                                              Progress* progress) {
    if (bake.bakes() == 0 && !hasDynamic(scene)) {
        if (progress != nullptr) progress->finish();
        std::fprintf(stderr,
                     "conelight: mode hybrid: nothing in the scene is dynamic: all of its light is baked\n");
    }
    const StoppableScope stoppable;
    return bake.of(scene, settings, [&](const reference::RadiosityProgress& now) {
        std::string text = fmt::format("baking what does not move: {:.0f} %", 100 * now.done);
        if (now.secondsLeft >= 0) text += ", " + timeText(now.secondsLeft) + " left";
        if (progress != nullptr) progress->show(text);
        return !interrupted();
    });
}

}  // namespace conelight::program

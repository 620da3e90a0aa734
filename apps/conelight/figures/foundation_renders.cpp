// SPDX-License-Identifier: MIT
// Pictures of the thesis's chapters 1 to 3.
#include <fmt/format.h>

#include "figures/renders.h"

namespace conelight::figures {

Panels renderUses(Studio& studio) {
    return {studio.draw("a courtyard in sun", {.scene = "builtin:atrium?triangles=100000"}),
            studio.draw("a box with a lamp", {.scene = "builtin:cornell"}),
            studio.draw("a parlour", {.scene = "builtin:parlour"}),
            studio.draw("glass on a table", {.scene = "builtin:glassware"})};
}

Panels renderLightKinds(Studio& studio) {
    Panels panels;
    for (int kind = 0; kind < 4; ++kind) {
        constexpr const char* kNames[] = {"point", "spot", "directional", "area"};
        panels.push_back(
            studio.draw(kNames[kind], {.scene = fmt::format("builtin:thesis-shapes?light={}", kind),
                                       .camera = "pos2",
                                       .settings = {{"image.exposure", "auto"}}}));
    }
    return panels;
}

Panels renderFalloffs(Studio& studio) {
    Panels panels;
    for (int falloff = 0; falloff < 3; ++falloff) {
        constexpr const char* kNames[] = {"quadratic", "linear", "constant"};
        panels.push_back(
            studio.draw(kNames[falloff], {.scene = fmt::format("builtin:thesis-shapes?falloff={}", falloff),
                                          .mode = "phong",
                                          .camera = "pos2"}));
    }
    return panels;
}

Panels renderLocalAndGlobal(Studio& studio) {
    return {studio.draw("local: direct light", {.scene = "builtin:cornell", .mode = "phong"}),
            studio.draw("global: all bounces", {.scene = "builtin:cornell"})};
}

Panels renderDragon(Studio& studio) {
    return {studio.draw("", {.scene = "builtin:thesis-room?body=2", .mode = "phong", .camera = "pos2"})};
}

Panels renderShrunkTriangles(Studio& studio) {
    Panels panels;
    for (const char* shrink : {"0", "0.4"})
        panels.push_back(studio.draw(shrink == std::string("0") ? "whole" : "smaller by two fifths",
                                     {.scene = "builtin:thesis-shapes",
                                      .mode = "phong",
                                      .camera = "pos2",
                                      .settings = {{"view.shrink", shrink}}}));
    return panels;
}

Panels renderPathTraced(Studio& studio) {
    return {studio.draw(
        "", {.scene = "builtin:conservatory", .mode = "reference", .samples = 192, .denoised = true})};
}

Panels renderBounces(Studio& studio) {
    Panels panels;
    for (const int bounces : {0, 1, 2, -1})
        panels.push_back(studio.draw(bounces < 0    ? "all bounces"
                                     : bounces == 0 ? "direct light"
                                     : bounces == 1 ? "1 bounce"
                                                    : fmt::format("{} bounces", bounces),
                                     {.scene = "builtin:cornell", .mode = "radiosity", .bounces = bounces}));
    return panels;
}

Panels renderRadiosityBesideRays(Studio& studio) {
    return {studio.draw("radiosity", {.scene = "builtin:mirrors?roughness=0.2", .mode = "radiosity"}),
            studio.draw("ray tracing", {.scene = "builtin:mirrors?roughness=0.2",
                                        .mode = "reference",
                                        .samples = 64,
                                        .denoised = true})};
}

}  // namespace conelight::figures

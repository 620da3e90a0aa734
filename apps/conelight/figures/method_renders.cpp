// SPDX-License-Identifier: MIT
// Pictures of the thesis's chapters 4 to 6: its technique, its variants, its limits.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "figures/drawings/drawings.h"
#include "figures/renders.h"

namespace conelight::figures {
namespace {

using Values = std::vector<std::pair<std::string, std::string>>;

Panel drawn(const std::string& label, const std::string& svg) {
    return {label, ".svg", {svg.begin(), svg.end()}};
}

// A picture of mode thesis from the camera that looks in from the front.
Shot thesisShot(const std::string& scene, const std::string& component, const Values& settings = {},
                int voxels = 128) {
    return {.scene = "builtin:" + scene,
            .mode = "thesis",
            .camera = "pos2",
            .component = component,
            .settings = settings,
            .voxels = voxels};
}

// Every defect of the published program but the one named.
Values defectsBut(const std::string& cured) {
    const std::string prefix = "thesis.defects.";
    Values values;
    for (const SettingInfo& info : settingInfos())
        if (info.key.starts_with(prefix) && info.key != prefix + cured) values.emplace_back(info.key, "true");
    return values;
}

// Regular and customised cones of a kind, as published and mended; one picture for both where they are the same.
// Exposures in stops, one per picture.
Panels allVariants(Studio& studio, const std::string& scene, const std::string& kind,
                   const std::string& component, const std::array<int, 4>& stops) {
    Panels panels;
    for (int i = 0; i < 4; ++i) {
        const bool published = i < 2;
        const char* variant = i % 2 == 0 ? "regular" : "customised";
        Values values = {{"thesis." + kind + ".variant", variant}};
        if (published) values.emplace_back("thesis.published", "true");
        const std::size_t at = std::size_t(i);
        if (component != "occlusion") values.emplace_back("image.exposure", std::to_string(stops[at]));
        std::string label = fmt::format("{}, {}", variant, published ? "as published" : "mended");
        if (stops[at] != 0) label += fmt::format(", {:g} times brighter", std::exp2(stops[at]));
        Panel panel = studio.draw(label, thesisShot(scene, component, values, 64));
        if (!panels.empty() && panels.back().bytes == panel.bytes)
            panels.back().label = "regular or " + label;
        else
            panels.push_back(std::move(panel));
    }
    return panels;
}

}  // namespace

Panels renderConesOfPixel(Studio& studio) {
    return {studio.inspect("", thesisShot("thesis-room", "full", {{"thesis.specular.min_weight", "0"}}), 0.36,
                           0.86)};
}

Panels renderMagnification(Studio& studio) {
    Panels panels = {drawn("a picture", drawMagnification())};
    for (const auto& [filter, label] :
         {std::pair("nearest", "cones that read the nearest texel"), std::pair("linear", "means of texels")})
        panels.push_back(studio.draw(
            label,
            thesisShot("thesis-room", "diffuse", {{"thesis.filter", filter}, {"image.exposure", "1"}}, 64)));
    return panels;
}

Panels renderThreeDirections(Studio& studio) {
    Panels panels = {drawn("a dome", drawThreeVoxelizations())};
    for (const auto& [along, label] : {std::pair("x", "along x"), std::pair("y", "along y"),
                                       std::pair("z", "along z"), std::pair("three", "three passes")})
        panels.push_back(studio.draw(
            label, thesisShot("thesis-room?front=0", "voxels",
                              {{"thesis.published", "true"}, {"thesis.voxelize_along", along}}, 64)));
    return panels;
}

Panels renderLightAndVoxels(Studio& studio) {
    return {studio.draw("direct light", thesisShot("thesis-room?front=0", "direct")),
            studio.draw("its voxels", thesisShot("thesis-room?front=0", "voxels", {}, 64))};
}

Panels renderPrimitives(Studio& studio) {
    return {studio.draw("", {.scene = "builtin:thesis-shapes?falloff=1", .mode = "phong", .camera = "pos2"})};
}

Panels renderResolutions(Studio& studio) {
    Panels panels;
    for (const int voxels : {32, 64, 128})
        panels.push_back(studio.draw(
            fmt::format("{} voxels", voxels),
            thesisShot("thesis-room?front=0", "voxels", {{"voxels.size", std::to_string(voxels)}}, voxels)));
    return panels;
}

Panels renderOcclusionVariants(Studio& studio) {
    return allVariants(studio, "thesis-room", "occlusion", "occlusion", {0, 0, 0, 0});
}

Panels renderSpecularVariants(Studio& studio) {
    return allVariants(studio, "thesis-complex", "specular", "specular", {2, 2, 2, 2});
}

Panels renderDiffuseVariants(Studio& studio) {
    return allVariants(studio, "thesis-room", "diffuse", "diffuse", {6, 2, 1, 1});
}

Panels renderConeSets(Studio& studio) {
    struct Set {
        const char* name;
        bool side, intermediate;
    };
    constexpr Set kSets[] = {{"front", false, false},
                             {"front and side", true, false},
                             {"front and intermediate", false, true},
                             {"all", true, true}};
    Panels panels;
    for (const Set& set : kSets)
        panels.push_back(studio.draw(
            set.name, thesisShot("thesis-complex", "diffuse",
                                 {{"thesis.front_cone", "true"},
                                  {"thesis.side_cones", set.side ? "true" : "false"},
                                  {"thesis.intermediate_cones", set.intermediate ? "true" : "false"}})));
    for (const Set& set : kSets) panels.push_back(drawn(set.name, drawConeSet(set.side, set.intermediate)));
    return panels;
}

Panels renderLeaks(Studio& studio) {
    Panels panels;
    for (const int level : {0, 2, 3, 4})
        panels.push_back(studio.draw(
            fmt::format("level {}", level),
            thesisShot("thesis-leak?front=0", "voxels",
                       {{"thesis.voxel_view", "surfaces"}, {"thesis.voxel_level", std::to_string(level)}})));
    return panels;
}

Panels renderBallNearWall(Studio& studio) {
    return {studio.draw("fixed offsets, as published",
                        thesisShot("thesis-ball", "full", {{"thesis.published", "true"}})),
            studio.draw("offsets that suit the voxel", thesisShot("thesis-ball", "full"))};
}

Panels renderJumpingVoxels(Studio& studio) {
    Panels panels;
    for (const char* shift : {"0", "-0.000002"})
        panels.push_back(studio.draw(fmt::format("wall moved by {} m", shift),
                                     thesisShot(fmt::format("thesis-ball?shift={}", shift), "occlusion",
                                                {{"thesis.published", "true"}}, 64)));
    panels.push_back(studio.draw("moved by -0.000002 m, mended",
                                 thesisShot("thesis-ball?shift=-0.000002", "occlusion", {}, 64)));
    return panels;
}

Panels renderRings(Studio& studio) {
    return {studio.draw("as published: the last step counts in full",
                        thesisShot("thesis-ball", "occlusion", {{"thesis.published", "true"}}, 64)),
            studio.draw("the last step by its share, all else as published",
                        thesisShot("thesis-ball", "occlusion", defectsBut("last_step"), 64))};
}

Panels renderGallery(Studio& studio) {
    // All modes in the same tones: the scenes' format has no tone map for mode thesis, and three lamps clip.
    const Values shown = {{"image.exposure", "auto"}, {"image.tone_map", "aces"}, {"image.srgb", "true"}};
    Panels panels;
    for (const char* mode : {"thesis", "cones", "traced"}) {
        for (const auto& [name, scene] :
             {std::pair("statue", "builtin:thesis-room"), std::pair("three lamps", "builtin:thesis-complex")})
            panels.push_back(
                studio.draw(fmt::format("{}, mode {}", name, mode),
                            {.scene = scene, .mode = mode, .camera = "pos2", .settings = shown}));
    }
    return panels;
}

}  // namespace conelight::figures

// SPDX-License-Identifier: MIT
// Every command and alias of the thesis's program, by what it leaves behind.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <set>

#include "console_test_support.h"
#include "thesis/format/scene.h"

namespace conelight::program {
namespace {

using test::ConsoleRig;

struct Drive {
    const char* line;
    std::function<std::string(const Session&)> state;
    const char* expected;          // of `state` after the line
    const char* output = nullptr;  // its first line
};

std::function<std::string(const Session&)> setting(const char* key) {
    return [key](const Session& s) { return getSetting(s.settings(), key); };
}
std::function<std::string(const Session&)> flag(bool ViewFlags::*member) {
    return [member](const Session& s) { return s.flags().*member ? std::string("on") : "off"; };
}
std::string eye(const Session& s) {
    return fmt::format("{:.2f} {:.2f} {:.2f}", s.camera().eye.x, s.camera().eye.y, s.camera().eye.z);
}
std::string matrix(const Session& s) {
    std::string text;
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 3; ++r)
            text +=
                fmt::format("{}{:.3g}", text.empty() ? "" : " ",
                            std::round(1000 * s.scene().instances[0].worldFromObject[c][r]) / 1000 + 0.0f);
    return text;
}
std::string only(const Session& s) {
    std::string text;
    for (const char* key :
         {"thesis.phong", "thesis.vox_diffuse", "thesis.vox_shadows", "thesis.vox_specular"})
        text += getSetting(s.settings(), key) == "true" ? "1" : "0";
    return text;
}
std::string shininess(const Session& s) {
    const Material& m = s.scene().materials[0];
    return fmt::format("{:g} {:g} {:g} {:g}", m.phong->shininess, m.phong->ambientStrength,
                       m.phong->diffuseStrength, m.phong->specularStrength);
}
std::string times(const Session& s) { return std::to_string(s.frameTimes().all().size()); }
std::string request(const Session& s) { return s.hasRequests() ? "asked" : "none"; }

// In this order, one after the other; the rig's scene has two boxes "box" and "lid", mode thesis.
const Drive kDrives[] = {
    {"objs", flag(&ViewFlags::drawObjects), "off", "Draw Objects: OFF"},
    {"objs", flag(&ViewFlags::drawObjects), "on", "Draw Objects: ON"},
    {"voxs", flag(&ViewFlags::drawVoxels), "on", "Draw Voxels: ON"},
    {"voxs", flag(&ViewFlags::drawVoxels), "off", "Draw Voxels: OFF"},
    {"vox", request, "asked"},
    {"voxsW", flag(&ViewFlags::wireframeVoxels), "on", "Wireframe Voxels: ON"},
    {"objsW", flag(&ViewFlags::wireframeObjects), "on", "Wireframe Objects: ON"},
    {"overlayW", flag(&ViewFlags::wireframeOverlay), "on", "Wireframe Overlay: ON"},
    {"sfMode", flag(&ViewFlags::singleFrame), "on", "Single Frame Mode: ON"},
    {"sf", request, "asked"},
    {"sfMode", flag(&ViewFlags::singleFrame), "off", "Single Frame Mode: OFF"},
    {"iLight", [](const Session& s) { return s.mode(); }, "phong", "VXCT: OFF"},
    {"iLight", [](const Session& s) { return s.mode(); }, "thesis", "VXCT: ON"},
    {"pos1", eye, "1.26 0.10 1.73"},
    {"pos2", eye, "0.00 0.00 1.80"},
    {"ray",
     [](const Session& s) {
         return s.rayMark() ? fmt::format("{:.3f} n {:.3f}", s.rayMark()->position.z, s.rayMark()->normal.z)
                            : std::string("no hit");
     },
     "0.500 n 1.000", "Raycast hit object: box, Distance: 1.3 m"},
    {"loclod", flag(&ViewFlags::localizedLod), "on", "Localized LOD Mode: ON"},
    {"loclod", flag(&ViewFlags::localizedLod), "off"},
    {"avgf", times, "3", "Average frametime across last 3 frames: 20 ms"},
    {"lastframes 2", times, "3", "20 ms"},
    {"clearf", times, "0", "All frametimes cleared."},
    {"avgf", times, "0", "no frames yet"},
    {"dynamic", flag(&ViewFlags::dynamic), "on", "Dynamic Revoxelization: ON"},
    {"vox_freq 0.25", [](const Session& s) { return fmt::format("{:g}", s.flags().period); }, "0.25"},
    {"draw_block", flag(&ViewFlags::drawBlock), "on", "Draw Block: ON"},
    {"phong", setting("thesis.phong"), "false", "VXCT Phong: OFF"},
    {"phong_ambient", setting("thesis.phong_ambient"), "false", "VXCT Phong Ambient: OFF"},
    {"phong_diffuse", setting("thesis.phong_diffuse"), "false", "VXCT Phong Diffuse: OFF"},
    {"phong_specular", setting("thesis.phong_specular"), "true", "VXCT Phong Specular: ON"},
    {"front_cone", setting("thesis.front_cone"), "false", "VXCT Front Cone: OFF"},
    {"side_cones", setting("thesis.side_cones"), "true", "VXCT Side Cones: ON"},
    {"intermediate_cones", setting("thesis.intermediate_cones"), "false", "VXCT Intermediate Cones: OFF"},
    {"vox_diffuse", setting("thesis.vox_diffuse"), "false", "VXCT Diffuse Component: OFF"},
    {"vdiff", setting("thesis.vox_diffuse"), "true", "VXCT Diffuse Component: ON"},
    {"vox_specular", setting("thesis.vox_specular"), "false", "VXCT Specular Component: OFF"},
    {"vspec", setting("thesis.vox_specular"), "true", "VXCT Specular Component: ON"},
    {"vox_shadows", setting("thesis.vox_shadows"), "false", "VXCT Occlusion Component: OFF"},
    {"vshad", setting("thesis.vox_shadows"), "true", "VXCT Occlusion Component: ON"},
    {"phong_only", only, "1000"},
    {"shadows_only", only, "0010"},
    {"specular_only", only, "0001"},
    {"diffuse_only", only, "0100"},
    {"all", only, "1111"},
    {"diffuse_offset 0.25", setting("thesis.diffuse.offset"), "0.25"},
    {"do 0.3", setting("thesis.diffuse.offset"), "0.3"},
    {"diffuse_offset", setting("thesis.diffuse.offset"), "0.3", "Diffuse Offset : 0.3"},
    {"do", setting("thesis.diffuse.offset"), "0.3", "Diffuse Offset : 0.3"},
    {"occlusion_offset 0.1", setting("thesis.occlusion.offset"), "0.1"},
    {"oo 0.2f", setting("thesis.occlusion.offset"), "0.2"},
    {"occlusion_offset", setting("thesis.occlusion.offset"), "0.2", "Occlusion Offset : 0.2"},
    {"oo", setting("thesis.occlusion.offset"), "0.2", "Occlusion Offset : 0.2"},
    {"specular_offset 0.4", setting("thesis.specular.offset"), "0.4"},
    {"so 0.5", setting("thesis.specular.offset"), "0.5"},
    {"specular_offset", setting("thesis.specular.offset"), "0.5", "Specular Offset : 0.5"},
    {"so", setting("thesis.specular.offset"), "0.5", "Specular Offset : 0.5"},
    {"diffuse_dist_factor 0.5", setting("thesis.diffuse.dist_factor"), "0.5"},
    {"ddf 0.6", setting("thesis.diffuse.dist_factor"), "0.6"},
    {"occlusion_dist_factor 0.7", setting("thesis.occlusion.dist_factor"), "0.7"},
    {"odf 0.8", setting("thesis.occlusion.dist_factor"), "0.8"},
    {"specular_dist_factor 0.9", setting("thesis.specular.dist_factor"), "0.9"},
    {"sdf 1", setting("thesis.specular.dist_factor"), "1"},
    {"diffuse_origin_offset 0.02", setting("thesis.diffuse.origin_offset"), "0.02"},
    {"doo 0.03", setting("thesis.diffuse.origin_offset"), "0.03"},
    {"diffuse_aperture 0.5", setting("thesis.diffuse.aperture"), "0.5"},
    {"da 0.6", setting("thesis.diffuse.aperture"), "0.6"},
    {"occlusion_aperture 0.2", setting("thesis.occlusion.aperture"), "0.2"},
    {"oa 0.3", setting("thesis.occlusion.aperture"), "0.3"},
    {"specular_aperture 0.05", setting("thesis.specular.aperture"), "0.05"},
    {"sa 0.06", setting("thesis.specular.aperture"), "0.06"},
    {"shadow_str 2", setting("thesis.occlusion.shadow_str"), "2"},
    {"ss 3", setting("thesis.occlusion.shadow_str"), "3"},
    {"shininess_falloff 4", setting("thesis.specular.shininess_falloff"), "4"},
    {"sf 5", setting("thesis.specular.shininess_falloff"), "5"},
    {"lod 3", setting("thesis.voxel_level"), "3"},
    {"toggle box", [](const Session& s) { return s.scene().instances[0].visible ? "on" : "off"; }, "off",
     "box: OFF"},
    {"toggle box", [](const Session& s) { return s.scene().instances[0].visible ? "on" : "off"; }, "on",
     "box: ON"},
    {"translate box y 0.5", matrix, "1 0 0 0 1 0 0 0 1 0 0.5 0"},
    {"scale box 0.5", matrix, "0.5 0 0 0 0.5 0 0 0 0.5 0 0.5 0"},
    // Half of the size, but a metre is a metre.
    {"translate box x 1", matrix, "0.5 0 0 0 0.5 0 0 0 0.5 1 0.5 0"},
    {"rotate box z 90", matrix, "0 0.5 0 -0.5 0 0 0 0 0.5 1 0.5 0"},
    {"setmat box shininess 64", shininess, "64 0.08 1 0.5"},
    {"setmat box ambient_str 0.2", shininess, "64 0.2 1 0.5"},
    {"setmat box diffuse_str 2", shininess, "64 0.2 2 0.5"},
    {"setmat box specular_str 1.5", shininess, "64 0.2 2 1.5"},
    {"load builtin:cornell", request, "asked"},
    {"exit", request, "asked"},
    {"quit", request, "asked"},
    {"q", request, "asked"},
};

TEST(OriginalCommands, EachDoesWhatItDid) {
    ConsoleRig rig;
    for (const double time : {10.0, 20.0, 30.0}) rig.session.frameDrawn(time);
    for (const Drive& drive : kDrives) {
        rig.lines.clear();
        rig.run(drive.line);
        EXPECT_EQ(drive.state(rig.session), drive.expected) << drive.line;
        for (const ConsoleLine& line : rig.lines)
            EXPECT_FALSE(line.isError) << drive.line << ": " << line.text;
        if (drive.output != nullptr) {
            ASSERT_FALSE(rig.lines.empty()) << drive.line;
            EXPECT_EQ(rig.lines.front().text, drive.output) << drive.line;
        }
        while (rig.session.takeRequest()) {
        }
    }
}

// The 70 first words of the original's 57 branches.
const char* const kWords[] = {"objs",
                              "voxs",
                              "vox",
                              "voxsW",
                              "objsW",
                              "sfMode",
                              "sf",
                              "iLight",
                              "overlayW",
                              "pos1",
                              "pos2",
                              "ray",
                              "loclod",
                              "avgf",
                              "clearf",
                              "dynamic",
                              "phong",
                              "phong_ambient",
                              "phong_diffuse",
                              "phong_specular",
                              "front_cone",
                              "side_cones",
                              "intermediate_cones",
                              "vox_diffuse",
                              "vdiff",
                              "vox_specular",
                              "vspec",
                              "vox_shadows",
                              "vshad",
                              "phong_only",
                              "shadows_only",
                              "specular_only",
                              "diffuse_only",
                              "all",
                              "diffuse_offset",
                              "do",
                              "occlusion_offset",
                              "oo",
                              "specular_offset",
                              "so",
                              "draw_block",
                              "exit",
                              "quit",
                              "q",
                              "diffuse_dist_factor",
                              "ddf",
                              "occlusion_dist_factor",
                              "odf",
                              "specular_dist_factor",
                              "sdf",
                              "diffuse_origin_offset",
                              "doo",
                              "diffuse_aperture",
                              "da",
                              "occlusion_aperture",
                              "oa",
                              "specular_aperture",
                              "sa",
                              "shadow_str",
                              "ss",
                              "shininess_falloff",
                              "lod",
                              "lastframes",
                              "load",
                              "vox_freq",
                              "toggle",
                              "scale",
                              "setmat",
                              "translate",
                              "rotate"};

TEST(OriginalCommands, NoneIsLeftOut) {
    const std::set<std::string> words(std::begin(kWords), std::end(kWords));
    EXPECT_EQ(words.size(), 70u);
    std::set<std::string> driven;
    for (const Drive& drive : kDrives) driven.insert(parseStatements(drive.line).at(0).words.at(0));
    EXPECT_EQ(driven, words);
    int branches = 0;
    std::set<std::string> listed;
    for (const CommandGroup& group : commandGroups()) {
        for (const Command& command : group.commands) {
            branches += command.branches;
            EXPECT_EQ(command.branches > 0, !command.original.empty()) << command.name;
            if (command.branches == 0) continue;
            listed.insert(command.name);
            listed.insert(command.aliases.begin(), command.aliases.end());
        }
    }
    EXPECT_EQ(branches, 57);
    EXPECT_EQ(listed, words);
}

TEST(OriginalCommands, WhatHungOrWasSilentIsAnError) {
    ConsoleRig rig;
    for (const char* line : {"diffuse_offset 0",
                             "do -1",
                             "occlusion_aperture 0",
                             "odf 0",
                             "sdf -1",
                             "da nan",
                             "oa x",
                             "lod -1",
                             "lod 9",
                             "lod 1.5",
                             "lastframes 0",
                             "toggle nobody",
                             "scale box 0",
                             "setmat box colour 1",
                             "translate box w 1",
                             "rotate nobody x 1",
                             "vox_freq -1",
                             "sf",
                             "objs now",
                             "translate box x"}) {
        rig.lines.clear();
        rig.run(line);
        ASSERT_EQ(rig.lines.size(), 1u) << line;
        EXPECT_TRUE(rig.lines[0].isError) << line;
    }
    EXPECT_EQ(rig.session.undoSteps(), 0u);
}

// The thesis measured its second table with it.
TEST(OriginalCommands, APeriodOfNothingIsEveryFrame) {
    ConsoleRig rig;
    rig.run("vox_freq 0");
    EXPECT_EQ(rig.session.flags().period, 0);
    for (const auto& line : rig.lines) EXPECT_FALSE(line.isError);
}

TEST(OriginalCommands, ConesSayWhereTheyAreSeen) {
    ConsoleRig rig;
    rig.run("mode cones; side_cones");
    ASSERT_EQ(rig.lines.size(), 2u);
    EXPECT_EQ(rig.lines[0].text, "VXCT Side Cones: ON");
    EXPECT_NE(rig.lines[1].text.find("mode thesis"), std::string::npos);
}

TEST(OriginalCommands, RayHitsWhatIsThere) {
    ConsoleRig rig;
    rig.run("pos2; toggle box; ray");  // the lid is behind the hidden box
    EXPECT_EQ(rig.lines.at(1).text, "Raycast hit object: lid, Distance: 3.3 m");
    EXPECT_EQ(rig.session.selection(), (Selection{SelectionKind::Instance, 1}));
    rig.lines.clear();
    rig.run("toggle lid; ray");
    EXPECT_EQ(rig.lines.at(1).text, "Raycast: no hit");
    EXPECT_FALSE(rig.session.rayMark());
}

TEST(OriginalCommands, CameraOfTheSceneWinsOverThePreset) {
    ConsoleRig rig;
    rig.run("camera eye 9 8 7; camera add pos1; camera eye 0 0 3; pos1");
    EXPECT_EQ(rig.session.camera().eye, glm::vec3(9, 8, 7));
}

}  // namespace
}  // namespace conelight::program

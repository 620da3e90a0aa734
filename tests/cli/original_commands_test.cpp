// SPDX-License-Identifier: MIT
// The commands of the thesis's program by what they do to the picture: each changes it, and `undo` brings it
// back bit for bit. What they leave in the session: tests/cpu/console_original_test.cpp.
#include <filesystem>
#include <fstream>
#include <vector>

#include "support/gl_fixture.h"
#include "support/program.h"

namespace conelight::test {
namespace {

class OriginalCommandsTest : public GlTest {};

struct Case {
    const char* command;
    const char* before = "";  // what has to be so for the command to show
    int undos = 1;
    int undosBefore = 0;
};

const Case kCases[] = {
    {"objs"},
    {"voxs"},
    {"voxsW", "voxs", 1, 1},
    {"objsW"},
    {"overlayW"},
    {"loclod"},
    {"lod 2", "voxs", 1, 1},
    {"iLight"},
    {"pos1"},
    {"pos2"},
    {"phong"},
    {"phong_diffuse"},
    {"phong_specular"},
    {"phong_ambient", "vdiff; setmat 'tall block' ambient_str 3", 1, 2},
    {"front_cone"},
    {"side_cones"},
    {"intermediate_cones"},
    {"vox_diffuse"},
    {"vdiff"},
    {"vox_specular"},
    {"vspec"},
    {"vox_shadows"},
    {"vshad"},
    {"phong_only"},
    {"shadows_only"},
    {"specular_only"},
    {"diffuse_only"},
    {"all", "phong_only", 1, 1},
    {"diffuse_dist_factor 0.1"},
    {"ddf 2"},
    {"occlusion_dist_factor 0.1"},
    {"odf 2"},
    {"specular_dist_factor 0.1"},
    {"sdf 2"},
    {"diffuse_offset 0.2"},
    {"do 0.3"},
    {"diffuse_origin_offset 0.2", "set thesis.defects.fixed_offsets true", 1, 1},
    {"doo 0.3", "set thesis.defects.fixed_offsets true", 1, 1},
    {"occlusion_offset 0.2"},
    {"oo 0.3"},
    {"specular_offset 0.2"},
    {"so 0.3"},
    {"diffuse_aperture 0.3"},
    {"da 1.5"},
    {"occlusion_aperture 0.6"},
    {"oa 0.9"},
    {"specular_aperture 0.6"},
    {"sa 0.9"},
    {"shadow_str 10"},
    {"ss 0.3"},
    {"shininess_falloff 8"},
    {"sf 0.2"},
    {"toggle 'tall block'"},
    {"scale 'tall block' 0.5"},
    {"translate 'tall block' y 0.2"},
    {"rotate 'tall block' y 40"},
    {"setmat 'tall block' shininess 5"},
    {"setmat 'tall block' ambient_str 3", "vdiff", 1, 1},
    {"setmat 'tall block' diffuse_str 0.2"},
    {"setmat 'tall block' specular_str 0.1"},
};

TEST_F(OriginalCommandsTest, EachChangesThePictureAndUndoBringsItBack) {
    const std::string folder = scratchPath("original_commands");
    std::filesystem::create_directories(folder);
    const auto picture = [&](std::size_t i, const char* part) {
        return folder + "/" + std::to_string(i) + part + ".exr";
    };
    // All objects share a material here: give the tall block a glossy one of its own.
    std::string script = "setmat 'tall block' specular_str 0.8; setmat 'tall block' shininess 40\n";
    for (std::size_t i = 0; i < std::size(kCases); ++i) {
        const Case& one = kCases[i];
        script += std::string(one.before) + "\nscreenshot '" + picture(i, "a") + "'\n" + one.command +
                  "\nscreenshot '" + picture(i, "b") + "'\n";
        for (int k = 0; k < one.undos; ++k) script += "undo\n";
        script += "screenshot '" + picture(i, "c") + "'\n";
        for (int k = 0; k < one.undosBefore; ++k) script += "undo\n";
    }
    std::ofstream(folder + "/script.txt") << script;
    const CommandResult result =
        conelight("render builtin:cornell-point --mode thesis --size 48x32 --voxels 32 --script '" + folder +
                  "/script.txt'");
    ASSERT_EQ(result.status, 0) << result.output;
    const std::string start = bytesOf(picture(0, "a"));
    ASSERT_FALSE(start.empty());
    for (std::size_t i = 0; i < std::size(kCases); ++i) {
        const std::string before = bytesOf(picture(i, "a")), after = bytesOf(picture(i, "b"));
        EXPECT_TRUE(before != after) << kCases[i].command;  // not as text: pictures are long
        EXPECT_TRUE(before == bytesOf(picture(i, "c"))) << "undo of " << kCases[i].command;
        if (kCases[i].undosBefore == 0) {
            EXPECT_TRUE(before == start) << kCases[i].command;
        }
    }
}

}  // namespace
}  // namespace conelight::test

// SPDX-License-Identifier: MIT
// `conelight figures`: each drawing is made, shows something and is the same twice; wrong names are said;
// nothing of others is written over; pictures of scenes are made small, and differ where they should.
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "io/image_file.h"
#include "support/program.h"

namespace conelight::test {
namespace {

namespace fs = std::filesystem;

class FiguresCliTest : public GlTest {};

std::string folder(const std::string& name) {
    const std::string path = scratchPath(name);
    fs::remove_all(path);
    return path;
}

CommandResult figures(const std::string& arguments) { return conelight("figures " + arguments); }

struct Drawn {
    std::string id, kind, file;
};

// What figures.json of a folder names.
std::vector<Drawn> drawnIn(const std::string& directory) {
    std::vector<Drawn> all;
    const nlohmann::json json = nlohmann::json::parse(bytesOf(directory + "/figures.json"));
    for (const nlohmann::json& figure : json["figures"])
        for (const nlohmann::json& file : figure["files"])
            all.push_back({figure["id"], figure["kind"], file["file"]});
    return all;
}

std::size_t count(const std::string& text, const std::string& part) {
    std::size_t n = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
    return n;
}

TEST_F(FiguresCliTest, ListNamesAllFigures) {
    const CommandResult list = figures("--list");
    ASSERT_EQ(list.status, 0) << list.output;
    for (int i = 1; i <= 50; ++i) EXPECT_EQ(count(list.output, fmt::format("F{:02} ", i)), 1u) << i;
    for (const char* table : {"T1 ", "T2 "}) EXPECT_EQ(count(list.output, table), 1u) << table;
}

TEST_F(FiguresCliTest, DrawingsShowSomethingAndAreTheSameTwice) {
    const std::string a = folder("drawings_a"), b = folder("drawings_b");
    ASSERT_EQ(figures("--only drawing,plot -o '" + a + "'").status, 0);
    ASSERT_EQ(figures("--only drawing,plot -o '" + b + "'").status, 0);
    const std::vector<Drawn> all = drawnIn(a);
    EXPECT_GE(all.size(), 27u);
    std::set<std::string> texts;
    for (const Drawn& one : all) {
        const std::string text = bytesOf(a + "/" + one.file);
        EXPECT_EQ(text, bytesOf(b + "/" + one.file)) << one.file << " is not the same twice";
        EXPECT_TRUE(text.starts_with("<svg ")) << one.file;
        EXPECT_GE(count(text, "<text "), 2u) << one.file << " has no labels";
        EXPECT_GE(count(text, "<poly") + count(text, "<rect") + count(text, "<image"), 3u) << one.file;
        EXPECT_EQ(count(text, ",nan") + count(text, "\"nan") + count(text, "inf\"") + count(text, ",inf"), 0u)
            << one.file;
        EXPECT_TRUE(texts.insert(text).second) << one.file << " equals another figure";
    }
    EXPECT_EQ(bytesOf(a + "/index.html"), bytesOf(b + "/index.html"));
    for (const Drawn& one : all)
        EXPECT_NE(bytesOf(a + "/index.html").find(one.file), std::string::npos) << one.file;
}

TEST_F(FiguresCliTest, WrongNamesAreSaid) {
    const std::string out = folder("undrawn");
    expectOneLine(figures("--only F51 -o '" + out + "'"), 2, "F51");
    expectOneLine(figures("--only F02"), 2, "--output");
    expectOneLine(figures("--only F02 --size 3 -o '" + out + "'"), 2, "--size");
    EXPECT_FALSE(fs::exists(out));
}

TEST_F(FiguresCliTest, FilesOfOthersStay) {
    const std::string out = folder("foreign");
    fs::create_directories(out);
    std::ofstream(out + "/F02.svg") << "mine";
    expectOneLine(figures("--only F02 -o '" + out + "'"), 2, "F02.svg");
    EXPECT_EQ(bytesOf(out + "/F02.svg"), "mine");
    std::ofstream(out + "/index.html") << "mine, too";
    expectOneLine(figures("--only F03 -o '" + out + "'"), 2, "index.html");
    EXPECT_EQ(bytesOf(out + "/index.html"), "mine, too");
    expectOneLine(figures("--only F03 -o '" + out + "/F02.svg'"), 1, "F02.svg");
    // Its own files are drawn anew, and figures drawn before stay in the page.
    fs::remove_all(out);
    ASSERT_EQ(figures("--only F02,F03 -o '" + out + "'").status, 0);
    ASSERT_EQ(figures("--only f3 -o '" + out + "'").status, 0);
    EXPECT_EQ(drawnIn(out).size(), 2u);
}

// Panels of a figure: none is of one colour, no two are alike.
void expectPictures(const std::string& directory, const std::string& id, std::size_t panels) {
    std::set<std::vector<std::uint8_t>> pictures;
    std::size_t drawn = 0;
    for (const Drawn& one : drawnIn(directory)) {
        if (one.id != id || !one.file.ends_with(".png")) continue;
        const io::ByteImage image = io::readByteImage(directory + "/" + one.file);
        EXPECT_EQ(image.width, 96);
        EXPECT_GT(std::set<std::uint8_t>(image.pixels.begin(), image.pixels.end()).size(), 8u) << one.file;
        EXPECT_TRUE(pictures.insert(image.pixels).second) << one.file << " equals another panel";
        ++drawn;
    }
    EXPECT_EQ(drawn, panels) << id;
}

TEST_F(FiguresCliTest, TablesHoldWhatWasMeasuredAndPrinted) {
    const std::string out = folder("tables");
    ASSERT_EQ(figures("--only T1,F47 --small -o '" + out + "'").status, 0);
    const nlohmann::json table = nlohmann::json::parse(bytesOf(out + "/T1.json"));
    ASSERT_EQ(table["cells"].size(), 6u);
    for (const nlohmann::json& cell : table["cells"]) {
        EXPECT_GE(cell["frames"], 2);
        EXPECT_GT(cell["wall_ms"], 0);
        EXPECT_GT(cell["cpu_ms"], 0);
        EXPECT_GT(cell["original_cpu_ms"], 1000);
    }
    EXPECT_EQ(table["cells"][0]["thesis_s"], 0.01666);
    EXPECT_EQ(count(bytesOf(out + "/T1.md"), "\n| "), 7u);
    const nlohmann::json methods = nlohmann::json::parse(bytesOf(out + "/F47.json"));
    ASSERT_EQ(methods.size(), 8u);
    for (const nlohmann::json& method : methods) EXPECT_GT(method["relrmse"], 0) << method["mode"];
}

TEST_F(FiguresCliTest, PicturesAreDrawnAndDiffer) {
    const std::string a = folder("pictures_a"), b = folder("pictures_b");
    const std::string only =
        "--only F07,F12,F15,F16,F17,F18,F19,F22,F27,F29,F31,F36,F37,F38,F39,F40,F42,F45,F46,F48,F49,B02 "
        "--small "
        "-o '";
    ASSERT_EQ(figures(only + a + "'").status, 0);
    for (const auto& [id, panels] : {std::pair<const char*, std::size_t>{"F07", 3},
                                     {"F12", 2},
                                     {"F15", 2},
                                     {"F16", 1},
                                     {"F17", 1},
                                     {"F18", 4},
                                     {"F19", 2},
                                     {"F22", 1},
                                     {"F27", 2},
                                     {"F29", 2},
                                     {"F31", 4},
                                     {"F36", 1},
                                     {"F37", 3},
                                     {"F38", 4},
                                     {"F39", 4},
                                     {"F40", 3},
                                     {"F42", 4},
                                     {"F45", 4},
                                     {"F46", 2},
                                     {"F48", 3},
                                     {"F49", 2},
                                     {"B02", 5}})
        expectPictures(a, id, panels);
    ASSERT_EQ(figures("--only F16,F37,F46 --small -o '" + b + "'").status, 0);
    for (const Drawn& one : drawnIn(b))
        EXPECT_EQ(bytesOf(a + "/" + one.file), bytesOf(b + "/" + one.file)) << one.file;
}

TEST_F(FiguresCliTest, InfoPrintsTheSyntaxTree) {
    const std::string file = scratchPath("tree.scene");
    std::ofstream(file) << "scene = {\n name = s\n light = {\n  color = { r = 1.0 }\n }\n}\n";
    const CommandResult tree = conelight("info --tree '" + file + "'");
    EXPECT_EQ(tree.status, 0);
    EXPECT_EQ(tree.output,
              "    1  scene\n    2    name = s\n    3    light\n    4      color\n    4        r = 1.0\n");
    expectOneLine(conelight("info --tree builtin:cornell"), 2, "--tree");
}

}  // namespace
}  // namespace conelight::test

// SPDX-License-Identifier: MIT
// fuzz_seeds DIR: what the fuzz targets start from, a folder each: the files of the tests' corpus.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "console/command_table.h"
#include "guests.h"
#include "support/corpus.h"

namespace {

namespace fs = std::filesystem;

// Pipes, devices and folders of the corpus are nothing to start from.
void copyFiles(const fs::path& from, const fs::path& to, const std::vector<std::string>& endings) {
    fs::create_directories(to);
    static int number = 0;  // names of several calls differ
    for (const fs::directory_entry& entry :
         fs::recursive_directory_iterator(from, fs::directory_options::skip_permission_denied)) {
        std::error_code loop;  // a link to itself has no status
        const std::string ending = entry.path().extension().string();
        const bool wanted = !entry.is_symlink(loop) && entry.is_regular_file(loop) &&
                            entry.file_size() < 1 << 16 &&
                            std::find(endings.begin(), endings.end(), ending) != endings.end();
        if (wanted) fs::copy_file(entry.path(), to / (std::to_string(number++) + ending));
    }
}

// A word that the argument may be, in the scene of cpu/console_test_support.h.
std::string wordFor(const conelight::program::Argument& argument) {
    using conelight::program::ArgumentKind;
    switch (argument.kind) {
        case ArgumentKind::Number:
        case ArgumentKind::Whole:
            return std::to_string(static_cast<int>(0.5 * (argument.low + argument.high)));
        case ArgumentKind::Choice:
            return argument.choices.front();
        case ArgumentKind::Mode:
            return "cones";
        case ArgumentKind::Setting:
            return "voxels.size";
        case ArgumentKind::SettingValue:
            return "32";
        case ArgumentKind::Object:
        case ArgumentKind::Selectable:
            return "box";
        case ArgumentKind::Material:
            return "white";
        case ArgumentKind::Light:
            return "lamp";
        case ArgumentKind::Camera:
            return "main";
        case ArgumentKind::CommandName:
            return "help";
        default:
            return "word";
    }
}

// Each command once, with all its arguments; settings, one by one; all of them in one script.
void writeScripts(const fs::path& folder) {
    using namespace conelight;
    program::registerGuests();
    std::string all;
    int number = 0;
    const auto add = [&](const std::string& line) {
        std::ofstream(folder / ("command" + std::to_string(number++) + ".txt")) << line << "\n";
        all += line + "\n";
    };
    for (const program::CommandGroup& group : program::commandGroups())
        for (const program::Command& command : group.commands) {
            std::string line = command.name;
            for (const program::Argument& argument : command.arguments) line += " " + wordFor(argument);
            add(line);
        }
    for (const SettingInfo& setting : settingInfos()) add("set " + setting.key + " 1");
    for (const char* line :
         {"light add point; light lamp intensity 1 2 3; light lamp delete",
          "material white roughness 0.2; undo; redo",
          "path add 0; camera orbit 30 0; path add 1; path save a.json; path load a.json; path play 1",
          "preset save p.json; preset load p.json; preset list .",
          "save s.gltf; save s.txt; save s.glb overwrite", "duplicate box; delete box; isolate lid; show box",
          "echo 'a \"b\" c' \"d\\\"e\" # f", "reset voxels",
          "translate box x 1; rotate box y 45; scale box 2; setmat box diffuse 1"})
        add(line);
    std::ofstream(folder / "all.txt") << all;
}

}  // namespace

int main(int count, char** arguments) {
    if (count != 2) {
        std::fputs("usage: fuzz_seeds DIR\n", stderr);
        return 2;
    }
    using namespace conelight::test;
    const fs::path folder = arguments[1];
    const fs::path corpus = folder / "corpus";
    fs::create_directories(corpus / "gltf");
    fs::create_directories(corpus / "obj");
    fs::create_directories(corpus / "thesis");
    fs::create_directories(folder / "ies");
    std::ofstream(folder / "ies" / "wall_washer.ies")
        << "IESNA:LM-63-2002\n[TEST] fuzz\nTILT=NONE\n1 1000 1 3 3 1 2 0 0 0\n1 1 20\n0 45 90\n0 90 180\n"
           "100 80 0\n100 50 0\n100 20 0\n";
    fs::create_directories(corpus / "picture");
    for (const char* kind : {"preset", "camera_path", "cone_set", "batch_job", "console"})
        fs::create_directories(corpus / kind);
    gltfCorpus(corpus / "gltf");
    objCorpus(corpus / "obj");
    thesisCorpus(corpus / "thesis");
    pictureCorpus(corpus / "picture");
    copyFiles(corpus / "gltf", folder / "gltf", {".gltf"});
    copyFiles(corpus / "gltf", folder / "glb", {".glb"});
    compressedCorpus(corpus / "glb", {Packing::Meshopt, Packing::Webp});
    copyFiles(corpus / "glb", folder / "glb", {".glb"});
    compressedCorpus(corpus / "draco", {Packing::Draco});
    copyFiles(corpus / "draco", folder / "draco", {".glb"});
    copyFiles(corpus / "obj", folder / "obj", {".obj", ".mtl"});
    copyFiles(corpus / "thesis", folder / "thesis", {".txt"});
    copyFiles(corpus / "picture", folder / "picture", {".png", ".jpg", ".jpeg", ".webp"});
    copyFiles(corpus / "picture", folder / "exr", {".exr"});
    copyFiles(corpus / "picture", folder / "hdr", {".hdr"});
    presetCorpus(corpus / "preset");
    copyFiles(corpus / "preset", folder / "preset", {".json"});
    cameraPathCorpus(corpus / "camera_path");
    copyFiles(corpus / "camera_path", folder / "camera_path", {".json"});
    coneSetCorpus(corpus / "cone_set");
    copyFiles(corpus / "cone_set", folder / "cone_set", {".json"});
    batchJobCorpus(corpus / "batch_job");
    copyFiles(corpus / "batch_job", folder / "batch_job", {".json"});
    scriptCorpus(corpus / "console");
    copyFiles(corpus / "console", folder / "console", {".txt"});
    writeScripts(folder / "console");
    return 0;
}

// SPDX-License-Identifier: MIT
#include "outputs.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>

#include "conelight/error.h"
#include "io/files.h"
#include "io/scene_file.h"
#include "picture_input.h"

namespace conelight::program {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const Output& output, const std::string& why) {
    throw Error(ErrorKind::Usage, fmt::format("{}: {}: {}; another name would be right",
                                              io::oneLine(output.file), output.option, why));
}

// Also through links, and for a name that is not there yet.
bool same(const fs::path& a, const fs::path& b) {
    std::error_code code;
    if (fs::equivalent(a, b, code) && !code) return true;
    const fs::path resolvedA = fs::weakly_canonical(a, code), resolvedB = fs::weakly_canonical(b, code);
    return !resolvedA.empty() && resolvedA == resolvedB;
}

// Names of pictures and scenes; `.txt`, which is a scene's too, may be anything.
bool namesAnotherKind(const std::string& file) {
    if (isPictureFile(file)) return true;
    const std::string extension = io::lowerExtension(file);
    const std::vector<std::string> scenes = io::sceneExtensions();
    return extension != ".txt" && extension != ".json" &&
           std::find(scenes.begin(), scenes.end(), extension) != scenes.end();
}

// The first characters of a regular file; empty when there is none.
std::string headOf(const fs::path& file) {
    std::error_code code;
    if (!fs::is_regular_file(file, code)) return {};
    std::array<char, 4096> head{};  // chosen: our page says that it is ours in its first 1000
    std::ifstream stream(file, std::ios::binary);
    stream.read(head.data(), head.size());
    return {head.data(), static_cast<std::size_t>(stream.gcount())};
}

void checkKind(const Output& output) {
    if (output.kind == OutputKind::Picture) return;
    if (output.kind == OutputKind::Json && namesAnotherKind(output.file))
        refuse(output, "is the name of a picture or scene, and JSON is written");
    const std::string head = headOf(output.file);
    if (head.empty()) return;
    if (output.kind == OutputKind::Json) {
        const std::size_t first = head.find_first_not_of(" \t\r\n");
        if (first != std::string::npos && head[first] != '{' && head[first] != '[')
            refuse(output, "is there already and holds no JSON");
    } else if (head.find("<meta name=\"generator\" content=\"conelight") == std::string::npos) {
        refuse(output, "is there already and is no report of this program");
    }
}

}  // namespace

void checkOutputs(const std::vector<Output>& outputs, const std::vector<std::string>& inputs) {
    for (auto output = outputs.begin(); output != outputs.end(); ++output) {
        if (output->file.empty() || output->file == "-") continue;
        for (const std::string& input : inputs)
            if (!input.empty() && input.rfind("builtin:", 0) != 0 && same(output->file, input))
                refuse(*output, "is read by the same command");
        for (auto other = outputs.begin(); other != output; ++other)
            if (!other->file.empty() && other->file != "-" && other->file.rfind("/dev/", 0) != 0 &&
                same(output->file, other->file))
                refuse(*output, "is written by " + other->option + " too");
        checkKind(*output);
        io::checkWritable(output->file);
    }
}

}  // namespace conelight::program

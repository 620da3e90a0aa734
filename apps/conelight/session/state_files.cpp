// SPDX-License-Identifier: MIT
#include "session/state_files.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "io/files.h"

namespace conelight::program {
namespace {

namespace fs = std::filesystem;

std::string stateFolder() {
    const fs::path folder = io::userFolder("XDG_STATE_HOME", ".local/state");
    return folder.empty() ? std::string() : (folder / "conelight").string();
}

std::vector<std::string> linesOf(const std::string& file) {
    std::vector<std::string> lines;
    std::ifstream stream(file);
    for (std::string line; std::getline(stream, line);)
        if (!line.empty()) lines.push_back(line);
    return lines;
}

// Written beside and renamed, so that another program never reads half of it.
void write(const std::string& file, const std::vector<std::string>& lines) {
    const std::string part = file + ".part";
    {
        std::ofstream stream(part, std::ios::trunc);
        for (const std::string& line : lines) stream << line << '\n';
        if (!stream.flush()) return;
    }
    std::error_code ignored;
    fs::rename(part, file, ignored);
}

void keepLast(std::vector<std::string>& lines, std::size_t count) {
    if (lines.size() > count) lines.erase(lines.begin(), lines.end() - static_cast<std::ptrdiff_t>(count));
}

}  // namespace

StateFiles::StateFiles(bool keep) {
    if (!keep) return;
    folder_ = stateFolder();
    if (folder_.empty()) return;
    std::error_code error;
    fs::create_directories(folder_, error);
    if (error) {
        folder_.clear();
        return;
    }
    recent_ = linesOf(folder_ + "/recent");
    if (recent_.size() > kRecent) recent_.resize(kRecent);
}

void StateFiles::opened(const std::string& scene) {
    if (folder_.empty() || scene.empty()) return;
    std::string name = scene;
    std::error_code error;
    if (scene.compare(0, 8, "builtin:") != 0) {
        const fs::path whole = fs::absolute(scene, error);
        if (!error) name = whole.lexically_normal().string();
    }
    recent_ = linesOf(folder_ + "/recent");  // another program may have added to it
    recent_.erase(std::remove(recent_.begin(), recent_.end(), name), recent_.end());
    recent_.insert(recent_.begin(), name);
    if (recent_.size() > kRecent) recent_.resize(kRecent);
    write(folder_ + "/recent", recent_);
}

std::vector<std::string> StateFiles::lines() const {
    if (folder_.empty()) return {};
    std::vector<std::string> lines = linesOf(folder_ + "/history");
    const bool overlong = lines.size() > 2 * kLines;
    keepLast(lines, kLines);
    if (overlong) write(folder_ + "/history", lines);
    return lines;
}

// Added at once: a program that is killed has not forgotten.
void StateFiles::typed(const std::string& line) {
    if (folder_.empty() || line.empty() || line.find('\n') != std::string::npos) return;
    std::ofstream(folder_ + "/history", std::ios::app) << line << '\n';
}

}  // namespace conelight::program

// SPDX-License-Identifier: MIT
// Judged is the resolved path: absolute, without links, `.` and `..`. See scene_folder.h.
#include "io/scene_folder.h"

#include <fmt/core.h>

#include <algorithm>

#include "conelight/error.h"

namespace conelight::io {

namespace fs = std::filesystem;

namespace {

constexpr const char* kMissing = "no such file";
constexpr const char* kOutside =
    "lies outside the scene's folder; a file in it, or the option --allow-outside, would be right";

}  // namespace

SceneFolder::SceneFolder(const fs::path& scene, bool allowOutside)
    : folder_(scene.has_parent_path() ? scene.parent_path() : fs::path(".")), allowOutside_(allowOutside) {
    std::error_code code;
    const fs::path resolved = fs::weakly_canonical(folder_, code);
    if (!code) roots_.push_back(resolved);
}

void SceneFolder::alsoBelow(const fs::path& folder) {
    std::error_code code;
    const fs::path resolved = fs::weakly_canonical(folder, code);
    if (!code && resolved != resolved.root_path()) roots_.push_back(resolved);
}

bool SceneFolder::inside(const fs::path& resolved) const {
    return std::any_of(roots_.begin(), roots_.end(), [&](const fs::path& root) {
        const auto [end, unused] = std::mismatch(root.begin(), root.end(), resolved.begin(), resolved.end());
        return end == root.end();
    });
}

std::string SceneFolder::refusal(const fs::path& file) const {
    if (file.empty()) return "has no name";
    if (file.native().find('\0') != std::string::npos) return "has a zero byte in its name";
    std::error_code code;
    const fs::path resolved = fs::weakly_canonical(file, code);
    const fs::file_status status = fs::status(resolved, code);
    if (code || !fs::exists(status)) return kMissing;
    if (!allowOutside_ && !inside(resolved)) return kOutside;
    return whyNotRegular(status);
}

bool SceneFolder::isMissing(const std::string& refusal) { return refusal == kMissing; }

SceneFolder::Choice SceneFolder::firstOf(const std::vector<fs::path>& candidates) const {
    std::string refused = kMissing;
    for (const fs::path& candidate : candidates) {
        const std::string why = refusal(candidate);
        if (why.empty()) return {candidate, {}};
        if (refused == kMissing) refused = why;
    }
    return {{}, refused};
}

Bytes SceneFolder::read(const fs::path& file) const {
    const std::string why = refusal(file);
    if (!why.empty()) throw Error(ErrorKind::BadInput, fmt::format("{}: {}", oneLine(file.string()), why));
    return readFile(file);
}

}  // namespace conelight::io

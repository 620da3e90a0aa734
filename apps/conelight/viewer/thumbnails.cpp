// SPDX-License-Identifier: MIT
#include "viewer/thumbnails.h"

#include <fcntl.h>
#include <imgui.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

#include "conelight/error.h"
#include "io/image_file.h"
#include "session/thumbnail_files.h"
#include "viewer/widget_places.h"

namespace conelight::program {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostKnown = 64;  // textures of a quarter of a MiB
constexpr int kNice = 15;               // of 19

std::vector<std::uint8_t> rgbBytesOf(const io::ByteImage& image) {
    std::vector<std::uint8_t> rgb;
    const auto channels = static_cast<std::size_t>(image.channels);
    for (std::size_t i = 0; i < image.pixels.size(); i += channels)
        for (std::size_t c = 0; c < 3; ++c) rgb.push_back(image.pixels[i + (channels >= 3 ? c : 0)]);
    return rgb;
}

// Calls that are allowed between fork and exec.
[[noreturn]] void becomeThumbnail(const char* const* words) {
    ::setpriority(PRIO_PROCESS, 0, kNice);
    const int nowhere = ::open("/dev/null", O_RDWR);
    for (const int stream : {0, 1, 2}) ::dup2(nowhere, stream);
    ::execv("/proc/self/exe", const_cast<char* const*>(words));
    ::_exit(127);
}

}  // namespace

Thumbnails::~Thumbnails() {
    if (process_ <= 0) return;
    ::kill(process_, SIGTERM);
    ::waitpid(process_, nullptr, 0);
}

bool Thumbnails::load(const std::string& scene, One& one) {
    const std::optional<std::string> file = thumbnailOf(scene);
    if (!file) return false;
    try {
        const io::ByteImage image = io::readByteImage(*file);
        one.texture.update(image.width, image.height, rgbBytesOf(image));
    } catch (const Error&) {
        one.failure = "no preview";
    }
    return true;
}

void Thumbnails::draw(const std::string& scene) {
    const std::string file = thumbnailPath(scene);
    if (file.empty()) return;
    std::error_code ignored;
    fs::create_directories(fs::path(file).parent_path(), ignored);
    ::chmod(fs::path(file).parent_path().c_str(), 0700);  // as the standard wants it
    const char* const words[] = {"conelight", "thumbnail", scene.c_str(), file.c_str(), nullptr};
    process_ = ::fork();
    if (process_ == 0) becomeThumbnail(words);
    if (process_ > 0) drawn_ = scene;
}

void Thumbnails::follow() {
    int status = 0;
    if (process_ <= 0 || ::waitpid(process_, &status, WNOHANG) == 0) return;
    process_ = -1;
    const auto one = known_.find(std::exchange(drawn_, {}));
    if (one == known_.end()) return;
    if (!load(one->first, *one->second)) one->second->failure = "no preview: it cannot be drawn";
}

void Thumbnails::show(const std::string& scene, float width) {
    follow();
    if (known_.size() > kMostKnown) known_.clear();
    std::unique_ptr<One>& one = known_[scene];
    if (!one) {
        one = std::make_unique<One>();
        load(scene, *one);
    }
    const float height = 0.75f * width;
    if (one->texture.name() != 0) {
        const float scale = std::min(width / static_cast<float>(one->texture.width()),
                                     height / static_cast<float>(one->texture.height()));
        ImGui::Image((ImTextureID)(static_cast<std::uintptr_t>(one->texture.name())),
                     {scale * static_cast<float>(one->texture.width()),
                      scale * static_cast<float>(one->texture.height())});
        notePlace("thumbnail");
        return;
    }
    const bool rests = ImGui::GetIO().MouseDelta.x == 0 && ImGui::GetIO().MouseDelta.y == 0;
    if (draws_ && one->failure.empty() && process_ <= 0 && rests) draw(scene);
    const ImVec2 at = ImGui::GetCursorPos();
    ImGui::Dummy({width, height});
    ImGui::SetCursorPos({at.x, at.y + 0.45f * height});
    ImGui::TextDisabled("%s", !one->failure.empty() ? one->failure.c_str()
                              : draws_              ? "drawing a preview"
                                                    : "no preview");
    ImGui::SetCursorPos({at.x, at.y + height});
}

}  // namespace conelight::program

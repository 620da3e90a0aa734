// SPDX-License-Identifier: MIT
#include "viewer/recovery.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <imgui.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <utility>

#include "io/files.h"
#include "io/gltf_write.h"
#include "session/save.h"
#include "viewer/imgui_names.h"
#include "viewer/widget_places.h"

namespace conelight::program {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

constexpr auto kLeastPause = 5s;      // between two files
constexpr int kPauseForWork = 20;     // times as long as the last one took: a twentieth of a core at most
constexpr const char* kName = ".of";  // the file with the scene's name
constexpr int kMostNames = 100;

std::string firstLineOf(const std::string& file) {
    std::ifstream stream(file);
    std::string line;
    std::getline(stream, line);
    return io::oneLine(line);
}

std::string timeOf(const std::string& file) {
    struct stat info {};
    if (::stat(file.c_str(), &info) != 0) return "an unknown time";
    std::tm local{};
    localtime_r(&info.st_mtime, &local);
    char text[32];
    std::strftime(text, sizeof text, "%Y-%m-%d %H:%M", &local);
    return text;
}

// Whether the program that locked it has ended.
bool isLeft(const std::string& file) {
    const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) return false;
    const bool left = ::flock(descriptor, LOCK_EX | LOCK_NB) == 0;
    ::close(descriptor);
    return left;
}

void removeBoth(const std::string& file) {
    std::error_code ignored;
    fs::remove(file + ".glb", ignored);
    fs::remove(file + kName, ignored);
}

}  // namespace

struct Recovery::Work {
    Scene scene;
    std::string file, failure;
};

Recovery::Recovery(const StateFiles& state, ViewerConsole& console) : console_(console) {
    if (state.folder().empty()) return;
    folder_ = state.folder() + "/recovery";
    find();
    if (found_)
        console_.say(fmt::format("recovery: changes of {} of {} are in no file; the window asks what to do",
                                 found_->scene, found_->when));
}

Recovery::~Recovery() {
    if (lock_ >= 0) ::close(lock_);
}

// The newest that nobody has.
void Recovery::find() {
    found_.reset();
    std::error_code code;
    fs::file_time_type newest{};
    for (fs::directory_iterator entry(folder_, code), end; !code && entry != end; entry.increment(code)) {
        const fs::path path = entry->path();
        if (path.extension() != kName || !isLeft(path.string())) continue;
        const std::string file = fs::path(path).replace_extension().string();
        std::error_code missing;
        const fs::file_time_type time = fs::last_write_time(file + ".glb", missing);
        if (missing) {
            removeBoth(file);  // it ended before there was one
        } else if (!found_ || time > newest) {
            newest = time;
            found_ = Found{file, firstLineOf(path.string()), timeOf(file + ".glb")};
        }
    }
}

// A name of its own, locked.
bool Recovery::claim() {
    if (lock_ >= 0) return true;
    std::error_code ignored;
    fs::create_directories(folder_, ignored);
    for (int i = 0; i < kMostNames && lock_ < 0; ++i) {
        own_ = fmt::format("{}/{}-{}", folder_, ::getpid(), i);
        lock_ = ::open((own_ + kName).c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
    }
    if (lock_ >= 0 && ::flock(lock_, LOCK_EX | LOCK_NB) == 0) return true;
    console_.fail("recovery: " + folder_ + " cannot be written; changes are kept only where you save them");
    folder_.clear();
    return false;
}

void Recovery::write(const Session& session) {
    if (!claim()) return;
    const std::string name = session.path() + "\n";
    if (::ftruncate(lock_, 0) != 0 ||
        ::pwrite(lock_, name.data(), name.size(), 0) != static_cast<ssize_t>(name.size()))
        return;
    stepsWritten_ = session.stepsTaken();
    work_ = std::make_shared<Work>();
    work_->scene = sceneToSave(session);
    work_->file = own_ + ".glb";
    began_ = Clock::now();
    job_.start(
        [work = work_](const Cancelled&) {
            try {
                io::writeGltf(work->file, work->scene, true);
            } catch (const std::exception& error) {
                work->failure = error.what();
            }
        },
        platform::Window::wake);
}

void Recovery::finishWriting() {
    const std::shared_ptr<Work> work = std::exchange(work_, nullptr);
    next_ = Clock::now() + std::max<Clock::duration>(kLeastPause, kPauseForWork * (Clock::now() - began_));
    written_ = true;
    if (!work->failure.empty()) console_.fail("recovery: " + work->failure);
}

// What was taken is this program's from now on, until it is saved.
void Recovery::adopt() {
    console_.say("recovered " + taken_->scene + "; Ctrl+S saves it");
    std::error_code code;
    if (claim()) fs::rename(taken_->file + ".glb", own_ + ".glb", code);
    if (!code) fs::remove(taken_->file + kName, code);
    written_ = true;
    taken_.reset();
    find();
}

void Recovery::removeOwn() {
    if (lock_ < 0) return;
    removeBoth(own_);
    ::close(std::exchange(lock_, -1));
    written_ = false;
}

void Recovery::follow(const Session& session, bool handRests, bool pending) {
    if (folder_.empty()) return;
    if (taken_ && recoveriesSeen_ != session.recoveries()) adopt();
    if (taken_ && !pending) found_ = std::exchange(taken_, std::nullopt);
    recoveriesSeen_ = session.recoveries();
    if (job_.busy()) return;
    if (work_) finishWriting();
    if (!session.unsaved()) {
        if (written_) removeOwn();
        stepsWritten_ = session.stepsTaken();
    } else if (stepsWritten_ != session.stepsTaken() && handRests && Clock::now() >= next_) {
        write(session);
    }
}

void Recovery::end() {
    if (folder_.empty()) return;
    job_.cancel();
    while (job_.busy()) std::this_thread::sleep_for(1ms);
    removeOwn();
    std::error_code ignored;
    fs::remove(folder_, ignored);  // when it is empty
}

void Recovery::show(Session& session) {
    if (!found_ || taken_ || later_) return;
    constexpr const char* kTitle = "Changes from before";
    if (!ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId)) ImGui::OpenPopup(kTitle);
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({0.5f * display.x, 0.5f * display.y}, ImGuiCond_Appearing, {0.5f, 0.5f});
    if (!ImGui::BeginPopupModal(kTitle, nullptr, ImGuiWindowFlags_AlwaysAutoResize)) return;
    ImGui::TextUnformatted("Conelight ended with changes that are in no file:");
    ImGui::Text("%s, changed %s", found_->scene.c_str(), found_->when.c_str());
    const auto button = [](const char* text, const char* place) {
        const bool pressed = ImGui::Button(text);
        notePlace(place);
        ImGui::SameLine();
        return pressed;
    };
    const bool takes = button("Recover", "recovery:take");
    const bool deletes = button("Delete them", "recovery:delete");
    later_ = button("Ask again at the next start", "recovery:later") || escapePressed();
    if (takes || deletes || later_) ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
    if (takes) {
        taken_ = std::exchange(found_, std::nullopt);
        Request request{RequestKind::Load, taken_->file + ".glb"};
        request.recovers = taken_->scene;
        session.request(std::move(request));
    } else if (deletes) {
        removeBoth(found_->file);
        find();
    }
}

}  // namespace conelight::program

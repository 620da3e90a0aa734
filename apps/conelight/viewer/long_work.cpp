// SPDX-License-Identifier: MIT
#include "viewer/long_work.h"

#include <fmt/core.h>
#include <imgui.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <utility>

#include "session/addition.h"
#include "traced_picture.h"
#include "viewer/background_job.h"
#include "viewer/widget_places.h"
#include "viewer/work_bar.h"

namespace conelight::program {
namespace {

// Of a bake: those of mode traced; -1 stands for all. All in other modes: cones bounces as often as it can
// pay for.
int bouncesOf(const Settings& settings) {
    return settings.mode == Mode::Traced ? settings.traced.bounces.value_or(-1) : -1;
}

std::string fileNameOf(const std::string& file) { return std::filesystem::path(file).filename().string(); }

struct Strip {
    const char* name;
    std::string text;
    double done = 0, secondsLeft = -1;
};

// `at`: its upper left corner. Returns whether its work is to end.
bool showStrip(const Strip& strip, const glm::vec2& at, float width) {
    const float em = ImGui::GetFontSize();
    const std::string text =
        strip.secondsLeft < 0 ? strip.text : strip.text + ", " + timeText(strip.secondsLeft) + " left";
    ImGui::SetNextWindowPos({at.x, at.y});
    ImGui::SetNextWindowSize({width, 2.3f * em});
    // It does not take the keys from who types: `stop`, for example.
    ImGui::Begin((std::string("##") + strip.name).c_str(), nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoFocusOnAppearing);
    showWorkBar(text, strip.done, -5 * em);
    ImGui::SameLine();
    const bool stopped = ImGui::Button("stop", {-1, 0});
    notePlace(std::string(strip.name) + ":stop");
    ImGui::End();
    return stopped;
}

}  // namespace

void LongWork::startPictures(const Request& request) {
    job_.start(request, in_.session, in_.view.fullSize(), film.traced);
}

void LongWork::startBake(const Request& request) {
    reference::RadiositySettings settings = radiosity_;
    settings.bounces = bouncesOf(in_.session.shownSettings());
    settings.threads = BackgroundJob::threads();
    bake_.start(request.file, request.overwrite, in_.session.scene(), settings, platform::Window::wake);
}

void LongWork::startFirst(const std::string& name, BackgroundLoad::Read read) {
    loadsFirst_ = true;
    load_.start(fileNameOf(name), std::move(read), platform::Window::wake);
}

bool LongWork::startLoad(const Request& request) {
    if (load_.busy()) {
        load_.stop();
        return false;
    }
    const auto read = [this, request, how = in_.session.openHow(),
                       steps = in_.session.stepsTaken()](const io::LoadOptions& watched) {
        auto opened = std::make_shared<OpenedScene>(readScene(request.file, how, watched));
        return BackgroundLoad::TakeOver(
            [this, request, opened, steps] { takeOver(request, *opened, steps); });
    };
    return load_.start(fileNameOf(request.file), read, platform::Window::wake);
}

bool LongWork::startImport(const Request& request) {
    if (load_.busy()) {
        load_.stop();
        return false;
    }
    const auto read = [this, file = request.file,
                       how = in_.session.openHow()](const io::LoadOptions& watched) {
        auto part = std::make_shared<Scene>(readPart(file, how, watched));
        return BackgroundLoad::TakeOver([this, file, part] {
            Picker& picker = in_.console.commands().picker();
            for (const std::string& line : addImported(in_.session, picker, std::move(*part), file))
                in_.console.say(line);
        });
    };
    return load_.start(fileNameOf(request.file), read, platform::Window::wake);
}

void LongWork::takeOver(const Request& request, OpenedScene& opened, std::uint64_t stepsBefore) {
    if (in_.session.unsaved() && in_.session.stepsTaken() != stepsBefore) return onChangedMeanwhile(request);
    for (const std::string& note : in_.session.take(std::move(opened), request.keepView))
        in_.console.say(note);
    if (!request.recovers.empty()) in_.session.markRecovered(request.recovers);
    in_.console.say("loaded " + request.file);
}

bool LongWork::waits() const {
    return in_.session.playing() || holdsCommands() || in_.console.commands().framesToWait() > 0;
}

// Bakes and films say themselves how far they came.
void LongWork::stop() {
    if (!waits()) return in_.console.say("stop: nothing is waited for");
    in_.session.stopPlaying();
    if (job_.busy()) job_.stop();
    if (bake_.busy()) bake_.stop();
    load_.stop();
    settling_ = false;
    in_.console.commands().endWait();
    in_.console.say("stopped");
}

bool LongWork::stopAtOnce(const std::vector<std::string>& words) {
    if (!waits()) return false;
    if (words == std::vector<std::string>{"stop"}) {
        stop();
        return true;
    }
    if (words != std::vector<std::string>{"path", "stop"} || !in_.session.playing()) return false;
    in_.session.stopPlaying();
    return true;
}

void LongWork::follow() {
    followLoad();
    followBake();
}

void LongWork::followLoad() {
    try {
        if (!load_.finish()) return;
    } catch (const Error& error) {
        const bool stopped = dynamic_cast<const io::LoadStopped*>(&error) != nullptr;
        if (loadsFirst_ && !stopped) throw;
        in_.console.commands().fail(error);
    }
    loadsFirst_ = false;
}

void LongWork::followBake() {
    try {
        if (const auto lines = bake_.finish())
            for (const std::string& line : *lines) in_.console.say(line);
    } catch (const Error& error) {
        in_.console.commands().fail(error);
    }
}

void LongWork::lookWhetherSettled(bool improves) {
    if (settling_ && (in_.view.halted() || in_.view.finished() || (!improves && in_.view.showsOwn())))
        settling_ = false;
}

bool LongWork::drawPictures() {
    if (!job_.busy()) return false;
    try {
        if (const std::optional<std::string> line = job_.step(in_.session, in_.view.slot(false)))
            in_.console.say(*line);
    } catch (const Error& error) {
        in_.console.commands().fail(error);
    }
    return true;
}

void LongWork::showStrips(const glm::vec2& at, const glm::vec2& size) {
    const float em = ImGui::GetFontSize();
    const float width = std::min(36 * em, size.x - em);
    glm::vec2 place(at.x + 0.5f * em, at.y + size.y - 2.8f * em);
    if (load_.busy()) {
        const BackgroundLoad::Status status = load_.status();
        if (showStrip({"load", status.text, status.done}, place, width)) load_.stop();
        place.y -= 2.6f * em;
    }
    if (bake_.busy()) {
        const BakeStatus status = bake_.status();
        const Strip strip{"bake", fmt::format("{}: {:.0f} %", fileNameOf(bake_.file()), 100 * status.done),
                          status.done, status.secondsLeft};
        if (showStrip(strip, place, width)) bake_.stop();
        place.y -= 2.6f * em;
    }
    // A screenshot of a picture that is finished takes no time.
    if (!job_.busy()) return;
    const std::string state = job_.bakes()         ? "waits for the bake"
                              : job_.frames() == 1 ? "settles"
                                                   : fmt::format("{} of {}", job_.done() + 1, job_.frames());
    const Strip strip{"record", fileNameOf(job_.file()) + ": " + state, job_.part(), job_.secondsLeft()};
    if (showStrip(strip, place, width)) job_.stop();
}

}  // namespace conelight::program

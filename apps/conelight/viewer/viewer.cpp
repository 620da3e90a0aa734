// SPDX-License-Identifier: MIT
#include "viewer/viewer.h"

#include <fmt/core.h>
#include <imgui.h>
#include <imgui_stdlib.h>
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <utility>

#include "conelight/error.h"
#include "console/console.h"
#include "console/line_reader.h"
#include "platform/window.h"
#include "viewer/camera_control.h"
#include "viewer/console_panel.h"
#include "viewer/file_watch.h"
#include "viewer/gui.h"
#include "viewer/panels.h"
#include "viewer/picture_view.h"
#include "viewer/settings_panel.h"
#include "viewer/viewer_requests.h"

namespace conelight::program {
namespace {

constexpr double kIdleWait = 0.5;  // s; the files are looked at this often while nothing else happens

// Stages of the settings panel and the settings that belong to them; the gather stage shows its mode's.
struct Stage {
    const char* name;
    std::vector<std::string> prefixes;
};
std::vector<Stage> stagesOf(const std::string& mode) {
    return {{"Scene", {}},
            {"Voxels", {"voxels."}},
            {"Light", {"light."}},
            {"Gather", {mode + "."}},
            {"Image", {"image.", "view."}}};
}

class Viewer {
  public:
    Viewer(Session& session, const ViewerOptions& options)
        : session_(session),
          options_(options),
          window_({options.width, options.height, "Conelight", true, options.debugGl}),
          gui_(window_, ""),
          view_(window_, options.shaderDirectory, options.debugGl),
          commands_(session, [this](const ConsoleLine& line) { print(line); }),
          console_([this](const std::string& line) { commands_.submit(line); },
                   [this](const std::string& line) { return completed(line); }),
          watch_(options.shaderDirectory) {
        window_.onDrop = [this](const std::vector<std::string>& paths) {
            if (!paths.empty()) session_.request({RequestKind::Load, paths.front(), 1, 0, false, false});
        };
        window_.onRefresh = [this] { frame(); };
        if (options.readStdin) input_ = std::make_unique<LineReader>(0, platform::Window::wake);
        for (const std::string& line : options.commands) commands_.submit(line, "--exec");
    }
    int run();

  private:
    void frame();
    void print(const ConsoleLine& line);
    std::vector<std::string> completed(const std::string& line) const;
    void takeCommands();
    void keys();
    void menuBar();
    void leftPanel(float top, float width, float height);
    void rightPanel(float top, float left, float width, float height);
    void bottomPanel(float top, float left, float width, float height);
    void picture(const glm::vec2& at, const glm::vec2& size);
    void modeControls();
    void overlayText(const glm::vec2& at, const glm::vec2& size);
    void explainBlack();
    void watchFiles();
    void focus();

    Session& session_;
    ViewerOptions options_;
    platform::Window window_;
    Gui gui_;
    PictureView view_;
    Console commands_;
    ConsolePanel console_;
    std::unique_ptr<LineReader> input_;
    FileWatch watch_;
    std::optional<Inspection> inspection_;
    std::optional<std::string> hint_;
    std::uint64_t hintVersion_ = 0;
    Picker picker_;
    std::string filter_;
    bool showConsole_ = true;
    bool showSide_ = true;
    bool more_ = true;
    double lastFrame_ = 0;
    ViewerState state_;
};

// Everything goes to the terminal as well, so that a pipe into the viewer can be answered.
void Viewer::print(const ConsoleLine& line) {
    console_.say(line.text);
    std::fprintf(line.isError ? stderr : stdout, "%s\n", line.text.c_str());
    std::fflush(line.isError ? stderr : stdout);
}

std::vector<std::string> Viewer::completed(const std::string& line) const {
    const Completion completion = commands_.complete(line, line.size());
    std::vector<std::string> lines;
    for (const std::string& candidate : completion.candidates)
        lines.push_back(line.substr(0, completion.begin) + candidate);
    return lines;
}

void Viewer::takeCommands() {
    std::string line;
    while (input_ && input_->take(line)) commands_.submit(line);
    commands_.runQueued();
}

int Viewer::run() {
    while (!state_.quit && !window_.shouldClose()) {
        const bool busy = more_ || session_.hasRequests() || !commands_.idle();
        window_.pollEvents(busy ? 0 : kIdleWait);
        if (window_.minimized()) continue;
        watchFiles();
        takeCommands();
        frame();
    }
    return state_.status;
}

// Files that changed on disk are loaded again; the view stays.
void Viewer::watchFiles() {
    watch_.setScene(session_.path());
    if (watch_.sceneChanged()) session_.request({RequestKind::Load, session_.path(), 1, 0, true, false});
    if (watch_.shadersChanged()) view_.dropShaders();
}

void Viewer::frame() {
    const double now = ImGui::GetTime();
    gui_.beginFrame();
    keys();
    const float em = ImGui::GetFontSize();
    const glm::vec2 display(ImGui::GetIO().DisplaySize.x, ImGui::GetIO().DisplaySize.y);
    menuBar();
    const float top = ImGui::GetFrameHeight();
    const float side = showSide_ ? std::min(24 * em, 0.3f * display.x) : 0;
    const float bottom = showConsole_ ? std::min(11 * em, 0.35f * display.y) : 0;
    const float height = display.y - top;
    if (showSide_) {
        leftPanel(top, side, height);
        rightPanel(top, display.x - side, side, height);
    }
    if (showConsole_) bottomPanel(display.y - bottom, side, display.x - 2 * side, bottom);
    picture({side, top}, {display.x - 2 * side, height - bottom});
    window_.clear(glm::vec3(0.07f));
    gui_.endFrame();
    window_.swapBuffers();
    lastFrame_ = now;
}

void Viewer::picture(const glm::vec2& at, const glm::vec2& size) {
    ImGui::SetNextWindowPos({at.x, at.y});
    ImGui::SetNextWindowSize({size.x, size.y});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
    ImGui::Begin("##picture", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoBringToFrontOnFocus);
    ImGui::PopStyleVar();
    const glm::vec2 pixels(
        static_cast<float>(window_.framebufferSize().x) / static_cast<float>(std::max(window_.size().x, 1)),
        static_cast<float>(window_.framebufferSize().y) / static_cast<float>(std::max(window_.size().y, 1)));
    const std::uint64_t before = view_.slot(false).version();
    more_ = view_.update(session_, glm::ivec2(size * pixels));
    if (view_.slot(false).version() != before) session_.frameDrawn(view_.slot(false).frameMs());
    while (carryOutRequest(session_, view_, commands_, state_)) more_ = true;
    if (!more_ || commands_.framesToWait() > 0) commands_.frameDone();

    auto clicked = view_.show(session_, at, size, static_cast<float>(ImGui::GetTime() - lastFrame_));
    if (state_.inspect) clicked = std::exchange(state_.inspect, std::nullopt);
    if (clicked) {
        const glm::ivec2 drawn = view_.pictureSize();
        Inspection inspection;
        inspection.pixel = *clicked;
        const Image& linear = view_.slot(false).linear();
        inspection.radiance = linear.pixels[static_cast<std::size_t>(clicked->y * linear.width + clicked->x)];
        inspection.hit = picker_.atPixel(session_, drawn.x, drawn.y, clicked->x, clicked->y);
        session_.select(inspection.hit ? Selection{SelectionKind::Instance, inspection.hit->instance}
                                       : Selection{});
        inspectGathering(inspection, view_.slot(false).renderer());
        inspection_ = inspection;
    }
    drawInspection(session_, picker_, inspection_, at, size);
    overlayText(at, size);
    ImGui::End();
}

// Mode names over the picture's halves, what the reference is at, and why there may be nothing to see.
void Viewer::overlayText(const glm::vec2& at, const glm::vec2& size) {
    ImDrawList* list = ImGui::GetWindowDrawList();
    const float em = ImGui::GetFontSize();
    const auto label = [&](const std::string& text, float x, float y, bool fromRight) {
        const ImVec2 extent = ImGui::CalcTextSize(text.c_str());
        const ImVec2 low{fromRight ? x - extent.x - em : x, y};
        list->AddRectFilled(low, {low.x + extent.x + em, low.y + 1.5f * em}, IM_COL32(20, 20, 20, 170), 4);
        list->AddText({low.x + 0.5f * em, low.y + 0.25f * em}, IM_COL32(230, 230, 230, 255), text.c_str());
    };
    const auto describe = [&](const std::string& mode, PictureSlot& slot) {
        if (mode != "reference") return mode;
        const ReferenceStatus status = slot.referenceStatus();
        if (!status.error.empty()) return "reference: " + status.error;
        return fmt::format("reference  {} spp  noise {:.1f} %{}", status.samplesPerPixel, 100 * status.noise,
                           status.running ? "" : "  done");
    };
    label(describe(session_.shownMode(), view_.slot(false)), at.x + 0.5f * em, at.y + 0.5f * em, false);
    if (view_.split.on)
        label(
            describe(view_.split.mode, view_.slot(true)) + (view_.split.errors ? ", error of the left" : ""),
            at.x + size.x - 0.5f * em, at.y + 0.5f * em, true);
    explainBlack();
    if (!hint_) return;
    const float wrap = std::min(30 * em, size.x - 4 * em);
    const ImVec2 extent = ImGui::CalcTextSize(hint_->c_str(), nullptr, false, wrap);
    const ImVec2 low{at.x + 0.5f * (size.x - extent.x) - em, at.y + 0.5f * (size.y - extent.y) - em};
    list->AddRectFilled(low, {low.x + extent.x + 2 * em, low.y + extent.y + 2 * em},
                        IM_COL32(28, 28, 28, 235), 6);
    list->AddText(ImGui::GetFont(), em, {low.x + em, low.y + em}, IM_COL32(235, 220, 180, 255),
                  hint_->c_str(), nullptr, wrap);
}

// Reading the picture back costs, so only pictures at rest are looked at, once each.
void Viewer::explainBlack() {
    PictureSlot& slot = view_.slot(false);
    if (more_ || view_.moving() || slot.version() == hintVersion_ || slot.version() == 0) return;
    hintVersion_ = slot.version();
    hint_ = whyBlack(session_, slot.linear());
}

void Viewer::focus() {
    Aabb bounds = session_.scene().bounds();
    if (session_.selection().kind == SelectionKind::Instance) {
        const Instance& instance = session_.scene().instances[session_.selection().index];
        const Aabb object = session_.scene().meshes[static_cast<std::size_t>(instance.mesh)].bounds();
        bounds = {};
        for (int corner = 0; corner < 8; ++corner)
            bounds.grow(glm::vec3(instance.worldFromObject *
                                  glm::vec4((corner & 1) ? object.max.x : object.min.x,
                                            (corner & 2) ? object.max.y : object.min.y,
                                            (corner & 4) ? object.max.z : object.min.z, 1)));
    }
    Camera camera = session_.camera();
    const glm::ivec2 size = glm::max(view_.pictureSize(), glm::ivec2(1));
    focusOn(camera, bounds, static_cast<float>(size.x) / static_cast<float>(size.y));
    session_.jumpCamera(camera, "focus");
}

void Viewer::keys() {
    if (gui_.wantsKeyboard()) return;
    const ImGuiIO& io = ImGui::GetIO();
    static bool wasDown[GLFW_KEY_LAST + 1] = {};
    const auto pressed = [&](int key) {
        const bool down = window_.isKeyDown(key);
        const bool edge = down && !wasDown[key];
        wasDown[key] = down;
        return edge;
    };
    if (pressed(GLFW_KEY_F) && !io.KeyCtrl) focus();
    if (pressed(GLFW_KEY_F11)) window_.setFullscreen(!window_.fullscreen());
    if (pressed(GLFW_KEY_TAB)) showSide_ = showConsole_ = !showSide_;
    if (pressed(GLFW_KEY_X)) view_.split.on = !view_.split.on;
    if (pressed(GLFW_KEY_Z) && io.KeyCtrl) {
        if (io.KeyShift)
            session_.redo();
        else
            session_.undo();
    }
    if (pressed(GLFW_KEY_Y) && io.KeyCtrl) session_.redo();
    if (pressed(GLFW_KEY_P))
        session_.request({RequestKind::Screenshot, nextScreenshot(), 1, 0, false, false});
    if (pressed(GLFW_KEY_ESCAPE) && window_.fullscreen()) window_.setFullscreen(false);
}

void Viewer::menuBar() {
    if (!ImGui::BeginMainMenuBar()) return;
    if (ImGui::BeginMenu("File")) {
        if (ImGui::MenuItem("Screenshot", "P"))
            session_.request({RequestKind::Screenshot, nextScreenshot(), 1, 0, false, false});
        if (ImGui::MenuItem("Quit")) state_.quit = true;
        ImGui::EndMenu();
    }
    if (ImGui::BeginMenu("Edit")) {
        if (ImGui::MenuItem("Undo", "Ctrl+Z", false, session_.undoSteps() > 0)) session_.undo();
        if (ImGui::MenuItem("Redo", "Ctrl+Y", false, session_.redoSteps() > 0)) session_.redo();
        ImGui::EndMenu();
    }
    if (ImGui::BeginMenu("View")) {
        if (ImGui::MenuItem("Focus", "F")) focus();
        ImGui::MenuItem("Split", "X", &view_.split.on);
        ImGui::MenuItem("Panels", "Tab", &showSide_);
        ImGui::MenuItem("Console", nullptr, &showConsole_);
        if (ImGui::MenuItem("Fullscreen", "F11")) window_.setFullscreen(!window_.fullscreen());
        ImGui::EndMenu();
    }
    modeControls();
    ImGui::EndMainMenuBar();
}

void Viewer::modeControls() {
    const float em = ImGui::GetFontSize();
    ImGui::SameLine(0, 2 * em);
    const auto combo = [&](const char* id, const std::string& value, const std::vector<std::string>& names,
                           float width) -> std::optional<std::string> {
        std::optional<std::string> chosen;
        ImGui::SetNextItemWidth(width * em);
        if (ImGui::BeginCombo(id, value.c_str())) {
            for (const std::string& name : names)
                if (ImGui::Selectable(name.c_str(), name == value)) chosen = name;
            ImGui::EndCombo();
        }
        return chosen;
    };
    if (const auto mode = combo("##mode", session_.mode(), sessionModes(), 7)) session_.setMode(*mode);
    ImGui::SameLine();
    if (const auto name = combo("##component", conelight::getSetting(session_.settings(), "component"),
                                settingChoices("component"), 7))
        session_.setSetting("component", *name);
    ImGui::SameLine();
    ImGui::Checkbox("split", &view_.split.on);
    if (!view_.split.on) return;
    ImGui::SameLine();
    if (const auto mode = combo("##right", view_.split.mode, sessionModes(), 7)) view_.split.mode = *mode;
    ImGui::SameLine();
    ImGui::Checkbox("error", &view_.split.errors);
    if (!view_.split.errors) return;
    ImGui::SameLine();
    ImGui::SetNextItemWidth(6 * em);
    ImGui::SliderFloat("##errorscale", &view_.split.errorScale, 0.05f, 4.0f, "x %.2f",
                       ImGuiSliderFlags_Logarithmic);
}

constexpr ImGuiWindowFlags kPanel = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoMove |
                                    ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoSavedSettings |
                                    ImGuiWindowFlags_NoBringToFrontOnFocus;

void Viewer::leftPanel(float top, float width, float height) {
    ImGui::SetNextWindowPos({0, top});
    ImGui::SetNextWindowSize({width, height});
    ImGui::Begin("##left", nullptr, kPanel);
    if (ImGui::BeginTabBar("stages")) {
        const std::string mode = conelight::getSetting(session_.settings(), "mode");
        for (const Stage& stage : stagesOf(mode)) {
            if (!ImGui::BeginTabItem(stage.name)) continue;
            ImGui::SetNextItemWidth(-1);
            ImGui::InputTextWithHint("##filter", "filter", &filter_);
            ImGui::BeginChild("##stage");
            if (stage.prefixes.empty())
                sceneTree(session_, filter_);
            else
                settingsPanel(session_.settings(), stage.prefixes, filter_,
                              [this](const std::string& key, const std::string& value, bool done) {
                                  if (!value.empty()) session_.setSetting(key, value, key);
                                  if (done) session_.seal();
                              });
            ImGui::EndChild();
            ImGui::EndTabItem();
        }
        ImGui::EndTabBar();
    }
    ImGui::End();
}

void Viewer::rightPanel(float top, float left, float width, float height) {
    ImGui::SetNextWindowPos({left, top});
    ImGui::SetNextWindowSize({width, height});
    ImGui::Begin("##right", nullptr, kPanel);
    if (ImGui::CollapsingHeader("Selection", ImGuiTreeNodeFlags_DefaultOpen)) selectionEditor(session_);
    if (ImGui::CollapsingHeader("Pixel", ImGuiTreeNodeFlags_DefaultOpen))
        inspectorPanel(session_, inspection_);
    if (ImGui::CollapsingHeader("Camera")) cameraEditor(session_);
    if (ImGui::CollapsingHeader("Frame", ImGuiTreeNodeFlags_DefaultOpen)) {
        ImGui::SetNextItemWidth(8 * ImGui::GetFontSize());
        ImGui::SliderFloat("resolution", &view_.resolutionScale, 0.25f, 1.0f, "%.2f");
        if (const FrameStats* stats = view_.slot(false).stats()) statsPanel(*stats, session_.frameTimes());
    }
    ImGui::End();
}

void Viewer::bottomPanel(float top, float left, float width, float height) {
    ImGui::SetNextWindowPos({left, top});
    ImGui::SetNextWindowSize({width, height});
    ImGui::Begin("##bottom", nullptr, kPanel);
    console_.show();
    ImGui::End();
}

}  // namespace

int runViewer(Session& session, const ViewerOptions& options) { return Viewer(session, options).run(); }

}  // namespace conelight::program

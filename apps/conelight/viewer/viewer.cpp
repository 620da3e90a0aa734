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
#include <cstdlib>
#include <ctime>
#include <memory>
#include <utility>

#include "conelight/error.h"
#include "console/console.h"
#include "console/line_reader.h"
#include "interrupt.h"
#include "io/image_file.h"
#include "platform/window.h"
#include "session/state_files.h"
#include "traced_picture.h"
#include "viewer/background_job.h"
#include "viewer/camera_control.h"
#include "viewer/console_panel.h"
#include "viewer/file_bake.h"
#include "viewer/file_watch.h"
#include "viewer/gui.h"
#include "viewer/open_dialog.h"
#include "viewer/panels.h"
#include "viewer/picture_view.h"
#include "viewer/settings_panel.h"
#include "viewer/viewer_requests.h"
#include "viewer/widget_places.h"

namespace conelight::program {
namespace {

constexpr double kIdleWait = 0.5;    // s; the files are looked at this often while nothing else happens
constexpr double kPace = 0.008;      // s between frames in which only the GUI changes
constexpr double kUserPause = 0.15;  // s after the last input until a slow picture is refined further

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

// A number's median over the last frames.
double median(const FrameTimes& times) {
    std::vector<double> sorted(times.all().begin(), times.all().end());
    if (sorted.empty()) return 0;
    std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2),
                     sorted.end());
    return sorted[sorted.size() / 2];
}

// Of a bake: those of mode traced, where 16 stands for all, as -1 does here. All in other modes: cones
// bounces as often as it can pay for.
int bouncesOf(const Settings& settings) {
    constexpr int kAll = 16;
    const bool limited = settings.mode == Mode::Traced && settings.traced.bounces < kAll;
    return limited ? settings.traced.bounces : -1;
}

double threadCpuMs() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

double steadyMs() {
    using clock = std::chrono::steady_clock;
    return std::chrono::duration<double, std::milli>(clock::now().time_since_epoch()).count();
}

// Places of the window's parts, window units.
struct Layout {
    float top = 0, left = 0, right = 0, bottom = 0;  // thickness of bar and panels
    glm::vec2 display{0};
    glm::vec2 pictureAt() const { return {left, top}; }
    glm::vec2 pictureSize() const { return {display.x - left - right, display.y - top - bottom}; }
};

class Viewer {
  public:
    Viewer(Session& session, const ViewerOptions& options);
    int run();

  private:
    void frame();
    void updatePictures(const Layout& layout);
    void carryOutRequests();
    void gui(const Layout& layout);
    void writeWindow(const std::string& file);
    void firstFrameShown();
    void print(const ConsoleLine& line);
    void fail(const std::string& what) { print({true, what}); }
    template <class Edit>
    void attempt(const Edit& edit);
    std::vector<std::string> completed(const std::string& line) const;
    void takeCommands();
    void followBake();
    void bakeStrip(const glm::vec2& at, const glm::vec2& size);
    void windowCommand(const Request& request);
    void splitCommand(const std::vector<std::string>& words);
    void status(const std::string& key);
    std::string splitText();
    std::string movingText() const;
    std::string selectionText() const;
    void answerPlaces();
    void keys();
    void menuBar();
    void fileMenu();
    void load(const std::string& scene);
    Layout layout() const;
    void resizePanels(const Layout& layout);
    void leftPanel(const Layout& layout);
    void stageTabs(const std::vector<Stage>& stages);
    void rightPanel(const Layout& layout);
    void bottomPanel(const Layout& layout);
    void picture(const glm::vec2& at, const glm::vec2& size);
    void inspect(const PictureView::Click& click);
    void modeControls();
    void overlayText(const glm::vec2& at, const glm::vec2& size);
    void explainBlack();
    void watchFiles();
    void rememberScene();
    void focus();

    Session& session_;
    platform::Window window_;
    Gui gui_;
    PictureView view_;
    Console commands_;
    StateFiles state_;
    ConsolePanel console_;
    std::unique_ptr<LineReader> input_;
    FileWatch watch_;
    OpenDialog openDialog_;
    SettingsPanel settingsPanel_;
    std::optional<Inspection> inspection_;
    std::optional<PictureView::Click> clicked_;
    std::optional<std::string> hint_;
    std::uint64_t hintVersion_ = 0;
    Picker picker_;
    std::size_t stage_ = 0;  // of the left panel
    std::string filter_;
    std::string remembered_;           // the scene that the recent list has
    std::vector<std::string> wanted_;  // widgets whose place was asked for
    std::string windowShot_;           // a file that gets the next frame
    bool placesAsked_ = false, placesRecorded_ = false;
    bool showConsole_ = true;
    bool showSide_ = true;
    float sideEm_ = 24, consoleEm_ = 10;  // sizes of panels, in heights of text
    FileBake bake_;
    reference::RadiositySettings radiosity_;  // of bakes
    bool more_ = true;
    bool lastWasIdle_ = false;  // the last frame drew no picture
    bool settling_ = false;     // `settle`: commands wait for the picture
    bool timing_;
    double startedMs_, firstFrameMs_ = -1;
    double lastFrame_ = 0;
    std::uint64_t inputsSeen_ = 0;
    double lastInput_ = -1;
    FrameTimes guiTimes_;
    ViewerState end_;
};

Viewer::Viewer(Session& session, const ViewerOptions& options)
    : session_(session),
      window_({options.width, options.height, "Conelight", true, options.debugGl}),
      gui_(window_, options.uiScale),
      view_(window_, options.shaderDirectory, options.debugGl),
      commands_(session, [this](const ConsoleLine& line) { print(line); }),
      state_(options.keepState),
      console_(
          commands_.history(),
          [this](const std::string& line) {
              state_.typed(line);
              commands_.submit(line);
          },
          [this](const std::string& line) { return completed(line); }),
      watch_(options.shaderDirectory),
      radiosity_(options.radiosity),
      timing_(options.timing),
      startedMs_(options.startedMs) {
    for (const std::string& line : state_.lines()) commands_.history().add(line);
    window_.onDrop = [this](const std::vector<std::string>& paths) {
        if (!paths.empty()) load(paths.front());
    };
    window_.onRefresh = [this] { frame(); };
    if (options.readStdin) input_ = std::make_unique<LineReader>(0, platform::Window::wake);
    for (const std::string& line : options.commands) commands_.submit(line, "--exec");
}

// Everything goes to the terminal as well, so that a pipe into the viewer can be answered.
void Viewer::print(const ConsoleLine& line) {
    console_.say(line.text, line.isError);
    std::fprintf(line.isError ? stderr : stdout, "%s\n", line.text.c_str());
    std::fflush(line.isError ? stderr : stdout);
}

// What a widget asks for may be refused (a number out of range): a line in the console, nothing else.
template <class Edit>
void Viewer::attempt(const Edit& edit) {
    try {
        edit();
    } catch (const Error& error) {
        fail(error.what());
    }
}

void Viewer::load(const std::string& scene) {
    Request request{RequestKind::Load};
    request.file = scene;
    session_.request(request);
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
    if (settling_ && (view_.finished() || (!more_ && view_.showsOwn()))) settling_ = false;
    if (!settling_ && !bake_.busy()) commands_.runQueued();
}

// Commands behind `bake` wait for it; everything else goes on.
void Viewer::followBake() {
    if (const std::optional<Request> asked = std::exchange(end_.bake, std::nullopt)) {
        reference::RadiositySettings settings = radiosity_;
        settings.bounces = bouncesOf(session_.shownSettings());
        settings.threads = BackgroundJob::threads();
        bake_.start(asked->file, asked->overwrite, session_.scene(), settings, platform::Window::wake);
    }
    try {
        if (const auto lines = bake_.finish())
            for (const std::string& line : *lines) print({false, line});
    } catch (const Error& error) {
        commands_.fail(error);
    }
}

// How far the bake is, and the end of it, at the bottom of the picture.
void Viewer::bakeStrip(const glm::vec2& at, const glm::vec2& size) {
    if (!bake_.busy()) return;
    const float em = ImGui::GetFontSize();
    const BakeStatus status = bake_.status();
    std::string text = fmt::format("{}: {:.0f} %", bake_.file(), 100 * status.done);
    if (status.secondsLeft >= 0) text += ", " + timeText(status.secondsLeft) + " left";
    ImGui::SetNextWindowPos({at.x + 0.5f * em, at.y + size.y - 2.8f * em});
    ImGui::SetNextWindowSize({std::min(36 * em, size.x - em), 2.3f * em});
    ImGui::Begin("##bake", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings);
    ImGui::ProgressBar(static_cast<float>(status.done), {-5 * em, 0}, text.c_str());
    ImGui::SameLine();
    if (ImGui::Button("stop", {-1, 0})) bake_.stop();
    notePlace("bake:stop");
    ImGui::End();
}

int Viewer::run() {
    while (!end_.quit && !window_.shouldClose()) {
        const bool waits = settling_ || bake_.busy();
        const bool busy = more_ || session_.hasRequests() || (!commands_.idle() && !waits) ||
                          !wanted_.empty() || session_.playing();
        const ViewFlags& flags = session_.flags();
        const double rest = flags.dynamic ? std::min<double>(flags.period, kIdleWait) : kIdleWait;
        if (!console_.takesKeysSoon()) window_.pollEvents(!busy ? rest : lastWasIdle_ ? kPace : 0);
        watchFiles();
        rememberScene();
        followBake();
        takeCommands();
        if (window_.minimized())
            carryOutRequests();
        else
            frame();
    }
    if (timing_)
        print({false,
               fmt::format("timing: GUI {:.3f} ms of CPU a frame, picture {:.1f} ms (medians of the last {} "
                           "and {} frames)",
                           median(guiTimes_), median(session_.frameTimes()), guiTimes_.all().size(),
                           session_.frameTimes().all().size())});
    return end_.status;
}

// Files that changed on disk are loaded again; the view stays.
void Viewer::watchFiles() {
    watch_.setScene(session_.path());
    if (watch_.sceneChanged()) {
        Request request{RequestKind::Load};
        request.file = session_.path();
        request.keepView = true;
        session_.request(request);
    }
    if (!watch_.shadersChanged()) return;
    const std::vector<std::string> failures = view_.reloadShaders();
    for (const std::string& failure : failures) fail(failure);
    if (failures.empty()) print({false, "shaders: built again"});
}

void Viewer::rememberScene() {
    if (session_.path() == remembered_) return;
    remembered_ = session_.path();
    state_.opened(remembered_);
    window_.setTitle(remembered_.empty() ? "Conelight" : remembered_ + " - Conelight");
}

// A window that is not seen draws nothing, but carries out what is asked.
void Viewer::carryOutRequests() {
    while (
        carryOutRequest(session_, view_, commands_, end_, [this](const Request& one) { windowCommand(one); }))
        more_ = true;
}

Layout Viewer::layout() const {
    const float em = ImGui::GetFontSize() > 0 ? ImGui::GetFontSize() : 14 * gui_.scale();
    Layout layout;
    layout.display = window_.size();
    layout.top = em + 2 * ImGui::GetStyle().FramePadding.y;
    const float side = showSide_ ? std::min(sideEm_ * em, 0.3f * layout.display.x) : 0;
    layout.left = layout.right = side;
    layout.bottom = showConsole_ ? std::min(consoleEm_ * em, 0.4f * layout.display.y) : 0;
    return layout;
}

// Picture first, then the GUI round it, then what the GUI found out about the picture.
void Viewer::frame() {
    const double now = ImGui::GetTime();
    updatePictures(layout());
    window_.clear(glm::vec3(0.07f));
    const double cpuStart = threadCpuMs();
    gui_.beginFrame();
    gui(layout());
    gui_.endFrame();
    guiTimes_.add(threadCpuMs() - cpuStart);
    if (!windowShot_.empty()) attempt([&] { writeWindow(std::exchange(windowShot_, {})); });
    window_.swapBuffers();
    lastFrame_ = now;
    firstFrameShown();
    if (clicked_) inspect(*clicked_);
    clicked_.reset();
    answerPlaces();
}

void Viewer::writeWindow(const std::string& file) {
    const glm::ivec2 size = window_.framebufferSize();
    const io::ByteImage image{size.x, size.y, 3, window_.pixels()};
    const WritingScope writing;
    if (io::imageFormatOf(file) == io::ImageFormat::Png)
        io::writePng(file, image);
    else
        io::writeJpg(file, image);
    print({false, fmt::format("written {} ({} x {})", file, size.x, size.y)});
}

void Viewer::firstFrameShown() {
    if (firstFrameMs_ >= 0 || view_.slot(false).texture() == 0) return;
    firstFrameMs_ = steadyMs() - startedMs_;
    if (timing_) print({false, fmt::format("timing: first frame after {:.2f} s", 1e-3 * firstFrameMs_)});
}

void Viewer::updatePictures(const Layout& layout) {
    const glm::vec2 pixels =
        glm::vec2(window_.framebufferSize()) / glm::max(glm::vec2(window_.size()), glm::vec2(1));
    const double now = ImGui::GetTime();
    if (std::exchange(inputsSeen_, window_.inputs()) != window_.inputs()) lastInput_ = now;
    const bool userActs = lastInput_ >= 0 && now - lastInput_ < kUserPause;
    const std::uint64_t before = view_.slot(false).version();
    more_ = view_.update(session_, glm::ivec2(layout.pictureSize() * pixels), userActs);
    lastWasIdle_ = view_.slot(false).version() == before;
    if (!lastWasIdle_) session_.frameDrawn(view_.slot(false).frameMs());
    while (const std::optional<std::string> error = view_.takeError()) fail(*error);
    carryOutRequests();
    if (const std::optional<glm::ivec2> asked = std::exchange(end_.inspect, std::nullopt)) {
        const Image& linear = view_.slot(false).linear();
        inspect({(glm::vec2(*asked) + 0.5f) / glm::max(glm::vec2(linear.width, linear.height), 1.0f)});
    }
    if (!more_ || commands_.framesToWait() > 0) commands_.frameDone();
    explainBlack();
}

void Viewer::gui(const Layout& layout) {
    beginPlaces();
    placesRecorded_ = std::exchange(placesAsked_, false);
    keys();
    menuBar();
    if (showSide_) {
        leftPanel(layout);
        rightPanel(layout);
    }
    if (showConsole_) bottomPanel(layout);
    picture(layout.pictureAt(), layout.pictureSize());
    bakeStrip(layout.pictureAt(), layout.pictureSize());
    if (const std::optional<std::string> scene = openDialog_.show()) load(*scene);
    resizePanels(layout);
}

// Borders between panels and picture are dragged.
void Viewer::resizePanels(const Layout& layout) {
    const float em = ImGui::GetFontSize();
    const auto border = [&](const char* name, const ImVec2& at, const ImVec2& size, ImGuiMouseCursor cursor) {
        ImGui::SetNextWindowPos(at);
        ImGui::SetNextWindowSize(size);
        ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
        ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1, 1});
        ImGui::Begin(name, nullptr,
                     ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                         ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBackground);
        ImGui::InvisibleButton("border", size);
        if (ImGui::IsItemHovered() || ImGui::IsItemActive()) ImGui::SetMouseCursor(cursor);
        const bool dragged = ImGui::IsItemActive();
        notePlace(std::string("border:") + (name + 2));
        ImGui::End();
        ImGui::PopStyleVar(2);
        return dragged;
    };
    const float thick = 0.3f * em, height = layout.display.y - layout.top;
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    if (showSide_) {
        if (border("##left border", {layout.left - thick, layout.top}, {thick, height},
                   ImGuiMouseCursor_ResizeEW))
            sideEm_ = std::clamp(mouse.x / em, 10.0f, 60.0f);
        if (border("##right border", {layout.display.x - layout.right, layout.top}, {thick, height},
                   ImGuiMouseCursor_ResizeEW))
            sideEm_ = std::clamp((layout.display.x - mouse.x) / em, 10.0f, 60.0f);
    }
    if (showConsole_ && border("##console border", {layout.left, layout.display.y - layout.bottom},
                               {layout.pictureSize().x, thick}, ImGuiMouseCursor_ResizeNS))
        consoleEm_ = std::clamp((layout.display.y - mouse.y) / em, 4.0f, 60.0f);
}

void Viewer::picture(const glm::vec2& at, const glm::vec2& size) {
    ImGui::SetNextWindowPos({at.x, at.y});
    ImGui::SetNextWindowSize({size.x, size.y});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
    ImGui::Begin("##picture", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoBringToFrontOnFocus);
    ImGui::PopStyleVar();
    clicked_ = view_.show(session_, at, size, static_cast<float>(ImGui::GetTime() - lastFrame_));
    drawInspection(session_, picker_, inspection_, at, size);
    overlayText(at, size);
    ImGui::End();
}

// Selects what was clicked and keeps what lies there.
void Viewer::inspect(const PictureView::Click& click) {
    const Image& linear = view_.slotAt(click.part.x).linear();
    const glm::ivec2 size(linear.width, linear.height);
    if (size.x == 0) return;
    Inspection inspection;
    inspection.pixel = glm::clamp(glm::ivec2(click.part * glm::vec2(size)), glm::ivec2(0), size - 1);
    inspection.radiance =
        linear.pixels[static_cast<std::size_t>(inspection.pixel.y) * static_cast<std::size_t>(size.x) +
                      static_cast<std::size_t>(inspection.pixel.x)];
    inspection.hit = picker_.atPixel(session_, size.x, size.y, inspection.pixel.x, inspection.pixel.y);
    session_.select(inspection.hit ? Selection{SelectionKind::Instance, inspection.hit->instance}
                                   : Selection{});
    inspectGathering(inspection, view_.slotAt(click.part.x).renderer());
    inspection_ = inspection;
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
    label(view_.slot(false).label(), at.x + 0.5f * em, at.y + 0.5f * em, false);
    if (view_.split.on)
        label(view_.slot(true).label() + (view_.split.errors ? ": error of the left" : ""),
              at.x + size.x - 0.5f * em, at.y + 0.5f * em, true);
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
    if (more_ || view_.moving() || !slot.ownPicture() || slot.version() == hintVersion_ ||
        slot.version() == 0)
        return;
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
    const std::vector<platform::Window::KeyPress> presses = window_.takeKeyPresses();
    if (gui_.wantsKeyboard() || window_.cursorCaptured()) return;
    for (const auto& press : presses) {
        if (press.key == GLFW_KEY_F && !press.control) focus();
        if (press.key >= GLFW_KEY_1 && press.key <= GLFW_KEY_3 && !press.control)
            view_.gizmo.tool = static_cast<GizmoTool>(press.key - GLFW_KEY_1);
        if (press.key == GLFW_KEY_F11) window_.setFullscreen(!window_.fullscreen());
        if (press.key == GLFW_KEY_TAB) showSide_ = showConsole_ = !showSide_;
        if (press.key == GLFW_KEY_X && !press.control) view_.split.on = !view_.split.on;
        if (press.key == GLFW_KEY_Z && press.control) press.shift ? session_.redo() : session_.undo();
        if (press.key == GLFW_KEY_Y && press.control) session_.redo();
        if (press.key == GLFW_KEY_O && press.control) openDialog_.open(session_.path());
        if (press.key == GLFW_KEY_P) session_.request({RequestKind::Screenshot, nextScreenshot()});
    }
}

void Viewer::menuBar() {
    if (!ImGui::BeginMainMenuBar()) return;
    fileMenu();
    const bool edit = ImGui::BeginMenu("Edit");
    notePlace("menu:Edit");
    if (edit) {
        if (ImGui::MenuItem("Undo", "Ctrl+Z", false, session_.undoSteps() > 0)) session_.undo();
        if (ImGui::MenuItem("Redo", "Ctrl+Y", false, session_.redoSteps() > 0)) session_.redo();
        ImGui::EndMenu();
    }
    const bool view = ImGui::BeginMenu("View");
    notePlace("menu:View");
    if (view) {
        if (ImGui::MenuItem("Focus", "F")) focus();
        const auto tool = [&](const char* name, const char* key, GizmoTool one) {
            if (ImGui::MenuItem(name, key, view_.gizmo.tool == one)) view_.gizmo.tool = one;
        };
        ImGui::Separator();
        tool("Move", "1", GizmoTool::Move);
        tool("Turn", "2", GizmoTool::Turn);
        tool("Scale", "3", GizmoTool::Scale);
        ImGui::Separator();
        ImGui::MenuItem("Split", "X", &view_.split.on);
        ImGui::MenuItem("Panels", "Tab", &showSide_);
        ImGui::MenuItem("Console", nullptr, &showConsole_);
        if (ImGui::MenuItem("Fullscreen", "F11")) window_.setFullscreen(!window_.fullscreen());
        ImGui::EndMenu();
    }
    modeControls();
    ImGui::EndMainMenuBar();
}

void Viewer::fileMenu() {
    const bool open = ImGui::BeginMenu("File");
    notePlace("menu:File");
    if (!open) return;
    if (ImGui::MenuItem("Open...", "Ctrl+O")) openDialog_.open(session_.path());
    if (ImGui::BeginMenu("Open recent", !state_.recent().empty())) {
        for (const std::string& scene : state_.recent()) {
            if (ImGui::MenuItem(scene.c_str())) load(scene);
            notePlace("recent:" + scene);
        }
        ImGui::EndMenu();
    }
    notePlace("menu:Open recent");
    if (ImGui::MenuItem("Reload", nullptr, false, !session_.path().empty())) {
        Request request{RequestKind::Load};
        request.file = session_.path();
        request.keepView = true;
        session_.request(request);
    }
    ImGui::Separator();
    if (ImGui::MenuItem("Screenshot", "P")) session_.request({RequestKind::Screenshot, nextScreenshot()});
    ImGui::Separator();
    if (ImGui::MenuItem("Quit")) end_.quit = true;
    ImGui::EndMenu();
}

void Viewer::modeControls() {
    const float em = ImGui::GetFontSize();
    ImGui::SameLine(0, 2 * em);
    // The names are asked for only while the list is open.
    const auto combo = [&](const char* id, const std::string& value, const auto& namesOf,
                           float width) -> std::optional<std::string> {
        std::optional<std::string> chosen;
        ImGui::SetNextItemWidth(width * em);
        if (ImGui::BeginCombo(id, value.c_str())) {
            for (const std::string& name : namesOf())
                if (ImGui::Selectable(name.c_str(), name == value)) chosen = name;
            ImGui::EndCombo();
        }
        return chosen;
    };
    if (const auto mode = combo("##mode", session_.mode(), sessionModes, 7))
        attempt([&] { session_.setMode(*mode); });
    notePlace("mode");
    ImGui::SameLine();
    if (const auto name = combo(
            "##component", conelight::getSetting(session_.settings(), "component"),
            [] { return settingChoices("component"); }, 7))
        attempt([&] { session_.setSetting("component", *name); });
    ImGui::SameLine();
    ImGui::Checkbox("split", &view_.split.on);
    notePlace("split on");
    if (!view_.split.on) return;
    ImGui::SameLine();
    if (const auto mode = combo("##right", view_.split.mode, sessionModes, 7)) view_.split.mode = *mode;
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

void Viewer::leftPanel(const Layout& layout) {
    ImGui::SetNextWindowPos({0, layout.top});
    ImGui::SetNextWindowSize({layout.left, layout.display.y - layout.top});
    ImGui::Begin("##left", nullptr, kPanel);
    const std::vector<Stage> stages = stagesOf(conelight::getSetting(session_.settings(), "mode"));
    stageTabs(stages);
    const Stage& stage = stages[stage_];
    ImGui::SetNextItemWidth(-1);
    ImGui::InputTextWithHint("##filter", "filter", &filter_);
    ImGui::BeginChild(stage.name);
    if (stage.prefixes.empty())
        sceneTree(session_, filter_);
    else
        settingsPanel_.show(session_.settings(), session_.revisions().settings, stage.prefixes, filter_,
                            [this](const std::string& key, const std::string& value, bool done) {
                                if (!value.empty()) attempt([&] { session_.setSetting(key, value, key); });
                                if (done) session_.seal();
                            });
    ImGui::EndChild();
    ImGui::End();
}

// Whole names on as many lines as they take: ImGui's own tabs cut them in narrow windows.
void Viewer::stageTabs(const std::vector<Stage>& stages) {
    const float room = ImGui::GetContentRegionAvail().x, gap = 0.2f * ImGui::GetFontSize();
    float used = 0;
    for (std::size_t i = 0; i < stages.size(); ++i) {
        const float width =
            ImGui::CalcTextSize(stages[i].name).x + 2 * ImGui::GetStyle().FramePadding.x + gap;
        if (i > 0 && used + width <= room + gap)
            ImGui::SameLine(0, gap);
        else
            used = 0;
        used += width;
        const bool shown = i == stage_;
        ImGui::PushStyleColor(ImGuiCol_Button,
                              ImGui::GetStyleColorVec4(shown ? ImGuiCol_ButtonActive : ImGuiCol_Tab));
        if (ImGui::Button(stages[i].name)) stage_ = i;
        ImGui::PopStyleColor();
        notePlace(std::string("tab:") + stages[i].name);
    }
}

void Viewer::rightPanel(const Layout& layout) {
    ImGui::SetNextWindowPos({layout.display.x - layout.right, layout.top});
    ImGui::SetNextWindowSize({layout.right, layout.display.y - layout.top});
    ImGui::Begin("##right", nullptr, kPanel);
    if (ImGui::CollapsingHeader("Selection", ImGuiTreeNodeFlags_DefaultOpen)) selectionEditor(session_);
    if (ImGui::CollapsingHeader("Pixel", ImGuiTreeNodeFlags_DefaultOpen))
        inspectorPanel(session_, inspection_);
    if (ImGui::CollapsingHeader("Camera")) cameraEditor(session_);
    if (ImGui::CollapsingHeader("Frame", ImGuiTreeNodeFlags_DefaultOpen)) {
        const float em = ImGui::GetFontSize();
        ImGui::SetNextItemWidth(std::min(8 * em, ImGui::GetContentRegionAvail().x - 5.5f * em));
        ImGui::SliderFloat("resolution", &view_.resolutionScale, 0.25f, 1.0f, "%.2f");
        if (const FrameStats* stats = view_.slot(false).stats())
            statsPanel(*stats, session_.frameTimes(), median(guiTimes_));
    }
    ImGui::End();
}

void Viewer::bottomPanel(const Layout& layout) {
    ImGui::SetNextWindowPos({layout.left, layout.display.y - layout.bottom});
    ImGui::SetNextWindowSize({layout.pictureSize().x, layout.bottom});
    ImGui::Begin("##bottom", nullptr, kPanel);
    console_.show();
    ImGui::End();
}

bool switched(const std::vector<std::string>& words, bool now) {
    return words.size() > 1 ? words[1] == "on" : !now;
}

void Viewer::windowCommand(const Request& request) {
    const std::vector<std::string>& words = request.words;
    const std::string& name = words.front();
    if (name == "split") {
        splitCommand(words);
    } else if (name == "error") {
        view_.split.errors = switched(words, view_.split.errors);
        if (view_.split.errors) view_.split.on = true;
        if (words.size() > 2) view_.split.errorScale = std::strtof(words[2].c_str(), nullptr);
    } else if (name == "fullscreen") {
        window_.setFullscreen(switched(words, window_.fullscreen()));
    } else if (name == "panels") {
        showSide_ = showConsole_ = switched(words, showSide_);
    } else if (name == "focus") {
        focus();
    } else if (name == "pick") {
        inspect({{std::strtof(words[1].c_str(), nullptr), std::strtof(words[2].c_str(), nullptr)}});
    } else if (name == "settle") {
        settling_ = true;
    } else if (name == "status") {
        status(words.size() > 1 ? words[1] : "");
    } else if (name == "screenshot_window") {
        windowShot_ = words[1];
    } else if (name == "where") {
        std::string widget = words[1];
        for (std::size_t i = 2; i < words.size(); ++i) widget += " " + words[i];
        wanted_.push_back(widget);
        askForPlaces();
        placesAsked_ = true;
    }
}

void Viewer::splitCommand(const std::vector<std::string>& words) {
    if (words.size() == 1) {
        view_.split.on = !view_.split.on;
        return;
    }
    view_.split.on = words[1] != "off";
    if (view_.split.on) view_.split.mode = words[1];
    if (words.size() > 2) view_.split.position = std::strtof(words[2].c_str(), nullptr);
}

void Viewer::answerPlaces() {
    if (!placesRecorded_) return;
    placesRecorded_ = false;
    for (const std::string& name : std::exchange(wanted_, {})) {
        if (const std::optional<WidgetPlace> place = placeOf(name))
            print(
                {false, fmt::format("where {}: {:.0f} {:.0f} {:.0f} {:.0f}", name, place->low.x, place->low.y,
                                    place->high.x - place->low.x, place->high.y - place->low.y)});
        else
            fail(fmt::format("where: '{}' is not on the screen", name));
    }
}

std::string Viewer::splitText() {
    if (!view_.split.on) return "off";
    PictureSlot& right = view_.slot(true);
    return fmt::format("{} at {:.3f}{}, {}, {} x {} pixels", view_.split.mode, view_.split.position,
                       view_.split.errors ? ", errors" : "", right.ownPicture() ? "shown" : "not yet",
                       right.width(), right.height());
}

std::string Viewer::movingText() const {
    const PictureView::Movement& m = view_.movement();
    return fmt::format("{:.1f} frames/s, longest wait {:.0f} ms, {} x {} pixels ({} pictures in {:.1f} s)",
                       m.pictures / std::max(m.seconds, 1e-3), 1e3 * m.longest, m.sizePx.x, m.sizePx.y,
                       m.pictures, m.seconds);
}

std::string Viewer::selectionText() const {
    const Selection& selection = session_.selection();
    const Scene& scene = session_.scene();
    if (selection.kind == SelectionKind::Instance) {
        const Instance& instance = scene.instances[selection.index];
        const glm::mat4& m = instance.worldFromObject;
        return fmt::format("object {} {} at {:.4f} {:.4f} {:.4f}, x axis {:.4f} {:.4f} {:.4f}",
                           selection.index, instance.name, m[3].x, m[3].y, m[3].z, m[0].x, m[0].y, m[0].z);
    }
    if (selection.kind == SelectionKind::Light) return fmt::format("light {}", selection.index);
    if (selection.kind == SelectionKind::Material)
        return fmt::format("material {} {}", selection.index, scene.materials[selection.index].name);
    return "none";
}

void Viewer::status(const std::string& key) {
    const glm::ivec2 window = window_.size(), pixels = window_.framebufferSize();
    const Layout places = layout();
    const Camera& c = session_.camera();
    std::vector<std::pair<std::string, std::string>> lines = {
        {"scene", session_.path()},
        {"window", fmt::format("{} x {}, {} x {} pixels, scale {:.2f}, {}", window.x, window.y, pixels.x,
                               pixels.y, gui_.scale(), window_.fullscreen() ? "full screen" : "windowed")},
        {"picture",
         fmt::format("{} x {} of {} x {} pixels, at {:.0f} {:.0f}", view_.pictureSize().x,
                     view_.pictureSize().y, view_.fullSize().x, view_.fullSize().y, places.left, places.top)},
        {"mode", view_.slot(false).label()},
        {"split", splitText()},
        {"settled", view_.finished() ? "yes" : "no"},
        {"selection", selectionText()},
        {"camera", fmt::format("eye {:.4g} {:.4g} {:.4g} target {:.4g} {:.4g} {:.4g} fov {:.4g} deg", c.eye.x,
                               c.eye.y, c.eye.z, c.target.x, c.target.y, c.target.z, glm::degrees(c.fovY))},
        {"steps", fmt::format("{} to undo, {} to redo", session_.undoSteps(), session_.redoSteps())},
        {"frames", fmt::format("{} pictures, {:.1f} ms (median)", view_.slot(false).version(),
                               median(session_.frameTimes()))},
        {"moving", movingText()},
        {"gui",
         fmt::format("{:.3f} ms of CPU a frame (median of {})", median(guiTimes_), guiTimes_.all().size())},
        {"first_frame", fmt::format("{:.2f} s after the start", 1e-3 * firstFrameMs_)}};
    if (inspection_) {
        const Inspection& i = *inspection_;
        lines.emplace_back(
            "pixel", fmt::format("{} {} radiance {:.4g} {:.4g} {:.4g} {}", i.pixel.x, i.pixel.y, i.radiance.x,
                                 i.radiance.y, i.radiance.z, i.hit ? i.hit->object : "(sky)"));
    } else {
        lines.emplace_back("pixel", "none");
    }
    for (const auto& [name, text] : lines)
        if (key.empty() || key == name) print({false, "status " + name + ": " + text});
}

}  // namespace

int runViewer(Session& session, const ViewerOptions& options) { return Viewer(session, options).run(); }

}  // namespace conelight::program

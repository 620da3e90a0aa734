// SPDX-License-Identifier: MIT
#include "viewer/viewer.h"

#include <fmt/core.h>
#include <imgui.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <utility>

#include <unistd.h>

#include "conelight/error.h"
#include "interrupt.h"
#include "io/image_file.h"
#include "session/why_black.h"
#include "viewer/background_job.h"
#include "viewer/camera_control.h"
#include "viewer/viewer_window.h"
#include "viewer/widget_places.h"

namespace conelight::program {
namespace {

constexpr double kIdleWait = 0.5;    // s; the files are looked at this often while nothing else happens
constexpr double kPace = 0.008;      // s between frames in which only the GUI changes
constexpr double kUserPause = 0.15;  // s after the last input until a slow picture is refined further

// Of a bake: those of mode traced; -1 stands for all. All in other modes: cones bounces as often as it can
// pay for.
int bouncesOf(const Settings& settings) {
    return settings.mode == Mode::Traced ? settings.traced.bounces.value_or(-1) : -1;
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

}  // namespace

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
              typed(line);
          },
          [this](const std::string& line) { return completed(line); }),
      watch_(options.shaderDirectory),
      radiosity_(options.radiosity),
      timing_(options.timing),
      startedMs_(options.startedMs) {
    view_.setRadiosity(radiosity_);
    for (const std::string& line : state_.lines()) commands_.history().add(line);
    for (const std::string& note : session.scene().notes) console_.say(note);  // the terminal has them
    window_.onDrop = [this](const std::vector<std::string>& paths) {
        if (!paths.empty()) openScene(paths.front());
    };
    window_.onRefresh = [this] { frame(); };
    if (options.readStdin) input_ = std::make_unique<LineReader>(0, platform::Window::wake);
    if (options.filmSamples > 0) end_.traced.samplesPerPixel = options.filmSamples;
    for (const std::string& line : options.commands) commands_.submit(line, "--exec");
}

// Everything goes to the terminal as well, so that a pipe into the viewer can be answered.
void Viewer::print(const ConsoleLine& line) {
    console_.say(line.text, line.isError);
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
    // What comes through a pipe is a script: it means the same at any speed.
    static const bool byHand = isatty(STDIN_FILENO) != 0;
    while (input_ && input_->take(line)) byHand ? typed(line) : commands_.submit(line);
    if (settling_ && (view_.finished() || (!more_ && view_.showsOwn()))) settling_ = false;
    if (!settling_ && !bake_.busy() && !end_.job.busy()) commands_.runQueued();
}

bool Viewer::waits() const {
    return session_.playing() || end_.job.busy() || bake_.busy() || settling_ || commands_.framesToWait() > 0;
}

// A line by itself that ends what commands wait for does not wait with them.
void Viewer::typed(const std::string& line) {
    const std::vector<Statement> statements = parseStatements(line);
    const std::vector<std::string> words =
        statements.size() == 1 ? statements.front().words : std::vector<std::string>{};
    const bool stop = words == std::vector<std::string>{"stop"};
    const bool stopPath = words == std::vector<std::string>{"path", "stop"};
    if (!waits() || !(stop || (stopPath && session_.playing()))) return commands_.submit(line);
    commands_.history().add(line);
    if (stopPath)
        session_.stopPlaying();
    else
        stopWaiting();
}

// The commands behind it go on. Bakes and films say themselves how far they came.
void Viewer::stopWaiting() {
    if (!waits()) return print({false, "stop: nothing is waited for"});
    session_.stopPlaying();
    if (end_.job.busy()) end_.job.stop();
    if (bake_.busy()) bake_.stop();
    settling_ = false;
    commands_.endWait();
    print({false, "stopped"});
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

int Viewer::run() {
    while (!end_.quit) {
        if (window_.shouldClose()) {
            window_.setShouldClose(false);
            leave({});
            if (end_.quit) break;
        }
        const bool waits = settling_ || bake_.busy();
        const bool busy = more_ || session_.hasRequests() || (!commands_.idle() && !waits) ||
                          !wanted_.empty() || session_.playing() || gui_.hasInput();
        const ViewFlags& flags = session_.flags();
        const double rest = flags.dynamic ? std::min<double>(flags.period, kIdleWait) : kIdleWait;
        if (!console_.takesKeysSoon()) window_.pollEvents(!busy ? rest : lastWasIdle_ ? kPace : 0);
        watchFiles();
        rememberScene();
        followBake();
        takeCommands();
        if (!window_.minimized())
            frame();
        else if (!drawPictureJob())
            carryOutRequests();
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
    // What this program saved is what it shows.
    if (std::exchange(savesSeen_, session_.saves()) != session_.saves()) watch_.acceptScene();
    if (watch_.sceneChanged()) reload();
    if (!watch_.shadersChanged()) return;
    const std::vector<std::string> failures = view_.reloadShaders();
    for (const std::string& failure : failures) fail(failure);
    if (failures.empty()) print({false, "shaders: built again"});
}

void Viewer::rememberScene() {
    const std::string& scene = session_.path();
    std::string title =
        scene.empty() ? "Conelight" : scene + (session_.unsaved() ? " * - Conelight" : " - Conelight");
    if (title != title_) window_.setTitle(title_ = std::move(title));
    if (scene == remembered_) return;
    remembered_ = scene;
    state_.opened(remembered_);
}

// The window shows the pictures of the job meanwhile. Returns whether there is one.
bool Viewer::drawPictureJob() {
    PictureJob& job = end_.job;
    if (!job.busy()) return false;
    try {
        if (const std::optional<std::string> line = job.step(session_, view_.slot(false)))
            commands_.print(*line);
    } catch (const Error& error) {
        commands_.fail(error);
    }
    more_ = true;
    lastWasIdle_ = job.busy() && job.waits();
    return true;
}

// A window that is not seen draws nothing, but carries out what is asked.
void Viewer::carryOutRequests() {
    while (
        carryOutRequest(session_, view_, commands_, end_, [this](const Request& one) { windowCommand(one); }))
        more_ = true;
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
    if (drawPictureJob()) return;
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

// Reading the picture back costs, so only pictures at rest are looked at, once each.
void Viewer::explainBlack() {
    PictureSlot& slot = view_.slot(false);
    if (more_ || view_.moving() || !slot.ownPicture() || slot.version() == hintVersion_ ||
        slot.version() == 0)
        return;
    hintVersion_ = slot.version();
    hint_.reset();
    const Image& linear = slot.linear();
    if (linear.pixels.empty() || !isBlack(linear, session_.shownSettings().image)) return;
    for (const std::string& reason : whyBlack(session_, picker_, &linear))
        hint_ = (hint_ ? *hint_ + "\n\n" : "The picture is black.\n\n") + reason;
    if (hint_) *hint_ += "\n\nKey F: the camera sees all of the selection, or of the scene.";
}

void Viewer::focus() {
    Aabb bounds = session_.scene().bounds();
    if (session_.selection().kind == SelectionKind::Instance) {
        const Instance& instance = session_.scene().instances[session_.selection().index];
        bounds = session_.scene().meshes[static_cast<std::size_t>(instance.mesh)].bounds().transformed(
            instance.worldFromObject);
    }
    Camera camera = session_.camera();
    const glm::ivec2 size = glm::max(view_.pictureSize(), glm::ivec2(1));
    focusOn(camera, bounds, static_cast<float>(size.x) / static_cast<float>(size.y));
    session_.jumpCamera(camera, "focus");
}

int runViewer(Session& session, const ViewerOptions& options) { return Viewer(session, options).run(); }

}  // namespace conelight::program

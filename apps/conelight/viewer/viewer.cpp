// SPDX-License-Identifier: MIT
#include "viewer/viewer.h"

#include <imgui.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <utility>

#include "conelight/error.h"
#include "viewer/black_hint.h"
#include "viewer/menus.h"
#include "viewer/picture_panel.h"
#include "viewer/recovery.h"
#include "viewer/requests.h"
#include "viewer/side_panels.h"
#include "viewer/stored_preferences.h"
#include "viewer/window_commands.h"

namespace conelight::program {
namespace {

constexpr double kIdleWait = 0.5;      // s; the files are looked at this often while nothing else happens
constexpr double kLongestStep = 0.25;  // s of a clip in one frame, however long that took
constexpr double kPace = 0.008;        // s between frames in which only the GUI changes
// s between frames while a piece of the picture goes on beside the window, which is woken when it ends, and by input.
constexpr double kPiecePace = 0.1;
constexpr double kPartsWithoutGui = 0.2;  // s of parts of a picture between frames of the GUI, without input
constexpr double kLoadingPace = 0.2;      // s between frames while a scene is read: a bar moves
constexpr double kUserPause = 0.15;       // s after the last input until a slow picture is refined further
// s after a button of the mouse: a second click comes within ImGui's 0.3; a pass between would hold it up.
constexpr double kClickPause = 0.4;

// How long input keeps slow pictures from being refined.
class InputClock {
  public:
    // Whether it came a moment ago.
    bool userActs(const platform::Window& window, double now) {
        if (std::exchange(seen_, window.inputs()) != window.inputs())
            until_ = std::max(until_, now + kUserPause);
        if (std::exchange(clicksSeen_, window.buttonInputs()) != window.buttonInputs())
            until_ = now + kClickPause;
        return now < until_;
    }

  private:
    std::uint64_t seen_ = 0, clicksSeen_ = 0;
    double until_ = -1;
};

// A scene as it was read: its name, and how often one was.
struct Drawn {
    std::string path;
    std::uint64_t readings = 0;
    bool operator==(const Drawn&) const = default;
};

// As the program's options say, else as the user left it.
platform::WindowOptions windowOptions(const ViewerOptions& options, const Preferences& preferences) {
    const glm::ivec2 last = preferences.width > 0 && preferences.height > 0
                                ? glm::ivec2(preferences.width, preferences.height)
                                : glm::ivec2(1280, 800);
    return {options.width > 0 ? options.width : last.x, options.height > 0 ? options.height : last.y,
            "Conelight", true, options.renderer.reportGlErrors};
}

class Viewer {
  public:
    explicit Viewer(const ViewerOptions& options);
    int run();

  private:
    double secondsToSleep() const;
    void look(double seconds);
    void watchShaders();
    void takeCommands();
    void frame();
    void updatePictures();
    bool drawPictureJob();
    void drawParts(const glm::ivec2& area);
    std::string workAhead() const;
    bool announce();
    void openScene();
    void carryOutRequests();
    std::optional<PictureView::Click> showGui();
    void takeClick(const PictureView::Click& click);

    Session session_;  // without a scene until the first was read
    // Reads the first scene; empty: it has begun.
    std::function<Session(const io::LoadOptions& watched)> open_;
    bool opened_ = false;
    std::string sceneName_;
    bool timing_;
    Ending ending_;
    StateFiles state_;
    StoredPreferences preferences_;
    platform::Window window_;
    Gui gui_;
    PictureView view_;
    ViewerConsole console_;
    Recovery recovery_;
    LongWork work_;
    Document document_;
    FileWatch shaders_;
    PixelProbe probe_;
    BlackHint hint_;
    Timings timings_;
    InputClock input_;
    PanelLayout panels_;
    KeyList keys_;
    Menus menus_;
    SelectionMenu menu_;
    LeftPanel left_;
    RightPanel right_;
    PicturePanel picture_;
    PlaceQuestions places_;
    WindowCommands commands_;
    bool more_ = true;          // another frame would change the picture
    bool lastWasIdle_ = false;  // the last frame drew no picture, nor a part of one
    bool drawing_ = false;      // it looks for events between two parts
    double lastFrame_ = 0;
    std::optional<Drawn> drawn_;  // the scene of the last picture
};

Viewer::Viewer(const ViewerOptions& options)
    : open_(options.open),
      sceneName_(options.scene),
      timing_(options.timing),
      state_(options.keepState),
      preferences_(state_),
      window_(windowOptions(options, preferences_.values())),
      gui_(window_, options.uiScale > 0 ? options.uiScale : preferences_.values().uiScale),
      view_(window_, options.renderer),
      console_(session_, state_,
               [this](const std::vector<std::string>& words) { return work_.stopAtOnce(words); }),
      recovery_(state_, console_),
      work_({session_, view_, console_}, options.radiosity),
      document_({session_, window_, console_, state_, work_.film, ending_}),
      shaders_(options.renderer.shaderDirectory),
      probe_(session_, view_),
      timings_(options.startedMs),
      panels_(window_, gui_),
      menus_({session_, window_, gui_, view_, probe_, console_, document_, panels_, keys_, work_}),
      menu_({session_, view_, console_}),
      left_(session_, console_, menu_),
      right_({session_, view_, console_, probe_, document_, work_.film, timings_}),
      picture_({session_, view_, probe_, hint_.text()}),
      commands_({session_, window_, gui_, view_, console_, work_, probe_, panels_, places_, hint_.text(),
                 timings_}) {
    view_.setRadiosity(options.radiosity);
    preferences_.apply(gui_, panels_);
    if (!preferences_.complaint().empty()) console_.fail(preferences_.complaint());
    window_.onDrop = [this](const std::vector<std::string>& paths) { document_.drop(paths); };
    window_.onRefresh = [this] {
        if (!drawing_) frame();
    };
    work_.onChangedMeanwhile = [this](const Request& request) { document_.load(request); };
    if (options.readStdin) console_.readStandardInput();
    if (options.filmSamples > 0) work_.film.traced.samplesPerPixel = options.filmSamples;
    for (const std::string& line : options.commands) console_.commands().submit(line, "--exec");
}

int Viewer::run() {
    while (!ending_.asked) {
        if (window_.shouldClose()) {
            window_.setShouldClose(false);
            document_.quit();
            if (ending_.asked) break;
        }
        if (!console_.panel().takesKeysSoon()) look(secondsToSleep());
        document_.follow();
        recovery_.follow(session_, !ImGui::IsAnyMouseDown() && !session_.clipState().playing,
                         session_.hasRequests() || work_.loads() || document_.asks());
        watchShaders();
        work_.follow();
        takeCommands();
        if (!window_.minimized())
            frame();
        else if (!opened_)
            openScene();
        else if (!drawPictureJob())
            carryOutRequests();  // what is not seen draws nothing, but does what is asked
    }
    recovery_.end();
    if (timing_) console_.say(timings_.summary(session_.frameTimes()));
    return ending_.status;
}

void Viewer::look(double seconds) {
    timings_.beginLook();
    window_.pollEvents(seconds);
    timings_.endLook();
}

double Viewer::secondsToSleep() const {
    const bool commandsGoOn = !console_.commands().idle() && !work_.wakesWindow();
    const bool acts = session_.hasRequests() || commandsGoOn || places_.open() || session_.playing() ||
                      session_.clipState().playing || view_.turntable.turns() || view_.moving() ||
                      gui_.hasInput();
    if (acts || more_) {
        if (!lastWasIdle_) return 0;
        return !acts && view_.works() ? kPiecePace : kPace;
    }
    if (work_.loads()) return kLoadingPace;
    const ViewFlags& flags = session_.flags();
    return flags.dynamic ? std::min<double>(flags.period, kIdleWait) : kIdleWait;
}

void Viewer::watchShaders() {
    if (!shaders_.shadersChanged()) return;
    const std::vector<std::string> failures = view_.reloadShaders();
    for (const std::string& failure : failures) console_.fail(failure);
    if (failures.empty()) console_.say("shaders: built again");
}

void Viewer::takeCommands() {
    if (!opened_) return;
    console_.commands().runWidgets();
    console_.takeStandardInput();
    work_.lookWhetherSettled(more_);
    if (!work_.holdsCommands()) console_.commands().runQueued();
}

// Picture first, then the GUI round it, then what the GUI found out about the picture.
void Viewer::frame() {
    const double now = ImGui::GetTime();
    // A film has its own clock.
    if (drawn_ && !work_.holdsRequests()) {
        session_.stepClip(std::min(now - lastFrame_, kLongestStep));
        view_.turntable.step(session_, std::min(now - lastFrame_, kLongestStep));
    }
    updatePictures();
    window_.clear(glm::vec3(0.07f));
    timings_.beginGui();
    gui_.beginFrame();
    const std::optional<PictureView::Click> clicked = showGui();
    gui_.endFrame();
    commands_.writeWindow();
    window_.swapBuffers();
    timings_.endGui();
    lastFrame_ = now;
    if (view_.slot(false).texture() != 0 && timings_.noteFirstPicture() && timing_)
        console_.say(timings_.firstPictureText());
    // What a click selects shows in the next frame, what was gathered there in the one after.
    if (probe_.gather()) more_ = true;
    if (clicked) takeClick(*clicked);
    places_.answer(console_);
}

// What the next frame will be busy with for so long that it is to be said; empty: nothing.
std::string Viewer::workAhead() const {
    if (!opened_) return "loading " + (work_.loads() ? work_.loadText() : sceneName_);
    if (!drawn_ || drawn_->readings != session_.revisions().scene)
        return "loading " + session_.path() + ": voxels, light and the first picture";
    return {};
}

// Shows a frame that names the work before it is begun. Returns whether that is this one.
bool Viewer::announce() {
    const std::string work = workAhead();
    const bool isNew = !work.empty() && work != view_.notice;
    view_.notice = work;
    if (!isNew) return false;
    // Another scene's lists do not stand beside the picture of this one.
    if (drawn_ && drawn_->path != session_.path()) view_.blank();
    more_ = true;
    lastWasIdle_ = false;
    return true;
}

// The first scene, in the background.
void Viewer::openScene() {
    if (open_)
        work_.startFirst(sceneName_,
                         [this, open = std::exchange(open_, nullptr)](const io::LoadOptions& watched) {
                             auto read = std::make_shared<Session>(open(watched));
                             return BackgroundLoad::TakeOver([this, read] {
                                 session_ = std::move(*read);
                                 for (const std::string& note : session_.scene().notes)
                                     console_.panel().say(note);  // the terminal has them
                             });
                         });
    opened_ = more_ = !work_.loads();
}

void Viewer::updatePictures() {
    if (drawPictureJob() || announce()) return;
    if (!opened_) return openScene();
    const glm::vec2 pixels =
        glm::vec2(window_.framebufferSize()) / glm::max(glm::vec2(window_.size()), glm::vec2(1));
    const glm::ivec2 area(panels_.layout().pictureSize() * pixels);
    const std::uint64_t before = view_.slot(false).version();
    drawParts(area);
    if (!view_.drawing() && !view_.halted()) {
        drawn_ = Drawn{session_.path(), session_.revisions().scene};
        view_.notice.clear();
    }
    if (view_.slot(false).version() != before) session_.frameDrawn(view_.slot(false).frameMs());
    while (const std::optional<std::string> error = view_.takeError()) console_.fail(*error);
    carryOutRequests();
    const bool waited = console_.commands().framesToWait() > 0 && !view_.drawing();
    if (!more_ || waited) console_.commands().frameDone();
    if (!more_) hint_.follow(session_, probe_.picker(), view_);
}

// One picture, or parts of one until somebody wants the window.
void Viewer::drawParts(const glm::ivec2& area) {
    using Clock = std::chrono::steady_clock;
    const Clock::time_point start = Clock::now();
    const std::uint64_t inputs = window_.inputs();
    for (;;) {
        const bool userActs = input_.userActs(window_, ImGui::GetTime()) || gui_.hasInput();
        const std::uint64_t before = view_.parts();
        more_ = view_.update(session_, area, userActs);
        lastWasIdle_ = view_.parts() == before;
        if (!view_.drawing() || lastWasIdle_) return;
        if (std::chrono::duration<double>(Clock::now() - start).count() > kPartsWithoutGui) return;
        const bool was = std::exchange(drawing_, true);
        look(0);
        drawing_ = was;
        if (window_.inputs() != inputs || window_.shouldClose()) return;
    }
}

// The window shows the pictures of the job meanwhile. Returns whether there is one.
bool Viewer::drawPictureJob() {
    if (!work_.drawPictures()) return false;
    more_ = true;
    lastWasIdle_ = work_.restsBetweenPictures();
    return true;
}

void Viewer::carryOutRequests() {
    const RequestInputs inputs{
        session_, view_, console_, work_, probe_, ending_, [this](const Request& request) {
            commands_.carryOut(request);
        }};
    while (carryOutRequest(inputs)) more_ = true;
}

void Viewer::takeClick(const PictureView::Click& click) {
    more_ = true;
    if (!click.menu && !click.adds) return probe_.select(click);
    probe_.choose(click);
    const Layout layout = panels_.layout();
    if (click.menu) menu_.open(layout.pictureAt() + click.part * layout.pictureSize());
}

std::optional<PictureView::Click> Viewer::showGui() {
    const Layout layout = panels_.layout();
    const glm::vec2 at = layout.pictureAt(), size = layout.pictureSize();
    places_.beginGui();
    menus_.takeKeys();
    probe_.follow();
    menus_.showBar();
    if (panels_.showSide) {
        left_.show(layout);
        right_.show(layout);
    }
    if (panels_.showConsole) {
        beginPanel("##bottom", {layout.left, layout.display.y - layout.bottom}, {size.x, layout.bottom});
        console_.panel().show();
        ImGui::End();
    }
    const std::optional<PictureView::Click> clicked =
        picture_.show(at, size, static_cast<float>(ImGui::GetTime() - lastFrame_));
    work_.showStrips(at, size);
    keys_.show(at, size);
    menu_.show();
    document_.showDialogs();
    recovery_.show(session_);
    panels_.dragBorders(layout);
    preferences_.follow(window_, gui_, panels_);
    return clicked;
}

}  // namespace

int runViewer(const ViewerOptions& options) { return Viewer(options).run(); }

}  // namespace conelight::program

// SPDX-License-Identifier: MIT
#include "viewer/viewer.h"

#include <imgui.h>

#include <algorithm>
#include <utility>

#include "conelight/error.h"
#include "viewer/black_hint.h"
#include "viewer/menus.h"
#include "viewer/picture_panel.h"
#include "viewer/requests.h"
#include "viewer/side_panels.h"
#include "viewer/window_commands.h"

namespace conelight::program {
namespace {

constexpr double kIdleWait = 0.5;      // s; the files are looked at this often while nothing else happens
constexpr double kLongestStep = 0.25;  // s of a clip in one frame, however long that took
constexpr double kPace = 0.008;        // s between frames in which only the GUI changes
constexpr double kUserPause = 0.15;    // s after the last input until a slow picture is refined further
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

class Viewer {
  public:
    explicit Viewer(const ViewerOptions& options);
    int run();

  private:
    double secondsToSleep() const;
    void watchShaders();
    void takeCommands();
    void frame();
    void updatePictures();
    bool drawPictureJob();
    std::string workAhead() const;
    bool announce();
    void openScene();
    void carryOutRequests();
    std::optional<PictureView::Click> showGui();
    void takeClick(const PictureView::Click& click);

    Session session_;  // without a scene until open_ was called
    std::function<Session()> open_;
    std::string sceneName_;
    bool timing_;
    Ending ending_;
    platform::Window window_;
    Gui gui_;
    PictureView view_;
    StateFiles state_;
    ViewerConsole console_;
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
    bool lastWasIdle_ = false;  // the last frame drew no picture
    double lastFrame_ = 0;
    std::string notice_;          // what the next frame is busy with for long
    std::optional<Drawn> drawn_;  // the scene of the last picture
};

Viewer::Viewer(const ViewerOptions& options)
    : open_(options.open),
      sceneName_(options.scene),
      timing_(options.timing),
      window_({options.width, options.height, "Conelight", true, options.renderer.reportGlErrors}),
      gui_(window_, options.uiScale),
      view_(window_, options.renderer),
      state_(options.keepState),
      console_(session_, state_,
               [this](const std::vector<std::string>& words) { return work_.stopAtOnce(words); }),
      work_({session_, view_, console_}, options.radiosity),
      document_({session_, window_, console_, state_, work_.film, ending_}),
      shaders_(options.renderer.shaderDirectory),
      probe_(session_, view_),
      timings_(options.startedMs),
      panels_(window_, gui_),
      menus_({session_, window_, gui_, view_, probe_, console_, document_, panels_, keys_}),
      menu_({session_, view_, console_}),
      left_(session_, console_, menu_),
      right_({session_, view_, console_, probe_, document_, work_.film, timings_}),
      picture_({session_, view_, probe_, hint_.text(), notice_}),
      commands_({session_, window_, gui_, view_, console_, work_, probe_, panels_, places_, hint_.text(),
                 timings_}) {
    view_.setRadiosity(options.radiosity);
    window_.onDrop = [this](const std::vector<std::string>& paths) { document_.drop(paths); };
    window_.onRefresh = [this] { frame(); };
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
        if (!console_.panel().takesKeysSoon()) window_.pollEvents(secondsToSleep());
        document_.follow();
        watchShaders();
        work_.follow();
        takeCommands();
        if (!window_.minimized())
            frame();
        else if (open_)
            openScene();
        else if (!drawPictureJob())
            carryOutRequests();  // what is not seen draws nothing, but does what is asked
    }
    if (timing_) console_.say(timings_.summary(session_.frameTimes()));
    return ending_.status;
}

double Viewer::secondsToSleep() const {
    const bool commandsGoOn = !console_.commands().idle() && !work_.wakesWindow();
    const bool busy = more_ || session_.hasRequests() || commandsGoOn || places_.open() ||
                      session_.playing() || session_.clipState().playing || gui_.hasInput();
    if (busy) return lastWasIdle_ ? kPace : 0;
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
    if (open_) return;
    console_.takeStandardInput();
    work_.lookWhetherSettled(more_);
    if (!work_.holdsCommands()) console_.commands().runQueued();
}

// Picture first, then the GUI round it, then what the GUI found out about the picture.
void Viewer::frame() {
    const double now = ImGui::GetTime();
    // A film has its own clock.
    if (drawn_ && !work_.holdsRequests()) session_.stepClip(std::min(now - lastFrame_, kLongestStep));
    updatePictures();
    window_.clear(glm::vec3(0.07f));
    timings_.beginGui();
    gui_.beginFrame();
    const std::optional<PictureView::Click> clicked = showGui();
    gui_.endFrame();
    timings_.endGui();
    commands_.writeWindow();
    window_.swapBuffers();
    lastFrame_ = now;
    if (view_.slot(false).texture() != 0 && timings_.noteFirstPicture() && timing_)
        console_.say(timings_.firstPictureText());
    if (clicked) takeClick(*clicked);
    places_.answer(console_);
}

// What the next frame will be busy with for so long that it is to be said; empty: nothing.
std::string Viewer::workAhead() const {
    if (open_) return "loading " + sceneName_ + ": reading the scene";
    if (const Request* next = session_.nextRequest();
        next != nullptr && next->kind == RequestKind::Load && !work_.holdsRequests())
        return "loading " + next->file + ": reading the scene";
    if (!drawn_ || drawn_->readings != session_.revisions().scene)
        return "loading " + session_.path() + ": voxels, light and the first picture";
    return {};
}

// Shows a frame that names the work before it is begun. Returns whether that is this one.
bool Viewer::announce() {
    const std::string work = workAhead();
    const bool isNew = !work.empty() && work != notice_;
    notice_ = work;
    if (!isNew) return false;
    // Another scene's lists do not stand beside the picture of this one.
    if (drawn_ && drawn_->path != session_.path()) view_.blank();
    more_ = true;
    lastWasIdle_ = false;
    return true;
}

void Viewer::openScene() {
    session_ = std::exchange(open_, nullptr)();
    for (const std::string& note : session_.scene().notes)
        console_.panel().say(note);  // the terminal has them
    more_ = true;
}

void Viewer::updatePictures() {
    if (drawPictureJob() || announce()) return;
    if (open_) return openScene();
    if (const Request* next = session_.nextRequest(); next != nullptr && next->kind == RequestKind::Load)
        return carryOutRequests();
    const glm::vec2 pixels =
        glm::vec2(window_.framebufferSize()) / glm::max(glm::vec2(window_.size()), glm::vec2(1));
    const glm::ivec2 area(panels_.layout().pictureSize() * pixels);
    const std::uint64_t before = view_.slot(false).version();
    const bool userActs = input_.userActs(window_, ImGui::GetTime()) || gui_.hasInput();
    more_ = view_.update(session_, area, userActs);
    drawn_ = Drawn{session_.path(), session_.revisions().scene};
    notice_.clear();
    lastWasIdle_ = view_.slot(false).version() == before;
    if (!lastWasIdle_) session_.frameDrawn(view_.slot(false).frameMs());
    while (const std::optional<std::string> error = view_.takeError()) console_.fail(*error);
    carryOutRequests();
    if (!more_ || console_.commands().framesToWait() > 0) console_.commands().frameDone();
    if (!more_) hint_.follow(session_, probe_.picker(), view_);
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
    // A scene to load is said first.
    const auto waits = [&] { return !window_.minimized() && !workAhead().empty() && workAhead() != notice_; };
    while (!waits() && carryOutRequest(inputs)) more_ = true;
}

void Viewer::takeClick(const PictureView::Click& click) {
    if (!click.menu && !click.adds) return probe_.inspect(click);
    probe_.choose(click);
    const Layout layout = panels_.layout();
    if (click.menu) menu_.open(layout.pictureAt() + click.part * layout.pictureSize());
    more_ = true;
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
    panels_.dragBorders(layout);
    return clicked;
}

}  // namespace

int runViewer(const ViewerOptions& options) { return Viewer(options).run(); }

}  // namespace conelight::program

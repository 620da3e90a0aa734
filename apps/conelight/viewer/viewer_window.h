// SPDX-License-Identifier: MIT
// The viewer's parts, shared by its files: viewer.cpp (start, loop, frame, files), viewer_menus.cpp
// (menu, keys, dialogs), viewer_gui.cpp (panels), viewer_commands.cpp (commands that are the window's own,
// and what it answers).
#pragma once

#include <algorithm>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "conelight/error.h"
#include "console/console.h"
#include "console/line_reader.h"
#include "platform/window.h"
#include "session/state_files.h"
#include "viewer/console_panel.h"
#include "viewer/file_bake.h"
#include "viewer/file_dialog.h"
#include "viewer/file_watch.h"
#include "viewer/gui.h"
#include "viewer/panels.h"
#include "viewer/picture_view.h"
#include "viewer/settings_panel.h"
#include "viewer/viewer.h"
#include "viewer/viewer_requests.h"

namespace conelight::program {

// Stages of the settings panel and the settings that belong to them; the gather stage shows its mode's.
struct Stage {
    const char* name;
    std::vector<std::string> prefixes;
};

// A number's median over the last frames.
inline double median(const FrameTimes& times) {
    std::vector<double> sorted(times.all().begin(), times.all().end());
    if (sorted.empty()) return 0;
    std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2),
                     sorted.end());
    return sorted[sorted.size() / 2];
}

// Places of the window's parts, window units.
struct Layout {
    float top = 0, left = 0, right = 0, bottom = 0;  // thickness of bar and panels
    glm::vec2 display{0};
    glm::vec2 pictureAt() const { return {left, top}; }
    glm::vec2 pictureSize() const { return {display.x - left - right, display.y - top - bottom}; }
};

// What would lose the scene's unsaved changes.
struct Leaving {
    enum class To { End, OtherScene, FileAsChanged } to = To::End;
    std::string file;  // what is opened or loaded again; not for End
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
    void typed(const std::string& line);  // by hand
    bool waits() const;                   // whether commands wait for something that can be ended
    void stopWaiting();
    void followBake();
    void jobStrips(const glm::vec2& at, const glm::vec2& size);
    void windowCommand(const Request& request);
    void splitCommand(const std::vector<std::string>& words);
    void status(const std::string& key);
    std::string splitText();
    std::string movingText() const;
    std::string pathText() const;
    std::string selectionText() const;
    void answerPlaces();
    void keys();
    void menuBar();
    void fileMenu();
    void presetMenu();
    void takeFile(const FileChoice& choice);
    void runLine(const std::string& line);  // as if it were typed into the window
    bool drawPictureJob();
    void openScene(const std::string& scene) { leave({Leaving::To::OtherScene, scene}); }
    void reload() { leave({Leaving::To::FileAsChanged, session_.path()}); }
    void leave(const Leaving& leaving);  // at once when nothing would be lost, else after a question
    void leaveNow(Leaving leaving);
    void unsavedQuestion();
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
    FileDialog fileDialog_;
    std::optional<Leaving> leaving_;  // waits for the answer, or for the file to be saved
    bool savesFirst_ = false;
    std::vector<std::string> presets_;  // of the current folder, while the menu shows them
    int filmFrames_ = 120;
    SettingsPanel settingsPanel_;
    std::optional<Inspection> inspection_;
    std::optional<PictureView::Click> clicked_;
    std::optional<std::string> hint_;
    std::uint64_t hintVersion_ = 0;
    Picker picker_;
    std::size_t stage_ = 0;  // of the left panel
    std::string filter_;
    std::string remembered_, title_;   // the scene that the recent list has; the window's title
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
    std::uint64_t inputsSeen_ = 0, savesSeen_ = 0;
    double lastInput_ = -1;
    FrameTimes guiTimes_;
    ViewerState end_;
};

// What a widget asks for may be refused (a number out of range): a line in the console, nothing else.
template <class Edit>
void Viewer::attempt(const Edit& edit) {
    try {
        edit();
    } catch (const Error& error) {
        fail(error.what());
    }
}

}  // namespace conelight::program

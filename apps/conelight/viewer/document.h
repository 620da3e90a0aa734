// SPDX-License-Identifier: MIT
// The scene as a file: opened, read again when it changes on disk, saved, left only after a question when
// changes would be lost; the dialog that names files; the recent list and the window's title.
#pragma once

#include <optional>
#include <string>

#include "platform/window.h"
#include "session/session.h"
#include "session/state_files.h"
#include "viewer/file_dialog.h"
#include "viewer/file_watch.h"
#include "viewer/long_work.h"
#include "viewer/picture_dialog.h"
#include "viewer/viewer_console.h"

namespace conelight::program {

// The end of the program: whether it was asked for, and the exit status.
struct Ending {
    bool asked = false;
    int status = 0;
};

class Document {
  public:
    struct Inputs {
        Session& session;
        platform::Window& window;
        ViewerConsole& console;
        StateFiles& state;
        const Film& film;
        Ending& ending;
    };
    explicit Document(const Inputs& inputs)
        : in_(inputs),
          thumbnails_(!inputs.state.folder().empty()),
          files_(thumbnails_, inputs.state.recent()) {}

    // At once when nothing would be lost, else after a question.
    void open(const std::string& file);  // a picture becomes A beside the scene
    void reload() { leave({Leaving::To::FileAsChanged, in_.session.path()}); }
    void drop(const std::vector<std::string>& files);  // on the window
    void quit() { leave({}); }
    void ask(FilePurpose purpose) { files_.open(purpose, in_.session.path()); }
    void askForPicture(bool film) { picture_.open(film, in_.film.frames); }

    void follow();       // the file, when it changed on disk, and its name
    void showDialogs();  // and does what they answer
    const std::vector<std::string>& recent() const { return in_.state.recent(); }
    Thumbnails& thumbnails() { return thumbnails_; }

  private:
    // What would lose the scene's unsaved changes.
    struct Leaving {
        enum class To { End, OtherScene, FileAsChanged } to = To::End;
        std::string file;  // what is opened or loaded again; not for End
    };
    void leave(const Leaving& leaving);
    void leaveNow(Leaving leaving);
    void showQuestion();
    void followSaving();
    void dropProfile(const std::string& file);
    void take(const FileChoice& choice);

    Inputs in_;
    FileWatch watch_{""};
    Thumbnails thumbnails_;
    FileDialog files_;
    PictureDialog picture_;
    std::optional<Leaving> leaving_;  // waits for the answer, or for the file to be saved
    bool savesFirst_ = false;
    std::string remembered_, title_;  // the scene that the recent list has; the window's title
    std::uint64_t savesSeen_ = 0;
};

}  // namespace conelight::program

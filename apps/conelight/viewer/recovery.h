// SPDX-License-Identifier: MIT
// Changes that are in no file, kept in the state folder for the case that the program ends without warning: written in
// the background after edits, removed when they are saved or given up. The next start finds those of programs that
// ended and offers them. Each program locks its own, so that several do not take each other's.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "session/session.h"
#include "session/state_files.h"
#include "viewer/background_job.h"
#include "viewer/viewer_console.h"

namespace conelight::program {

class Recovery {
  public:
    // Says what it finds.
    Recovery(const StateFiles& state, ViewerConsole& console);
    ~Recovery();
    Recovery(const Recovery&) = delete;
    Recovery& operator=(const Recovery&) = delete;

    // Once a round of the main loop: writes what was changed, removes what is not needed. `pending`: what was taken may
    // still be read; else it could not be, and the question comes back.
    void follow(const Session& session, bool handRests, bool pending);
    // The question whether what was found is to be taken.
    void show(Session& session);
    void end();  // of the program, as the user wanted: nothing is left

  private:
    using Clock = std::chrono::steady_clock;
    // Of a program that ended: FILE.glb is the scene, FILE.of its name.
    struct Found {
        std::string file, scene, when;
    };
    void find();
    bool claim();
    void write(const Session& session);
    void finishWriting();
    void adopt();
    void removeOwn();

    std::string folder_;  // empty: nothing is kept
    ViewerConsole& console_;
    std::optional<Found> found_, taken_;
    bool later_ = false;  // the question waits for the next start
    std::string own_;     // as Found::file
    int lock_ = -1;       // open while own_ is this program's
    bool written_ = false;
    std::uint64_t stepsWritten_ = 0, recoveriesSeen_ = 0;
    Clock::time_point next_{}, began_{};
    struct Work;
    std::shared_ptr<Work> work_;  // null: nothing is being written
    BackgroundJob job_;
};

}  // namespace conelight::program

// SPDX-License-Identifier: MIT
// Work that a command or a panel asks for and the main loop carries out between frames: it owns the window,
// the GL context and the files.
#pragma once

#include <string>
#include <vector>

#include "session/picture_format.h"

namespace conelight::program {

enum class RequestKind {
    Screenshot,   // file, format
    Record,       // file, format, count frames; turntable, alongPath or clip
    Bake,         // file; overwrite
    Load,         // file; keepView, recovers
    Import,       // file
    Revoxelize,   // and say how large the voxels are
    SingleFrame,  // draw one frame although ViewFlags::singleFrame is on
    Wait,         // draw `count` frames before the next command
    Inspect,      // how pixel (x, y) was gathered; steps
    Window,       // words: a command that only a window has (commands_window.cpp)
    Quit,         // status
};

struct Request {
    RequestKind kind = RequestKind::Wait;
    std::string file;
    int count = 1;
    int first = 0;             // Record: number of the first frame
    int total = 0;             // Record: frames of the whole film; 0: `count`
    int framesPerSecond = 30;  // Record: of a film
    int status = 0;
    bool keepView = false;  // Load: camera and settings stay
    std::string recovers;   // Load: the scene whose unsaved changes the file has; empty: it is a scene itself
    bool turntable = false;  // Record: once round the target
    bool alongPath = false;  // Record: along the session's camera path
    bool clip = false;       // Record: the clip that is chosen, from its start
    PictureFormat format;
    bool overwrite = false;  // Bake: what is there already
    int x = 0, y = 0;        // Inspect: from the upper left corner
    bool steps = false;      // Inspect: print every step
    std::vector<std::string> words;
};

}  // namespace conelight::program

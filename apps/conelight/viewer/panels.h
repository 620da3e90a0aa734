// SPDX-License-Identifier: MIT
// The panels beside the picture. Each is a function that draws its widgets into the current ImGui window and
// changes the session through its calls.
#pragma once

#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "conelight/renderer.h"
#include "session/inspection_lines.h"
#include "session/picker.h"
#include "session/session.h"
#include "viewer/file_dialog.h"

namespace conelight::program {

// Takes a line of the console: what has a command is done by it, and said in the log.
using RunLine = std::function<void(const std::string& line)>;

void cameraEditor(Session& session);
// What films take; `samples`: a pixel and frame in mode reference.
struct FilmNumbers {
    int& frames;
    int& samples;
};
class KeyStrip;
// Key frames: keep, go to, fly along, load, save, record.
void pathEditor(Session& session, KeyStrip& strip, const FilmNumbers& film, const RunLine& run,
                const std::function<void(FilePurpose)>& ask);

// Clips of the scene, which has some.
void clipEditor(Session& session);

// Times of passes and frames, memory.
// `guiMs`: CPU time of a frame of the GUI.
void statsPanel(const FrameStats& stats, const FrameTimes& times, double guiMs);

// What lies under the last clicked pixel.
struct Inspection {
    glm::ivec2 pixel{0};
    glm::vec4 radiance{0};
    std::optional<Pick> hit;
    std::optional<PixelInspection> gathered;  // nothing in modes on the CPU
    int chosen = -1;                          // the path that stands out; -1: none
    // Lines over the picture, and what they were made for.
    std::vector<PictureLine> lines;
    std::uint64_t linesOf[3] = {0, 0, 0};
};
// A table of cones or rays; a click on one makes it stand out and shows its steps.
void inspectorPanel(const Session& session, std::optional<Inspection>& inspection);
// Cones and rays over the picture at `at`, into the current ImGui window.
void drawInspection(const Session& session, Picker& picker, std::optional<Inspection>& inspection,
                    const glm::vec2& at, const glm::vec2& size);

}  // namespace conelight::program

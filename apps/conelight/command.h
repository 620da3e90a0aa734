// SPDX-License-Identifier: MIT
// What the sub-commands share: registration, options that several take, progress, interruption.
#pragma once

#include <CLI/CLI.hpp>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "conelight/renderer.h"
#include "conelight/scene.h"
#include "conelight/settings.h"
#include "interrupt.h"
#include "io/animation.h"
#include "io/scene_file.h"
#include "platform/headless_context.h"

#include "session/usage.h"

namespace conelight::program {

void addRender(CLI::App& app);
void addCompare(CLI::App& app);
void addBench(CLI::App& app);
void addScore(CLI::App& app);
void addStudy(CLI::App& app);
void addBake(CLI::App& app);
void addBatch(CLI::App& app);
void addFigures(CLI::App& app);
void addInfo(CLI::App& app);
void addInspect(CLI::App& app);
void addSettings(CLI::App& app);
void addCommands(CLI::App& app);
void addConvert(CLI::App& app);
void addShaders(CLI::App& app);
void addThumbnail(CLI::App& app);
void addView(CLI::App& app);

// One status line on standard error, on a terminal only; of work that says nothing for a while it counts
// the seconds. finish() clears it.
class Progress {
  public:
    Progress();
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;
    void show(const std::string& text);
    void finish();
    // How far the loading of a file is, of which show() has told.
    bool showLoading(const std::string& path, const io::LoadStep& step);
    std::function<bool(const io::LoadStep&)> watch;  // told too (LoadOptions::progress)

  private:
    struct Line;
    std::unique_ptr<Line> line_;  // null: no terminal
};

struct Size {
    int width = 800;
    int height = 600;
};
Size parseSize(const std::string& text);                                  // "800x600"
double parseNumber(const std::string& option, const std::string& text);   // finite
glm::vec3 parseVec3(const std::string& option, const std::string& text);  // "x,y,z"

std::vector<std::string> splitList(const std::string& text);  // "a,b" -> a and b; "" -> none

// Options that choose scene, view and settings; `render` and `bench` take them all.
struct ViewOptions {
    std::string size = "800x600";
    int voxels = 0;  // 0: the setting's default
    std::string preset;
    std::string quality;
    std::string coneSet;  // a file
    std::string camera;
    std::string eye, target;
    double fovDeg = 0;
    std::optional<double> lensDiameter, focusDistance, orthographicHeight;  // m
    std::string sky;
    std::string environment;
    double rotateDeg = 0;
    double environmentStrength = 1;
    bool splitsSun = false;
    std::vector<std::string> sets;
    std::optional<int> stillViews;  // image.antialiasing where nothing else sets it
    int device = -1;
    bool debugGl = false;
    std::string execution = "auto";
    std::string programCache = "auto";
    bool allowOutside = false;
    bool noGround = false;
    io::UpAxis up = io::UpAxis::Auto;

    void addTo(CLI::App& command);
    void addContextTo(CLI::App& command);
    void addCameraTo(CLI::App& command);
    void addEnvironmentTo(CLI::App& command);
};

// --allow-outside, of every command that reads scenes.
void addAllowOutside(CLI::App& command, bool& allow);
// --up, of the same.
void addUpAxis(CLI::App& command, io::UpAxis& up);

// The OpenGL context that --device and --gl-debug ask for.
std::unique_ptr<platform::HeadlessContext> openContext(const ViewOptions& options);
// What --gl-debug, --execution and --program-cache ask for, and --shader-dir of those that have it.
RendererOptions rendererOptions(const ViewOptions& options, const std::string& shaderDirectory);

// Loads a scene, prints its notes, completes it, applies --sky and --environment.
// `animation`: with the movement of glTF files; null: without. Clips that cannot be used are a note, and with
// `needsClips` an error.
Scene openScene(const std::string& path, const ViewOptions& options, Progress& progress,
                io::SceneAnimation* animation = nullptr, bool needsClips = false);
// The settings a scene starts with in a mode: the scene's own block, then --voxels and --set.
Settings settingsFor(const Scene& scene, const std::string& mode, const ViewOptions& options);
Camera cameraFor(const Scene& scene, const ViewOptions& options);
// The mode given, else that of --preset; empty: neither.
std::string modeFor(const std::string& given, const ViewOptions& options);

}  // namespace conelight::program

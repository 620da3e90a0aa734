// SPDX-License-Identifier: MIT
// Commands of the thesis's program for its window: what is drawn, camera, frame times, scene. Its README's
// meaning where its code did otherwise.
#include <fmt/core.h>

#include <algorithm>
#include <filesystem>

#include "conelight/error.h"
#include "console/console.h"
#include "thesis/console/commands.h"
#include "thesis/format/scene.h"

namespace conelight::thesis {

using namespace program;

namespace {

Command toggle(const char* name, const char* label, bool ViewFlags::*flag, const char* help,
               const char* original) {
    Command command;
    command.name = name;
    command.help = help;
    command.run = [label, flag](const CommandContext& context) {
        ViewFlags flags = context.session.flags();
        flags.*flag = !(flags.*flag);
        context.session.setFlags(flags, label);
        context.print(fmt::format("{}: {}", label, flags.*flag ? "ON" : "OFF"));
    };
    command.original = original;
    command.branches = 1;
    return command;
}

// The scene's camera of that name, else the position that the original had compiled in.
Command preset(const char* name, const glm::vec3& eye, float yawDeg, float pitchDeg) {
    Command command;
    command.name = name;
    command.help =
        fmt::format("camera preset {} of the thesis's program, or the scene's camera of that name", name + 3);
    command.run = [name, eye, yawDeg, pitchDeg](const CommandContext& context) {
        Camera camera = thesis::thesisCamera(name, eye, yawDeg, pitchDeg);
        for (const Camera& one : context.session.scene().cameras)
            if (one.name == name) camera = one;
        context.session.jumpCamera(camera, name);
    };
    command.original = "as there";
    command.branches = 1;
    return command;
}

void iLight(const CommandContext& context) {
    Session& session = context.session;
    const bool on = session.mode() == "phong";
    // Back to what was shown before, if anything was; else the thesis's renderer, which `iLight` stands for.
    const std::string lit = context.console.litMode();
    session.setMode(!on ? "phong" : lit.empty() ? "thesis" : lit);
    context.print(fmt::format("VXCT: {}", on ? "ON" : "OFF"));
}

std::string text(const glm::vec3& v) { return fmt::format("({:.4g}, {:.4g}, {:.4g})", v.x, v.y, v.z); }

void ray(const CommandContext& context) {
    Session& session = context.session;
    const Camera& camera = session.camera();
    const auto pick = context.console.picker().along(session, camera.eye, camera.target - camera.eye);
    if (!pick) {
        session.setRayMark({});
        return context.print("Raycast: no hit");
    }
    context.print(fmt::format("Raycast hit object: {}, Distance: {:.6g} m", pick->object, pick->distance));
    context.print("Ray position: " + text(pick->position));
    context.print("Ray normal: " + text(pick->normal));
    session.setRayMark(RayMark{pick->position, pick->normal});
    session.select({SelectionKind::Instance, pick->instance});
}

void averageTime(const CommandContext& context) {
    const FrameTimes& times = context.session.frameTimes();
    const std::size_t n = times.all().size();
    if (n == 0) return context.print("no frames yet");
    context.print(fmt::format("Average frametime across last {} frame{}: {:.6g} ms", n, n == 1 ? "" : "s",
                              times.mean()));
    if (n < FrameTimes::kKept) context.print(fmt::format("fewer than {} frames so far", FrameTimes::kKept));
}

void lastTimes(const CommandContext& context) {
    const auto& times = context.session.frameTimes().all();
    const std::size_t asked = static_cast<std::size_t>(context.number(0));
    const std::size_t shown = std::min(asked, times.size());
    for (std::size_t i = times.size() - shown; i < times.size(); ++i)
        context.print(fmt::format("{:.6g} ms", times[i]));
    if (asked > times.size()) context.print(fmt::format("only {} are kept", times.size()));
}

// The original's `load x` means scenes/x.txt; so it does here when there is such a file and no file x.
std::string sceneOf(const std::string& word, const std::string& present) {
    namespace fs = std::filesystem;
    std::error_code code;
    if (word.rfind("builtin:", 0) == 0 || fs::is_regular_file(word, code)) return word;
    const fs::path beside = fs::path(present).parent_path();
    for (const fs::path& candidate :
         {fs::path("scenes") / (word + ".txt"), beside / word, beside / (word + ".txt")})
        if (fs::is_regular_file(candidate, code)) return candidate.string();
    return word;
}

Command load() {
    Command command;
    command.name = "load";
    command.arguments = {{"SCENE", ArgumentKind::SceneFile}};
    command.help = "another scene; camera and settings stay";
    command.details =
        "A file, builtin:NAME, or a bare name: scenes/NAME.txt, or such a file beside the present scene.";
    command.run = [](const CommandContext& context) {
        Request request{RequestKind::Load, sceneOf(context.words[0], context.session.path())};
        request.keepView = true;
        context.session.request(std::move(request));
    };
    command.original = "also other formats and generated scenes; the old scene's voxels go with it";
    command.branches = 1;
    return command;
}

Command plain(const char* name, const char* help, void (*run)(const CommandContext&), const char* original) {
    Command command;
    command.name = name;
    command.help = help;
    command.run = run;
    command.original = original;
    command.branches = 1;
    return command;
}

void singleFrame(const CommandContext& context) {
    if (!context.session.flags().singleFrame)
        throw Error(ErrorKind::Usage, "sf: single-frame mode is off; `sfMode` first would be right");
    context.session.request({RequestKind::SingleFrame});
}

void setPeriod(const CommandContext& context) {
    ViewFlags flags = context.session.flags();
    flags.period = static_cast<float>(context.number(0));
    context.session.setFlags(flags, "vox_freq");
}

}  // namespace

CommandGroup viewCommands() {
    CommandGroup group{"The thesis's program: view", {}};
    std::vector<Command>& c = group.commands;
    c = {
        toggle("objs", "Draw Objects", &ViewFlags::drawObjects, "draw the objects", "as there"),
        toggle("voxs", "Draw Voxels", &ViewFlags::drawVoxels,
               "show the voxels as cubes among the objects, alone after `objs`",
               "ray cast, not drawn one by one; does not need `vox` first"),
        plain(
            "vox", "build the voxels anew at the next frame",
            [](const CommandContext& context) {
                context.session.askForVoxels();
                context.session.request({RequestKind::Revoxelize});
            },
            "rarely needed: voxels follow every change by themselves"),
        toggle("voxsW", "Wireframe Voxels", &ViewFlags::wireframeVoxels, "draw voxels as wireframes",
               "with `voxs` on; seen through, as there"),
        toggle("objsW", "Wireframe Objects", &ViewFlags::wireframeObjects, "draw objects as wireframes",
               "all edges, in one colour; in every mode but reference"),
        toggle("sfMode", "Single Frame Mode", &ViewFlags::singleFrame, "draw only when `sf` asks",
               "the window stays alive"),
        plain("sf", "draw one frame in single-frame mode", singleFrame, "says so when the mode is off"),
        plain("iLight", "indirect light: the mode before, or mode phong", iLight,
              "back to the mode before; from the start on mode thesis"),
        toggle("overlayW", "Wireframe Overlay", &ViewFlags::wireframeOverlay,
               "draw edges on top of the picture",
               "as its README says: on the filled picture, in every mode but reference; `objsW` stays as it "
               "is"),
        preset("pos1", {1.26f, 0.10f, 1.73f}, -126, -4),
        preset("pos2", {0, 0, 1.8f}, -90, 0),
        plain("ray", "what is in front of the camera: object, distance, point, normal; selects it", ray,
              "at once; with the objects' transforms, without inactive ones"),
        toggle("loclod", "Localized LOD Mode", &ViewFlags::localizedLod,
               "surfaces in the colours of mode thesis's volume at level `lod`", "as there"),
        plain("avgf", "mean time of the last frames, up to 100", averageTime, "milliseconds that are such"),
        plain(
            "clearf", "forget the frame times",
            [](const CommandContext& context) {
                context.session.frameTimes().clear();
                context.print("All frametimes cleared.");
            },
            "as there"),
        toggle("dynamic", "Dynamic Revoxelization", &ViewFlags::dynamic,
               "build the voxels anew every `vox_freq` seconds, whether anything changed or not",
               "voxels follow changes without it"),
        toggle("draw_block", "Draw Block", &ViewFlags::drawBlock, "wait for the device after every frame",
               "kept and printed; frames are waited for when they are read"),
    };
    Command times = plain("lastframes", "times of the last COUNT frames, oldest first", lastTimes,
                          "the last ones, not the first; milliseconds");
    times.arguments = {{"COUNT", ArgumentKind::Whole, false, false, "frames", 1, 100, {}}};
    c.push_back(times);
    c.push_back(load());
    Command period = plain("vox_freq", "period of `dynamic`; 0 builds the voxels anew at every frame",
                           setPeriod, "a period, as there; 0: at every frame");
    period.arguments = {{"SECONDS", ArgumentKind::Number, false, false, "s", 0, 3600, {}}};
    c.push_back(period);
    return group;
}

}  // namespace conelight::thesis

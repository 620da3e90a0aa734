// SPDX-License-Identifier: MIT
// Camera paths: `path` and its words. `record FILE FRAMES path` makes the film.
#include <fmt/core.h>

#include "conelight/error.h"
#include "console/console.h"
#include "console/names.h"
#include "session/projection.h"
#include "session/usage.h"

namespace conelight::program {
namespace {

// At least `few` and at most `many` words behind the first.
void takes(const CommandContext& context, std::size_t few, std::size_t many, const char* right) {
    const std::size_t given = context.count() - 1;
    if (given < few || given > many)
        usage(fmt::format("path {}: got {} argument{}; path {} would be right", context.words[0], given,
                          given == 1 ? "" : "s", right));
}

double seconds(const CommandContext& context, double low) {
    const double value = numberFrom("path " + context.words[0], context.words[1]);
    if (value >= low && value <= 1e6) return value;
    usage(fmt::format("path {}: '{}' is not usable; a number from {:g} to 1e+06 s would be right",
                      context.words[0], context.words[1], low));
}

bool overwrite(const CommandContext& context) {
    if (context.count() < 3) return false;
    if (context.words[2] != "overwrite" && context.words[2] != "force")
        usage(fmt::format("path save: '{}' is not usable; overwrite would be right", context.words[2]));
    return true;
}

const CameraPath& pathWithKeys(const CommandContext& context) {
    const CameraPath& path = context.session.cameraPath();
    if (path.empty())
        usage(fmt::format("path {}: the path has no keys; `path add` or `path load` would be right",
                          context.words[0]));
    return path;
}

void listPath(const CommandContext& context) {
    const CameraPath& path = context.session.cameraPath();
    if (path.empty()) return context.print("the camera path has no keys; `path add` keeps this view as one");
    for (std::size_t i = 0; i < path.keys().size(); ++i) {
        const auto& [time, camera, hour] = path.keys()[i];
        context.print(fmt::format("{:3} {:>8.3f} s  eye {}  target {}  {}{}", i, time, textOf(camera.eye),
                                  textOf(camera.target), projectionText(camera),
                                  hour ? fmt::format("  hour {:g}", *hour) : ""));
    }
}

void addToPath(const CommandContext& context) {
    takes(context, 0, 1, "add [SECONDS]");
    CameraPath path = context.session.cameraPath();
    const double time = context.count() > 1 ? seconds(context, 0) : path.empty() ? 0 : path.end() + 1;
    Camera camera = context.session.camera();
    camera.name.clear();
    path.add(time, camera);
    context.session.setCameraPath(path, "path add");
    context.print(fmt::format("key at {:g} s, {} in all", time, path.keys().size()));
}

std::size_t keyNumber(const CommandContext& context, const CameraPath& path) {
    const std::string name = "path " + context.words[0];
    const double given = numberFrom(name, context.words[1]);
    const auto index = static_cast<std::size_t>(given < 0 ? 1e9 : given);
    if (index < path.keys().size() && double(index) == given) return index;
    usage(fmt::format("{}: there is no key '{}'; 0 to {} would be right", name, context.words[1],
                      path.keys().size() - 1));
}

void removeFromPath(const CommandContext& context) {
    takes(context, 1, 1, "remove NUMBER");
    CameraPath path = pathWithKeys(context);
    path.remove(keyNumber(context, path));
    context.session.setCameraPath(path, "path remove");
}

void moveInPath(const CommandContext& context) {
    takes(context, 2, 2, "move NUMBER SECONDS");
    CameraPath path = pathWithKeys(context);
    const std::size_t index = keyNumber(context, path);
    const double wanted = numberFrom("path move", context.words[2]);
    // Between its neighbours.
    if (!(wanted >= 0 && wanted <= 1e6) || path.freeTime(index, wanted, 0) != wanted ||
        (index > 0 && wanted == path.keys()[index - 1].seconds) ||
        (index + 1 < path.keys().size() && wanted == path.keys()[index + 1].seconds))
        usage(
            fmt::format("path move: key {} cannot be at {} s; a time between its neighbours' would be right",
                        index, context.words[2]));
    path.move(index, wanted);
    context.session.setCameraPath(path, "path move");
}

void play(const CommandContext& context) {
    takes(context, 0, 1, "play [SECONDS]");
    const CameraPath& path = pathWithKeys(context);
    const double own = std::max(path.end() - path.start(), 0.001);
    context.session.playPath(context.count() > 1 ? seconds(context, 0.001) : own);
}

void path(const CommandContext& context) {
    Session& session = context.session;
    const std::string word = context.count() > 0 ? context.words[0] : "list";
    if (word == "list") return listPath(context);
    if (word == "add") return addToPath(context);
    if (word == "remove") return removeFromPath(context);
    if (word == "move") return moveInPath(context);
    if (word == "clear") return session.setCameraPath({}, "path clear");
    if (word == "play") return play(context);
    if (word == "stop") return session.stopPlaying();
    if (word == "at") {
        takes(context, 1, 1, "at SECONDS");
        return session.jumpCamera(pathWithKeys(context).at(seconds(context, 0)), "path at");
    }
    if (word == "load") {
        takes(context, 1, 1, "load FILE");
        const CameraPath read = readCameraPath(context.words[1]);
        session.setCameraPath(read, "path load");
        return context.print(fmt::format("{} keys, {:g} s", read.keys().size(), read.end() - read.start()));
    }
    takes(context, 1, 2, "save FILE [overwrite]");
    writeCameraPath(context.words[1], pathWithKeys(context), overwrite(context));
    context.print("saved " + context.words[1]);
}

}  // namespace

Command pathCommand() {
    return command("path",
                   {{"WORD",
                     ArgumentKind::Choice,
                     true,
                     false,
                     "",
                     0,
                     0,
                     {"list", "add", "remove", "move", "clear", "at", "play", "stop", "save", "load"}},
                    {"VALUE", ArgumentKind::Text, true, true}},
                   "the camera's way through key frames: add, list, play, save, load", path,
                   "path add [SECONDS]      this view is a key, at that time; else 1 s after the last\n"
                   "path list               the keys, with their numbers\n"
                   "path remove NUMBER      without one of them\n"
                   "path move NUMBER SECONDS  one of them to another time between its neighbours\n"
                   "path clear              without any\n"
                   "path at SECONDS         the view at a time, between keys too\n"
                   "path play [SECONDS]     fly along it in a window; without one, be at its end\n"
                   "path stop               stop flying\n"
                   "path save FILE [overwrite], path load FILE   as JSON (docs/reference/camera_path.md)\n"
                   "record FILE FRAMES path writes the film.");
}

}  // namespace conelight::program

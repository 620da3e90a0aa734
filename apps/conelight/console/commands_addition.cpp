// SPDX-License-Identifier: MIT
// `add` and `import`: shapes and scenes into the scene, where the view looks.
#include <fmt/core.h>

#include "console/console.h"
#include "io/scene_file.h"
#include "session/addition.h"
#include "session/usage.h"

namespace conelight::program {
namespace {

void addShape(const CommandContext& context) {
    const AddedPlace place = placeInView(context.session, context.console.picker());
    Scene shape = shapeOf(context.words[0], place.size);
    if (context.count() > 1) shape.instances[0].name = context.words[1];
    addToScene(context.session, std::move(shape), place.foot, "add " + context.words[0]);
}

// Objects and lights; the camera, the sky and settings stay those of the scene.
void importScene(const CommandContext& context) {
    const std::string& file = context.words[0];
    io::LoadOptions options;
    options.allowOutside = context.session.openHow().allowOutside;
    Scene part = io::loadScene(file, options);
    for (const std::string& note : part.notes) context.print(note);
    const std::size_t objects = part.instances.size(), lights = part.lights.size();
    if (objects + lights == 0) usage("import: " + file + ": holds no object and no light");
    const AddedPlace place = placeInView(context.session, context.console.picker());
    addToScene(context.session, std::move(part), place.foot, "import " + file);
    context.print(fmt::format("imported {}: {} object{}, {} light{}", file, objects, objects == 1 ? "" : "s",
                              lights, lights == 1 ? "" : "s"));
}

}  // namespace

std::vector<Command> additionCommands() {
    const Argument kind{"KIND", ArgumentKind::Choice, false, false, "", 0, 0, shapeKinds()};
    return {
        command("add", {kind, {"NAME", ArgumentKind::Text, true}}, "add a shape, and select it", addShape,
                "It stands on what is below the middle of the view, as large as suits that. Lights: light "
                "add."),
        command("import", {{"SCENE", ArgumentKind::SceneFile}},
                "add the objects and lights of a file to the scene, and select them", importScene,
                "They stand on what is below the middle of the view, as large as the file says. Camera, "
                "sky and settings stay.")};
}

}  // namespace conelight::program

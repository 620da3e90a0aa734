// SPDX-License-Identifier: MIT
// `add` and `import`: shapes and scenes into the scene, where the view looks.
#include "console/console.h"
#include "session/addition.h"

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
    context.session.request({RequestKind::Import, context.words[0]});
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

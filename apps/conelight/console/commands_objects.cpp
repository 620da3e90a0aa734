// SPDX-License-Identifier: MIT
// Objects shown and hidden, deleted and duplicated: those of a name, or the one that is selected. Each is one
// step of undo.
#include <algorithm>
#include <cmath>

#include "conelight/error.h"
#include "console/command_table.h"
#include "console/console.h"
#include "console/names.h"

namespace conelight::program {
namespace {

// Of the name given, else what is selected.
std::vector<std::size_t> objectsOf(const CommandContext& context, const std::string& command) {
    const Session& session = context.session;
    if (context.count() == 0) {
        if (session.selection().kind == SelectionKind::Instance) return {session.selection().index};
        throw Error(ErrorKind::Usage, command + ": no object is selected; a selection, or " + command +
                                          " NAME, would be right");
    }
    requireName(command, "object", objectNames(session), context.words[0]);
    return objectsNamed(session, context.words[0]);
}

bool among(const std::vector<std::size_t>& objects, std::size_t i) {
    return std::find(objects.begin(), objects.end(), i) != objects.end();
}

// Hidden and shown objects as `visible` says; those that are so already are no change.
template <class Visible>
void setVisible(Session& session, const Visible& visible, const std::string& label) {
    std::vector<std::pair<std::size_t, Instance>> changed;
    for (std::size_t i = 0; i < session.scene().instances.size(); ++i) {
        Instance instance = session.scene().instances[i];
        if (instance.visible == visible(i, instance.visible)) continue;
        instance.visible = !instance.visible;
        changed.emplace_back(i, instance);
    }
    session.setInstances(changed, label);
}

void hide(const CommandContext& context) {
    const std::vector<std::size_t> objects = objectsOf(context, "hide");
    setVisible(
        context.session, [&](std::size_t i, bool now) { return now && !among(objects, i); }, "hide");
}

void show(const CommandContext& context) {
    std::vector<std::size_t> objects;
    if (context.count() > 0) objects = objectsOf(context, "show");
    setVisible(
        context.session,
        [&](std::size_t i, bool now) { return now || context.count() == 0 || among(objects, i); }, "show");
}

void isolate(const CommandContext& context) {
    const std::vector<std::size_t> objects = objectsOf(context, "isolate");
    setVisible(
        context.session, [&](std::size_t i, bool) { return among(objects, i); }, "isolate");
}

void remove(const CommandContext& context) {
    const std::vector<std::size_t> objects = objectsOf(context, "delete");
    std::vector<Instance> rest;
    for (std::size_t i = 0; i < context.session.scene().instances.size(); ++i)
        if (!among(objects, i)) rest.push_back(context.session.scene().instances[i]);
    context.session.setInstanceList(rest, "delete");
}

// Instances after `change`, as one step of undo.
template <class Change>
void changeEach(const CommandContext& context, const std::string& label, const Change& change) {
    std::vector<std::pair<std::size_t, Instance>> changed;
    for (const std::size_t i : objectsOf(context, label)) {
        Instance instance = context.session.scene().instances[i];
        change(instance.worldFromObject);
        changed.emplace_back(i, std::move(instance));
    }
    context.session.setInstances(changed, label + " " + context.words[0]);
}

// The front of a model is its +z, up is y (glTF 2.0, 3.4). Sizes along its axes stay.
void lookAt(const CommandContext& context) {
    const glm::vec3 target(context.number(1), context.number(2), context.number(3));
    changeEach(context, "look_at", [&](glm::mat4& m) {
        const glm::vec3 way = target - glm::vec3(m[3]);
        if (!(glm::length(way) > 1e-6f)) return;
        const glm::vec3 front = glm::normalize(way);
        const glm::vec3 up = std::abs(front.y) > 0.9999f ? glm::vec3(0, 0, 1) : glm::vec3(0, 1, 0);
        const glm::vec3 side = glm::normalize(glm::cross(up, front));
        const glm::vec3 axes[] = {side, glm::cross(front, side), front};
        for (int k = 0; k < 3; ++k) m[k] = glm::vec4(axes[k] * glm::length(glm::vec3(m[k])), 0);
    });
}

void resetPlace(const CommandContext& context) {
    changeEach(context, "reset_place", [](glm::mat4& m) { m = glm::mat4(1); });
}

void setMoving(const CommandContext& context) {
    const bool moves = context.count() < 2 || context.words[1] == "on";
    std::vector<std::pair<std::size_t, Instance>> changed;
    for (const std::size_t i : objectsOf(context, "moving")) {
        Instance instance = context.session.scene().instances[i];
        if (instance.dynamic == moves) continue;
        instance.dynamic = moves;
        changed.emplace_back(i, std::move(instance));
    }
    context.session.setInstances(changed, "moving " + context.words[0]);
}

// "chair" -> "chair 2", or the first number that is free.
std::string freeName(const Session& session, const std::string& name) {
    const std::vector<std::string> names = objectNames(session);
    for (int number = 2;; ++number) {
        std::string one = (name.empty() ? "object" : name) + " " + std::to_string(number);
        if (std::find(names.begin(), names.end(), one) == names.end()) return one;
    }
}

// Beside the original, by its width along x; the last copy is selected.
void duplicate(const CommandContext& context) {
    Session& session = context.session;
    std::vector<Instance> all = session.scene().instances;
    for (const std::size_t i : objectsOf(context, "duplicate")) {
        Instance copy = all[i];
        copy.name = freeName(session, copy.name);
        const Aabb bounds = session.scene().meshes[static_cast<std::size_t>(copy.mesh)].bounds().transformed(
            copy.worldFromObject);
        if (!bounds.empty()) copy.worldFromObject[3].x += bounds.max.x - bounds.min.x;
        all.push_back(copy);
    }
    session.setInstanceList(all, "duplicate");
    session.select({SelectionKind::Instance, all.size() - 1});
}

}  // namespace

std::vector<Command> objectCommands() {
    const Argument object{"NAME", ArgumentKind::Object, true};
    const Argument named{"NAME", ArgumentKind::Object};
    const char* const kWhich = "Without NAME: what is selected.";
    return {
        command("hide", {object}, "take an object out of the picture and its light", hide, kWhich),
        command("isolate", {object}, "hide all objects but one", isolate, kWhich),
        command("show", {object}, "show an object again", show, "Without NAME: all that are hidden."),
        command("delete", {object}, "delete an object", remove, kWhich),
        command("duplicate", {object}, "put a copy of an object beside it, and select that", duplicate,
                kWhich),
        command("look_at",
                {named,
                 {"X", ArgumentKind::Number, false, false, "m", -1e6, 1e6, {}},
                 {"Y", ArgumentKind::Number, false, false, "m", -1e6, 1e6, {}},
                 {"Z", ArgumentKind::Number, false, false, "m", -1e6, 1e6, {}}},
                "turn an object's front to a point", lookAt,
                "The front is the object's +z, up is y; its size stays."),
        command("moving", {named, {"WHETHER", ArgumentKind::Choice, true, false, "", 0, 0, {"on", "off"}}},
                "say that an object moves, or with `off` that it does not", setMoving,
                "Mode hybrid bakes light on what does not (`dynamic` in scene files)."),
        command("reset_place", {named}, "put an object where its own coordinates are the world's", resetPlace,
                "Position, scale and rotation are forgotten.")};
}

}  // namespace conelight::program

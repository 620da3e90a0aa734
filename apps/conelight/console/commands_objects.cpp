// SPDX-License-Identifier: MIT
// Objects shown and hidden, deleted and duplicated: those of a name, or the one that is selected. Each is one
// step of undo.
#include <algorithm>

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
    const char* const kWhich = "Without NAME: what is selected.";
    return {command("hide", {object}, "take an object out of the picture and its light", hide, kWhich),
            command("isolate", {object}, "hide all objects but one", isolate, kWhich),
            command("show", {object}, "show an object again", show, "Without NAME: all that are hidden."),
            command("delete", {object}, "delete an object", remove, kWhich),
            command("duplicate", {object}, "put a copy of an object beside it, and select that", duplicate,
                    kWhich)};
}

}  // namespace conelight::program

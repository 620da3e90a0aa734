// SPDX-License-Identifier: MIT
// Objects shown and hidden, deleted, duplicated and renamed: those of a name, or all that is selected. Each is one
// step of undo.
#include <algorithm>
#include <cmath>
#include <memory>

#include "console/command_table.h"
#include "console/console.h"
#include "console/names.h"
#include "session/material_edit.h"
#include "session/rename.h"
#include "session/usage.h"

namespace conelight::program {
namespace {

struct Chosen {
    std::vector<std::size_t> objects, lights;
};

// Objects of the name given, else what is selected.
Chosen chosenBy(const CommandContext& context, const std::string& command) {
    const Session& session = context.session;
    if (context.count() == 0) {
        Chosen chosen{session.selectedOf(SelectionKind::Instance), session.selectedOf(SelectionKind::Light)};
        if (!chosen.objects.empty() || !chosen.lights.empty()) return chosen;
        usage(command + ": no object is selected; a selection, or " + command + " NAME, would be right");
    }
    const std::string& word = context.words[0];
    requireName(command, "object", objectNames(session), word);
    // Lights of a group go with its objects.
    return {objectsNamed(session, word),
            isGroupName(word) ? lightsNamed(session, word) : std::vector<std::size_t>{}};
}

std::vector<std::size_t> objectsOf(const CommandContext& context, const std::string& command) {
    std::vector<std::size_t> objects = chosenBy(context, command).objects;
    if (objects.empty())
        usage(command + ": no object is selected; a selection, or " + command + " NAME, would be right");
    return objects;
}

bool among(const std::vector<std::size_t>& objects, std::size_t i) {
    return std::binary_search(objects.begin(), objects.end(), i);
}

// Hidden and shown objects as `visible` says; those that are so already are no change. Lights go on or off.
template <class Visible>
void setVisible(Session& session, const Visible& visible, const std::string& label,
                const std::vector<std::size_t>& lights = {}, bool on = false) {
    SceneEdits edits;
    for (std::size_t i = 0; i < session.scene().instances.size(); ++i) {
        Instance instance = session.scene().instances[i];
        if (instance.visible == visible(i, instance.visible)) continue;
        instance.visible = !instance.visible;
        edits.instances.emplace_back(i, instance);
    }
    if (!lights.empty()) edits.lights = session.scene().lights;
    for (const std::size_t i : lights) (*edits.lights)[i].enabled = on;
    session.edit(edits, label);
}

void hide(const CommandContext& context) {
    const Chosen chosen = chosenBy(context, "hide");
    setVisible(
        context.session, [&](std::size_t i, bool now) { return now && !among(chosen.objects, i); }, "hide",
        chosen.lights);
}

// Lights that are selected go on again.
void show(const CommandContext& context) {
    std::vector<std::size_t> objects, lights;
    if (context.count() > 0) {
        const Chosen chosen = chosenBy(context, "show");
        objects = chosen.objects;
        lights = chosen.lights;
    } else {
        lights = context.session.selectedOf(SelectionKind::Light);
    }
    setVisible(
        context.session,
        [&](std::size_t i, bool now) { return now || context.count() == 0 || among(objects, i); }, "show",
        lights, true);
}

void isolate(const CommandContext& context) {
    const std::vector<std::size_t> objects = objectsOf(context, "isolate");
    setVisible(
        context.session, [&](std::size_t i, bool) { return among(objects, i); }, "isolate");
}

template <class T>
std::vector<T> without(const std::vector<T>& all, const std::vector<std::size_t>& gone) {
    std::vector<T> rest;
    for (std::size_t i = 0; i < all.size(); ++i)
        if (!among(gone, i)) rest.push_back(all[i]);
    return rest;
}

void remove(const CommandContext& context) {
    Session& session = context.session;
    const Chosen chosen = chosenBy(context, "delete");
    SceneEdits edits;
    if (!chosen.objects.empty()) edits.instanceList = without(session.scene().instances, chosen.objects);
    if (!chosen.lights.empty()) edits.lights = without(session.scene().lights, chosen.lights);
    if (context.count() == 0) session.select({});
    session.edit(edits, "delete");
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

// Beside the originals, by their width along x; the copies are selected.
void duplicate(const CommandContext& context) {
    Session& session = context.session;
    const Scene& scene = session.scene();
    const Chosen chosen = chosenBy(context, "duplicate");
    Aabb bounds;
    for (const std::size_t i : chosen.objects) {
        const Instance& one = scene.instances[i];
        bounds.grow(
            scene.meshes[static_cast<std::size_t>(one.mesh)].bounds().transformed(one.worldFromObject));
    }
    for (const std::size_t i : chosen.lights) bounds.grow(scene.lights[i].position);
    // A lamp alone is a point.
    const float width = std::max(bounds.extent().x, chosen.objects.empty() ? 0.1f : 0.0f);
    Scene copies;
    std::vector<Selection> made;
    FreeNames objects(objectNames(session)), lights(lightNames(session));
    for (const std::size_t i : chosen.objects) {
        copies.instances.push_back(scene.instances[i]);
        Instance& copy = copies.instances.back();
        copy.name = objects.take(copy.name.empty() ? "object" : copy.name);
        copy.worldFromObject[3].x += width;
        made.push_back({SelectionKind::Instance, scene.instances.size() + copies.instances.size() - 1});
    }
    for (const std::size_t i : chosen.lights) {
        copies.lights.push_back(scene.lights[i]);
        copies.lights.back().name =
            lights.take(scene.lights[i].name.empty() ? "light" : scene.lights[i].name);
        copies.lights.back().position.x += width;
        made.push_back({SelectionKind::Light, scene.lights.size() + copies.lights.size() - 1});
    }
    SceneEdits edits;
    edits.added = std::make_shared<Scene>(std::move(copies));
    session.edit(edits, "duplicate");
    session.selectAll(made);
}

// Objects that share a material with others get one of their own.
void singleMaterial(const CommandContext& context) {
    const int copies = makeMaterialsSingle(context.session, objectsOf(context, "single_material"));
    if (copies == 0) context.print("single_material: no other object has the material");
}

void rename(const CommandContext& context) {
    Session& session = context.session;
    const std::string& word = context.words[0];
    if (isGroupName(word)) usage("rename: " + word + ": groups keep the names of their file");
    std::vector<Selection> things;
    const auto add = [&](SelectionKind kind, const std::vector<std::size_t>& found) {
        for (const std::size_t i : found) things.push_back({kind, i});
    };
    add(SelectionKind::Instance, objectsNamed(session, word));
    if (things.empty()) add(SelectionKind::Light, lightsNamed(session, word));
    if (things.empty()) add(SelectionKind::Material, materialsNamed(session, word));
    if (things.empty())
        requireName("rename", "object, light or material", wordsOf(session, {"", ArgumentKind::Selectable}),
                    word);
    renameAll(session, things, context.words[1]);
}

}  // namespace

std::vector<Command> objectCommands() {
    const Argument object{"NAME", ArgumentKind::Object, true};
    const Argument named{"NAME", ArgumentKind::Object};
    const char* const kWhich = "Without NAME: all that is selected.";
    return {
        command(
            "hide", {object}, "take an object out of the picture and its light", hide,
            "Without NAME: all that is selected; lights go off. NAME/: all that is in a group, here and in "
            "other commands."),
        command("isolate", {object}, "hide all objects but one", isolate, kWhich),
        command("show", {object}, "show an object again", show,
                "Without NAME: all that are hidden, and lights that are selected."),
        command("delete", {object}, "delete an object", remove, kWhich),
        command("duplicate", {object}, "put a copy of an object beside it, and select that", duplicate,
                kWhich),
        command("rename", {{"NAME", ArgumentKind::Selectable}, {"NEW", ArgumentKind::Text}},
                "give an object, light or material another name", rename),
        command("single_material", {object}, "give an object a material of its own, where others share it",
                singleMaterial,
                "Objects that are meant together and share one get one copy together. Without NAME: all "
                "that is selected."),
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

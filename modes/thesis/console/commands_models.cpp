// SPDX-License-Identifier: MIT
// Commands of the thesis's program for its models: each acts on every object of the name.
#include <fmt/core.h>

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <set>

#include "console/console.h"
#include "console/names.h"
#include "session/material_edit.h"
#include "thesis/console/commands.h"

namespace conelight::thesis {

using namespace program;

namespace {

using Changes = std::vector<std::pair<std::size_t, Instance>>;

template <class Change>
void changeObjects(const CommandContext& context, const std::string& label, Change change) {
    Changes changes;
    for (const std::size_t index : objectsNamed(context.session, context.words[0])) {
        Instance instance = context.session.scene().instances[index];
        change(instance);
        changes.emplace_back(index, std::move(instance));
    }
    context.session.setInstances(changes, label + " " + context.words[0]);
}

void toggle(const CommandContext& context) {
    changeObjects(context, "toggle", [&](Instance& instance) {
        instance.visible = !instance.visible;
        context.print(fmt::format("{}: {}", context.words[0], instance.visible ? "ON" : "OFF"));
    });
}

void scale(const CommandContext& context) {
    const float factor = static_cast<float>(context.number(1));
    changeObjects(context, "scale", [&](Instance& instance) {
        instance.worldFromObject = glm::scale(instance.worldFromObject, glm::vec3(factor));
    });
}

int axisOf(const std::string& word) { return word == "x" ? 0 : word == "y" ? 1 : 2; }

void translate(const CommandContext& context) {
    const int axis = axisOf(context.words[1]);
    const float distance = static_cast<float>(context.number(2));
    changeObjects(context, "translate",
                  [&](Instance& instance) { instance.worldFromObject[3][axis] += distance; });
}

// About the object's own axis and origin; lengths and angles stay, whatever its scale.
void rotate(const CommandContext& context) {
    const int axis = axisOf(context.words[1]);
    const float angle = glm::radians(static_cast<float>(context.number(2)));
    changeObjects(context, "rotate", [&](Instance& instance) {
        glm::mat4& m = instance.worldFromObject;
        const glm::vec3 own(m[axis]);
        if (!(glm::length(own) > 0)) return;
        const glm::vec3 origin(m[3]);
        const glm::mat4 turned = glm::rotate(glm::mat4(1), angle, glm::normalize(own));
        m[3] = glm::vec4(0, 0, 0, 1);
        m = turned * m;
        m[3] = glm::vec4(origin, 1);
    });
}

void setMaterial(const CommandContext& context) {
    static constexpr std::pair<const char*, float PhongMaterial::*> kProperties[] = {
        {"shininess", &PhongMaterial::shininess},
        {"ambient_str", &PhongMaterial::ambientStrength},
        {"diffuse_str", &PhongMaterial::diffuseStrength},
        {"specular_str", &PhongMaterial::specularStrength}};
    std::set<std::size_t> indices;
    for (const std::size_t object : objectsNamed(context.session, context.words[0]))
        indices.insert(context.session.materialOf(object));
    std::vector<std::pair<std::size_t, Material>> changes;
    for (const std::size_t index : indices) {
        Material material = context.session.scene().materials[index];
        PhongMaterial phong = phongOf(material);
        for (const auto& [name, property] : kProperties)
            if (context.words[1] == name) phong.*property = static_cast<float>(context.number(2));
        setPhong(material, phong);
        changes.emplace_back(index, std::move(material));
    }
    context.session.setMaterials(changes, "setmat " + context.words[0]);
    const std::string others = othersWith(context.session, indices, context.words[0]);
    if (!others.empty()) context.print("(the material is shared with " + others + ")");
}

Command originalCommand(const char* name, std::vector<Argument> arguments, const char* help,
                        void (*run)(const CommandContext&), const char* original) {
    Command made = command(name, std::move(arguments), help, run);
    made.original = original;
    made.branches = 1;
    return made;
}

}  // namespace

CommandGroup modelCommands() {
    const Argument object{"OBJECT", ArgumentKind::Object};
    const Argument axis{"AXIS", ArgumentKind::Choice, false, false, "", 0, 0, {"x", "y", "z"}};
    return {
        "The thesis's program: objects",
        {
            originalCommand("toggle", {object}, "show or hide an object: hidden ones are in no pass", toggle,
                            "says so when no object has the name, as all of these do"),
            originalCommand("scale",
                            {object, {"FACTOR", ArgumentKind::Number, false, false, "", 1e-4, 1e4, {}}},
                            "multiply an object's size", scale, "as there; 0 is refused"),
            originalCommand("setmat",
                            {object,
                             {"PROPERTY",
                              ArgumentKind::Choice,
                              false,
                              false,
                              "",
                              0,
                              0,
                              {"shininess", "ambient_str", "diffuse_str", "specular_str"}},
                             {"VALUE", ArgumentKind::Number, false, false, "", 0, 10000, {}}},
                            "a Phong property of an object's material (`material` changes all others)",
                            setMaterial, "unknown properties are refused; the physical modes follow"),
            originalCommand(
                "translate",
                {object, axis, {"DISTANCE", ArgumentKind::Number, false, false, "m", -1e6, 1e6, {}}},
                "move an object along an axis of the world", translate,
                "in metres along the world's axes, as its README says, not along scaled axes of the model"),
            originalCommand(
                "rotate",
                {object, axis, {"ANGLE", ArgumentKind::Number, false, false, "deg", -36000, 36000, {}}},
                "turn an object about its own axis", rotate, "does not shear scaled models"),
        }};
}

}  // namespace conelight::thesis

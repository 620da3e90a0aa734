// SPDX-License-Identifier: MIT
#include "session/rename.h"

#include <algorithm>

namespace conelight::program {

const std::string& nameOf(const Session& session, const Selection& what) {
    static const std::string kNone;
    const Scene& scene = session.scene();
    if (what.kind == SelectionKind::Instance) return scene.instances.at(what.index).name;
    if (what.kind == SelectionKind::Light) return scene.lights.at(what.index).name;
    if (what.kind == SelectionKind::Material) return scene.materials.at(what.index).name;
    return kNone;
}

void renameAll(Session& session, const std::vector<Selection>& things, const std::string& name) {
    const Scene& scene = session.scene();
    SceneEdits edits;
    std::vector<std::pair<std::size_t, Material>> materials;
    for (const Selection& one : things) {
        if (nameOf(session, one) == name) continue;
        if (one.kind == SelectionKind::Instance) {
            edits.instances.emplace_back(one.index, scene.instances[one.index]);
            edits.instances.back().second.name = name;
        } else if (one.kind == SelectionKind::Light) {
            if (!edits.lights) edits.lights = scene.lights;
            (*edits.lights)[one.index].name = name;
        } else if (one.kind == SelectionKind::Material) {
            materials.emplace_back(one.index, scene.materials[one.index]);
            materials.back().second.name = name;
        }
    }
    session.edit(edits, "rename " + name);
    session.setMaterials(materials, "rename " + name);
}

std::string FreeNames::take(const std::string& name) {
    // A copy of "chair 2" is "chair 2 2": its name says what it was made of.
    for (int number = 2;; ++number) {
        std::string one = name + " " + std::to_string(number);
        if (taken_.insert(one).second) return one;
    }
}

std::string FreeNames::takeOwn(const std::string& name) {
    return taken_.insert(name).second ? name : take(name);
}

}  // namespace conelight::program

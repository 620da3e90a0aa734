// SPDX-License-Identifier: MIT
// One step of undo: what changed, before and after. Only the parts that changed are kept: of meshes and textures
// those that were added, which all steps share.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "conelight/scene.h"
#include "conelight/settings.h"
#include "session/camera_path.h"
#include "session/view_flags.h"

namespace conelight::program {

template <class T>
struct BeforeAfter {
    T before, after;
};
// The settings and the mode's name, which may be one that Settings does not know (reference, radiosity).
struct PictureSettings {
    Settings settings;
    std::string mode;
};

struct InstanceEdit : BeforeAfter<Instance> {
    std::size_t index = 0;
};
struct InstancesEdit : BeforeAfter<std::vector<Instance>> {};
struct MaterialEdit : BeforeAfter<Material> {
    std::size_t index = 0;
};
struct MaterialsEdit : BeforeAfter<std::vector<Material>> {};
// How many a scene has.
struct SceneCounts {
    std::size_t meshes = 0, materials = 0, textures = 0, instances = 0, lights = 0, groups = 0;
};
// Meshes, materials, textures, instances, lights and groups behind those of the scene, whose numbers theirs go on from.
struct AddEdit {
    std::shared_ptr<const Scene> added;
    SceneCounts before;
};
struct LightsEdit : BeforeAfter<std::vector<Light>> {};
struct CamerasEdit : BeforeAfter<std::vector<Camera>> {};
struct SkyEdit : BeforeAfter<glm::vec3> {};
struct EnvironmentEdit : BeforeAfter<Environment> {};
struct SettingsEdit : BeforeAfter<PictureSettings> {};
struct CameraEdit : BeforeAfter<Camera> {};
struct FlagsEdit : BeforeAfter<ViewFlags> {};
struct PathEdit : BeforeAfter<CameraPath> {};

using Edit = std::variant<InstanceEdit, InstancesEdit, MaterialEdit, MaterialsEdit, LightsEdit, CamerasEdit,
                          SkyEdit, EnvironmentEdit, SettingsEdit, CameraEdit, FlagsEdit, PathEdit, AddEdit>;

struct Step {
    std::string label;     // "translate Lucy"
    std::string mergeKey;  // steps of one key in a row become one: a slider that is dragged
    std::vector<Edit> edits;
    std::uint64_t serial = 0;  // of its last merge: no two states of a session share one
};

// Whether it changes what a scene file holds; settings, view and camera path are not of the scene.
inline bool isOfScene(const Edit& edit) {
    return !std::holds_alternative<SettingsEdit>(edit) && !std::holds_alternative<CameraEdit>(edit) &&
           !std::holds_alternative<FlagsEdit>(edit) && !std::holds_alternative<PathEdit>(edit);
}

}  // namespace conelight::program

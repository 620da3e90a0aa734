// SPDX-License-Identifier: MIT
#include "session/save.h"

#include <algorithm>

#include "io/gltf_write.h"
#include "io/scene_write.h"
#include "session/preset.h"

namespace conelight::program {
namespace {

bool sameView(const Camera& a, const Camera& b) {
    return a.eye == b.eye && a.target == b.target && a.up == b.up && a.fovY == b.fovY &&
           a.lensDiameter == b.lensDiameter && a.focusDistance == b.focusDistance &&
           a.orthographicHeight == b.orthographicHeight;
}

}  // namespace

Scene sceneToSave(const Session& session) {
    Scene scene = session.scene();
    const bool isFirst = !scene.cameras.empty() && sameView(scene.cameras.front(), session.camera());
    if (!isFirst) {
        Camera view = session.camera();
        view.name = "saved";
        std::erase_if(scene.cameras, [](const Camera& one) { return one.name == "saved"; });
        scene.cameras.insert(scene.cameras.begin(), view);
    }
    // All that differs from what a reader starts with; the picture's look always, because formats differ in
    // it.
    scene.settings = differences(Settings{}, session.settings());
    for (const SettingInfo& info : settingInfos()) {
        const bool said = std::any_of(scene.settings.begin(), scene.settings.end(),
                                      [&](const auto& one) { return one.first == info.key; });
        if (info.key.rfind("image.", 0) == 0 && !said)
            scene.settings.emplace_back(info.key, getSetting(session.settings(), info.key));
    }
    return scene;
}

std::vector<std::string> saveSession(Session& session, const std::string& path, bool force) {
    std::vector<std::string> notes = io::writeScene(path, sceneToSave(session), force);
    session.markSaved();
    return notes;
}

}  // namespace conelight::program

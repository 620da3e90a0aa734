// SPDX-License-Identifier: MIT
#include "io/scene_write.h"

#include <fmt/format.h>

#include <algorithm>

#include "conelight/error.h"
#include "io/files.h"
#include "io/gltf_write.h"
#include "io/scene_format.h"

namespace conelight::io {

std::vector<std::string> writtenSceneExtensions() {
    std::vector<std::string> all{".glb", ".gltf"};
    for (const SceneFormat& format : sceneFormats())
        all.insert(all.end(), format.extensions.begin(), format.extensions.end());
    std::sort(all.begin(), all.end());
    return all;
}

std::vector<std::string> writeScene(const std::string& path, const Scene& scene, bool force) {
    const std::vector<std::string> known = writtenSceneExtensions();
    const std::string extension = lowerExtension(path);
    if (std::find(known.begin(), known.end(), extension) == known.end())
        throw Error(ErrorKind::Usage,
                    fmt::format("{}: scenes are not written as '{}'; one of {} would be right", oneLine(path),
                                oneLine(extension), fmt::join(known, " ")));
    refuseOverwriting(path, force);
    if (const SceneFormat* format = sceneFormatOf(extension)) return format->write(path, scene, force);
    return writeGltf(path, scene, force);
}

}  // namespace conelight::io

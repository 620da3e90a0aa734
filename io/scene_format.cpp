// SPDX-License-Identifier: MIT
// The list of registered formats; few, so it is searched from the front.
#include "io/scene_format.h"

#include <algorithm>

namespace conelight::io {
namespace {

std::vector<SceneFormat>& registered() {
    static std::vector<SceneFormat> formats;
    return formats;
}

}  // namespace

void registerSceneFormat(SceneFormat format) {
    std::erase_if(registered(), [&](const SceneFormat& one) { return one.name == format.name; });
    registered().push_back(std::move(format));
}

const std::vector<SceneFormat>& sceneFormats() { return registered(); }

const SceneFormat* sceneFormatOf(const std::string& extension) {
    for (const SceneFormat& one : registered())
        if (std::find(one.extensions.begin(), one.extensions.end(), extension) != one.extensions.end())
            return &one;
    return nullptr;
}

const SceneFormat* sceneFormatNamed(const std::string& name) {
    for (const SceneFormat& one : registered())
        if (one.name == name) return &one;
    return nullptr;
}

}  // namespace conelight::io

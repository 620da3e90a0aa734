// SPDX-License-Identifier: MIT
// Scenes made by code: the analytic boxes that measurements need (furnace, leak, Cornell), a few rooms that
// stress one effect each, and the atrium, a show piece with any number of triangles.
// SPEC -> Scene. Everything is deterministic: the same specification gives the same tables, bit by bit.
#pragma once

#include "conelight/scene.h"

#include <span>
#include <string>
#include <string_view>

namespace conelight::io {

// What the names of generated scenes and surroundings begin with, where files may stand as well.
inline constexpr std::string_view kBuiltin = "builtin:";

// A number that a generated scene can be asked for.
struct GeneratedParameter {
    std::string_view name;
    double defaultValue;
    double min;
    double max;
    bool integer;              // true: only whole numbers are taken
    std::string_view meaning;  // with its unit
};

struct GeneratedSceneInfo {
    std::string_view name;
    std::string_view description;  // one line
    std::span<const GeneratedParameter> parameters;
};

namespace generated {
class Values;  // the parameters asked for: generated_scenes.h
}

// Adds a scene of a guest (modes/) behind those of this folder. First thing in a program, from one thread;
// the texts of `info` last for ever. A name that is there already: nothing is done.
void registerGeneratedScene(const GeneratedSceneInfo& info, Scene (*build)(const generated::Values&));

// All scenes that generateScene knows, in the order in which help should list them. Valid until the next
// registerGeneratedScene.
std::span<const GeneratedSceneInfo> generatedScenes();

// Makes the scene NAME or NAME?key=value&key=value, e.g. "atrium?triangles=1000000". Has at least one camera;
// the first one is the default view. Throws Error(Usage), one line that names what is known, for an unknown
// name or key, for a key given twice, and for a value that is no number or out of its range. Thread-safe.
Scene generateScene(const std::string& spec);

}  // namespace conelight::io

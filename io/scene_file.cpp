// SPDX-License-Identifier: MIT
// Chooses the reader by name and extension, then checks its result: see scene_file.h.
#include "io/scene_file.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "conelight/error.h"
#include "io/animation.h"
#include "io/assimp_import.h"
#include "io/files.h"
#include "io/generated.h"
#include "io/generated_figure.h"
#include "io/gltf.h"
#include "io/scene_format.h"

namespace conelight::io {

namespace fs = std::filesystem;

namespace {
// " .ext (its title)," for each.
std::string registeredFormats() {
    std::string text;
    for (const SceneFormat& format : sceneFormats())
        text += fmt::format(" {} ({}),", format.extensions.front(), format.title);
    return text;
}

Scene read(const fs::path& path, const LoadOptions& options, SceneAnimation* animation) {
    const std::string extension = lowerExtension(path);
    const auto refuseUp = [&] {
        if (options.up == UpAxis::Auto) return;
        throw Error(ErrorKind::Usage,
                    fmt::format("{}: is y-up by its format; an up axis is taken for .obj, .ply, "
                                ".stl and others that may stand along another one",
                                oneLine(path.string())));
    };
    if (extension == ".gltf" || extension == ".glb" || extension == ".vrm") {
        try {
            Scene scene = loadGltf(path, options, animation);
            refuseUp();
            return scene;
        } catch (const GltfVersion1&) {
            return loadAssimp(path, options);
        }
    }
    if (const SceneFormat* format = sceneFormatOf(extension)) {
        refuseUp();
        return format->read(path, options);
    }
    const std::vector<std::string> known = assimpExtensions();
    if (std::find(known.begin(), known.end(), extension) != known.end()) return loadAssimp(path, options);
    if (!fs::exists(path))
        throw Error(ErrorKind::BadInput, fmt::format("{}: no such file", oneLine(path.string())));
    throw Error(ErrorKind::Usage, fmt::format("{}: unknown scene extension '{}'; known: .gltf .glb,{} .obj "
                                              ".fbx .ply .stl .dae .3ds .ifc and {} "
                                              "more, or builtin:NAME",
                                              oneLine(path.string()), oneLine(extension), registeredFormats(),
                                              known.size() - std::min<std::size_t>(known.size(), 7)));
}

Scene load(const std::string& pathOrBuiltin, const LoadOptions& options, SceneAnimation* animation) {
    const std::string file = oneLine(pathOrBuiltin);
    const LoadStopped stopped(file + ": stopped; nothing is loaded");
    if (options.progress && !options.progress({"reading"})) throw stopped;
    if (pathOrBuiltin.rfind(kBuiltin, 0) == 0) {
        if (options.up != UpAxis::Auto)
            throw Error(ErrorKind::Usage, file + ": is y-up; an up axis is taken for files");
        Scene scene = generateScene(pathOrBuiltin.substr(kBuiltin.size()));
        if (animation != nullptr) *animation = generated::figureAnimation(scene);
        return scene;
    }
    try {
        Scene scene = read(fs::path(pathOrBuiltin), options, animation);
        if (scene.name.empty()) scene.name = fs::path(pathOrBuiltin).stem().string();
        scene.validate();
        return scene;
    } catch (const LoadStopped&) {
        throw stopped;
    } catch (const Error& error) {
        // Scene::validate and other rooms do not know the file.
        const std::string what = oneLine(error.what(), 1000);
        if (what.rfind(file, 0) == 0) throw Error(error.kind(), what);
        throw Error(error.kind(), file + ": " + what);
    } catch (const std::bad_alloc&) {
        throw Error(ErrorKind::BadInput, file + ": needs more memory than there is");
    } catch (const std::exception& error) {
        throw Error(ErrorKind::BadInput, fmt::format("{}: {}", file, oneLine(error.what())));
    }
}

}  // namespace

void LoadOptions::tell(const LoadStep& step) const {
    if (progress && !progress(step)) throw LoadStopped("stopped");
}

Scene loadScene(const std::string& pathOrBuiltin, const LoadOptions& options) {
    return load(pathOrBuiltin, options, nullptr);
}

Scene loadAnimatedScene(const std::string& pathOrBuiltin, const LoadOptions& options,
                        SceneAnimation& animation) {
    animation = {};
    Scene scene = load(pathOrBuiltin, options, &animation);
    markMoving(animation, scene);
    return scene;
}

Scene loadMovingScene(const std::string& pathOrBuiltin, const LoadOptions& options,
                      SceneAnimation& animation) {
    try {
        return loadAnimatedScene(pathOrBuiltin, options, animation);
    } catch (const LoadStopped&) {
        throw;
    } catch (const Error& error) {
        animation = {};
        Scene scene = loadScene(pathOrBuiltin, options);
        scene.notes.push_back(std::string("clips are left out: ") + error.what());
        return scene;
    }
}

std::vector<std::string> sceneExtensions() {
    const std::vector<std::string> foreign = assimpExtensions();
    std::set<std::string> all(foreign.begin(), foreign.end());
    all.insert({".gltf", ".glb"});
    for (const SceneFormat& format : sceneFormats())
        all.insert(format.extensions.begin(), format.extensions.end());
    return {all.begin(), all.end()};
}

}  // namespace conelight::io

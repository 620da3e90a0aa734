// SPDX-License-Identifier: MIT
// Scenes from files: glTF 2.0 (.gltf .glb), registered formats (scene_format.h), generated scenes
// (builtin:NAME) and every format Assimp reads (.obj .fbx .ply .stl .dae .3ds .ifc ...).
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "conelight/error.h"
#include "conelight/export.h"
#include "conelight/scene.h"

namespace conelight::io {

// The axis of a file that points up. Auto: what its format or its exporter says, else what io/upright.h finds.
enum class UpAxis : std::uint8_t { Auto, X, Y, Z };
// How far a load is.
struct LoadStep {
    std::string_view name;            // "reading", "pictures", "meshes", "importing"
    std::size_t done = 0, total = 0;  // of that; total 0: not known
};

struct LoadOptions {
    // Processor seconds a foreign importer may use, plus one for every 5 MB of the file; 0 = no limit. A file
    // that needs more is an error. Does not apply to glTF and registered formats, whose cost is bounded by
    // size.
    double timeLimitSeconds = 10.0;
    // Memory a foreign importer may take, plus 100 bytes for every byte of the file; 0 = no limit.
    std::uint64_t memoryLimitBytes = std::uint64_t(4) << 30;
    // Import foreign formats in a child process, so that an importer that crashes, hangs or eats memory ends
    // as one line of error. Off: faster for many tiny files, and the importer can take the program with it.
    bool isolate = true;
    // Texels of all pictures of a scene together, about 4 bytes each; larger ones are read smaller, with a note.
    std::uint64_t maxTexels = std::uint64_t(1) << 28;
    // Let a scene name files outside its own folder (scene_folder.h): only for scenes that are trusted.
    bool allowOutside = false;
    // For formats that Assimp reads: the axis of the scene, as its format has it, that becomes +y. Error(Usage) for
    // others, which are y-up by definition.
    UpAxis up = UpAxis::Auto;
    // Told how far the load is: at its beginning, before each picture and each mesh of a glTF file and each model
    // of a registered format, and several times a second while a foreign importer works. Returning false stops the
    // load, which throws LoadStopped. Called on the thread that loads; must not throw. Empty: nobody is told.
    std::function<bool(const LoadStep&)> progress;
    // For readers: tells, and throws LoadStopped when the load is to stop.
    CONELIGHT_API void tell(const LoadStep& step) const;
};

// LoadOptions::progress has stopped the load: kind Runtime, "FILE: stopped; nothing is loaded".
class CONELIGHT_API LoadStopped : public Error {
  public:
    explicit LoadStopped(const std::string& message) : Error(ErrorKind::Runtime, message) {}
};

// Reads a scene. The result fulfils Scene::validate(); it has the file's cameras and lights only (see
// completeScene). What was left out or changed is in Scene::notes.
// Throws Error(BadInput), one line "FILE: where: what is wrong; what would be right"; Error(Usage) for an
// extension nobody reads and for an unknown builtin; LoadStopped. Reads files in the scene's folder; no other effect.
// Thread-safe; on POSIX systems foreign formats fork the process.
CONELIGHT_API Scene loadScene(const std::string& pathOrBuiltin, const LoadOptions& options = {});

// Extensions loadScene reads, in lower case with dot, sorted; for help texts and file dialogs.
CONELIGHT_API std::vector<std::string> sceneExtensions();

}  // namespace conelight::io

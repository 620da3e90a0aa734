// SPDX-License-Identifier: MIT
// Which extensions of glTF are read: the list behind messages and docs/reference/gltf.md. Private to this room.
#pragma once

#include <span>
#include <string_view>

namespace conelight::io {

enum class GltfSupport {
    Read,      // in full
    Harmless,  // what it adds does not change a picture
    Fallback,  // what stands beside it in the file is read instead; a file that requires it is drawn plainer
    None,      // named in a note; a file that requires it is refused
};

struct GltfExtension {
    std::string_view name;
    GltfSupport support;
};

// In the order of their names.
std::span<const GltfExtension> gltfExtensions();
GltfSupport supportOf(std::string_view name);

}  // namespace conelight::io

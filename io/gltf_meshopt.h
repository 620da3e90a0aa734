// SPDX-License-Identifier: MIT
// EXT_meshopt_compression: the bytes of a buffer view from those it is compressed to. Private to this room.
#pragma once

#include <cstdint>
#include <span>

#include "io/gltf_file.h"

namespace conelight::io {

// `extension` is the object that stands in the buffer view, `packed` the bytes it names. Throws
// Error(BadInput) with a line that starts at the extension.
Bytes unpackMeshopt(const GltfValue& extension, std::span<const std::uint8_t> packed);

}  // namespace conelight::io

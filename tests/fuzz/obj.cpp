// SPDX-License-Identifier: MIT
// Bytes -> the text of an OBJ or MTL file as Assimp's reader gets it.
#include "io/obj_text.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    conelight::io::plainObjText(conelight::io::Bytes(data, data + size));
    return 0;
}

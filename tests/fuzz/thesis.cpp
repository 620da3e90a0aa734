// SPDX-License-Identifier: MIT
// Bytes -> syntax tree of the thesis's scene format. A file that is none is an Error, nothing else.
#include "conelight/error.h"
#include "thesis/format/syntax.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try {
        conelight::thesis::parseThesisText({reinterpret_cast<const char*>(data), size}, "scene.txt");
    } catch (const conelight::Error&) {
    }
    return 0;
}

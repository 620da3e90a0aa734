// SPDX-License-Identifier: MIT
// JSON of a glTF file -> scene, complete.
#include "conelight/error.h"
#include "first_picture.h"
#include "folder.h"
#include "io/files.h"
#include "json_mutation.h"

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t maxSize,
                                               unsigned seed) {
    using Json = conelight::fuzz::Json;
    static const std::vector<Json> kOdd = {
        0,    -1,   1,      2,     65535,       65536, 2147483647, 4294967295u,   -1e30,
        1e30, 0.5,  1e-45,  "",    "a/../../b", true,  nullptr,    Json::array(), Json::object(),
        5120, 5126, "MASK", "MAT4"};
    return conelight::fuzz::mutateJson(kOdd, data, size, maxSize, seed);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const std::filesystem::path kFile = conelight::fuzz::folder() / "scene.gltf";
    conelight::io::writeFile(kFile, {data, size});
    try {
        conelight::fuzz::loadComplete(kFile);
    } catch (const conelight::Error&) {
    }
    return 0;
}

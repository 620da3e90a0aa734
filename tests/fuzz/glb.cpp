// SPDX-License-Identifier: MIT
// Binary glTF -> scene: views compressed by meshoptimizer, pictures as WebP, PNG and JPEG.
#include "glb_mutation.h"

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t maxSize,
                                               unsigned seed) {
    using Json = conelight::fuzz::Json;
    static const std::vector<Json> kOdd = {0,
                                           -1,
                                           1,
                                           2,
                                           3,
                                           4,
                                           16,
                                           65536,
                                           1e30,
                                           2147483647,
                                           4294967295u,
                                           "NONE",
                                           "ATTRIBUTES",
                                           "TRIANGLES",
                                           "INDICES",
                                           "OCTAHEDRAL",
                                           5120,
                                           5126,
                                           "QUATERNION",
                                           "EXPONENTIAL",
                                           "VEC4",
                                           "MAT4",
                                           Json::array(),
                                           Json::object()};
    return conelight::fuzz::mutateGlb(kOdd, data, size, maxSize, seed);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    conelight::fuzz::loadGlb(data, size);
    return 0;
}

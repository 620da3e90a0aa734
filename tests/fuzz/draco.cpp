// SPDX-License-Identifier: MIT
// Binary glTF with meshes compressed by Draco -> scene. It is decoded in a child process, whose memory has no limit
// under the address sanitizer: meshes of more than 65,536 things are left alone.
#include <cstdlib>
#include <string_view>

#include "glb_mutation.h"

namespace {

// One of the first numbers behind the header that Draco's bytes begin with is that large. They are sevens of bits.
bool isLarge(const std::uint8_t* data, std::size_t size) {
    constexpr std::string_view kName = "DRACO";
    const std::uint8_t* const end = data + size;
    for (const std::uint8_t* at = data;; ++at) {
        at = std::search(at, end, kName.begin(), kName.end());
        constexpr std::ptrdiff_t kHeader = 11;
        if (end - at < kHeader) return false;
        // The method's own first byte is there or not: read from both places.
        for (const std::ptrdiff_t skipped : {0, 1}) {
            const std::uint8_t* byte = at + kHeader + skipped;
            for (int number = 0; number < 4; ++number) {
                std::uint64_t value = 0;
                int shift = 0;
                for (bool more = true; more && byte < end && shift < 63; ++byte, shift += 7) {
                    value |= std::uint64_t(*byte & 127) << shift;
                    more = (*byte & 128) != 0;
                }
                if (value > 65536) return true;
            }
        }
    }
}

}  // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t maxSize,
                                               unsigned seed) {
    using Json = conelight::fuzz::Json;
    static const std::vector<Json> kOdd = {
        0,    -1,   1,    2,    24,       25,     96,     65536,         4294967295u,
        5120, 5121, 5123, 5125, "SCALAR", "VEC4", "MAT4", Json::array(), Json::object()};
    return conelight::fuzz::mutateGlb(kOdd, data, size, maxSize, seed);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (isLarge(data, size)) return -1;
    // A sanitizer that ends the child ends it with this status. The whole line: files may quote a part of it.
    if (conelight::fuzz::loadGlb(data, size) ==
        ": KHR_draco_mesh_compression: the importer ended without a result (status 1)")
        std::abort();
    return 0;
}

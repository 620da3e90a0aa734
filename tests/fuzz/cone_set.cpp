// SPDX-License-Identifier: MIT
// JSON of a set of cones -> cones, all of finite numbers.
#include "io/cone_set_file.h"

#include <cmath>
#include <cstdlib>

#include "conelight/error.h"
#include "folder.h"
#include "io/files.h"
#include "json_mutation.h"

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t maxSize,
                                               unsigned seed) {
    using Json = conelight::fuzz::Json;
    static const std::vector<Json> kOdd = {
        0,     -1,   1,        2,           1e-30, 1e30,          -1e300,
        1e-45, 3.15, "weight", "direction", "",    Json::array(), Json::object()};
    return conelight::fuzz::mutateJson(kOdd, data, size, maxSize, seed);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace conelight;
    static const std::filesystem::path kFile = fuzz::folder() / "cones.json";
    io::writeFile(kFile, {data, size});
    std::vector<SetCone> cones;
    try {
        cones = io::readConeSet(kFile.string());
    } catch (const Error&) {
        return 0;
    }
    for (const SetCone& cone : cones)
        if (!std::isfinite(cone.aperture) || !std::isfinite(cone.weight) || !std::isfinite(cone.direction.x))
            std::abort();
    return 0;
}

// SPDX-License-Identifier: MIT
// JSON of a preset -> settings; what a preset sets is written as one again and read the same.
#include "session/preset.h"

#include <cstdlib>

#include "conelight/error.h"
#include "folder.h"
#include "guests.h"
#include "io/files.h"
#include "json_mutation.h"

extern "C" int LLVMFuzzerInitialize(int*, char***) {
    conelight::program::registerGuests();
    return 0;
}

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t maxSize,
                                               unsigned seed) {
    using Json = conelight::fuzz::Json;
    static const std::vector<Json> kOdd = {
        0,  -1,    1,    2,      2147483648u,   -1e300,         1e300,  1e-45,
        "", "nan", "on", "auto", Json::array(), Json::object(), "high", "cones"};
    return conelight::fuzz::mutateJson(kOdd, data, size, maxSize, seed);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace conelight;
    static const std::filesystem::path kFile = fuzz::folder() / "preset.json";
    static const std::filesystem::path kAgain = fuzz::folder() / "again.json";
    io::writeFile(kFile, {data, size});
    Settings settings;
    try {
        const program::Preset preset = program::readPreset(kFile.string());
        preset.apply(settings);
    } catch (const Error&) {
        return 0;
    }
    program::Preset written;
    written.values = program::differences(Settings{}, settings);
    program::writePreset(kAgain.string(), written, true);
    Settings again;
    program::readPreset(kAgain.string()).apply(again);
    if (!program::differences(settings, again).empty()) std::abort();
    return 0;
}

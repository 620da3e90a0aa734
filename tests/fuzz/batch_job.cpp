// SPDX-License-Identifier: MIT
// JSON of a batch job -> tasks, whose pictures lie below the folder of results. Patterns of file names are left
// alone: they would look through this machine.
#include "apps/conelight/batch/job.h"
#include "conelight/error.h"
#include "folder.h"
#include "io/files.h"
#include "json_mutation.h"

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t maxSize,
                                               unsigned seed) {
    using Json = conelight::fuzz::Json;
    static const std::vector<Json> kOdd = {0,
                                           -1,
                                           1,
                                           2,
                                           99999,
                                           1e9,
                                           1e300,
                                           true,
                                           "",
                                           "mode",
                                           "builtin:",
                                           "seed",
                                           "{seed}.exr",
                                           "{frame}.png",
                                           "../a",
                                           "{scene}-{mode}.png",
                                           "set.mode",
                                           "scene.x",
                                           "path",
                                           nullptr,
                                           "builtin:room?",
                                           Json::array(),
                                           Json::object()};
    return conelight::fuzz::mutateJson(kOdd, data, size, maxSize, seed);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace conelight;
    static const std::filesystem::path kFile = fuzz::folder() / "job.json";
    static const std::vector<program::BatchOption> kOptions = {
        {"mode", false, false},     {"size", false, false},       {"seed", false, false},
        {"overwrite", true, false}, {"environment", false, true}, {"spp", false, false}};
    const std::string text(reinterpret_cast<const char*>(data), size);
    // So many tasks are allowed that they take long: lists stay, ranges of many are left out.
    if (text.find_first_of("*?") != std::string::npos || text.find("000") != std::string::npos) return -1;
    io::writeFile(kFile, {data, size});
    try {
        for (const program::BatchTask& task : program::readBatchJob(kFile.string(), kOptions).tasks)
            for (const std::string& file : task.files)
                if (file.empty() || file.front() == '/' || file.find("../") != std::string::npos)
                    std::abort();
    } catch (const Error&) {
    }
    return 0;
}

// SPDX-License-Identifier: MIT
// JSON of a glTF file -> scene. Mutations keep it JSON: a value becomes another one, is left out, or is put
// somewhere else. What is no JSON is mutated as bytes.
#include <unistd.h>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

#include "conelight/error.h"
#include "io/files.h"
#include "io/scene_file.h"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t maxSize);

namespace {

using Json = nlohmann::json;

void collect(Json& value, std::vector<Json*>& all) {
    all.push_back(&value);
    if (value.is_structured())
        for (Json& child : value) collect(child, all);
}

Json oddValue(std::mt19937& random) {
    static const std::vector<Json> kOdd = {
        0,    -1,   1,      2,     65535,       65536, 2147483647, 4294967295u,   -1e30,
        1e30, 0.5,  1e-45,  "",    "a/../../b", true,  nullptr,    Json::array(), Json::object(),
        5120, 5126, "MASK", "MAT4"};
    return kOdd[random() % kOdd.size()];
}

void mutate(Json& root, std::mt19937& random) {
    std::vector<Json*> all;
    collect(root, all);
    Json& value = *all[random() % all.size()];
    switch (random() % 5) {
        case 0:
            value = oddValue(random);
            break;
        case 1:
            value = Json(*all[random() % all.size()]);
            break;
        case 2:
            if (value.is_array() && !value.empty()) value.push_back(Json(value[random() % value.size()]));
            break;
        case 3:
            if (value.is_array() && !value.empty()) value.erase(random() % value.size());
            if (value.is_object() && !value.empty())
                value.erase(std::next(value.begin(), std::ptrdiff_t(random() % value.size())));
            break;
        default:
            if (value.is_number()) value = value.get<double>() + double(int(random() % 9)) - 4;
            break;
    }
}

// One folder per process, in memory where there is such a file system.
const std::filesystem::path& sceneFile() {
    static const std::filesystem::path kFile = [] {
        const std::filesystem::path base =
            std::filesystem::exists("/dev/shm") ? "/dev/shm" : std::filesystem::temp_directory_path();
        const std::filesystem::path folder = base / ("conelight_fuzz_" + std::to_string(getpid()));
        std::filesystem::create_directories(folder);
        return folder / "scene.gltf";
    }();
    return kFile;
}

}  // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t maxSize,
                                               unsigned seed) {
    Json root = Json::parse(data, data + size, nullptr, false);
    std::mt19937 random(seed);
    if (root.is_discarded() || random() % 16 == 0) return LLVMFuzzerMutate(data, size, maxSize);
    for (unsigned i = 0; i <= random() % 3; ++i) mutate(root, random);
    const std::string text = root.dump(-1, ' ', false, Json::error_handler_t::replace);
    if (text.size() > maxSize) return LLVMFuzzerMutate(data, size, maxSize);
    std::memcpy(data, text.data(), text.size());
    return text.size();
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    conelight::io::writeFile(sceneFile(), {data, size});
    try {
        conelight::io::LoadOptions options;
        options.maxTexels = std::uint64_t(1) << 20;
        conelight::io::loadScene(sceneFile().string(), options);
    } catch (const conelight::Error&) {
    }
    return 0;
}

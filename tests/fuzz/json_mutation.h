// SPDX-License-Identifier: MIT
// Mutations for libFuzzer that keep JSON what it is: a value becomes another one, is left out, or is put somewhere
// else. What is no JSON is mutated as bytes. A target includes this file and gives its odd values.
#pragma once

#include <cstring>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t maxSize);

namespace conelight::fuzz {

using Json = nlohmann::json;

inline void collect(Json& value, std::vector<Json*>& all) {
    all.push_back(&value);
    if (value.is_structured())
        for (Json& child : value) collect(child, all);
}

inline void mutate(Json& root, const std::vector<Json>& oddValues, std::mt19937& random) {
    std::vector<Json*> all;
    collect(root, all);
    Json& value = *all[random() % all.size()];
    switch (random() % 5) {
        case 0:
            value = oddValues[random() % oddValues.size()];
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

// What LLVMFuzzerCustomMutator does, whose arguments the last four are.
inline std::size_t mutateJson(const std::vector<Json>& oddValues, std::uint8_t* data, std::size_t size,
                              std::size_t maxSize, unsigned seed) {
    Json root = Json::parse(data, data + size, nullptr, false);
    std::mt19937 random(seed);
    if (root.is_discarded() || random() % 16 == 0) return LLVMFuzzerMutate(data, size, maxSize);
    const unsigned times = 1 + random() % 3;
    for (unsigned i = 0; i < times; ++i) mutate(root, oddValues, random);
    const std::string text = root.dump(-1, ' ', false, Json::error_handler_t::replace);
    if (text.size() > maxSize) return LLVMFuzzerMutate(data, size, maxSize);
    std::memcpy(data, text.data(), text.size());
    return text.size();
}

}  // namespace conelight::fuzz

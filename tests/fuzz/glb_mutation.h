// SPDX-License-Identifier: MIT
// Mutations for libFuzzer of binary glTF: its JSON as JSON, its buffer as bytes; the header says what is there. What
// is no binary glTF is mutated as bytes. A target includes this file and gives its odd values.
#pragma once

#include <algorithm>
#include <cstring>
#include <string>
#include <vector>

#include "conelight/error.h"
#include "first_picture.h"
#include "folder.h"
#include "io/files.h"
#include "json_mutation.h"

namespace conelight::fuzz {

struct Glb {
    std::string json;
    std::vector<std::uint8_t> buffer;
};

// The two first chunks; false: there are none.
inline bool takeApart(const std::uint8_t* data, std::size_t size, Glb& glb) {
    const auto word = [&](std::size_t at) {
        std::uint32_t value = 0;
        std::memcpy(&value, data + at, sizeof value);
        return std::size_t(value);
    };
    constexpr std::size_t kHeader = 12, kChunk = 8;
    if (size < kHeader + kChunk || std::memcmp(data, "glTF", 4) != 0) return false;
    const std::size_t text = word(kHeader), after = kHeader + kChunk + text;
    if (text > size - kHeader - kChunk) return false;
    glb.json.assign(reinterpret_cast<const char*>(data) + kHeader + kChunk, text);
    if (size < after + kChunk || word(after) > size - after - kChunk) return false;
    glb.buffer.assign(data + after + kChunk, data + after + kChunk + word(after));
    return true;
}

inline std::string putTogether(Glb glb) {
    while (glb.json.size() % 4 != 0) glb.json.push_back(' ');
    while (glb.buffer.size() % 4 != 0) glb.buffer.push_back(0);
    const auto word = [](std::size_t value) {
        const auto v = std::uint32_t(value);
        std::string bytes(sizeof v, '\0');
        std::memcpy(bytes.data(), &v, sizeof v);
        return bytes;
    };
    return "glTF" + word(2) + word(28 + glb.json.size() + glb.buffer.size()) + word(glb.json.size()) +
           "JSON" + glb.json + word(glb.buffer.size()) + std::string("BIN\0", 4) +
           std::string(glb.buffer.begin(), glb.buffer.end());
}

// A few bytes of the buffer are others, in place: what names them still does.
inline void mutateBuffer(std::vector<std::uint8_t>& buffer, std::mt19937& random) {
    if (buffer.empty()) return;
    const std::size_t start = random() % buffer.size();
    const std::size_t count = std::min<std::size_t>(buffer.size() - start, 1 + random() % 64);
    LLVMFuzzerMutate(&buffer[start], count, count);
}

// What LLVMFuzzerCustomMutator does, whose arguments the last four are.
inline std::size_t mutateGlb(const std::vector<Json>& oddValues, std::uint8_t* data, std::size_t size,
                             std::size_t maxSize, unsigned seed) {
    Glb glb;
    std::mt19937 random(seed);
    Json root;
    if (takeApart(data, size, glb)) root = Json::parse(glb.json, nullptr, false);
    if (!root.is_object() || random() % 32 == 0) return LLVMFuzzerMutate(data, size, maxSize);
    const unsigned times = 1 + random() % 3;
    for (unsigned i = 0; i < times; ++i)
        if (random() % 2 == 0)
            mutate(root, oddValues, random);
        else
            mutateBuffer(glb.buffer, random);
    glb.json = root.dump(-1, ' ', false, Json::error_handler_t::replace);
    const std::string all = putTogether(std::move(glb));
    if (all.size() > maxSize) return LLVMFuzzerMutate(data, size, maxSize);
    std::memcpy(data, all.data(), all.size());
    return all.size();
}

// Loads and completes it; what the importer says against it.
inline std::string loadGlb(const std::uint8_t* data, std::size_t size) {
    static const std::filesystem::path kFile = folder() / "scene.glb";
    io::writeFile(kFile, {data, size});
    try {
        loadComplete(kFile);
    } catch (const Error& error) {
        return std::string(error.what()).substr(kFile.string().size());
    }
    return {};
}

}  // namespace conelight::fuzz

// SPDX-License-Identifier: MIT
// What the importer tests share: files in a scratch folder, a small glTF builder, expectations on errors,
// mutated inputs.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

#include "conelight/error.h"
#include "conelight/scene.h"
#include "io/scene_file.h"
#include "support/gl_fixture.h"

namespace conelight::test {

using Json = nlohmann::json;

// A folder of one test, fresh and unique by name.
inline std::filesystem::path folderOf(const std::string& name) {
    const std::filesystem::path folder = std::filesystem::path(scratchDir()) / name;
    std::filesystem::create_directories(folder);
    return folder;
}

inline std::string write(const std::filesystem::path& path, const std::string& content) {
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << content;
    return path.string();
}

// The message of the Error that loading must throw; it is one line and starts with the path.
inline std::string loadError(const std::string& path, const io::LoadOptions& options = {}) {
    try {
        io::loadScene(path, options);
    } catch (const Error& error) {
        const std::string what = error.what();
        EXPECT_EQ(what.rfind(path, 0), 0u) << what;
        EXPECT_EQ(what.find('\n'), std::string::npos) << what;
        return what;
    }
    ADD_FAILURE() << path << " loads";
    return {};
}

inline bool hasNote(const Scene& scene, const std::string& part) {
    for (const std::string& note : scene.notes)
        if (note.find(part) != std::string::npos) return true;
    return false;
}

inline bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

// Collects buffers and accessors of a glTF document; the rest is plain JSON.
class GltfBuilder {
  public:
    Json json = {{"asset", {{"version", "2.0"}}}};

    template <typename T>
    int view(const std::vector<T>& values) {
        while (bytes_.size() % 4 != 0) bytes_.push_back('\0');
        json["bufferViews"].push_back(
            {{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", values.size() * sizeof(T)}});
        bytes_.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
        return int(json["bufferViews"].size()) - 1;
    }
    int accessor(int bufferView, int componentType, std::size_t count, const std::string& type) {
        json["accessors"].push_back(
            {{"bufferView", bufferView}, {"componentType", componentType}, {"count", count}, {"type", type}});
        return int(json["accessors"].size()) - 1;
    }
    int floats(const std::vector<float>& values, std::size_t components) {
        static const char* const kTypes[] = {"", "SCALAR", "VEC2", "VEC3", "VEC4"};
        return accessor(view(values), 5126, values.size() / components,
                        components == 16 ? "MAT4" : kTypes[components]);
    }
    int indices(const std::vector<std::uint16_t>& values) {
        return accessor(view(values), 5123, values.size(), "SCALAR");
    }

    // One triangle (0,0,0) (1,0,0) (0,1,0) as mesh 0; returns its primitive.
    Json& triangle() {
        const int positions = floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, 3);
        json["meshes"] = {{{"primitives", {{{"attributes", {{"POSITION", positions}}}}}}}};
        return json["meshes"][0]["primitives"][0];
    }
    // Makes `nodes` the nodes of the only scene, roots 0.
    void node(const Json& value) {
        json["nodes"].push_back(value);
        json["scenes"] = {{{"nodes", {0}}}};
        json["scene"] = 0;
    }

    std::string glb() const {
        Json out = json;
        std::string binary = bytes_;
        while (binary.size() % 4 != 0) binary.push_back('\0');
        if (!binary.empty()) out["buffers"] = {{{"byteLength", binary.size()}}};
        std::string text = out.dump();
        while (text.size() % 4 != 0) text.push_back(' ');
        const auto word = [](std::size_t value) {
            std::string s(4, '\0');
            const auto v = std::uint32_t(value);
            std::memcpy(s.data(), &v, 4);
            return s;
        };
        std::string all =
            "glTF" + word(2) + word(12 + 8 + text.size() + (binary.empty() ? 0 : 8 + binary.size()));
        all += word(text.size()) + "JSON" + text;
        if (!binary.empty()) all += word(binary.size()) + std::string("BIN\0", 4) + binary;
        return all;
    }
    const std::string& bytes() const { return bytes_; }

  private:
    std::string bytes_;
};

inline std::string base64(const std::string& bytes) {
    static const char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t bits = 0;
        for (std::size_t j = 0; j < 3; ++j)
            bits = bits << 8 | (i + j < bytes.size() ? std::uint8_t(bytes[i + j]) : 0u);
        for (std::size_t j = 0; j < 4; ++j)
            out.push_back(j <= bytes.size() - i ? kDigits[bits >> (18 - 6 * j) & 63] : '=');
    }
    return out;
}

// Damages a file in one of the ways files get damaged: cut, bits flipped, bytes overwritten by a repeated or
// extreme value, pieces removed or doubled.
inline std::string mutated(const std::string& original, std::mt19937& random) {
    std::string out = original;
    const auto at = [&](std::size_t size) { return std::size_t(random()) % std::max<std::size_t>(size, 1); };
    const int count = 1 + int(random() % 4);
    for (int i = 0; i < count && !out.empty(); ++i) {
        switch (random() % 6) {
            case 0:
                out.resize(at(out.size()));
                break;
            case 1:
                out[at(out.size())] ^= char(1u << random() % 8);
                break;
            case 2:
                out[at(out.size())] = char(random());
                break;
            case 3: {
                const std::size_t start = at(out.size());
                out.erase(start, 1 + at(16));
                break;
            }
            case 4: {
                const std::size_t start = at(out.size());
                out.insert(start, out.substr(start, 1 + at(32)));
                break;
            }
            default: {
                static const char* const kExtremes[] = {
                    "4294967295",           "-1", "1e39", "nan", "\xff\xff\xff\xff",
                    "99999999999999999999", "{",  "}",    "[",   "0"};
                out.insert(at(out.size()), kExtremes[random() % std::size(kExtremes)]);
            }
        }
    }
    return out;
}

struct FuzzCount {
    int loaded = 0;
    int refused = 0;
};

// Loads `count` damaged versions; each must load or throw Error, nothing else.
inline FuzzCount fuzz(const std::string& original, const std::filesystem::path& path, int count,
                      unsigned seed, const io::LoadOptions& options = {}) {
    std::mt19937 random(seed);
    FuzzCount result;
    for (int i = 0; i < count; ++i) {
        write(path, mutated(original, random));
        try {
            const Scene scene = io::loadScene(path.string(), options);
            scene.validate();
            ++result.loaded;
        } catch (const Error& error) {
            const std::string what = error.what();
            EXPECT_EQ(what.rfind(path.string(), 0), 0u) << what;
            EXPECT_EQ(what.find('\n'), std::string::npos) << what;
            ++result.refused;
        }
    }
    return result;
}

}  // namespace conelight::test

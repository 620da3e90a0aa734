// SPDX-License-Identifier: MIT
#include "support/moving_scene.h"

#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "io/files.h"
#include "support/program.h"

namespace conelight::test {
namespace {

using Json = nlohmann::json;

std::size_t nodeOf(const Json& json, const std::string& name) {
    std::size_t node = 0;
    while (json["nodes"].at(node)["name"] != name) ++node;
    return node;
}

// `type`: SCALAR or VEC3. Returns the number of the accessor.
std::size_t addAccessor(Json& json, const std::vector<float>& values, const std::string& type) {
    io::Bytes bytes(sizeof(float) * values.size());
    std::memcpy(bytes.data(), values.data(), bytes.size());
    json["bufferViews"].push_back({{"buffer", json["buffers"].size()}, {"byteLength", bytes.size()}});
    json["buffers"].push_back({{"byteLength", bytes.size()},
                               {"uri", "data:application/octet-stream;base64," + io::base64Encoded(bytes)}});
    json["accessors"].push_back({{"bufferView", json["bufferViews"].size() - 1},
                                 {"componentType", 5126},
                                 {"count", values.size() / (type == "VEC3" ? 3 : 1)},
                                 {"type", type}});
    return json["accessors"].size() - 1;
}

// `values` at 0 s and at 1 s.
void addClip(Json& json, std::size_t node, const std::string& path, const std::vector<float>& values) {
    const std::size_t input = addAccessor(json, {0, 1}, "SCALAR");
    const std::size_t output = addAccessor(json, values, path == "weights" ? "SCALAR" : "VEC3");
    json["animations"] = {{{"name", "rise"},
                           {"samplers", {{{"input", input}, {"output", output}}}},
                           {"channels", {{{"sampler", 0}, {"target", {{"node", node}, {"path", path}}}}}}}};
}

Json cornell(const std::string& path) {
    std::filesystem::remove_all(path);
    EXPECT_EQ(conelight("convert builtin:cornell '" + path + "' --overwrite").status, 0);
    return Json::parse(std::ifstream(path));
}

}  // namespace

std::string risingBlock(const std::string& name, const std::vector<float>& placed, const std::string& what) {
    const std::string path = scratchPath(name);
    Json json = cornell(path);
    const std::size_t block = nodeOf(json, what), lift = json["nodes"].size();
    json["nodes"].push_back({{"name", "lift"}, {"children", {block}}});
    for (Json& root : json["scenes"][0]["nodes"])
        if (root == block) root = lift;
    if (placed.empty())
        addClip(json, lift, "translation", {0, 0, 0, 0, 0.5f, 0});
    else
        json["nodes"][lift]["translation"] = placed;
    std::ofstream(path) << json;
    return path;
}

std::string growingBlock(const std::string& name) {
    const std::string path = scratchPath(name);
    Json json = cornell(path);
    const std::size_t block = nodeOf(json, "short block");
    Json& primitive = json["meshes"][json["nodes"][block]["mesh"].get<std::size_t>()]["primitives"][0];
    const std::size_t positions = primitive["attributes"]["POSITION"];
    std::vector<float> deltas;
    for (std::size_t i = 0; i < json["accessors"][positions]["count"]; ++i)
        deltas.insert(deltas.end(), {0, 0.5f, 0});
    primitive["targets"] = {{{"POSITION", addAccessor(json, deltas, "VEC3")}}};
    addClip(json, block, "weights", {0, 1});
    std::ofstream(path) << json;
    return path;
}

}  // namespace conelight::test

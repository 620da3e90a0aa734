// SPDX-License-Identifier: MIT
#include "io/gltf_write.h"

#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "conelight/error.h"
#include "conelight/version.h"
#include "io/files.h"
#include "io/gltf_write_buffer.h"
#include "io/gltf_write_material.h"
#include "io/scene_info.h"

namespace conelight::io {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::uint32_t kGlbMagic = 0x46546c67, kJsonChunk = 0x4e4f534a, kBinaryChunk = 0x004e4942;

// A placement that looks along `forward` (glTF's lights and cameras look along -z).
glm::mat4 lookingAlong(const glm::vec3& position, const glm::vec3& forward, const glm::vec3& up) {
    const glm::vec3 z = -glm::normalize(forward);
    glm::vec3 x = glm::cross(up, z);
    if (!(glm::length(x) > 1e-6f)) x = glm::cross(glm::vec3(1, 0, 0), z);
    if (!(glm::length(x) > 1e-6f)) x = glm::cross(glm::vec3(0, 0, 1), z);
    x = glm::normalize(x);
    return {glm::vec4(x, 0), glm::vec4(glm::cross(z, x), 0), glm::vec4(z, 0), glm::vec4(position, 1)};
}

class Writer {
  public:
    Writer(const Scene& scene, const GltfLightmaps* lightmaps)
        : scene_(scene), lightmaps_(lightmaps), buffer_(root_) {}
    Json document();
    std::vector<std::uint8_t>& bytes() { return buffer_.bytes(); }
    std::vector<std::string> notes() const;

  private:
    int meshOf(const Instance& instance);
    void addInstance(std::size_t index);
    void addLight(const Light& light);
    std::size_t profileOf(const std::shared_ptr<const LightProfile>& profile);
    void addCamera(const Camera& camera);
    void addNode(Json node);
    void addSceneExtras(Json& scene);
    Json environment();

    const Scene& scene_;
    const GltfLightmaps* lightmaps_;  // null: none
    Json root_;
    GltfBuffer buffer_;
    std::map<int, Json> primitives_;             // mesh of the scene -> attributes and indices
    std::map<std::pair<int, int>, int> meshes_;  // (mesh, material) -> mesh of the file
    std::set<std::string> extensions_;
    std::vector<std::shared_ptr<const LightProfile>> profiles_;
    Json nodes_ = Json::array();
    std::size_t areaLights_ = 0, customFalloffs_ = 0, flagged_ = 0;
};

int Writer::meshOf(const Instance& instance) {
    const auto key = std::make_pair(instance.mesh, instance.material);
    if (const auto known = meshes_.find(key); known != meshes_.end()) return known->second;
    const Mesh& mesh = scene_.meshes[static_cast<std::size_t>(instance.mesh)];
    Json& primitive = primitives_[instance.mesh];
    if (primitive.is_null()) {
        const auto attribute = [&](const char* name, int accessor) {
            if (accessor >= 0) primitive["attributes"][name] = accessor;
        };
        attribute("POSITION", buffer_.vectors(mesh.positions, true));
        attribute("NORMAL", buffer_.vectors(mesh.normals));
        attribute("TANGENT", buffer_.vectors(mesh.tangents));
        attribute("TEXCOORD_0", buffer_.vectors(mesh.uvs));
        if (lightmaps_ != nullptr)
            attribute("TEXCOORD_1",
                      buffer_.vectors(lightmaps_->uvs[static_cast<std::size_t>(instance.mesh)]));
        attribute("COLOR_0", buffer_.vectors(mesh.colors));
        primitive["indices"] = buffer_.indices(mesh.indices);
    }
    Json placed = primitive;
    if (instance.material >= 0) placed["material"] = instance.material;
    root_["meshes"].push_back({{"name", mesh.name}, {"primitives", Json::array({placed})}});
    return meshes_[key] = static_cast<int>(root_["meshes"].size()) - 1;
}

void Writer::addNode(Json node) {
    nodes_.push_back(root_["nodes"].size());
    root_["nodes"].push_back(std::move(node));
}

void Writer::addInstance(std::size_t index) {
    const Instance& instance = scene_.instances[index];
    if (instance.mesh < 0 || scene_.meshes[static_cast<std::size_t>(instance.mesh)].indices.empty()) return;
    Json node = {{"name", instance.name}, {"mesh", meshOf(instance)}};
    if (instance.worldFromObject != glm::mat4(1.0f)) node["matrix"] = listOf(instance.worldFromObject);
    Json flags = Json::object();
    if (!instance.visible) flags["visible"] = false;
    if (!instance.voxelized) flags["voxelized"] = false;
    if (!instance.castsShadow) flags["castsShadow"] = false;
    if (instance.dynamic) flags["dynamic"] = true;
    if (!flags.empty()) {
        node["extras"]["conelight"] = flags;
        ++flagged_;
    }
    if (lightmaps_ != nullptr && lightmaps_->instances[index].map >= 0) {
        const GltfLightmaps::Place& place = lightmaps_->instances[index];
        node["extras"]["lightmap"] = {{"map", place.map},
                                      {"offset", {place.offset.x, place.offset.y}},
                                      {"scale", {place.scale.x, place.scale.y}}};
    }
    addNode(std::move(node));
}

// Each is written once, as the file it came from.
std::size_t Writer::profileOf(const std::shared_ptr<const LightProfile>& profile) {
    const auto known = std::find(profiles_.begin(), profiles_.end(), profile);
    if (known != profiles_.end()) return static_cast<std::size_t>(known - profiles_.begin());
    profiles_.push_back(profile);
    extensions_.insert("EXT_lights_ies");
    root_["extensions"]["EXT_lights_ies"]["lights"].push_back(
        {{"name", profile->file},
         {"bufferView", buffer_.view(profile->text.data(), profile->text.size())},
         {"mimeType", "application/x-ies-lm-63"}});
    return profiles_.size() - 1;
}

void Writer::addLight(const Light& light) {
    Json own = Json::object();
    if (!light.enabled) own["enabled"] = false;
    if (!light.castsShadow) own["castsShadow"] = false;
    if (light.customFalloff) {
        own["falloff"] = listOf(light.falloff);
        ++customFalloffs_;
    }
    Json node = {{"name", light.name},
                 {"matrix", listOf(lookingAlong(light.position, light.direction, {0, 1, 0}))}};
    if (hasArea(light.type)) {
        own["type"] = lightTypeName(light.type);
        own["radiance"] = listOf(light.intensity);
        own["direction"] = listOf(light.direction);
        own["halfU"] = listOf(light.halfU);
        own["halfV"] = listOf(light.halfV);
        node["extras"]["conelight"]["light"] = own;
        ++areaLights_;
        addNode(std::move(node));
        return;
    }
    const float strength = std::max({light.intensity.r, light.intensity.g, light.intensity.b});
    const glm::vec3 color = strength > 0 ? light.intensity / strength : glm::vec3(1);
    if (light.profile != nullptr && light.type != LightType::Directional && !light.profile->text.empty()) {
        if (light.range > 0) own["range"] = light.range;
        if (light.type == LightType::Spot) own["cone"] = {light.innerAngle, light.outerAngle};
        if (!own.empty()) node["extras"]["conelight"]["light"] = own;
        // Its first column lies along x.
        const glm::vec3 up = glm::cross(-light.direction, light.halfU);
        node["matrix"] = listOf(lookingAlong(light.position, light.direction, up));
        node["extensions"]["EXT_lights_ies"] = {{"light", profileOf(light.profile)},
                                                {"multiplier", strength * 683 / light.profile->candela},
                                                {"color", listOf(color)}};
        addNode(std::move(node));
        return;
    }
    Json to = {{"name", light.name},
               {"type", light.type == LightType::Point  ? "point"
                        : light.type == LightType::Spot ? "spot"
                                                        : "directional"},
               {"color", listOf(color)},
               {"intensity", strength}};
    if (light.range > 0) to["range"] = light.range;
    if (light.type == LightType::Spot)
        to["spot"] = {{"innerConeAngle", light.innerAngle}, {"outerConeAngle", light.outerAngle}};
    if (!own.empty()) to["extras"]["conelight"] = own;
    Json& lights = root_["extensions"]["KHR_lights_punctual"]["lights"];
    node["extensions"]["KHR_lights_punctual"]["light"] = lights.size();
    lights.push_back(to);
    extensions_.insert("KHR_lights_punctual");
    addNode(std::move(node));
}

void Writer::addCamera(const Camera& camera) {
    const glm::vec3 forward = camera.target - camera.eye;
    Json own = {{"distance", glm::length(forward)}};
    if (camera.lensDiameter > 0) own["lensDiameter"] = camera.lensDiameter;
    if (camera.focusDistance > 0) own["focusDistance"] = camera.focusDistance;
    root_["cameras"].push_back(
        {{"name", camera.name},
         {"type", "perspective"},
         {"perspective", {{"yfov", camera.fovY}, {"znear", camera.zNear}, {"zfar", camera.zFar}}}});
    addNode({{"name", camera.name},
             {"camera", root_["cameras"].size() - 1},
             {"matrix", listOf(lookingAlong(camera.eye, forward, camera.up))},
             {"extras", {{"conelight", own}}}});
}

// A generated picture is kept as its specification, another as floats in the buffer.
Json Writer::environment() {
    const Environment& from = scene_.environment;
    Json json = {{"file", from.file}, {"rotation", from.rotation}, {"strength", from.strength}};
    if (from.file.starts_with("builtin:")) return json;
    json["width"] = from.image->width;
    json["height"] = from.image->height;
    json["bufferView"] = buffer_.view(from.image->radiance.data(),
                                      from.image->radiance.size() * sizeof(from.image->radiance[0]));
    return json;
}

void Writer::addSceneExtras(Json& scene) {
    if (scene_.environment.image != nullptr) scene["extras"]["conelight"]["environment"] = environment();
    if (scene_.sky != glm::vec3(0)) scene["extras"]["sky"] = listOf(scene_.sky);
    if (!scene_.format.empty()) scene["extras"]["conelight"]["format"] = scene_.format;
    for (const auto& [key, value] : scene_.settings)
        scene["extras"]["conelight"]["settings"].push_back(Json::array({key, value}));
}

Json Writer::document() {
    root_["asset"] = {{"version", "2.0"}, {"generator", "Conelight " CONELIGHT_VERSION_STRING}};
    writeGltfTextures(root_, buffer_, scene_);
    for (const Material& material : scene_.materials) writeGltfMaterial(root_, material, extensions_);
    for (std::size_t i = 0; i < scene_.instances.size(); ++i) addInstance(i);
    for (const Light& light : scene_.lights) addLight(light);
    for (const Camera& camera : scene_.cameras) addCamera(camera);
    Json scene = {{"name", scene_.name}, {"nodes", nodes_}};
    if (nodes_.empty()) scene.erase("nodes");
    addSceneExtras(scene);
    root_["scene"] = 0;
    root_["scenes"] = Json::array({scene});
    if (!extensions_.empty()) root_["extensionsUsed"] = extensions_;
    while (buffer_.bytes().size() % 4 != 0) buffer_.bytes().push_back(0);
    return root_;
}

std::vector<std::string> Writer::notes() const {
    std::vector<std::string> notes;
    const auto note = [&](std::size_t count, const char* what) {
        if (count > 0)
            notes.push_back(fmt::format("{} {}: kept as extras, which only Conelight reads", count, what));
    };
    note(areaLights_, areaLights_ == 1 ? "area light" : "area lights");
    note(customFalloffs_,
         customFalloffs_ == 1 ? "light with its own falloff" : "lights with their own falloff");
    note(flagged_, flagged_ == 1 ? "object with flags" : "objects with flags");
    return notes;
}

void append(std::vector<std::uint8_t>& to, std::uint32_t word) {
    for (int i = 0; i < 4; ++i) to.push_back(static_cast<std::uint8_t>(word >> (8 * i)));
}

std::vector<std::uint8_t> glbOf(const std::filesystem::path& path, std::string json,
                                const std::vector<std::uint8_t>& binary) {
    while (json.size() % 4 != 0) json += ' ';
    const std::uint64_t total = 12 + 8 + json.size() + (binary.empty() ? 0 : 8 + binary.size());
    if (total > 0xffffffffull)
        throw Error(ErrorKind::Runtime,
                    path.string() + ": more than 4 GiB, which .glb cannot hold; .gltf would be right");
    std::vector<std::uint8_t> file;
    file.reserve(total);
    append(file, kGlbMagic);
    append(file, 2);
    append(file, static_cast<std::uint32_t>(total));
    append(file, static_cast<std::uint32_t>(json.size()));
    append(file, kJsonChunk);
    file.insert(file.end(), json.begin(), json.end());
    if (binary.empty()) return file;
    append(file, static_cast<std::uint32_t>(binary.size()));
    append(file, kBinaryChunk);
    file.insert(file.end(), binary.begin(), binary.end());
    return file;
}

// Names come from files in any encoding; JSON wants UTF-8.
std::string textOf(const Json& document, int indent) {
    return document.dump(indent, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

namespace {

std::filesystem::path bufferBeside(const std::filesystem::path& path) {
    return std::filesystem::path(path).replace_extension(".bin");
}

// Whether the glTF file that is there reads its geometry from `buffer`.
bool names(const std::filesystem::path& path, const std::filesystem::path& buffer) {
    std::error_code code;
    if (!std::filesystem::is_regular_file(path, code)) return false;
    const Bytes bytes = readFile(path);
    const Json old = Json::parse(bytes.begin(), bytes.end(), nullptr, false);
    if (!old.is_object() || !old.contains("buffers") || !old["buffers"].is_array()) return false;
    for (const Json& one : old["buffers"])
        if (one.is_object() && one.contains("uri") && one["uri"].is_string() &&
            percentDecoded(one["uri"].get<std::string>()) == buffer.filename().string())
            return true;
    return false;
}

}  // namespace

void refuseForeignBuffer(const std::filesystem::path& path, bool overwrite) {
    if (overwrite || lowerExtension(path) == ".glb") return;
    const std::filesystem::path buffer = bufferBeside(path);
    std::error_code code;
    if (!std::filesystem::exists(std::filesystem::symlink_status(buffer, code)) || names(path, buffer))
        return;
    throw Error(ErrorKind::Usage,
                fmt::format("{}: is there already and not of {}; another name, .glb, or overwrite, would be "
                            "right",
                            oneLine(buffer.string()), oneLine(path.filename().string())));
}

std::vector<std::string> writeGltf(const std::filesystem::path& path, const Scene& scene, bool overwrite,
                                   const GltfLightmaps* lightmaps) {
    scene.validate();
    Writer writer(scene, lightmaps);
    Json document = writer.document();
    const std::vector<std::uint8_t>& binary = writer.bytes();
    if (!binary.empty()) document["buffers"] = Json::array({{{"byteLength", binary.size()}}});
    if (lowerExtension(path) == ".glb") {
        writeFile(path, glbOf(path, textOf(document, -1), binary));
        return writer.notes();
    }
    std::vector<std::pair<std::filesystem::path, Bytes>> files;
    if (!binary.empty()) {
        refuseForeignBuffer(path, overwrite);
        document["buffers"][0]["uri"] = bufferBeside(path).filename().string();
        files.emplace_back(bufferBeside(path), binary);
    }
    const std::string text = textOf(document, 1) + "\n";
    files.emplace_back(path, Bytes(text.begin(), text.end()));
    writeFiles(files);
    return writer.notes();
}

}  // namespace conelight::io

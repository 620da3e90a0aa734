// SPDX-License-Identifier: MIT
#include "thesis/format/write.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <optional>
#include <set>

#include "conelight/error.h"
#include "conelight/thesis/thesis.h"
#include "io/files.h"
#include "thesis/format/scene.h"

namespace conelight::thesis {

using io::Bytes;
using io::oneLine;
using io::refuseOverwriting;
using io::writeFiles;

namespace fs = std::filesystem;

namespace {

constexpr double kDegreeInRadians = 3.14159265358979323846 / 180.0;

std::string number(float value) { return fmt::format("{:.9g}", value); }
std::string triple(const glm::vec3& v, const char* names) {
    return fmt::format("{{ {} = {} {} = {} {} = {} }}", names[0], number(v.x), names[1], number(v.y),
                       names[2], number(v.z));
}

// T Rx Ry Rz S of a matrix; nothing when it has shear or no extent in some direction.
struct Placement {
    glm::vec3 position, rotationDeg, scale;
};
std::optional<Placement> placementOf(const glm::mat4& m) {
    glm::dvec3 axis[3];
    Placement out;
    out.position = glm::vec3(m[3]);
    for (int c = 0; c < 3; ++c) {
        const glm::dvec3 column = glm::dvec3(glm::vec3(m[c]));
        const double length = glm::length(column);
        if (!(length > 1e-12)) return std::nullopt;
        out.scale[c] = static_cast<float>(length);
        axis[c] = column / length;
    }
    // 1e-5: rounding of three float rotations in a row stays below it.
    for (int c = 0; c < 3; ++c)
        if (std::abs(glm::dot(axis[c], axis[(c + 1) % 3])) > 1e-5) return std::nullopt;
    if (glm::dot(glm::cross(axis[0], axis[1]), axis[2]) < 0) {
        axis[0] = -axis[0];
        out.scale.x = -out.scale.x;
    }
    const double sinY = std::clamp(axis[2].x, -1.0, 1.0);
    glm::dvec3 angles(0, std::asin(sinY), 0);
    if (std::abs(sinY) < 1 - 1e-12) {
        angles.x = std::atan2(-axis[2].y, axis[2].z);
        angles.z = std::atan2(-axis[1].x, axis[0].x);
    } else {
        angles.x = std::atan2(axis[1].z, axis[1].y);
    }
    out.rotationDeg = glm::vec3(angles / kDegreeInRadians);
    return out;
}

// Positions, normals and texture coordinates; Wavefront counts from 1, and v upward.
std::string objOf(const Mesh& mesh) {
    std::string text = "# written by Conelight\no mesh\n";
    for (const glm::vec3& p : mesh.positions)
        text += fmt::format("v {} {} {}\n", number(p.x), number(p.y), number(p.z));
    for (const glm::vec2& uv : mesh.uvs) text += fmt::format("vt {} {}\n", number(uv.x), number(1 - uv.y));
    for (const glm::vec3& n : mesh.normals)
        text += fmt::format("vn {} {} {}\n", number(n.x), number(n.y), number(n.z));
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        text += "f";
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const std::uint32_t index = mesh.indices[i + corner] + 1;
            text += fmt::format(" {}", index);
            if (!mesh.uvs.empty() || !mesh.normals.empty()) text += "/";
            if (!mesh.uvs.empty()) text += std::to_string(index);
            if (!mesh.normals.empty()) text += "/" + std::to_string(index);
        }
        text += "\n";
    }
    return text;
}

Mesh transformed(const Mesh& mesh, const glm::mat4& m) {
    Mesh out = mesh;
    const glm::mat3 linear(m);
    for (glm::vec3& p : out.positions) p = glm::vec3(m * glm::vec4(p, 1));
    const float determinant = glm::determinant(linear);
    const glm::mat3 normals = determinant == 0 ? glm::mat3(1) : glm::transpose(glm::inverse(linear));
    for (glm::vec3& n : out.normals) {
        const glm::vec3 turned = normals * n;
        n = glm::length(turned) > 0 ? glm::normalize(turned) : glm::vec3(0, 1, 0);
    }
    if (determinant < 0)
        for (std::size_t i = 0; i + 2 < out.indices.size(); i += 3)
            std::swap(out.indices[i + 1], out.indices[i + 2]);
    return out;
}

bool isCube(const Mesh& mesh) {
    static const Mesh kCube = thesisCube();
    return mesh.positions == kCube.positions && mesh.indices == kCube.indices &&
           mesh.normals == kCube.normals;
}

class Writer {
  public:
    Writer(const fs::path& path, const Scene& scene) : path_(path), scene_(scene) {
        folder_ = wordOf(path.stem().string(), "scene") + "_meshes";
    }

    std::vector<std::string> write(bool force);

  private:
    void line(int depth, const std::string& text) { text_ += std::string(4 * depth, ' ') + text + "\n"; }
    void value(int depth, const char* key, const std::string& v) {
        line(depth, std::string(key) + " = " + v);
    }
    // One word that the reader gives back as it is.
    std::string wordOf(const std::string& name, const std::string& otherwise);
    std::string fileOf(const Mesh& mesh, const std::string& name);
    std::string fileOf(const std::shared_ptr<const LightProfile>& profile);
    void model(const Instance& instance);
    void material(const Material& material);
    void light(const Light& light);
    void camera(const Camera& camera);
    void settings();

    fs::path path_;
    const Scene& scene_;
    std::string folder_, text_;
    std::vector<std::pair<std::string, std::string>> files_;  // name, content
    std::set<std::string> fileNames_;
    std::map<int, std::string> meshFiles_;
    std::map<std::shared_ptr<const LightProfile>, std::string> profileFiles_;
    std::set<std::string> noted_;
    std::vector<std::string> notes_;
};

std::string Writer::wordOf(const std::string& name, const std::string& otherwise) {
    std::string word;
    for (const char c : name) {
        const bool plain = static_cast<unsigned char>(c) > ' ' && c != '=' && c != '{' && c != '}' &&
                           c != ',' && c != ';' && c != '#' && c != 127;
        word += plain ? c : '_';
    }
    if (word.empty()) word = otherwise;
    if (word.rfind("//", 0) == 0) word[0] = '_';
    if (word != name && !name.empty() && noted_.insert(name).second)
        notes_.push_back(fmt::format("the name '{}' is written as {}", oneLine(name, 60), word));
    return word;
}

std::string Writer::fileOf(const Mesh& mesh, const std::string& name) {
    std::string base = wordOf(mesh.name, name);
    for (char& c : base)
        if (c == '/' || c == '\\' || c == ':') c = '_';
    if (base.size() > 80) base.resize(80);
    std::string file = base + ".obj";
    for (int i = 2; !fileNames_.insert(file).second; ++i) file = fmt::format("{}_{}.obj", base, i);
    if (!mesh.colors.empty())
        notes_.push_back(fmt::format("mesh {}: vertex colours are left out", oneLine(mesh.name, 60)));
    files_.emplace_back(file, objOf(mesh));
    return folder_ + "/" + file;
}

// As it was read, beside the meshes.
std::string Writer::fileOf(const std::shared_ptr<const LightProfile>& profile) {
    std::string& file = profileFiles_[profile];
    if (!file.empty()) return file;
    file = fmt::format("profile{}.ies", profileFiles_.size());
    fileNames_.insert(file);
    files_.emplace_back(file, profile->text);
    return file = folder_ + "/" + file;
}

void Writer::model(const Instance& instance) {
    if (instance.mesh < 0) return;
    const Mesh& mesh = scene_.meshes[static_cast<std::size_t>(instance.mesh)];
    std::optional<Placement> placement = placementOf(instance.worldFromObject);
    line(1, "model = {");
    value(2, "name", wordOf(instance.name, "UnnamedModel"));
    if (!placement) {
        value(2, "path", fileOf(transformed(mesh, instance.worldFromObject), "mesh"));
        placement = Placement{glm::vec3(0), glm::vec3(0), glm::vec3(1)};
    } else if (isCube(mesh)) {
        value(2, "primitive", "cube");
    } else {
        std::string& file = meshFiles_[instance.mesh];
        if (file.empty()) file = fileOf(mesh, fmt::format("mesh{}", instance.mesh));
        value(2, "path", file);
    }
    if (!instance.visible) value(2, "active", "false");
    if (!instance.voxelized) value(2, "static", "true");
    if (instance.castsShadow != instance.voxelized)
        value(2, "casts_shadow", instance.castsShadow ? "true" : "false");
    if (instance.dynamic) value(2, "dynamic", "true");
    value(2, "position", triple(placement->position, "xyz"));
    if (placement->rotationDeg != glm::vec3(0)) value(2, "rotation", triple(placement->rotationDeg, "xyz"));
    const glm::vec3& s = placement->scale;
    if (s != glm::vec3(1))
        line(2, fmt::format("scale_x = {} scale_y = {} scale_z = {}", number(s.x), number(s.y), number(s.z)));
    material(instance.material < 0 ? Material{}
                                   : scene_.materials[static_cast<std::size_t>(instance.material)]);
    line(1, "}");
}

void Writer::material(const Material& m) {
    const bool textured = m.baseColorTexture.used() || m.metallicRoughnessTexture.used() ||
                          m.normalTexture.used() || m.emissiveTexture.used() || m.specularTexture.used() ||
                          m.specularColorTexture.used();
    if (textured && noted_.insert("textures of " + m.name).second)
        notes_.push_back(fmt::format("material {}: textures are left out", oneLine(m.name, 60)));
    if (m.alphaMode != AlphaMode::Opaque && noted_.insert("alpha of " + m.name).second)
        notes_.push_back(fmt::format("material {}: opacity is left out", oneLine(m.name, 60)));
    if (isTransmissive(m) && noted_.insert("glass of " + m.name).second)
        notes_.push_back(fmt::format("material {}: transmission is left out", oneLine(m.name, 60)));
    if (hasLayers(m) && noted_.insert("layers of " + m.name).second)
        notes_.push_back(fmt::format("material {}: coat and sheen are left out", oneLine(m.name, 60)));

    PhongMaterial phong = phongOf(m);
    if (m.unlit) {
        phong.color = glm::vec3(m.baseColor);
        value(2, "shader", "EMIT");
    }
    line(2, "material = {");
    value(3, "color", triple(phong.color, "rgb"));
    line(3, fmt::format("shininess = {} ambient_str = {} diffuse_str = {} specular_str = {}",
                        number(phong.shininess), number(phong.ambientStrength), number(phong.diffuseStrength),
                        number(phong.specularStrength)));
    // What the reader would derive from these need not be said.
    Material derived;
    setPbrFromPhong(derived, phong);
    if (m.roughness != derived.roughness) value(3, "roughness", number(m.roughness));
    if (m.metallic != derived.metallic) value(3, "metallic", number(m.metallic));
    if (m.ior != derived.ior) value(3, "ior", number(m.ior));
    if (m.specular != derived.specular) value(3, "specular", number(m.specular));
    if (m.specularColor != derived.specularColor) value(3, "specular_color", triple(m.specularColor, "rgb"));
    if (!m.unlit && glm::vec3(m.baseColor) != glm::vec3(derived.baseColor))
        value(3, "base_color", triple(glm::vec3(m.baseColor), "rgb"));
    if (m.emission != glm::vec3(0)) value(3, "emission", triple(m.emission, "rgb"));
    if (m.doubleSided) value(3, "double_sided", "true");
    line(2, "}");
}

void Writer::light(const Light& one) {
    static constexpr const char* kTypes[] = {"point", "spot", "directional", "rect", "disk", "sphere"};
    line(1, "light = {");
    value(2, "name", wordOf(one.name, "light"));
    value(2, "type", kTypes[static_cast<int>(one.type)]);
    value(2, "intensity", triple(one.intensity, "rgb"));
    if (one.type != LightType::Directional) value(2, "position", triple(one.position, "xyz"));
    if (hasDirection(one.type)) value(2, "direction", triple(one.direction, "xyz"));
    if (one.type == LightType::Spot)
        line(2,
             fmt::format("inner_angle = {} outer_angle = {}",
                         number(static_cast<float>(static_cast<double>(one.innerAngle) / kDegreeInRadians)),
                         number(static_cast<float>(static_cast<double>(one.outerAngle) / kDegreeInRadians))));
    if (one.profile != nullptr && !one.profile->text.empty() &&
        (one.type == LightType::Point || one.type == LightType::Spot)) {
        value(2, "ies", fileOf(one.profile));
        value(2, "up", triple(one.halfU, "xyz"));
        if (one.type == LightType::Point) value(2, "direction", triple(one.direction, "xyz"));
    }
    if (one.type == LightType::Sphere) value(2, "radius", number(glm::length(one.halfU)));
    if (one.type == LightType::Rect || one.type == LightType::Disk) {
        const float u = glm::length(one.halfU), v = glm::length(one.halfV);
        line(2, fmt::format("width = {} height = {}", number(2 * u), number(2 * v)));
        value(2, "up", triple(one.halfV / std::max(v, 1e-30f), "xyz"));
        if (std::abs(glm::dot(one.halfU, one.halfV)) > 1e-4f * u * v)
            notes_.push_back(
                fmt::format("light {}: a slanted area is written upright", oneLine(one.name, 60)));
    }
    if (one.customFalloff)
        line(2, fmt::format("att_constant = {} att_linear = {} att_quadratic = {}", number(one.falloff.x),
                            number(one.falloff.y), number(one.falloff.z)));
    if (one.range > 0) value(2, "range", number(one.range));
    if (!one.enabled) value(2, "active", "false");
    if (!one.castsShadow) value(2, "casts_shadow", "false");
    line(1, "}");
}

void Writer::camera(const Camera& one) {
    float fovY = one.fovY;
    if (one.isOrthographic()) {
        notes_.push_back(
            "camera " + wordOf(one.name, "camera") +
            ": its rays are parallel, which the format has no word for; written in perspective, the "
            "target as large");
        fovY = 2 * std::atan(0.5f * one.orthographicHeight / glm::distance(one.eye, one.target));
    }
    line(1, "camera = {");
    value(2, "name", wordOf(one.name, "camera"));
    value(2, "position", triple(one.eye, "xyz"));
    value(2, "target", triple(one.target, "xyz"));
    value(2, "up", triple(one.up, "xyz"));
    line(2, fmt::format("fov = {} near = {} far = {}",
                        number(static_cast<float>(static_cast<double>(fovY) / kDegreeInRadians)),
                        number(one.zNear), number(one.zFar)));
    line(1, "}");
}

void Writer::settings() {
    auto all = scene_.settings;
    // Scenes of other formats start otherwise than the thesis's do: say what theirs would be.
    if (scene_.format != kSceneFormat) {
        for (const auto& [key, start] : {std::pair<const char*, const char*>{"image.exposure", "0"},
                                         {"image.tone_map", "aces"},
                                         {"image.srgb", "true"},
                                         {"phong.shadows", "on"}}) {
            const bool said =
                std::any_of(all.begin(), all.end(), [k = key](const auto& one) { return one.first == k; });
            if (!said) all.emplace_back(key, start);
        }
    }
    if (all.empty()) return;
    line(1, "settings = {");
    for (const auto& [key, v] : all) value(2, key.c_str(), v);
    line(1, "}");
}

std::vector<std::string> Writer::write(bool force) {
    line(0, "# written by Conelight; format: docs/reference/thesis_format.md");
    line(0, "scene = {");
    value(1, "name", wordOf(scene_.name, "unnamedScene"));
    if (scene_.sky != glm::vec3(0)) value(1, "sky", triple(scene_.sky, "rgb"));
    if (scene_.environment.image != nullptr)
        notes_.push_back("the environment is left out: the format has a constant sky alone; .glb keeps it");
    if (!scene_.groups.empty())
        notes_.push_back("groups of objects are left out: the format has a list alone; .glb keeps them");
    for (const Camera& one : scene_.cameras) camera(one);
    for (const Light& one : scene_.lights) light(one);
    for (const Instance& one : scene_.instances) model(one);
    settings();
    line(0, "}");
    if (scene_.cameras.empty())
        notes_.push_back("no camera: a reader takes the three of the thesis's program");

    const fs::path folder = path_.has_parent_path() ? path_.parent_path() / folder_ : fs::path(folder_);
    std::vector<std::pair<fs::path, Bytes>> all;
    for (const auto& [name, content] : files_) {
        refuseOverwriting((folder / name).string(), force);
        all.emplace_back(folder / name, Bytes(content.begin(), content.end()));
    }
    all.emplace_back(path_, Bytes(text_.begin(), text_.end()));
    std::error_code code;
    const bool makes = !files_.empty() && !fs::is_directory(folder, code);
    if (makes) {
        fs::create_directory(folder, code);
        if (code)
            throw Error(ErrorKind::Runtime,
                        fmt::format("{}: cannot be made: {}", oneLine(folder.string()), code.message()));
    }
    try {
        writeFiles(all);
    } catch (const Error&) {
        if (makes) fs::remove(folder, code);
        throw;
    }
    return std::move(notes_);
}

}  // namespace

std::vector<std::string> writeThesisScene(const std::string& path, const Scene& scene, bool force) {
    return Writer(path, scene).write(force);
}

}  // namespace conelight::thesis

// SPDX-License-Identifier: MIT
// The thesis's scene text format -> Scene (input: file; output: tables with Scene::format = "thesis").
//
// What its words become: active = false -> Instance::visible false. static = true -> voxelized and
// castsShadow false (it is drawn, but lights pass through it). shader: COLOR -> lit; EMIT -> Material::unlit,
// the flat colour in every mode; EMITRGBA draws nothing in the original (its colour is never set) ->
// invisible, noted; VOX and unknown words -> COLOR, noted. A light's intensity is pi * color, so that rho/pi
// * I * cos / att is the original's kd * color * cos / att; its falloff is the original's. material ->
// PhongMaterial, plus the metallic-roughness values closest to it. First of doubled keys wins. Meshes: the
// first of a file, node transforms ignored, as the original does; missing normals are made. Additions: see
// docs/reference/thesis_format.md.
#include "thesis/format/scene.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <map>

#include "conelight/error.h"
#include "conelight/thesis/thesis.h"
#include "io/assimp_import.h"
#include "io/files.h"
#include "io/geometry.h"
#include "io/light_profile_file.h"
#include "io/scene_folder.h"
#include "thesis/format/syntax.h"
#include "thesis/format/values.h"

namespace conelight::thesis {

using io::Bytes;
using io::loadFirstMesh;
using io::LoadOptions;
using io::oneLine;
using io::readFile;
using io::removeMirrors;
using io::SceneFolder;

namespace fs = std::filesystem;

namespace {

constexpr float kDegree = glm::pi<float>() / 180.0f;

// Reads one file.
class Loader : BlockValues {
  public:
    Loader(const fs::path& path, const LoadOptions& options)
        : BlockValues(oneLine(path.string()), scene_.notes),
          path_(path),
          options_(options),
          folder_(path, options.allowOutside) {
        // Where the format looks for meshes (locate).
        folder_.alsoBelow(".");
        folder_.alsoBelow(folder_.path() / "..");
    }

    Scene load();

  private:
    void readScene(const Item& scene);
    void readModel(const Item& model);
    void readMaterial(const Item& model, Material& material);
    LightType lightType(const Item& light);
    void readIntensity(const Item& block, Light& light);
    void readRectangle(const Item& block, Light& light);
    void readProfile(const Item& block, Light& light);
    void readLight(const Item& light);
    void readCamera(const Item& camera);
    void readSettings(const Item& settings, const std::string& prefix);
    int meshOf(const Item& model, const std::string& name);
    SceneFolder::Choice locate(const std::string& path) const;

    fs::path path_;
    LoadOptions options_;
    SceneFolder folder_;
    Scene scene_;
    std::map<std::string, int> meshes_;  // by resolved path, "cube" for the primitive
};

SceneFolder::Choice Loader::locate(const std::string& given) const {
    std::string slashed = given;
    std::replace(slashed.begin(), slashed.end(), '\\', '/');
    const fs::path relative(slashed);
    // As given from the working folder (the original's rule), beside the scene file, then in its parent
    // folder.
    return folder_.firstOf({relative, folder_.path() / relative, folder_.path() / ".." / relative});
}

int Loader::meshOf(const Item& model, const std::string& name) {
    if (const std::string* path = word(model, "path")) {
        const SceneFolder::Choice choice = locate(*path);
        if (choice.file.empty()) {
            note(model.line,
                 fmt::format("model {}: {}: {}; model skipped", name, oneLine(*path), choice.refusal));
            return -1;
        }
        const fs::path found = choice.file.lexically_normal();
        const auto known = meshes_.find(found.string());
        if (known != meshes_.end()) return known->second;
        options_.tell({"meshes"});
        try {
            Mesh mesh = loadFirstMesh(found, options_);
            mesh.name = found.stem().string();
            scene_.meshes.push_back(std::move(mesh));
            return meshes_[found.string()] = int(scene_.meshes.size()) - 1;
        } catch (const io::LoadStopped&) {
            throw;
        } catch (const Error& error) {
            note(model.line, fmt::format("model {}: {}; model skipped", name, error.what()));
            return -1;
        }
    }
    if (const std::string* primitive = word(model, "primitive")) {
        if (*primitive != "cube") {
            note(model.line, fmt::format("model {}: primitive '{}' is unknown (known: cube); model skipped",
                                         name, oneLine(*primitive)));
            return -1;
        }
        const auto known = meshes_.find("cube");
        if (known != meshes_.end()) return known->second;
        scene_.meshes.push_back(thesisCube());
        return meshes_["cube"] = int(scene_.meshes.size()) - 1;
    }
    note(model.line, fmt::format("model {}: has neither path nor primitive; model skipped", name));
    return -1;
}

void Loader::readMaterial(const Item& model, Material& material) {
    static const Item kEmpty;
    const Item* found = first(model, "material");
    const Item& block = found != nullptr ? *found : kEmpty;
    if (found != nullptr && !found->isBlock) fail(found->line, "material: a block expected");
    checkKeys(block,
              {"color", "shininess", "ambient_str", "diffuse_str", "specular_str", "emission", "roughness",
               "metallic", "double_sided", "base_color", "ior", "specular", "specular_color"});

    PhongMaterial& phong = material.phong.emplace();
    phong.color = triple(block, "color", "rgb", phong.color);
    phong.shininess = number(block, "shininess", phong.shininess);
    phong.ambientStrength = number(block, "ambient_str", phong.ambientStrength);
    phong.diffuseStrength = number(block, "diffuse_str", phong.diffuseStrength);
    phong.specularStrength = number(block, "specular_str", phong.specularStrength);
    const bool negative = glm::any(glm::lessThan(phong.color, glm::vec3(0))) || phong.shininess < 0 ||
                          phong.ambientStrength < 0 || phong.diffuseStrength < 0 ||
                          phong.specularStrength < 0;
    if (negative) fail(block.line, "material: a negative value; all must be 0 or more");
    setPbrFromPhong(material, phong);

    // Additions for the physically based modes.
    material.emission = glm::max(triple(block, "emission", "rgb", glm::vec3(0)), glm::vec3(0));
    material.roughness = std::clamp(number(block, "roughness", material.roughness), 0.0f, 1.0f);
    material.metallic = std::clamp(number(block, "metallic", material.metallic), 0.0f, 1.0f);
    material.ior = number(block, "ior", material.ior);
    if (material.ior != 0 && material.ior < 1) fail(block.line, "material: ior must be 1 or more");
    material.specular = std::clamp(number(block, "specular", material.specular), 0.0f, 1.0f);
    material.specularColor =
        glm::max(triple(block, "specular_color", "rgb", material.specularColor), glm::vec3(0));
    const glm::vec3 base = triple(block, "base_color", "rgb", glm::vec3(material.baseColor));
    material.baseColor = glm::vec4(glm::clamp(base, 0.0f, 1.0f), material.baseColor.a);
    material.doubleSided = boolean(block, "double_sided", false);
}

void Loader::readModel(const Item& model) {
    checkKeys(model,
              {"name", "path", "primitive", "active", "static", "shader", "position", "rotation", "scale",
               "scale_x", "scale_y", "scale_z", "material", "dynamic", "casts_shadow", "model", "light"});
    const std::string* given = word(model, "name");
    const std::string name = given != nullptr ? oneLine(*given) : "UnnamedModel";

    Instance instance;
    instance.name = name;
    instance.visible = boolean(model, "active", true);
    const bool isStatic = boolean(model, "static", false);
    instance.voxelized = !isStatic;
    instance.castsShadow = boolean(model, "casts_shadow", !isStatic);
    instance.dynamic = boolean(model, "dynamic", false);

    // M = T Rx Ry Rz S(scale) S(scale_x, scale_y, scale_z): scaled, turned about z, y, x, then moved.
    const glm::vec3 position = triple(model, "position", "xyz", glm::vec3(0));
    const glm::vec3 rotation = triple(model, "rotation", "xyz", glm::vec3(0)) * kDegree;
    const glm::vec3 scale = number(model, "scale", 1.0f) * glm::vec3(number(model, "scale_x", 1.0f),
                                                                     number(model, "scale_y", 1.0f),
                                                                     number(model, "scale_z", 1.0f));
    glm::mat4 m = glm::translate(glm::mat4(1.0f), position);
    m = glm::rotate(m, rotation.x, glm::vec3(1, 0, 0));
    m = glm::rotate(m, rotation.y, glm::vec3(0, 1, 0));
    m = glm::rotate(m, rotation.z, glm::vec3(0, 0, 1));
    instance.worldFromObject = glm::scale(m, scale);

    Material material;
    material.name = name;
    readMaterial(model, material);
    const std::string* shaderWord = word(model, "shader");
    const std::string shader = shaderWord != nullptr ? *shaderWord : "COLOR";
    if (shader == "EMIT") {
        material.unlit = true;
        material.baseColor = glm::vec4(material.phong->color, 1.0f);
    } else if (shader == "EMITRGBA") {
        instance.visible = false;
        note(model.line,
             fmt::format("model {}: shader EMITRGBA draws nothing (its colour cannot be set); use EMIT",
                         name));
    } else if (shader != "COLOR") {
        note(model.line, fmt::format("model {}: shader '{}' drawn as COLOR", name, oneLine(shader)));
    }

    instance.mesh = meshOf(model, name);
    if (instance.mesh < 0) return;
    instance.material = int(scene_.materials.size());
    scene_.materials.push_back(std::move(material));
    scene_.instances.push_back(std::move(instance));
}

LightType Loader::lightType(const Item& block) {
    const std::string* type = word(block, "type");
    if (type == nullptr || *type == "point") return LightType::Point;
    if (*type == "spot") return LightType::Spot;
    if (*type == "directional") return LightType::Directional;
    if (*type == "rect") return LightType::Rect;
    if (*type == "disk") return LightType::Disk;
    if (*type == "sphere") return LightType::Sphere;
    fail(first(block, "type")->line,
         fmt::format("light type '{}' is unknown; known: point, spot, directional, rect, disk, sphere",
                     oneLine(*type)));
}

// Intensity and falloff, once the type is known.
void Loader::readIntensity(const Item& block, Light& light) {
    // `color`: shows kd * color on a facing surface at attenuation 1. `intensity`: radiometric, in the unit
    // of the type; then the falloff is the inverse square unless an attenuation is given.
    const glm::vec3 color = triple(block, "color", "rgb", glm::vec3(1));
    const bool physical = first(block, "intensity") != nullptr;
    light.intensity = physical ? triple(block, "intensity", "rgb", glm::vec3(0))
                               : color * (hasArea(light.type) ? 1.0f : glm::pi<float>());
    if (glm::any(glm::lessThan(light.intensity, glm::vec3(0))))
        fail(block.line, "light: a negative colour; all must be 0 or more");
    const bool hasFalloff =
        first(block, "att_constant") || first(block, "att_linear") || first(block, "att_quadratic");
    const bool falls = light.type == LightType::Point || light.type == LightType::Spot;
    light.customFalloff = falls && (hasFalloff || !physical);
    light.falloff = {number(block, "att_constant", 1.0f), number(block, "att_linear", 0.15f),
                     number(block, "att_quadratic", 0.45f)};
    if (light.customFalloff &&
        (glm::any(glm::lessThan(light.falloff, glm::vec3(0))) || light.falloff == glm::vec3(0)))
        fail(block.line, "light: attenuation must be 0 or more, and not 0 in all three");
}

void Loader::readRectangle(const Item& block, Light& light) {
    // Height runs along `up`, else the world's, as far as the direction allows; width at right angles to
    // both.
    const bool upright = std::abs(light.direction.y) <= 0.999f;
    const glm::vec3 up = triple(block, "up", "xyz", upright ? glm::vec3(0, 1, 0) : glm::vec3(0, 0, -1));
    if (!(glm::length(glm::cross(up, light.direction)) > 0))
        fail(block.line, "light: up and direction are parallel");
    const glm::vec3 u = glm::normalize(glm::cross(up, light.direction));
    const glm::vec3 v = glm::cross(light.direction, u);
    light.halfU = 0.5f * std::max(number(block, "width", 1.0f), 0.0f) * u;
    light.halfV = 0.5f * std::max(number(block, "height", 1.0f), 0.0f) * v;
    if (light.halfU == glm::vec3(0) || light.halfV == glm::vec3(0))
        fail(block.line, "light: width and height must be above 0");
}

// The file's own strength, unless another is given.
void Loader::readProfile(const Item& block, Light& light) {
    const std::string* path = word(block, "ies");
    if (path == nullptr) return;
    if (light.type != LightType::Point && light.type != LightType::Spot)
        fail(block.line, "light: ies: point and spot lights have profiles");
    const SceneFolder::Choice choice = locate(*path);
    if (choice.file.empty())
        fail(block.line, fmt::format("light: ies: {}: {}", oneLine(*path), choice.refusal));
    const glm::vec3 given = light.intensity;
    io::setLightProfile(light, io::readLightProfile(choice.file.lexically_normal().string()));
    if (first(block, "intensity") != nullptr) light.intensity = given;
    light.halfU = triple(block, "up", "xyz", light.halfU);
}

void Loader::readLight(const Item& block) {
    checkKeys(block, {"name", "type", "position", "color", "att_constant", "att_linear", "att_quadratic",
                      "intensity", "direction", "inner_angle", "outer_angle", "width", "height", "radius",
                      "ies", "range", "active", "casts_shadow", "up"});
    Light light;
    const std::string* name = word(block, "name");
    light.name = name != nullptr ? oneLine(*name) : fmt::format("light{}", scene_.lights.size());
    light.type = lightType(block);
    light.position = triple(block, "position", "xyz", glm::vec3(0));
    const glm::vec3 direction = triple(block, "direction", "xyz", glm::vec3(0, -1, 0));
    if (!(glm::length(direction) > 0.0f)) fail(block.line, "light: direction has no length");
    light.direction = glm::normalize(direction);

    readIntensity(block, light);
    readProfile(block, light);
    light.outerAngle = std::clamp(number(block, "outer_angle", 45.0f), 0.1f, 90.0f) * kDegree;
    light.innerAngle =
        std::clamp(number(block, "inner_angle", 0.0f) * kDegree, 0.0f, 0.999f * light.outerAngle);
    light.range = std::max(number(block, "range", 0.0f), 0.0f);
    light.enabled = boolean(block, "active", true);
    light.castsShadow = boolean(block, "casts_shadow", true);
    if (light.type == LightType::Rect || light.type == LightType::Disk) readRectangle(block, light);
    if (light.type == LightType::Sphere) {
        light.halfU = {number(block, "radius", 0.5f), 0, 0};
        if (!(light.halfU.x > 0)) fail(block.line, "light: radius must be above 0");
    }
    scene_.lights.push_back(std::move(light));
}

void Loader::readCamera(const Item& block) {
    checkKeys(block, {"name", "position", "target", "yaw", "pitch", "up", "fov", "near", "far"});
    const std::string* name = word(block, "name");
    const glm::vec3 eye = triple(block, "position", "xyz", glm::vec3(0, 0, 3));
    Camera camera =
        thesisCamera(name != nullptr ? oneLine(*name) : fmt::format("camera{}", scene_.cameras.size()), eye,
                     number(block, "yaw", -90.0f), number(block, "pitch", 0.0f));
    camera.target = triple(block, "target", "xyz", camera.target);
    camera.up = triple(block, "up", "xyz", camera.up);
    if (!(glm::length(glm::cross(camera.target - camera.eye, camera.up)) > 0.0f))
        fail(block.line, "camera: looks along its up vector or nowhere; give another target or up");
    camera.up = glm::normalize(camera.up);
    const float fov = number(block, "fov", 45.0f);
    if (!(fov > 0.0f && fov < 180.0f)) fail(block.line, "camera: fov must be between 0 and 180 degrees");
    camera.fovY = fov * kDegree;
    camera.zNear = number(block, "near", camera.zNear);
    camera.zFar = number(block, "far", camera.zFar);
    if (!(camera.zNear > 0.0f && camera.zFar > camera.zNear))
        fail(block.line, "camera: 0 < near < far is needed");
    scene_.cameras.push_back(std::move(camera));
}

// Nested blocks join their keys by dots: thesis = { defects = { rings = true } } is thesis.defects.rings.
void Loader::readSettings(const Item& settings, const std::string& prefix) {
    for (const Item& item : settings.children) {
        const std::string key = prefix + oneLine(item.key);
        if (item.isBlock)
            readSettings(item, key + ".");
        else
            scene_.settings.emplace_back(key, oneLine(item.word));
    }
}

void Loader::readScene(const Item& block) {
    checkKeys(block, {"name", "model", "light", "camera", "sky", "settings"});
    const std::string* name = word(block, "name");
    scene_.name = name != nullptr ? oneLine(*name) : "unnamedScene";
    scene_.sky = glm::max(triple(block, "sky", "rgb", glm::vec3(0)), glm::vec3(0));
    for (const Item& item : block.children) {
        if (item.key == "model" || item.key == "light" || item.key == "camera" || item.key == "settings") {
            if (!item.isBlock) fail(item.line, fmt::format("{}: a block expected", item.key));
            if (item.key == "model") readModel(item);
            if (item.key == "light") readLight(item);
            if (item.key == "camera") readCamera(item);
            if (item.key == "settings") readSettings(item, "");
        }
    }
}

Scene Loader::load() {
    const Bytes bytes =
        readFile(path_, std::uint64_t(64) << 20);  // 64 MB of text: a thousand times any scene
    ThesisText text = parseThesisText({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, file());
    scene_.format = kSceneFormat;
    scene_.name = "unnamedScene";
    scene_.notes = std::move(text.notes);

    // Only the first item counts, whatever it is: a scene, or a bare model, light or camera.
    const auto usable = [](const Item& item) {
        return item.isBlock &&
               (item.key == "scene" || item.key == "model" || item.key == "light" || item.key == "camera");
    };
    const auto root = std::find_if(text.items.begin(), text.items.end(), usable);
    if (text.blank) {
        throw Error(ErrorKind::BadInput, file() + ": is empty; 'scene = { ... }' would be right");
    } else if (root == text.items.end()) {
        throw Error(
            ErrorKind::BadInput,
            fmt::format("{}: holds no 'scene = {{ ... }}'; not a scene of the thesis's format", file()));
    } else {
        if (text.items.size() > 1)
            note(text.items[1].line, "more than one item at the top level; only the first is used");
        if (root->key == "scene") {
            readScene(*root);
        } else {
            Item wrapped;
            wrapped.line = root->line;
            wrapped.children.push_back(*root);
            readScene(wrapped);
        }
    }
    if (scene_.cameras.empty()) {
        scene_.cameras.push_back(thesisCamera("start", {0, 0, 3}, -90, 0));
        scene_.cameras.push_back(thesisCamera("pos1", {1.26f, 0.10f, 1.73f}, -126, -4));
        scene_.cameras.push_back(thesisCamera("pos2", {0, 0, 1.8f}, -90, 0));
    }
    removeMirrors(scene_);
    return std::move(scene_);
}

}  // namespace

Camera thesisCamera(const std::string& name, const glm::vec3& eye, float yawDeg, float pitchDeg) {
    const float yaw = yawDeg * kDegree, pitch = pitchDeg * kDegree;
    Camera camera;
    camera.name = name;
    camera.eye = eye;
    camera.target =
        eye + glm::vec3(std::cos(yaw) * std::cos(pitch), std::sin(pitch), std::sin(yaw) * std::cos(pitch));
    camera.fovY = 45.0f * kDegree;
    camera.zNear = 0.1f;
    camera.zFar = 100.0f;
    return camera;
}

Mesh thesisCube() {
    Mesh cube;
    cube.name = "cube";
    for (int i = 0; i < 8; ++i) {
        const glm::vec3 corner((i & 1) != 0 ? 0.5f : -0.5f, (i & 2) != 0 ? 0.5f : -0.5f,
                               (i & 4) != 0 ? 0.5f : -0.5f);
        cube.positions.push_back(corner);
        cube.normals.push_back(glm::normalize(corner));
    }
    // Two triangles per face, counter-clockwise from outside: -x +x -y +y -z +z.
    cube.indices = {0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4,
                    2, 6, 7, 2, 7, 3, 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6};
    return cube;
}

Scene loadThesisScene(const fs::path& path, const LoadOptions& options) {
    return Loader(path, options).load();
}

}  // namespace conelight::thesis

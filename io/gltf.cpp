// SPDX-License-Identifier: MIT
// glTF 2.0 -> Scene: extensions, node graph, instances, lights, cameras, skins. Parts: gltf_file (container
// and accessors), gltf_material, gltf_mesh.
#include "io/gltf.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <glm/gtc/quaternion.hpp>
#include <map>
#include <set>

#include "conelight/error.h"
#include "io/geometry.h"
#include "io/gltf_animation.h"
#include "io/gltf_draco.h"
#include "io/gltf_environment.h"
#include "io/gltf_extensions.h"
#include "io/gltf_file.h"
#include "io/gltf_material.h"
#include "io/gltf_mesh.h"
#include "io/gltf_profile.h"
#include "io/groups.h"
#include "io/scene_info.h"
#include "io/starting_settings.h"

namespace conelight::io {

namespace {

constexpr std::size_t kMaxInstances = 10'000'000;  // 1 GB of table; more is a broken file

class Reader {
  public:
    Reader(const std::filesystem::path& path, const LoadOptions& options)
        : options_(options), file_(path, options.allowOutside) {}
    Scene read(SceneAnimation* animation);  // null: movement is left out

  private:
    void checkExtensions();
    void keepHung(const std::vector<KeptInstance>& kept);
    void mirrorMoving(std::size_t mesh, std::size_t copy);
    void findWorldTransforms();
    std::vector<std::size_t> nodesOfScene();
    void placeMesh(std::size_t node, const GltfValue& value, GltfMeshes& meshes);
    std::vector<glm::mat4> instanceTransforms(const GltfValue& node);
    void findMovingWeights();
    void poseAtRest();
    void addLight(std::size_t node, const GltfValue& value);
    void addCamera(std::size_t node, const GltfValue& value);
    void addGroups();
    std::string nameOf(std::size_t node) const {
        return oneLine(file_.array("nodes")[node]["name"].text(fmt::format("node{}", node)));
    }

    void readOwnExtras(const GltfValue& scene);
    void readFlags(std::size_t node, const GltfValue& value, Instance& instance) const;
    void addAreaLight(std::size_t node, const GltfValue& own);

    const LoadOptions& options_;
    GltfFile file_;
    Scene scene_;
    std::vector<glm::mat4> worldFromNode_;
    std::vector<std::uint8_t> hidden_;  // by KHR_node_visibility, of the node or of one above it
    GltfProfiles profiles_;
    SceneAnimation animation_;
    std::set<std::size_t> movingWeights_;
    std::vector<int> nodesOfInstances_, nodesOfLights_;
    std::size_t skinned_ = 0;
};

void Reader::checkExtensions() {
    const GltfValue required = file_.array("extensionsRequired");
    for (std::size_t i = 0; i < required.size(); ++i) {
        const std::string name = required[i].text("");
        if (supportOf(name) == GltfSupport::None)
            required[i].fail(
                fmt::format("the file needs {}, which is not supported; export it without", oneLine(name)));
    }
    const GltfValue used = file_.array("extensionsUsed");
    for (std::size_t i = 0; i < used.size(); ++i) {
        const std::string name = used[i].text("");
        if (supportOf(name) == GltfSupport::None || supportOf(name) == GltfSupport::Fallback)
            scene_.notes.push_back(fmt::format("extension {} is not supported and left out", oneLine(name)));
    }
}

// World transforms of all nodes, parents first, with an own stack. Every node must have one parent at most,
// and all must hang on roots: a second parent or a cycle is an error.
void Reader::findWorldTransforms() {
    const GltfValue nodes = file_.array("nodes");
    const std::size_t count = nodes.size();
    std::vector<std::uint8_t> hasParent(count, 0);
    for (std::size_t n = 0; n < count; ++n) {
        const GltfValue children = nodes[n]["children"];
        for (std::size_t c = 0; c < children.size(); ++c) {
            const std::size_t child = children[c].index(count).value();
            if (hasParent[child] != 0)
                children[c].fail(fmt::format("node {} has two parents; nodes must form trees", child));
            hasParent[child] = 1;
        }
    }
    worldFromNode_.assign(count, glm::mat4(1.0f));
    hidden_.assign(count, 0);
    const auto isHidden = [&](std::size_t n) {
        return !nodes[n].extension("KHR_node_visibility")["visible"].boolean(true);
    };
    animation_.nodes.resize(count);
    const auto poseOf = [&](std::size_t n) {
        animation_.nodes[n].rest = readNodePose(nodes[n]);
        return animation_.nodes[n].rest.parentFromNode();
    };
    std::size_t reached = 0;
    std::vector<std::size_t> stack;
    for (std::size_t n = 0; n < count; ++n) {
        if (hasParent[n] != 0) continue;
        worldFromNode_[n] = poseOf(n);
        hidden_[n] = isHidden(n);
        stack.push_back(n);
        while (!stack.empty()) {
            const std::size_t node = stack.back();
            stack.pop_back();
            ++reached;
            animation_.parentsFirst.push_back(node);
            const GltfValue children = nodes[node]["children"];
            for (std::size_t c = 0; c < children.size(); ++c) {
                const std::size_t child = children[c].index(count).value();
                animation_.nodes[child].parent = int(node);
                worldFromNode_[child] = worldFromNode_[node] * poseOf(child);
                hidden_[child] = hidden_[node] != 0 || isHidden(child);
                stack.push_back(child);
            }
        }
    }
    if (reached != count) nodes.fail("contain a cycle; nodes must form trees");
}

// What io/gltf_write.cpp keeps of a value; absent in other programs' files, whose extras may be anything.
GltfValue ownExtras(const GltfValue& value) {
    const GltfValue absent = value["(none)"];
    if (!value.isObject() || !value["extras"].isObject()) return absent;
    const GltfValue own = value["extras"]["conelight"];
    return own.isObject() ? own : absent;
}

void Reader::readOwnExtras(const GltfValue& scene) {
    const GltfValue own = ownExtras(scene);
    scene_.format = oneLine(own["format"].text(own["thesisFormat"].boolean(false) ? "thesis" : ""));
    readImageBasedLight(file_, scene, scene_.environment, scene_.notes);
    readOwnEnvironment(file_, own["environment"], scene_.environment);
    const GltfValue settings = own["settings"];
    for (std::size_t i = 0; i < settings.size(); ++i)
        scene_.settings.emplace_back(settings[i][std::size_t(0)].text(""),
                                     settings[i][std::size_t(1)].text(""));
}

void Reader::readFlags(std::size_t node, const GltfValue& value, Instance& instance) const {
    const GltfValue own = ownExtras(value);
    instance.visible = own["visible"].boolean(true) && hidden_[node] == 0;
    instance.voxelized = own["voxelized"].boolean(true);
    instance.castsShadow = own["castsShadow"].boolean(true);
    instance.dynamic = own["dynamic"].boolean(false);
}

// An area light has no place in KHR_lights_punctual; it stands whole in the extras of its node.
void Reader::addAreaLight(std::size_t node, const GltfValue& own) {
    constexpr LightType kTypes[] = {LightType::Rect, LightType::Disk, LightType::Sphere};
    const std::string type = own["type"].text("");
    const auto* const found = std::find_if(std::begin(kTypes), std::end(kTypes),
                                           [&](LightType one) { return type == lightTypeName(one); });
    if (found == std::end(kTypes)) return;
    Light to;
    to.name = nameOf(node);
    to.type = *found;
    to.intensity = glm::max(own["radiance"].vector<3>(glm::vec3(1)), glm::vec3(0));
    to.position = glm::vec3(worldFromNode_[node][3]);
    to.direction = own["direction"].vector<3>(to.direction);
    to.halfU = own["halfU"].vector<3>(to.halfU);
    to.halfV = own["halfV"].vector<3>(to.halfV);
    to.enabled = own["enabled"].boolean(true);
    to.castsShadow = own["castsShadow"].boolean(true);
    scene_.lights.push_back(std::move(to));
}

// Nodes below the default scene (all nodes when the file has no scenes), in the file's order of walking.
std::vector<std::size_t> Reader::nodesOfScene() {
    const GltfValue nodes = file_.array("nodes"), scenes = file_.array("scenes");
    const std::size_t count = nodes.size();
    std::vector<std::size_t> order;
    if (scenes.size() == 0) {
        for (std::size_t n = 0; n < count; ++n) order.push_back(n);
        return order;
    }
    const GltfValue chosen = scenes[file_.root()["scene"].index(scenes.size()).value_or(0)];
    scene_.name = oneLine(chosen["name"].text(""));
    scene_.sky =
        glm::max(chosen["extras"].isObject() ? chosen["extras"]["sky"].vector<3>(glm::vec3(0)) : glm::vec3(0),
                 glm::vec3(0));
    readOwnExtras(chosen);
    if (scenes.size() > 1)
        scene_.notes.push_back(
            fmt::format("{} scenes in the file; {} is shown", scenes.size(), chosen.path()));
    std::vector<std::uint8_t> seen(count, 0);
    const GltfValue roots = chosen["nodes"];
    for (std::size_t r = 0; r < roots.size(); ++r) {
        std::vector<std::size_t> stack = {roots[r].index(count).value()};
        while (!stack.empty()) {
            const std::size_t node = stack.back();
            stack.pop_back();
            if (seen[node] != 0) continue;
            seen[node] = 1;
            order.push_back(node);
            const GltfValue children = nodes[node]["children"];
            for (std::size_t c = children.size(); c-- > 0;) stack.push_back(children[c].index(count).value());
        }
    }
    return order;
}

std::vector<glm::mat4> Reader::instanceTransforms(const GltfValue& node) {
    const GltfValue attributes = node.extension("EXT_mesh_gpu_instancing")["attributes"];
    if (!attributes.exists()) return {glm::mat4(1.0f)};
    std::size_t count = 0;
    for (const char* name : {"TRANSLATION", "ROTATION", "SCALE"})
        if (attributes[name].exists()) {
            const std::size_t here = file_.accessorCount(attributes[name]);
            if (count != 0 && here != count)
                attributes[name].fail("must have as many elements as the others");
            count = here;
        }
    if (count > kMaxInstances) attributes.fail("has too many instances");
    const auto read = [&](const char* name, std::size_t components) {
        return attributes[name].exists() ? file_.floats(attributes[name], components) : std::vector<float>();
    };
    const std::vector<float> t = read("TRANSLATION", 3), r = read("ROTATION", 4), s = read("SCALE", 3);
    std::vector<glm::mat4> out(count, glm::mat4(1.0f));
    for (std::size_t i = 0; i < count; ++i) {
        if (!r.empty()) {
            const glm::quat q(r[4 * i + 3], r[4 * i], r[4 * i + 1], r[4 * i + 2]);
            if (glm::length(q) > 0.0f) out[i] = glm::mat4_cast(glm::normalize(q));
        }
        if (!s.empty())
            for (int c = 0; c < 3; ++c) out[i][c] *= s[3 * i + std::size_t(c)];
        if (!t.empty()) out[i][3] = glm::vec4(t[3 * i], t[3 * i + 1], t[3 * i + 2], 1.0f);
    }
    return out;
}

// Nodes whose morph weights a clip moves.
void Reader::findMovingWeights() {
    for (const AnimationClip& clip : animation_.clips)
        for (const NodeTrack& track : clip.tracks)
            if (track.value == NodeValue::Weights) movingWeights_.insert(track.node);
}

// Moving meshes are read as they are without weights and joints.
void Reader::poseAtRest() {
    const NodePoses rest{worldFromNode_, std::vector<std::vector<float>>(worldFromNode_.size())};
    for (const DeformedMesh& moving : animation_.meshes) {
        Mesh& mesh = scene_.meshes[moving.mesh];
        deform(moving, rest, mesh);
        for (const glm::vec3& p : mesh.positions)
            if (!std::isfinite(p.x + p.y + p.z))
                file_.array("meshes").fail(mesh.name + ": positions leave the range of numbers");
    }
}

void Reader::placeMesh(std::size_t node, const GltfValue& value, GltfMeshes& meshes) {
    const std::optional<std::size_t> mesh = value["mesh"].index(file_.array("meshes").size());
    if (!mesh) return;
    std::vector<float> weights(value["weights"].size());
    for (std::size_t i = 0; i < weights.size(); ++i) weights[i] = value["weights"][i].number(0.0f);

    // A skinned mesh is placed by its joints alone.
    if (const auto skin = value["skin"].index(file_.array("skins").size())) {
        const GltfSkin joints = readSkin(file_, file_.array("skins")[*skin], worldFromNode_);
        ++skinned_;
        const std::size_t known = animation_.meshes.size();
        std::vector<DeformedMesh>* const moving = animation_.clips.empty() ? nullptr : &animation_.meshes;
        const std::vector<GltfPart> parts = meshes.parts(*mesh, weights, &joints, moving);
        for (std::size_t m = known; m < animation_.meshes.size(); ++m) animation_.meshes[m].node = node;
        for (const GltfPart& part : parts) {
            Instance instance;
            instance.name = nameOf(node);
            instance.mesh = part.mesh;
            instance.material = part.material;
            instance.visible = hidden_[node] == 0;
            scene_.instances.push_back(std::move(instance));
        }
        return;
    }
    const std::size_t known = animation_.meshes.size();
    const std::vector<GltfPart> parts =
        meshes.parts(*mesh, weights, nullptr, movingWeights_.count(node) > 0 ? &animation_.meshes : nullptr);
    for (std::size_t m = known; m < animation_.meshes.size(); ++m) animation_.meshes[m].node = node;
    const std::vector<glm::mat4> transforms = instanceTransforms(value);
    if (scene_.instances.size() + transforms.size() * parts.size() > kMaxInstances)
        value.fail("the file has too many instances");
    for (const glm::mat4& transform : transforms)
        for (const GltfPart& part : parts) {
            Instance instance;
            instance.name = nameOf(node);
            instance.mesh = part.mesh;
            instance.material = part.material;
            instance.worldFromObject = worldFromNode_[node] * transform;
            readFlags(node, value, instance);
            animation_.instances.push_back({scene_.instances.size(), node, transform});
            scene_.instances.push_back(std::move(instance));
        }
}

void Reader::addLight(std::size_t node, const GltfValue& value) {
    const GltfValue lights = file_.root().extension("KHR_lights_punctual")["lights"];
    const std::optional<std::size_t> at =
        value.extension("KHR_lights_punctual")["light"].index(lights.size());
    if (!at) {
        const GltfValue own = ownExtras(value)["light"];
        if (std::optional<Light> measured = profiles_.lightOf(file_, value, own)) {
            measured->name = nameOf(node);
            measured->enabled = measured->enabled && hidden_[node] == 0;
            placeLight(*measured, worldFromNode_[node]);
            animation_.lights.push_back({scene_.lights.size(), node});
            scene_.lights.push_back(std::move(*measured));
            return;
        }
        if (own.isObject()) addAreaLight(node, own);
        return;
    }
    const GltfValue from = lights[*at];
    Light to;
    to.name = oneLine(from["name"].text(nameOf(node)));
    const std::string type = from["type"].text("");
    if (type == "point")
        to.type = LightType::Point;
    else if (type == "spot")
        to.type = LightType::Spot;
    else if (type == "directional")
        to.type = LightType::Directional;
    else
        from["type"].fail(fmt::format("'{}' is unknown; known: point, spot, directional", oneLine(type)));
    to.intensity = from["color"].vector<3>(glm::vec3(1)) * from["intensity"].number(1.0f);
    if (glm::any(glm::lessThan(to.intensity, glm::vec3(0)))) from.fail("a negative intensity");
    placeLight(to, worldFromNode_[node]);
    animation_.lights.push_back({scene_.lights.size(), node});
    to.range = std::max(from["range"].number(0.0f), 0.0f);
    const GltfValue own = ownExtras(from);
    to.enabled = own["enabled"].boolean(true) && hidden_[node] == 0;
    to.castsShadow = own["castsShadow"].boolean(true);
    to.customFalloff = own["falloff"].exists();
    to.falloff = own["falloff"].vector<3>(to.falloff);
    if (to.type == LightType::Spot) {
        constexpr float kRightAngle = 1.57079632679f;
        to.outerAngle = from["spot"]["outerConeAngle"].number(0.785398163f);
        to.innerAngle = from["spot"]["innerConeAngle"].number(0.0f);
        const bool valid =
            to.innerAngle >= 0.0f && to.innerAngle < to.outerAngle && to.outerAngle <= kRightAngle + 1e-4f;
        if (!valid)
            scene_.notes.push_back(fmt::format("light {}: cone angles out of range, clamped", to.name));
        to.outerAngle = std::clamp(to.outerAngle, 1e-3f, kRightAngle);
        to.innerAngle = std::clamp(to.innerAngle, 0.0f, 0.999f * to.outerAngle);
    }
    scene_.lights.push_back(std::move(to));
}

void Reader::addCamera(std::size_t node, const GltfValue& value) {
    const std::optional<std::size_t> at = value["camera"].index(file_.array("cameras").size());
    if (!at) return;
    const GltfValue from = file_.array("cameras")[*at];
    Camera to;
    to.name = oneLine(from["name"].text(nameOf(node)));
    const float given = ownExtras(value)["distance"].number(1.0f), distance = given > 0 ? given : 1.0f;
    if (!placeCamera(to, worldFromNode_[node], distance)) {
        scene_.notes.push_back(fmt::format("camera {}: has no usable direction; left out", to.name));
        return;
    }
    to.lensDiameter = std::max(ownExtras(value)["lensDiameter"].number(0.0f), 0.0f);
    to.focusDistance = std::max(ownExtras(value)["focusDistance"].number(0.0f), 0.0f);
    const std::string type = from["type"].text("perspective");
    const GltfValue lens = from[type == "orthographic" ? "orthographic" : "perspective"];
    if (type == "orthographic") {
        to.orthographicHeight = 2 * std::abs(lens["ymag"].number(0.0f));
        if (!to.isOrthographic())
            scene_.notes.push_back(
                fmt::format("camera {}: is orthographic without a height; drawn in perspective", to.name));
        const float fovY = ownExtras(value)["fieldOfView"].number(to.fovY);
        if (fovY > 1e-4f && fovY < 3.1415f) to.fovY = fovY;
    } else {
        to.fovY = lens["yfov"].number(to.fovY);
        if (!(to.fovY > 1e-4f && to.fovY < 3.1415f)) lens["yfov"].fail("must be between 0 and pi");
    }
    to.zNear = lens["znear"].number(to.zNear);
    // Parallel rays may begin at the eye.
    if (!(to.zNear > 0.0f))
        to.zNear = to.isOrthographic() ? std::min(0.01f, 1e-4f * lens["zfar"].number(100.0f)) : 0.01f;
    if (!(to.zNear > 0.0f)) to.zNear = 0.01f;
    to.zFar = lens["zfar"].number(std::max(to.zFar, 1e5f * to.zNear));  // absent: endless
    if (!(to.zFar > to.zNear)) to.zFar = 1e5f * to.zNear;
    animation_.cameras.push_back({scene_.cameras.size(), node, glm::mat4(1.0f), distance});
    scene_.cameras.push_back(std::move(to));
}

void Reader::addGroups() {
    NodeTree tree{{}, animation_.parentsFirst, [this](std::size_t node) { return nameOf(node); }};
    for (const auto& node : animation_.nodes) tree.parents.push_back(node.parent);
    makeGroups(scene_, tree, nodesOfInstances_, nodesOfLights_);
}

// A mesh that moves, and its mirrored copy.
void Reader::mirrorMoving(std::size_t mesh, std::size_t copy) {
    const auto moving = [&](std::size_t number) {
        return std::find_if(animation_.meshes.begin(), animation_.meshes.end(),
                            [&](const DeformedMesh& one) { return one.mesh == number; });
    };
    const auto found = moving(mesh);
    if (found == animation_.meshes.end() || moving(copy) != animation_.meshes.end()) return;
    DeformedMesh turned = *found;
    turned.mesh = copy;
    turned.mirrored = true;
    animation_.meshes.push_back(std::move(turned));
}

// Instances that removeMirrors dropped are out of the list; meshes that it mirrored are turned back.
void Reader::keepHung(const std::vector<KeptInstance>& kept) {
    std::vector<SceneAnimation::Hung> hung;
    std::size_t next = 0;
    for (std::size_t i = 0; i < kept.size(); ++i) {
        while (next < animation_.instances.size() && animation_.instances[next].index < kept[i].before)
            ++next;
        if (next == animation_.instances.size() || animation_.instances[next].index != kept[i].before)
            continue;
        SceneAnimation::Hung one = animation_.instances[next];
        one.index = i;
        if (kept[i].mirrored) {
            one.nodeFromThing[0] = -one.nodeFromThing[0];
            mirrorMoving(std::size_t(kept[i].mesh), std::size_t(scene_.instances[i].mesh));
        }
        hung.push_back(one);
    }
    animation_.instances = std::move(hung);
}

Scene Reader::read(SceneAnimation* animation) {
    checkExtensions();
    unpackDraco(file_);
    findWorldTransforms();
    if (animation != nullptr) animation_.clips = readClips(file_, scene_.notes);
    findMovingWeights();
    GltfMaterials materials(file_, scene_, options_);
    GltfMeshes meshes(file_, scene_, materials);
    const std::vector<std::size_t> nodes = nodesOfScene();
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const std::size_t node = nodes[i];
        const GltfValue value = file_.array("nodes")[node];
        if (value["mesh"].exists()) options_.tell({"meshes", i, nodes.size()});
        placeMesh(node, value, meshes);
        addLight(node, value);
        nodesOfInstances_.resize(scene_.instances.size(), static_cast<int>(node));
        nodesOfLights_.resize(scene_.lights.size(), static_cast<int>(node));
        addCamera(node, value);
    }
    meshes.addNotes();
    if (skinned_ > 0 && animation == nullptr && file_.array("animations").size() > 0)
        scene_.notes.push_back(
            fmt::format("{} skinned mesh{} shown in rest pose", skinned_, skinned_ == 1 ? "" : "es"));
    const std::size_t animations = file_.array("animations").size();
    if (animation == nullptr && animations > 0)
        scene_.notes.push_back(
            fmt::format("{} animation{} left out", animations, animations == 1 ? "" : "s"));
    poseAtRest();
    addGroups();
    keepHung(removeMirrors(scene_));
    const bool ours = file_.root()["asset"]["generator"].text("").rfind("Conelight", 0) == 0;
    if (!ours && scene_.settings.empty()) addStartingSettings(scene_);
    if (animation != nullptr) *animation = std::move(animation_);
    return std::move(scene_);
}

}  // namespace

Scene loadGltf(const std::filesystem::path& path, const LoadOptions& options, SceneAnimation* animation) {
    return Reader(path, options).read(animation);
}

}  // namespace conelight::io

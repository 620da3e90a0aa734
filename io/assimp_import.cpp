// SPDX-License-Identifier: MIT
// Everything Assimp reads -> Scene. Assimp triangulates, welds and makes smooth normals; we place meshes by
// the node hierarchy, check every index and number, convert lights, cameras and axes, and keep all of it in a
// child process. Measured with Assimp 5.2.5 on its own 595 test files: none crashes, one (OutOfMemory.off)
// runs away; mutated files crash it now and then (tests/cpu/io_assimp_test.cpp), hence the child.
#include "io/assimp_import.h"

#include <assimp/camera.h>
#include <assimp/config.h>
#include <assimp/light.h>
#include <assimp/metadata.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/core.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cmath>
#include <iterator>
#include <limits>
#include <set>

#include "conelight/error.h"
#include "io/assimp_files.h"
#include "io/assimp_material.h"
#include "io/child_process.h"
#include "io/files.h"
#include "io/geometry.h"
#include "io/groups.h"
#include "io/scene_stream.h"
#include "io/starting_settings.h"
#include "io/upright.h"

namespace conelight::io {

namespace fs = std::filesystem;

namespace {

constexpr float kSmoothingAngleDeg = 60.0f;  // corners sharper than this stay sharp
constexpr double kBytesPerSecond = 5e6;      // slowest useful importer measured (FBX text), with a margin
constexpr std::uint64_t kMemoryPerByte =
    100;  // text formats: a vertex of 20 bytes becomes 200 with its copies

[[noreturn]] void fail(const std::string& why) { throw Error(ErrorKind::BadInput, why); }

std::string textOf(const aiString& text) {
    return oneLine(std::string(text.data, std::min<std::size_t>(text.length, sizeof text.data - 1)));
}
glm::vec3 vec(const aiVector3D& v) { return {v.x, v.y, v.z}; }
bool isFinite(const glm::vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }
glm::mat4 mat(const aiMatrix4x4& m) {  // aiMatrix4x4 is row by row
    return {m.a1, m.b1, m.c1, m.d1, m.a2, m.b2, m.c2, m.d2, m.a3, m.b3, m.c3, m.d3, m.a4, m.b4, m.c4, m.d4};
}

struct Converter {
    const aiScene& source;
    Scene& scene;
    std::vector<int> meshOf;  // index into scene.meshes, -1: nothing of it could be used
    std::size_t badTriangles = 0;
    std::size_t boneMeshes = 0;

    void convertMeshes();
    Mesh convertMesh(const aiMesh& from);
    void place(const glm::mat4& worldFromRoot);
    void convertLight(const aiLight& from, const glm::mat4& worldFromNode);
    void convertCamera(const aiCamera& from, const glm::mat4& worldFromNode);
};

Mesh Converter::convertMesh(const aiMesh& from) {
    Mesh to;
    to.name = textOf(from.mName);
    if (from.mVertices == nullptr || from.mNumVertices == 0) return to;
    const unsigned count = from.mNumVertices;
    to.positions.reserve(count);
    for (unsigned i = 0; i < count; ++i) to.positions.push_back(vec(from.mVertices[i]));
    if (from.mNormals != nullptr)
        for (unsigned i = 0; i < count; ++i) to.normals.push_back(vec(from.mNormals[i]));
    if (from.mTextureCoords[0] != nullptr)
        for (unsigned i = 0; i < count; ++i) {
            const aiVector3D& uv = from.mTextureCoords[0][i];
            const bool usable = std::isfinite(uv.x) && std::isfinite(uv.y);
            to.uvs.push_back(usable ? glm::vec2(uv.x, uv.y) : glm::vec2(0));
        }
    if (from.mColors[0] != nullptr)
        for (unsigned i = 0; i < count; ++i) {
            const aiColor4D& c = from.mColors[0][i];
            const glm::vec4 color(c.r, c.g, c.b, c.a);
            const bool usable = isFinite(glm::vec3(color)) && std::isfinite(color.a);
            to.colors.push_back(usable ? glm::max(color, glm::vec4(0)) : glm::vec4(1));
        }

    // Only whole triangles whose corners exist and are finite; zero the positions nobody uses then.
    for (unsigned f = 0; f < from.mNumFaces; ++f) {
        const aiFace& face = from.mFaces[f];
        if (face.mNumIndices != 3) continue;
        bool usable = true;
        for (unsigned c = 0; c < 3 && usable; ++c)
            usable = face.mIndices[c] < count && isFinite(to.positions[face.mIndices[c]]);
        if (!usable) {
            ++badTriangles;
            continue;
        }
        to.indices.insert(to.indices.end(), face.mIndices, face.mIndices + 3);
    }
    for (glm::vec3& p : to.positions)
        if (!isFinite(p)) p = glm::vec3(0);
    if (!to.normals.empty()) repairNormals(to);
    return to;
}

void Converter::convertMeshes() {
    std::size_t unusable = 0;
    for (unsigned i = 0; i < source.mNumMeshes; ++i) {
        const aiMesh& from = *source.mMeshes[i];
        Mesh mesh = convertMesh(from);
        if (mesh.indices.empty()) {
            meshOf.push_back(-1);
            ++unusable;
            continue;
        }
        boneMeshes += from.mNumBones > 0 ? 1 : 0;
        const unsigned material = from.mMaterialIndex;
        if (material < scene.materials.size() && (scene.materials[material].normalTexture.used() ||
                                                  scene.materials[material].coatNormalTexture.used()))
            makeTangents(mesh);
        meshOf.push_back(int(scene.meshes.size()));
        scene.meshes.push_back(std::move(mesh));
    }
    if (unusable > 0)
        scene.notes.push_back(fmt::format("{} mesh{} without triangles (points, lines) left out", unusable,
                                          unusable == 1 ? "" : "es"));
    if (badTriangles > 0)
        scene.notes.push_back(
            fmt::format("{} triangles with broken indices or numbers left out", badTriangles));
}

// Walks the node tree with an own stack: files can be deep.
void Converter::place(const glm::mat4& worldFromRoot) {
    struct Visit {
        const aiNode* node;
        glm::mat4 worldFromParent;
        int parent;  // number of its node; -1: the root, which is the importer's own and no group
    };
    constexpr std::size_t kMaxNodes = 4'000'000;  // beyond it a file is broken, not big
    std::vector<Visit> stack{{source.mRootNode, worldFromRoot, -1}};
    std::vector<const aiNode*> nodes;
    std::vector<int> ofInstances, ofLights;
    NodeTree tree;
    for (std::size_t visited = 0; !stack.empty(); ++visited) {
        if (visited > kMaxNodes) fail("has too many nodes");
        const Visit visit = stack.back();
        stack.pop_back();
        nodes.push_back(visit.node);
        const int number = visited == 0 ? -1 : static_cast<int>(visited);
        tree.parents.push_back(visit.parent);
        tree.parentsFirst.push_back(visited);
        const glm::mat4 worldFromNode = visit.worldFromParent * mat(visit.node->mTransformation);
        for (unsigned i = 0; i < visit.node->mNumMeshes; ++i) {
            const unsigned mesh = visit.node->mMeshes[i];
            if (mesh >= meshOf.size() || meshOf[mesh] < 0) continue;
            Instance instance;
            instance.name = textOf(visit.node->mName);
            instance.mesh = meshOf[mesh];
            const unsigned material = source.mMeshes[mesh]->mMaterialIndex;
            instance.material = material < scene.materials.size() ? int(material) : -1;
            instance.worldFromObject = worldFromNode;
            scene.instances.push_back(std::move(instance));
        }
        for (unsigned i = 0; i < source.mNumLights; ++i)
            if (source.mLights[i]->mName == visit.node->mName)
                convertLight(*source.mLights[i], worldFromNode);
        for (unsigned i = 0; i < source.mNumCameras; ++i)
            if (source.mCameras[i]->mName == visit.node->mName)
                convertCamera(*source.mCameras[i], worldFromNode);
        for (unsigned i = visit.node->mNumChildren; i-- > 0;)
            if (visit.node->mChildren[i] != nullptr)
                stack.push_back({visit.node->mChildren[i], worldFromNode, number});
        ofInstances.resize(scene.instances.size(), number);
        ofLights.resize(scene.lights.size(), number);
    }
    tree.nameOf = [&](std::size_t node) { return textOf(nodes[node]->mName); };
    makeGroups(scene, tree, ofInstances, ofLights);
}

// Assimp gives colours without a unit; they are taken as W/sr (point, spot) or W/m^2 (directional).
void Converter::convertLight(const aiLight& from, const glm::mat4& worldFromNode) {
    Light to;
    to.name = textOf(from.mName);
    switch (from.mType) {
        case aiLightSource_POINT:
            to.type = LightType::Point;
            break;
        case aiLightSource_SPOT:
            to.type = LightType::Spot;
            break;
        case aiLightSource_DIRECTIONAL:
            to.type = LightType::Directional;
            break;
        default:
            scene.notes.push_back(
                fmt::format("light {}: its kind (ambient or area) is not supported; left out", to.name));
            return;
    }
    const aiColor3D& c = from.mColorDiffuse;
    to.intensity = glm::max(glm::vec3(c.r, c.g, c.b), glm::vec3(0));
    to.position = glm::vec3(worldFromNode * glm::vec4(vec(from.mPosition), 1.0f));
    const glm::vec3 along = glm::mat3(worldFromNode) * vec(from.mDirection);
    if (glm::length(along) > 0.0f && isFinite(along)) to.direction = glm::normalize(along);
    if (to.type == LightType::Spot) {
        constexpr float kRightAngle = 1.5707963f;
        const float outer = std::isfinite(from.mAngleOuterCone) ? 0.5f * from.mAngleOuterCone : 0.0f;
        to.outerAngle = outer > 0.0f ? std::min(outer, kRightAngle) : 0.78539816f;
        const float inner = std::isfinite(from.mAngleInnerCone) ? 0.5f * from.mAngleInnerCone : 0.0f;
        to.innerAngle = std::clamp(inner, 0.0f, 0.99f * to.outerAngle);
    }
    // A falloff other than "none" or pure inverse square is kept as written.
    const glm::vec3 falloff(from.mAttenuationConstant, from.mAttenuationLinear, from.mAttenuationQuadratic);
    if (to.type != LightType::Directional && isFinite(falloff) &&
        (falloff.y > 0.0f || (falloff.z > 0.0f && falloff.x > 0.0f))) {
        to.customFalloff = true;
        to.falloff = glm::max(falloff, glm::vec3(0));
    }
    if (!isFinite(to.intensity) || !isFinite(to.position)) {
        scene.notes.push_back(fmt::format("light {}: has numbers that are not finite; left out", to.name));
        return;
    }
    scene.lights.push_back(to);
}

void Converter::convertCamera(const aiCamera& from, const glm::mat4& worldFromNode) {
    Camera to;
    to.name = textOf(from.mName);
    to.eye = glm::vec3(worldFromNode * glm::vec4(vec(from.mPosition), 1.0f));
    const glm::vec3 forward = glm::mat3(worldFromNode) * vec(from.mLookAt);
    glm::vec3 up = glm::mat3(worldFromNode) * vec(from.mUp);
    const float slant = glm::length(glm::cross(forward, up));
    if (!isFinite(to.eye) || !isFinite(forward) || !isFinite(up) || !(slant > 0.0f)) {
        scene.notes.push_back(fmt::format("camera {}: has no usable direction; left out", to.name));
        return;
    }
    to.target = to.eye + glm::normalize(forward);
    to.up = glm::normalize(up);
    const float aspect = from.mAspect > 0.0f && std::isfinite(from.mAspect) ? from.mAspect : 4.0f / 3.0f;
    const float horizontal = from.mHorizontalFOV;
    // Half the width, in the node's units.
    const float height = 2 * from.mOrthographicWidth / aspect * glm::length(up) / glm::length(vec(from.mUp));
    if (height > 0.0f && std::isfinite(height))
        to.orthographicHeight = height;
    else if (horizontal > 0.01f && horizontal < 3.1f)
        to.fovY = 2.0f * std::atan(std::tan(0.5f * horizontal) / aspect);
    scene.cameras.push_back(to);
}

// Root rotation that brings the file's up axis to +y. FBX states its axes as metadata and Assimp 5.2 leaves
// the conversion to us; Blender and 3MF are z-up by definition; the other importers rotate by themselves, and
// PLY, OBJ and STL say nothing: io/upright.h finds out.
const glm::mat4 kYUpFromZUp{1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1};  // (x, y, z) -> (x, z, -y)

glm::mat4 yUpFromFile(const aiScene& source, const std::string& extension) {
    if (extension == ".blend" || extension == ".3mf") return kYUpFromZUp;
    int upAxis = 1, upSign = 1, frontAxis = 2, frontSign = 1, coordAxis = 0, coordSign = 1;
    if (source.mMetaData == nullptr || !source.mMetaData->Get("UpAxis", upAxis)) return glm::mat4(1.0f);
    source.mMetaData->Get("UpAxisSign", upSign);
    source.mMetaData->Get("FrontAxis", frontAxis);
    source.mMetaData->Get("FrontAxisSign", frontSign);
    source.mMetaData->Get("CoordAxis", coordAxis);
    source.mMetaData->Get("CoordAxisSign", coordSign);
    const bool valid = upAxis >= 0 && upAxis < 3 && frontAxis >= 0 && frontAxis < 3 && coordAxis >= 0 &&
                       coordAxis < 3 && upAxis != frontAxis && frontAxis != coordAxis && upAxis != coordAxis;
    if (!valid) return glm::mat4(1.0f);
    // Rows of the matrix: which file axis feeds x (right), y (up), z (front, towards the viewer).
    glm::mat4 m(0.0f);
    m[coordAxis][0] = coordSign < 0 ? -1.0f : 1.0f;
    m[upAxis][1] = upSign < 0 ? -1.0f : 1.0f;
    m[frontAxis][2] = frontSign < 0 ? -1.0f : 1.0f;
    m[3][3] = 1.0f;
    return m;
}

// Assimp's words for some common cases, said so that they help.
std::string plainWords(const std::string& why) {
    if (why.empty()) return "cannot be read";
    if (why.find("bad_alloc") != std::string::npos)
        return "needs too much memory; the file is probably broken";
    if (why.find("No meshes remaining") != std::string::npos)
        return "holds no triangles (only points or lines)";
    return why;
}

// Runs the importer; `work` sees the aiScene before it dies, and what was refused to it.
template <typename Work>
void withAssimp(const fs::path& path, const SceneFolder& folder, unsigned flags, const Work& work) {
    Assimp::Importer importer;
    auto* const files = new AssimpFiles(folder);
    importer.SetIOHandler(files);  // which owns them now
    importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
    importer.SetPropertyFloat(AI_CONFIG_PP_GSN_MAX_SMOOTHING_ANGLE, kSmoothingAngleDeg);
    const aiScene* source = importer.ReadFile(path.string(), flags);
    if (source == nullptr) fail(plainWords(oneLine(importer.GetErrorString())));
    if (source->mRootNode == nullptr) fail("holds no scene");
    work(*source, files->notes());
}

// Whether all corners of the bounds are beyond one side of what a camera sees, in a picture up to twice as
// wide as high.
bool seesNothing(const Camera& camera, const Aabb& bounds) {
    const glm::vec3 ahead = glm::normalize(camera.target - camera.eye);
    glm::vec3 side = glm::cross(ahead, camera.up);
    if (!(glm::length(side) > 1e-3f))
        side = {ahead.y, ahead.z, -ahead.x};  // straight up or down: any will do
    const glm::vec3 right = glm::normalize(side), up = glm::cross(right, ahead);
    int behind = 0, beyond[4] = {0, 0, 0, 0};
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec3 from = glm::vec3((corner & 1) != 0 ? bounds.max.x : bounds.min.x,
                                         (corner & 2) != 0 ? bounds.max.y : bounds.min.y,
                                         (corner & 4) != 0 ? bounds.max.z : bounds.min.z) -
                               camera.eye;
        const float x = glm::dot(from, right), y = glm::dot(from, up), z = glm::dot(from, ahead);
        const float halfY = 0.5f * camera.heightAt(z), halfX = 2 * halfY;
        behind += z <= 0 ? 1 : 0;
        beyond[0] += x > halfX ? 1 : 0;
        beyond[1] += -x > halfX ? 1 : 0;
        beyond[2] += y > halfY ? 1 : 0;
        beyond[3] += -y > halfY ? 1 : 0;
    }
    return behind == 8 || *std::max_element(std::begin(beyond), std::end(beyond)) == 8;
}

Scene importWhole(const fs::path& path, const SceneFolder& folder, const LoadOptions& options) {
    Scene scene;
    constexpr unsigned kFlags = aiProcess_Triangulate | aiProcess_JoinIdenticalVertices |
                                aiProcess_SortByPType | aiProcess_GenSmoothNormals | aiProcess_FlipUVs |
                                aiProcess_GlobalScale;
    withAssimp(path, folder, kFlags, [&](const aiScene& source, const std::vector<std::string>& notes) {
        scene.notes = notes;
        importAssimpMaterials(source, folder, options.maxTexels, scene);
        Converter converter{source, scene, {}, 0, 0};
        converter.convertMeshes();
        converter.place(yUpFromFile(source, lowerExtension(path)));
        if (converter.boneMeshes > 0)
            scene.notes.push_back(fmt::format("{} skinned mesh{} shown in rest pose", converter.boneMeshes,
                                              converter.boneMeshes == 1 ? "" : "es"));
        if (source.mNumAnimations > 0)
            scene.notes.push_back(fmt::format("{} animation{} left out", source.mNumAnimations,
                                              source.mNumAnimations == 1 ? "" : "s"));
        if (!scene.lights.empty())
            scene.notes.push_back("light colours of this format have no unit; taken as W/sr and W/m^2");
    });
    if (scene.instances.empty() && scene.lights.empty() && scene.cameras.empty())
        fail("holds no triangles, lights or cameras");
    takeUpAxis(scene, path, options.up);
    removeMirrors(scene);
    addStartingSettings(scene);
    // Clip planes of these formats come in the file's units, unlike the rest: derive them from the size.
    const float size = scene.instances.empty() ? 1.0f : glm::length(scene.bounds().extent());
    for (Camera& camera : scene.cameras) {
        camera.zNear = std::clamp(1e-3f * size, 1e-5f, 0.1f);
        camera.zFar = std::max(1000.0f, 20.0f * size);
    }
    // Cameras that an animation turns look anywhere at rest.
    if (!scene.instances.empty() && !scene.cameras.empty() &&
        seesNothing(scene.cameras.front(), scene.bounds())) {
        scene.cameras.insert(scene.cameras.begin(), frameCamera(scene.bounds()));
        scene.notes.emplace_back(
            "the first camera looks past the scene: one that frames it was put before it");
    }
    return scene;
}

Scene importFirstMesh(const fs::path& path, const SceneFolder& folder, const LoadOptions&) {
    Scene scene;
    // As stored, plus welding, and normals where there are none.
    constexpr unsigned kFlags = aiProcess_Triangulate | aiProcess_JoinIdenticalVertices |
                                aiProcess_GenSmoothNormals | aiProcess_FlipUVs;
    withAssimp(path, folder, kFlags, [&](const aiScene& source, const std::vector<std::string>&) {
        if (source.mNumMeshes == 0) fail("holds no mesh");
        Converter converter{source, scene, {}, 0, 0};
        scene.meshes.push_back(converter.convertMesh(*source.mMeshes[0]));
        if (scene.meshes[0].indices.empty()) fail("its first mesh has no triangles");
    });
    return scene;
}

using Import = Scene (*)(const fs::path&, const SceneFolder&, const LoadOptions&);

Scene isolated(const fs::path& path, const LoadOptions& options, Import import) {
    const std::string file = oneLine(path.string());
    std::error_code code;
    const fs::file_status status = fs::status(path, code);
    if (!fs::exists(status)) throw Error(ErrorKind::BadInput, file + ": no such file");
    const std::string unusual = whyNotRegular(status);
    if (!unusual.empty()) throw Error(ErrorKind::BadInput, fmt::format("{}: {}", file, unusual));
    const std::uintmax_t size = fs::file_size(path, code);
    if (!code && size > kMostFileBytes)
        throw Error(ErrorKind::BadInput,
                    fmt::format("{}: has {} bytes; at most {} are read", file, size, kMostFileBytes));
    const SceneFolder folder(path, options.allowOutside);
    std::string failure;
    if (options.isolate) {
        ChildLimits limits;
        limits.cpuSeconds = options.timeLimitSeconds;
        limits.extraMemoryBytes = options.memoryLimitBytes;
        if (limits.extraMemoryBytes > 0 && !code) limits.extraMemoryBytes += kMemoryPerByte * size;
        if (limits.cpuSeconds > 0.0 && !code) limits.cpuSeconds += double(size) / kBytesPerSecond;
        if (options.progress) limits.goesOn = [&] { return options.progress({"importing"}); };
        ChildResult result =
            runInChild([&] { return bytesFromScene(import(path, folder, options)); }, limits);
        if (result.failure.empty()) return sceneFromBytes(result.bytes);
        if (result.stopped) throw LoadStopped("stopped");
        failure = oneLine(result.failure);
    } else {
        try {
            return import(path, folder, options);
        } catch (const std::exception& error) {
            failure = oneLine(error.what());
        }
    }
    throw Error(ErrorKind::BadInput, fmt::format("{}: {}", file, failure));
}

}  // namespace

Scene loadAssimp(const fs::path& path, const LoadOptions& options) {
    return isolated(path, options, importWhole);
}

Mesh loadFirstMesh(const fs::path& path, const LoadOptions& options) {
    return std::move(isolated(path, options, importFirstMesh).meshes.at(0));
}

std::vector<std::string> assimpExtensions() {
    const Assimp::Importer importer;
    std::string list;
    importer.GetExtensionList(list);  // "*.3ds;*.obj;..."
    std::set<std::string> sorted;
    for (std::size_t at = 0; at < list.size();) {
        const std::size_t end = std::min(list.find(';', at), list.size());
        if (end > at + 1 && list[at] == '*') sorted.insert(list.substr(at + 1, end - at - 1));
        at = end + 1;
    }
    return {sorted.begin(), sorted.end()};
}

}  // namespace conelight::io

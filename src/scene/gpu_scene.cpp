// SPDX-License-Identifier: MIT
#include "scene/gpu_scene.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "gl/gl.h"
#include "scene/gpu_vertices.h"
#include "scene/normal_map.h"
#include "scene/packed_mesh.h"

namespace conelight::scene {
namespace {

// Whether two materials cast the same shadow, of triangles as they are.
bool hidesAlike(const Material& a, const Material& b) {
    if (a.alphaMode != b.alphaMode) return false;
    return a.alphaMode == AlphaMode::Opaque ||
           (a.alphaCutoff == b.alphaCutoff && a.baseColor.a == b.baseColor.a &&
            a.baseColorTexture == b.baseColorTexture);
}

// Whether they use the same textures for the same things.
bool usesAlike(const Material& a, const Material& b) {
    return texturesOf(a).slots == texturesOf(b).slots &&
           a.transmissionTexture.texture == b.transmissionTexture.texture;
}

}  // namespace

GpuScene::GpuScene(const Scene& source) : source_(source) {
    source_.validate();
    uploadMeshes();
    placeBakedLight();
    uploadInstances();
    makeVertexArray();
    uploadMaterials();
    textures_ = SceneTextures(source_.textures, normalMaps(source_.materials, source_.textures.size()));
    updateNormalMaps();
    geometryRevision_ = lightRevision_ = skyRevision_ = bakedRevision_ = identity_;
    firstBounds_ = bounds();
    firstGridBounds_ = boundsForGrid();
}

// Meshes one after the other.
void GpuScene::uploadMeshes() {
    std::vector<gpu::Vertex> vertices;
    std::vector<std::uint32_t> indices;
    for (const Mesh& mesh : source_.meshes) {
        hasVertexColors_ = hasVertexColors_ || !mesh.colors.empty();
        const PackedMesh own = packed(mesh);
        meshRanges_.push_back(
            {static_cast<std::uint32_t>(vertices.size()), static_cast<std::uint32_t>(indices.size()),
             static_cast<std::uint32_t>(own.indices.size()), mesh.bounds(), hasWideColors(mesh),
             partBounds_.size(), static_cast<std::uint32_t>(own.vertices.size()),
             static_cast<std::uint32_t>(own.indices.size())});
        meshRanges_.back().vertexCount = meshRanges_.back().vertexRoom;
        vertices.insert(vertices.end(), own.vertices.begin(), own.vertices.end());
        indices.insert(indices.end(), own.indices.begin(), own.indices.end());
        partBounds_.insert(partBounds_.end(), own.parts.begin(), own.parts.end());
    }
    vertexBuffer_ = gl::Buffer(vertices, "scene vertices");
    indexBuffer_ = gl::Buffer(indices, "scene indices");
    vertexCount_ = static_cast<std::uint32_t>(vertices.size());
    indexCount_ = static_cast<std::uint32_t>(indices.size());
}

void GpuScene::uploadInstances() {
    const std::uint32_t defaultMaterial = static_cast<std::uint32_t>(source_.materials.size());
    std::vector<std::uint32_t> instanceIndices;
    for (const Instance& instance : source_.instances) {
        const MeshRange& range = meshRanges_[static_cast<std::size_t>(instance.mesh)];
        gpu::Instance g{};
        g.firstIndex = range.firstIndex;
        g.indexCount = range.indexCount;
        g.firstVertex = range.firstVertex;
        g.material = instance.material >= 0 ? static_cast<std::uint32_t>(instance.material) : defaultMaterial;
        g.firstTriangle = triangleCount_;
        g.flags = range.wideColors ? INSTANCE_WIDE_COLORS : 0u;
        triangleCount_ += range.indexCount / 3;
        instanceIndices.push_back(static_cast<std::uint32_t>(instances_.size()));
        instances_.push_back(g);
        instanceObjectBounds_.push_back(range.bounds);
        instanceParts_.push_back(range.firstPart);
    }
    instanceIndexBuffer_ = gl::Buffer(instanceIndices, "scene instance indices");
    instanceBounds_.resize(instances_.size());
    instanceRevisions_.resize(instances_.size(), identity_);
    casterRevisions_.resize(instances_.size(), identity_);
    shapeRevisions_.resize(instances_.size(), identity_);
    shapesBefore_.resize(instances_.size());
    entryRevisions_.resize(instances_.size(), identity_);
    removed_.resize(instances_.size());
    for (std::size_t i = 0; i < instances_.size(); ++i) {
        setFlags(i, source_.instances[i]);
        place(i, source_.instances[i].worldFromObject);
    }
    instanceBuffer_ = gl::Buffer(instances_, "scene instances");
    drawOrder_.resize(instances_.size());
    std::iota(drawOrder_.begin(), drawOrder_.end(), 0u);
    sortDraws();
}

void GpuScene::makeVertexArray() {
    vertexArray_ = gl::VertexArray(vertexBuffer_, sizeof(gpu::Vertex),
                                   {{0, 3, GL_FLOAT, false, offsetof(gpu::Vertex, position)},
                                    {1, 1, GL_UNSIGNED_INT, true, offsetof(gpu::Vertex, normalOct)},
                                    {2, 2, GL_FLOAT, false, offsetof(gpu::Vertex, u)},
                                    {3, 1, GL_UNSIGNED_INT, true, offsetof(gpu::Vertex, tangentOct)},
                                    {4, 1, GL_UNSIGNED_INT, true, offsetof(gpu::Vertex, color)}},
                                   indexBuffer_, "scene");
    vertexArray_.addPerDrawUint(5, instanceIndexBuffer_);
}

void GpuScene::sortDraws() {
    std::sort(drawOrder_.begin(), drawOrder_.end(),
              [&](std::uint32_t a, std::uint32_t b) { return isDrawnBefore(a, b); });
}

bool GpuScene::isDrawnBefore(std::uint32_t a, std::uint32_t b) const {
    return instances_[a].material != instances_[b].material ? instances_[a].material < instances_[b].material
                                                            : a < b;
}

// Blended surfaces that may hide less than all. Vertex colours may, too, but triangles of the tree have none.
bool GpuScene::mayBeVeil(const Instance& source) const {
    if (!source.visible || !source.castsShadow || source.material < 0 || source.mesh < 0) return false;
    const auto mesh = static_cast<std::size_t>(source.mesh);
    if (isHostMesh(mesh) || !source_.meshes[mesh].colors.empty()) return false;
    const Material& m = source_.materials[static_cast<std::size_t>(source.material)];
    return m.alphaMode == AlphaMode::Blend && !isTransmissive(m) &&
           (m.baseColor.a < 1 || m.baseColorTexture.texture >= 0);
}

void GpuScene::setFlags(std::size_t index, const Instance& source) {
    gpu::Instance& g = instances_[index];
    // What rays through glass meet is the CPU's.
    const bool glass = source.material >= 0 && !isHostMesh(static_cast<std::size_t>(source.mesh)) &&
                       isTransmissive(source_.materials[static_cast<std::size_t>(source.material)]);
    const bool baked = source.visible && bakedPlaces_[index] == source.worldFromObject;
    g.flags = (source.visible ? INSTANCE_VISIBLE : 0u) | (glass ? INSTANCE_GLASS : 0u) |
              (baked ? INSTANCE_BAKED : 0u) |
              (source.visible && source.voxelized && !glass ? INSTANCE_VOXELIZED : 0u) |
              (source.visible && source.castsShadow && !glass ? INSTANCE_CASTS_SHADOW : 0u) |
              (mayBeVeil(source) ? INSTANCE_VEIL : 0u) |
              (g.flags & (INSTANCE_FLIPPED | INSTANCE_WIDE_COLORS));
}

// In the CPU table.
void GpuScene::place(std::size_t index, const glm::mat4& worldFromObject) {
    gpu::Instance& g = instances_[index];
    g.worldFromObject = worldFromObject;
    const glm::mat3 linear(worldFromObject);
    const float determinant = glm::determinant(linear);
    g.flags = determinant < 0 ? g.flags | INSTANCE_FLIPPED : g.flags & ~INSTANCE_FLIPPED;
    // Cofactors instead of the inverse transpose: the same direction, and defined for flat scalings too.
    const float sign = determinant < 0 ? -1.0f : 1.0f;
    g.normalColumn0 = glm::vec4(glm::cross(linear[1], linear[2]) * sign, 0);
    g.normalColumn1 = glm::vec4(glm::cross(linear[2], linear[0]) * sign, 0);
    g.normalColumn2 = glm::vec4(glm::cross(linear[0], linear[1]) * sign, 0);
    instanceBounds_[index] = instanceObjectBounds_[index].transformed(worldFromObject);
    boundsCurrent_ = false;
}

void GpuScene::uploadInstance(std::size_t index) {
    instanceBuffer_.update(index * sizeof(gpu::Instance), &instances_[index], sizeof(gpu::Instance));
}

void GpuScene::setInstance(std::size_t index, const Instance& instance) {
    source_.instances[index] = instance;
    gpu::Instance& g = instances_[index];
    const std::uint32_t material = instance.material >= 0 ? static_cast<std::uint32_t>(instance.material)
                                                          : static_cast<std::uint32_t>(materials_.size() - 1);
    const std::uint32_t flagsBefore = g.flags;
    const bool recolored = g.material != material;
    g.material = material;
    setFlags(index, instance);
    const bool moves = g.worldFromObject != instance.worldFromObject;
    place(index, instance.worldFromObject);
    if (!moves && !recolored && g.flags == flagsBefore) return;
    uploadInstance(index);
    if (recolored) sortDraws();
    geometryRevision_ = instanceRevisions_[index] = casterRevisions_[index] = base::Revision::next();
}

void GpuScene::setMesh(std::size_t index, const Mesh& mesh) {
    const PackedMesh own = packed(mesh);
    MeshRange& range = meshRanges_[index];
    std::vector<gpu::Vertex> before(own.vertices.size());
    range.bentBy = 0;
    for (std::size_t i = 0; i < before.size(); ++i) {
        before[i].position = source_.meshes[index].positions[own.sources[i]];
        range.bentBy = std::max(range.bentBy, glm::distance(before[i].position, own.vertices[i].position));
    }
    verticesBefore_.update(placeForVerticesBefore(index), before.data(), before.size() * sizeof(gpu::Vertex));
    vertexBuffer_.update(range.firstVertex * sizeof(gpu::Vertex), own.vertices.data(),
                         own.vertices.size() * sizeof(gpu::Vertex));
    indexBuffer_.update(range.firstIndex * sizeof(std::uint32_t), own.indices.data(),
                        own.indices.size() * sizeof(std::uint32_t));
    std::copy(own.parts.begin(), own.parts.end(),
              partBounds_.begin() + static_cast<std::ptrdiff_t>(range.firstPart));
    range.bounds = mesh.bounds();
    range.wideColors = hasWideColors(mesh);
    hasVertexColors_ = hasVertexColors_ || !mesh.colors.empty();
    source_.meshes[index] = mesh;
    reshape(index);
}

// The instances of a mesh that has other bounds and vertices.
void GpuScene::reshape(std::size_t index) {
    const MeshRange& range = meshRanges_[index];
    geometryRevision_ = base::Revision::next();
    for (std::size_t i = 0; i < instances_.size(); ++i) {
        if (source_.instances[i].mesh != static_cast<int>(index)) continue;
        gpu::Instance& g = instances_[i];
        bakedPlaces_[i].reset();  // light of another shape
        g.flags &= ~INSTANCE_BAKED;
        g.flags = range.wideColors ? g.flags | INSTANCE_WIDE_COLORS : g.flags & ~INSTANCE_WIDE_COLORS;
        instanceObjectBounds_[i] = range.bounds;
        place(i, g.worldFromObject);
        uploadInstance(i);
        shapesBefore_[i] = shapeRevisions_[i];
        instanceRevisions_[i] = casterRevisions_[i] = shapeRevisions_[i] = geometryRevision_;
    }
}

void GpuScene::setMaterial(std::size_t index, const Material& material) {
    const bool turnsGlass = isTransmissive(material) != isTransmissive(source_.materials[index]);
    const bool sameShadow = !turnsGlass && hidesAlike(material, source_.materials[index]);
    const bool sameTextures = usesAlike(material, source_.materials[index]);
    const std::uint32_t unit = materials_[index].flags & MATERIAL_UNIT_NORMALS;
    source_.materials[index] = material;
    materials_[index] = packedMaterial(material, source_.textures);
    materials_[index].flags |= unit;
    materialTextures_[index] = texturesOf(material);
    materialBuffer_.update(index * sizeof(gpu::Material), &materials_[index], sizeof(gpu::Material));
    if (!sameTextures) updateNormalMaps();
    geometryRevision_ = base::Revision::next();
    for (std::size_t i = 0; i < instances_.size(); ++i)
        if (instances_[i].material == index) {
            instanceRevisions_[i] = geometryRevision_;
            if (!sameShadow) casterRevisions_[i] = geometryRevision_;
            if (!turnsGlass) continue;
            setFlags(i, source_.instances[i]);
            uploadInstance(i);
        }
}

void GpuScene::setTexture(std::size_t index, const Texture& texture) {
    textures_.set(index, texture, textures_.hasUnitNormals(index));
    source_.textures[index] = texture;
    // Layers count with the mean of their textures.
    for (std::size_t i = 0; i < source_.materials.size(); ++i)
        if (hasLayers(source_.materials[i]) && materialTextures_[i].has(index)) {
            materials_[i] = packedMaterial(source_.materials[i], source_.textures);
            materialBuffer_.update(i * sizeof(gpu::Material), &materials_[i], sizeof(gpu::Material));
        }
    updateNormalMaps();
    touchUsersOf(index);
}

void GpuScene::setTexture(const gl::Device& device, std::size_t index, const HostTexture& texture) {
    textures_.set(device, index, texture);
    source_.textures[index] = whiteTexel(texture.name);
    updateNormalMaps();
    touchUsersOf(index);
}

// Which textures are normal maps, and which materials have one of unit normals.
void GpuScene::updateNormalMaps() {
    const std::vector<bool> normals = normalMaps(source_.materials, source_.textures.size());
    for (std::size_t i = 0; i < normals.size(); ++i) textures_.setUse(i, source_.textures[i], normals[i]);
    for (std::size_t i = 0; i < source_.materials.size(); ++i) {
        const TextureRef& map = source_.materials[i].normalTexture;
        const bool unit = map.used() && textures_.hasUnitNormals(static_cast<std::size_t>(map.texture));
        const std::uint32_t flags =
            (materials_[i].flags & ~MATERIAL_UNIT_NORMALS) | (unit ? MATERIAL_UNIT_NORMALS : 0u);
        if (flags == materials_[i].flags) continue;
        materials_[i].flags = flags;
        materialBuffer_.update(i * sizeof(gpu::Material), &materials_[i], sizeof(gpu::Material));
    }
}

void GpuScene::touchUsersOf(std::size_t texture) {
    geometryRevision_ = base::Revision::next();
    for (std::size_t i = 0; i < instances_.size(); ++i)
        if (materialTextures_[instances_[i].material].has(texture) ||
            materials_[instances_[i].material].transmissionLayer == static_cast<int>(texture))
            instanceRevisions_[i] = casterRevisions_[i] = geometryRevision_;
}

void GpuScene::setLights(const std::vector<Light>& lights) {
    source_.lights = lights;
    lightRevision_ = base::Revision::next();
}

void GpuScene::setEnvironment(const Environment& environment) {
    source_.environment = environment;
    skyRevision_ = base::Revision::next();
}

void GpuScene::setSky(const glm::vec3& radiance) {
    source_.sky = radiance;
    skyRevision_ = base::Revision::next();
}

void GpuScene::placeBakedLight() {
    bakedPlaces_.assign(source_.instances.size(), std::nullopt);
    if (source_.baked == nullptr) return;
    for (const BakedLight::Surface& surface : source_.baked->surfaces)
        bakedPlaces_[static_cast<std::size_t>(surface.instance)] = surface.worldFromObject;
}

void GpuScene::setBakedLight(std::shared_ptr<const BakedLight> baked) {
    source_.baked = std::move(baked);
    placeBakedLight();
    for (std::size_t i = 0; i < instances_.size(); ++i) setFlags(i, source_.instances[i]);
    instanceBuffer_.update(0, instances_.data(), instances_.size() * sizeof(gpu::Instance));
    bakedRevision_ = base::Revision::next();
}

void GpuScene::touch() {
    geometryRevision_ = base::Revision::next();
    std::fill(instanceRevisions_.begin(), instanceRevisions_.end(), geometryRevision_);
    std::fill(casterRevisions_.begin(), casterRevisions_.end(), geometryRevision_);
}

const Aabb& GpuScene::bounds() const {
    if (boundsCurrent_) return bounds_;
    bounds_ = Aabb{};
    for (std::size_t i = 0; i < instances_.size(); ++i)
        if ((instances_[i].flags & INSTANCE_VISIBLE) != 0 && !instanceBounds_[i].empty())
            bounds_.grow(instanceBounds_[i]);
    boundsCurrent_ = true;
    return bounds_;
}

void GpuScene::uploadMaterials() {
    for (const Material& material : source_.materials) {
        materials_.push_back(packedMaterial(material, source_.textures));
        materialTextures_.push_back(texturesOf(material));
    }
    materials_.push_back(packedMaterial(Material{}, source_.textures));
    materialTextures_.push_back(texturesOf(Material{}));
    materialBuffer_ = gl::Buffer(materials_, "scene materials");
}

void GpuScene::declare(gl::Inputs& inputs) const {
    inputs.storage("VertexTable", vertexBuffer_)
        .storage("IndexTable", indexBuffer_)
        .storage("InstanceTable", instanceBuffer_)
        .storage("MaterialTable", materialBuffer_);
    if (verticesBefore_) inputs.storage("VerticesBefore", verticesBefore_);
    textures_.declare(inputs);
}

void GpuScene::declareMaterialTextures(gl::Inputs& inputs) { SceneTextures::declarePerDraw(inputs); }

// Parts that follow each other in one draw.
void GpuScene::collectParts(std::uint32_t index, const Draw& draw) const {
    const gpu::Instance& instance = instances_[index];
    std::uint32_t begin = 0;  // of those that are accepted but not taken yet
    const auto takeTo = [&](std::uint32_t end) {
        if (begin < end)
            draws_.push_back(
                {instance.firstIndex + begin, end - begin, instance.firstVertex, index, draw.copies});
    };
    std::size_t number = instanceParts_[index];
    for (std::uint32_t first = 0; draw.part && first < instance.indexCount; first += kPartIndices, ++number) {
        if (draw.part(instance, partBounds_[number])) continue;
        takeTo(first);
        begin = first + kPartIndices;
    }
    takeTo(instance.indexCount);
}

void GpuScene::collectGroups(const Draw& draw) const {
    draws_.clear();
    drawGroups_.clear();
    const std::size_t end = draw.first + std::min(draw.count, drawOrder_.size() - draw.first);
    for (std::size_t place = draw.first; place < end; ++place) {
        const std::uint32_t index = drawOrder_[place];
        const gpu::Instance& instance = instances_[index];
        if ((instance.flags & INSTANCE_VISIBLE) == 0 || instance.indexCount == 0) continue;
        if (draw.filter && !draw.filter(instance)) continue;
        DrawGroup run{};
        run.material = draw.textured != nullptr ? instance.material : 0;
        run.doubleSided = (materials_[instance.material].flags & MATERIAL_DOUBLE_SIDED) != 0;
        run.flipped = (instance.flags & INSTANCE_FLIPPED) != 0;
        run.first = draws_.size();
        collectParts(index, draw);
        run.end = draws_.size();
        if (run.first == run.end) continue;
        if (drawGroups_.empty() || !drawGroups_.back().joins(run))
            drawGroups_.push_back(run);
        else
            drawGroups_.back().end = run.end;
    }
}

void GpuScene::draw(const Draw& draw) const {
    collectGroups(draw);
    if (draws_.empty()) return;
    if (draw.together) drawList_.fill(draws_);
    vertexArray_.bind();
    const MaterialUnits units =
        draw.textured != nullptr ? SceneTextures::unitsOf(*draw.textured) : MaterialUnits{};
    const DrawGroup* before = nullptr;
    for (const DrawGroup& run : drawGroups_) {
        if (draw.textured != nullptr && (before == nullptr || run.material != before->material))
            textures_.bind(materialTextures_[run.material], units);
        if (before == nullptr || run.doubleSided != before->doubleSided)
            gl::setCull(run.doubleSided ? gl::Cull::None : draw.cull);
        if (before == nullptr || run.flipped != before->flipped) gl::setFrontFace(!run.flipped);
        before = &run;
        drawCalls_ += draw.together ? 1 : run.end - run.first;
        if (draw.together)
            drawList_.draw(run.first, run.end - run.first);
        else
            for (std::size_t i = run.first; i < run.end; ++i) gl::drawIndexed(draws_[i]);
    }
}

}  // namespace conelight::scene

// SPDX-License-Identifier: MIT
#include "thesis/render/volume.h"

#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "gl/gl.h"
#include "gl/pace.h"
#include "scene/gpu_lights.h"

namespace conelight::thesis {
namespace {

constexpr int kBrick = THESIS_BRICK;
constexpr float kSumSteps = 16777216.0f;  // 2^24, see voxelize.frag.glsl
constexpr float kMaxRadiance = 60000.0f;  // below the largest half float, 65,504
constexpr int kOriginalLevels = 7;

// Voxels per axis of the texture: `size`, or a little more, so that it halves evenly often enough: to 1 for
// powers of two, five times for sizes from 32 on.
int textureEdge(int size) {
    const int unit = std::min(32, static_cast<int>(std::bit_floor(static_cast<unsigned>(size))));
    return (size + unit - 1) / unit * unit;
}

int levelCount(int edge, bool capped) {
    const int even = std::countr_zero(static_cast<unsigned>(edge)) + 1;
    return capped ? std::min(even, kOriginalLevels) : even;
}

// No light can make a diffuse surface brighter than this, at a distance of half a voxel or more.
float radianceBound(const ThesisVolume::Inputs& inputs, const ThesisDefects& defects, float voxelSize) {
    const auto largest = [](const glm::vec3& v) { return std::max({v.x, v.y, v.z, 0.0f}); };
    float light = 0;
    for (const gpu::Light& l : inputs.lights.table()) {
        const float d = 0.5f * voxelSize;
        float falloff = l.customFalloff != 0 ? l.falloff.x + l.falloff.y * d + l.falloff.z * d * d : d * d;
        if (defects.unattenuatedVoxels || l.type == LIGHT_DIRECTIONAL) falloff = 1.0f;
        float strength = largest(l.intensity) / glm::pi<float>();
        if (l.type == LIGHT_RECT) strength *= scene::areaOf(l);
        light += strength / std::max(falloff, 1e-6f);
    }
    float bound = 1e-3f;
    for (const gpu::Material& m : inputs.scene.materials()) {
        const bool phong = (m.flags & MATERIAL_HAS_PHONG) != 0;
        const float color = largest(phong ? m.phongColor : glm::vec3(m.baseColor));
        bound = std::max({bound, light * color * (m.phongDiffuse + m.phongAmbient), largest(m.emission)});
        if ((m.flags & MATERIAL_UNLIT) != 0) bound = std::max(bound, color);
    }
    return std::min(bound, kMaxRadiance);
}

gl::Defines volumeDefines(const ThesisDefects& d) {
    return d.clippedRadiance ? gl::Defines{{"CLIPPED_RADIANCE", "1"}} : gl::Defines{};
}

// 3: each triangle's own.
int firstAxis(VoxelizationAxis along) {
    switch (along) {
        case VoxelizationAxis::X:
            return 0;
        case VoxelizationAxis::Y:
            return 1;
        case VoxelizationAxis::Z:
            return 2;
        default:
            return 3;
    }
}

gl::ProgramDesc markDesc() { return {{"thesis/shaders/mark_bricks.comp.glsl"}, {}}; }

gl::ProgramDesc bricksDesc(bool arguments) {
    return {{"thesis/shaders/bricks.comp.glsl"}, {{"ARGUMENTS", arguments ? "1" : "0"}}};
}

// Where the voxels' values go.
enum class ResolvedTo { Level, TwoLevels, Octree };

gl::ProgramDesc resolveDesc(const ThesisDefects& d, ResolvedTo target) {
    gl::Defines defines = volumeDefines(d);
    if (target == ResolvedTo::Octree) defines.emplace_back("OCTREE", "1");
    if (target == ResolvedTo::TwoLevels) {
        defines.emplace_back("LEVEL_1", "1");
        if (d.volumeMips) defines.emplace_back("VOLUME_MIPS", "1");
    }
    if (d.binaryOpacity) defines.emplace_back("BINARY_OPACITY", "1");
    if (ThesisVolume::hasAreas(d)) defines.emplace_back("AXIS_AREAS", "1");
    return {{"thesis/shaders/resolve.comp.glsl"}, defines};
}

// `brickTexels`: of the coarse level, per brick; 0 for levels whose texels are larger than bricks.
gl::ProgramDesc mipDesc(const ThesisDefects& d, int brickTexels, bool ofAreas) {
    gl::Defines defines = ofAreas ? gl::Defines{{"AREAS", "1"}} : volumeDefines(d);
    if (!ofAreas && ThesisVolume::hasAreas(d)) defines.emplace_back("SEEN", "1");
    if (d.volumeMips) defines.emplace_back("VOLUME_MIPS", "1");
    defines.emplace_back("BRICK_TEXELS", std::to_string(brickTexels));
    return {{"thesis/shaders/mip.comp.glsl"}, defines};
}

gl::RasterState rasterTo(const gl::Framebuffer& viewport) {
    gl::RasterState state;
    state.framebuffer = &viewport;
    state.depthTest = false;
    state.depthWrite = false;
    state.colorWrite = false;
    state.cull = gl::Cull::None;
    return state;
}

}  // namespace

gl::ProgramDesc ThesisVolume::voxelizeDesc(const ThesisVolumeOptions& options, const SceneKey& scene,
                                           Content content) {
    const ThesisDefects& d = options.defects;
    const bool light = content == Content::Light;
    const bool shadowed = options.shadows && light;
    gl::Defines defines = shadowed ? options.lights.defines()
                                   : gl::Defines{{"LIGHTS_SHAPED", options.lights.shaped ? "1" : "0"}};
    defines.emplace_back("SHADOWED", shadowed ? "1" : "0");
    defines.emplace_back("TEXTURED", scene.textured ? "1" : "0");
    if (!light) defines.emplace_back("CONTENT", std::to_string(static_cast<int>(content)));
    const auto add = [&](const char* name, bool on) {
        if (on) defines.emplace_back(name, "1");
    };
    add("FACE_ROUNDING", d.faceRounding);
    add("UNBOUNDED_SPECULAR", d.unboundedSpecular && content == Content::Albedo);
    add("AXIS_AREAS", light && hasAreas(d));
    add("RECTANGLES", light && scene.rectangles && !d.pointlikeRectangles);
    add("RACING_STORES", light && d.racingStores);
    add("UNATTENUATED_VOXELS", light && d.unattenuatedVoxels);
    add("DARK_EMITTERS", light && d.darkEmitters);
    add("AMBIENT_TWICE", light && d.ambientTwice);
    add("CLIPPED_RADIANCE", light && d.racingStores && d.clippedRadiance);
    add("OCTREE", light && d.racingStores && options.storage == VolumeStorage::Octree);
    if (d.centerCoverage)
        return {{"thesis/shaders/voxelize.vert.glsl", "thesis/shaders/voxelize.geom.glsl",
                 "thesis/shaders/voxelize.frag.glsl"},
                defines};
    defines.emplace_back("TILES", scene.tiles ? "1" : "0");
    return {{"thesis/shaders/voxelize.comp.glsl"}, defines};
}

gpu::ThesisGrid ThesisVolume::fitGrid(const Aabb& bounds, const Aabb& filled,
                                      const ThesisVolumeOptions& options) {
    gpu::ThesisGrid grid{};
    const int edge = textureEdge(options.size);
    if (options.unitGrid || bounds.empty()) {
        grid.voxelSize = 2.0f / static_cast<float>(options.size);
        grid.edge = grid.voxelSize * static_cast<float>(edge);
        grid.origin = glm::vec3(-1.0f);
    } else {
        const glm::vec3 extent = bounds.extent();
        const float longest = std::max({extent.x, extent.y, extent.z, 1e-6f});
        // At least one voxel free on each side: light of a surface is shared by two layers of voxels.
        const float n = static_cast<float>(options.size);
        const float cube = std::max(longest * (1.0f + 2.0f * options.padding), longest * n / (n - 2.0f));
        grid.voxelSize = cube / n;
        grid.edge = grid.voxelSize * static_cast<float>(edge);
        grid.origin = bounds.center() - 0.5f * grid.edge;
    }
    grid.origin -= grid.voxelSize * options.shift;
    grid.size = static_cast<float>(edge);
    grid.maxLevel = static_cast<float>(levelCount(edge, options.defects.cappedLevels) - 1);

    // The box: whole bricks around the bounds and the layer of voxels that shares.
    const Aabb box = filled.empty() ? Aabb{glm::vec3(0), glm::vec3(0)} : filled;
    for (int axis = 0; axis < 3; ++axis) {
        const auto voxel = [&](float world) { return (world - grid.origin[axis]) / grid.voxelSize; };
        const float limit = grid.size;
        const int low =
            static_cast<int>(std::clamp(std::floor(voxel(box.min[axis])) - 1.0f, 0.0f, limit - 1.0f));
        const int high = static_cast<int>(std::clamp(std::floor(voxel(box.max[axis])) + 2.0f, 1.0f, limit));
        grid.boxMin[axis] = low / kBrick * kBrick;
        grid.boxSize[axis] = (std::max(high, low + 1) + kBrick - 1) / kBrick * kBrick - grid.boxMin[axis];
    }
    return grid;
}

gl::Inputs ThesisVolume::bricks() const {
    gl::Inputs inputs;
    inputs.uniform("ThesisGridBlock", constants_)
        .storage("BrickSlots", brickSlots_)
        .storage("BrickList", brickList_);
    if (sums_) inputs.storage("SumTable", sums_);
    if (areaSums_) inputs.storage("AreaTable", areaSums_);
    return inputs;
}

// The grid, and room for what will be in it.
void ThesisVolume::layOut(const Inputs& inputs, const ThesisVolumeOptions& options) {
    grid_ = fitGrid(inputs.scene.firstBounds(), inputs.scene.bounds(), options);
    const float bound = radianceBound(inputs, options.defects, grid_.voxelSize);
    grid_.sumScale = kSumSteps / (options.defects.clippedRadiance ? std::min(bound, 1.0f) : bound);
    const std::size_t lights = inputs.lights.table().size();
    grid_.boxSize.w = static_cast<int>(inputs.scene.instances().size());
    grid_.boxMin.w = static_cast<int>(options.defects.tenLights ? std::min<std::size_t>(lights, 10) : lights);
    grid_.along = {firstAxis(options.along), 0, 0, 0};
    allocate(options);
    constants_.update(grid_);
    const std::uint32_t none[3] = {};
    brickList_.update(0, none, sizeof(none));
}

base::Steps ThesisVolume::buildInSteps(const gl::Device& device, const Inputs& inputs,
                                       const ThesisVolumeOptions& options) {
    gl::PassSteps pass(device, "thesis voxels");
    if (std::exchange(unfinished_, true)) {
        sums_.reset();  // they hold what a build that was left has summed
        areaSums_.reset();
    }
    layOut(inputs, options);
    // Stores of the original's raster that race into textures need no list of bricks before.
    const bool asPublished =
        options.defects.racingStores && options.defects.centerCoverage && !isOctree_ && options.bounces == 1;

    {
        const gl::PassScope step(device.profiler, "thesis clear");
        if (!isOctree_) clearBox();
        brickSlots_.clear();
    }
    co_await pass.rest();
    {
        const gl::PassScope step(device.profiler, "thesis bricks");
        brickCount_ = 0;
        if (!asPublished) markBricks(device, inputs, options);
        allocateSums(options);
    }
    co_await pass.rest();
    {
        const gl::PassScope step(device.profiler, "thesis voxelize");
        drawTriangles(device, inputs, options, Content::Light);
        if (asPublished) listBricks(device);
    }
    co_await pass.rest();
    if (isOctree_) growOctree(device, options);
    co_await pass.rest();
    {
        const gl::PassScope step(device.profiler, "thesis mips");
        resolve(device, options.defects, texture_);
        // Stores that race leave level 1 to be made; sums bring it along.
        const int first = isOctree_ || options.defects.racingStores ? 1 : 2;
        for (const gl::Texture& areas : areas_)
            if (areas) buildMips(device, options.defects, areas, first);
        buildMips(device, options.defects, texture_, first);
    }
    co_await pass.rest();
    if (options.bounces > 1) {
        const gl::PassScope step(device.profiler, "thesis bounces");
        gl::barrier(gl::Access::TextureFetch);
        sumSurfaces(device, inputs, options);
        bounce(device, inputs, options);
    }
    // Who asks for an octree has little memory; the sums are as large as its bricks.
    if (isOctree_) {
        sums_.reset();
        areaSums_.reset();
    }
    gl::barrier(gl::Access::TextureFetch | gl::Access::ImageAccess);
    revision_ = base::Revision::next();
    unfinished_ = false;
}

// The bricks that light will be summed in, and how many they are.
void ThesisVolume::markBricks(const gl::Device& device, const Inputs& inputs,
                              const ThesisVolumeOptions& options) {
    if (inputs.scene.triangleCount() > 0) {
        gl::Inputs given = bricks();
        given.add(inputs.scene);
        forEachAxis(options, [&] {
            device.get(markDesc()).dispatchLinear(given, inputs.scene.triangleCount());
            gl::barrier(gl::Access::ShaderStorage);
        });
    }
    listBricks(device);
    gl::barrier(gl::Access::Update);
    const std::vector<std::uint32_t> counts = brickList_.read<std::uint32_t>(2);
    brickCount_ = counts[0];
    tileCount_ = counts[1];
    if (tiles_.bytes() < 8 * std::max<std::size_t>(tileCount_, 2))
        tiles_ = gl::Buffer(8 * tileCount_, "thesis tiles");
}

// Only the box of the last build holds anything.
void ThesisVolume::clearBox() {
    for (int level = 0; level < texture_.desc().levels; ++level) {
        if (filledSize_.x == 0) {
            texture_.clear(level, GL_RGBA, GL_FLOAT, nullptr);
            clearOthers(level, glm::ivec3(0), glm::ivec3(texture_.width(level)));
            continue;
        }
        const glm::ivec3 edge(texture_.width(level));
        const glm::ivec3 first = filledMin_ >> level;
        const glm::ivec3 last = glm::min(((filledMin_ + filledSize_ - 1) >> level) + 1, edge);
        texture_.clearRegion(level, first, last - first, GL_RGBA, GL_FLOAT);
        clearOthers(level, first, last - first);
    }
    filledMin_ = glm::ivec3(grid_.boxMin);
    filledSize_ = glm::ivec3(grid_.boxSize);
}

template <class Pass>
void ThesisVolume::forEachAxis(const ThesisVolumeOptions& options, const Pass& pass) {
    if (options.along != VoxelizationAxis::Three) return pass();
    for (int axis = 0; axis < 3; ++axis) {
        const glm::ivec4 along{axis, 1, 0, 0};
        constants_.update(offsetof(gpu::ThesisGrid, along), &along, sizeof(along));
        pass();
    }
}

void ThesisVolume::drawTriangles(const gl::Device& device, const Inputs& inputs,
                                 const ThesisVolumeOptions& options, Content content) {
    const auto hasTexture = [](const gpu::Material& material) {
        return material.layers.x >= 0 || material.layers.w >= 0;
    };
    const std::vector<gpu::Material>& materials = inputs.scene.materials();
    const SceneKey key{std::any_of(materials.begin(), materials.end(), hasTexture),
                       inputs.lights.ends().w > inputs.lights.ends().z};
    gl::Inputs given = bricks();
    given.add(inputs.scene).add(inputs.lights);
    if (!isOctree_) given.image("volume", texture_, gl::ImageUse::Write);  // of stores that race
    forEachAxis(options, [&] {
        if (options.defects.centerCoverage)
            rasterTriangles(device, inputs, {options, key, content}, given);
        else
            sumTriangles(device, inputs, {options, key, content}, given);
        gl::barrier(gl::Access::ShaderStorage | gl::Access::ImageAccess | gl::Access::Update);
    });
}

// As in the original: by pixel centres.
void ThesisVolume::rasterTriangles(const gl::Device& device, const Inputs& inputs, const Wanted& wanted,
                                   const gl::Inputs& given) {
    gl::apply(rasterTo(viewport_));
    const auto isLamp = [&](const gpu::Instance& instance) {
        return inputs.lights.areInTable(
            static_cast<std::size_t>(&instance - inputs.scene.instances().data()));
    };
    bool hasLamps = false;
    for (const gpu::Instance& instance : inputs.scene.instances()) hasLamps = hasLamps || isLamp(instance);
    // Emitters that are lights of the table shine from there, not from the volume.
    for (const bool lamps : {false, true}) {
        if (lamps && !hasLamps) break;
        ThesisVolumeOptions kind = wanted.options;
        kind.defects.darkEmitters = wanted.options.defects.darkEmitters || lamps;
        device.get(voxelizeDesc(kind, wanted.scene, wanted.content)).use(given);
        const auto taken = [&](const gpu::Instance& instance) {
            return (instance.flags & INSTANCE_VOXELIZED) != 0 && isLamp(instance) == lamps;
        };
        inputs.scene.draw({.filter = taken, .together = device.profile == gl::ExecutionProfile::Gpu});
    }
}

// By the area that triangles cover of each column of voxels: small ones, then tiles of wide ones.
void ThesisVolume::sumTriangles(const gl::Device& device, const Inputs& inputs, const Wanted& wanted,
                                gl::Inputs given) {
    if (inputs.scene.triangleCount() == 0) return;
    std::vector<std::uint32_t> lamps(inputs.scene.instances().size());
    for (std::size_t i = 0; i < lamps.size(); ++i) lamps[i] = inputs.lights.areInTable(i) ? 1 : 0;
    const gl::Buffer lampTable(lamps, "thesis lamps");
    const std::uint32_t none = 0;
    brickList_.update(8, &none, sizeof(none));
    given.storage("LampTable", lampTable).storage("TileTable", tiles_);
    SceneKey key = wanted.scene;
    device.get(voxelizeDesc(wanted.options, key, wanted.content))
        .dispatchLinear(given, inputs.scene.triangleCount());
    gl::barrier(gl::Access::ShaderStorage | gl::Access::ImageAccess);
    key.tiles = true;
    device.get(voxelizeDesc(wanted.options, key, wanted.content))
        .dispatchLinear(given, tileCount_ * std::size_t{kBrick});
}

// The marked bricks.
void ThesisVolume::listBricks(const gl::Device& device) {
    const std::size_t count = static_cast<std::size_t>(grid_.boxSize.x / kBrick) *
                              static_cast<std::size_t>(grid_.boxSize.y / kBrick) *
                              static_cast<std::size_t>(grid_.boxSize.z / kBrick);
    const gl::Inputs given = bricks();
    device.get(bricksDesc(false)).dispatchLinear(given, count);
    gl::barrier(gl::Access::ShaderStorage);
    device.get(bricksDesc(true)).dispatch(given, 1);
    gl::barrier(gl::Access::ShaderStorage | gl::Access::Indirect);
}

void ThesisVolume::resolve(const gl::Device& device, const ThesisDefects& defects,
                           const gl::Texture& target) {
    if (defects.racingStores && !isOctree_) return;
    gl::Inputs given = bricks();
    if (isOctree_) given.add(octree_);
    given.image("volume", target, gl::ImageUse::Write);
    if (areas_[0])
        given.image("areasPlus", areas_[0], gl::ImageUse::Write)
            .image("areasMinus", areas_[1], gl::ImageUse::Write);
    const bool hasLevels = !isOctree_ && target.desc().levels > 1;
    if (hasLevels) {
        given.image("volume1", target, gl::ImageUse::Write, 1);
        if (areas_[0])
            given.image("areasPlus1", areas_[0], gl::ImageUse::Write, 1)
                .image("areasMinus1", areas_[1], gl::ImageUse::Write, 1);
    }
    const ResolvedTo where = isOctree_   ? ResolvedTo::Octree
                             : hasLevels ? ResolvedTo::TwoLevels
                                         : ResolvedTo::Level;
    device.get(resolveDesc(defects, where)).dispatchIndirect(given, brickList_, 16);
    gl::barrier(gl::Access::ImageAccess);
}

void ThesisVolume::buildMips(const gl::Device& device, const ThesisDefects& defects,
                             const gl::Texture& texture, int first) {
    if (isOctree_) {
        buildOctreeMips(device, defects, texture);
        return;
    }
    const bool ofAreas = areAreas(texture);
    for (int level = first; level < texture.desc().levels; ++level) {
        gl::Inputs given = bricks();
        given.image("fine", texture, gl::ImageUse::Read, level - 1)
            .image("coarse", texture, gl::ImageUse::Write, level);
        if (!ofAreas && areas_[0])
            given.image("areasPlus", areas_[0], gl::ImageUse::Read, level)
                .image("areasMinus", areas_[1], gl::ImageUse::Read, level);
        if (level <= 3) {
            // 4^3, 2^3 or 1 texels per brick; arguments for as many groups of 64.
            const int texels = 64 >> (3 * (level - 1));
            device.get(mipDesc(defects, texels, ofAreas))
                .dispatchIndirect(given, brickList_, 16 + 12 * static_cast<std::size_t>(level - 1));
        } else {
            const int edge = texture.width(level);
            const int ratio = static_cast<int>(grid_.size) / edge;
            const glm::ivec3 low = glm::ivec3(grid_.boxMin) / ratio;
            const glm::ivec3 high =
                (glm::ivec3(grid_.boxMin) + glm::ivec3(grid_.boxSize) + ratio - 1) / ratio;
            const glm::ivec3 count = high - low;
            device.get(mipDesc(defects, 0, ofAreas)).dispatch(given, count.x, count.y, count.z);
        }
        gl::barrier(gl::Access::ImageAccess);
    }
}

void ThesisVolume::declare(gl::Inputs& inputs) const {
    inputs.texture("volume", texture(), &sampler_).uniform("ThesisGridBlock", constants_);
    if (areas_[0])
        inputs.texture("areasPlus", areas_[0], &areaSampler_).texture("areasMinus", areas_[1], &areaSampler_);
    if (isOctree_) inputs.add(octree_);
}

std::vector<gl::ProgramDesc> ThesisVolume::programDescs() {
    ThesisVolumeOptions mended, shadowed, published;
    mended.shadows = false;
    published.shadows = false;
    ThesisDefects& d = published.defects;
    d.racingStores = d.centerCoverage = d.binaryOpacity = d.faceRounding = d.unattenuatedVoxels = true;
    d.clippedRadiance = d.darkEmitters = d.volumeMips = d.ambientTwice = true;
    d.isotropicOpacity = d.pointlikeRectangles = true;
    std::vector<gl::ProgramDesc> descs{markDesc(), bricksDesc(false), bricksDesc(true)};
    const auto addVoxelize = [&](ThesisVolumeOptions options, SceneKey key, Content content) {
        options.defects.centerCoverage = true;
        descs.push_back(voxelizeDesc(options, key, content));
        options.defects.centerCoverage = false;
        for (const bool tiles : {false, true}) {
            key.tiles = tiles;
            descs.push_back(voxelizeDesc(options, key, content));
        }
    };
    for (const ThesisVolumeOptions& options : {mended, shadowed, published})
        for (const SceneKey& key : {SceneKey{}, SceneKey{true, false}, SceneKey{false, true}})
            for (const bool shaped : {false, true}) {
                ThesisVolumeOptions unshadowed = options;
                if (!options.shadows) unshadowed.lights.shaped = shaped;
                if (!shaped || !options.shadows) addVoxelize(unshadowed, key, Content::Light);
            }
    for (const light::LightKey& lights : light::LightKey::all()) {
        shadowed.lights = lights;
        addVoxelize(shadowed, {}, Content::Light);
        if (lights.rect > 0) addVoxelize(shadowed, {false, true}, Content::Light);
    }
    for (const Content content : {Content::Albedo, Content::Normal})
        for (const ThesisVolumeOptions& options : {mended, published})
            addVoxelize(options, {true, false}, content);
    for (const ThesisVolumeOptions& options : {mended, published}) {
        for (const ResolvedTo where : {ResolvedTo::Level, ResolvedTo::TwoLevels, ResolvedTo::Octree})
            descs.push_back(resolveDesc(options.defects, where));
        for (const int texels : {64, 8, 1, 0})
            for (const bool ofAreas : {false, true})
                descs.push_back(mipDesc(options.defects, texels, ofAreas));
    }
    published.storage = VolumeStorage::Octree;
    addVoxelize(published, {}, Content::Light);
    const std::vector<gl::ProgramDesc> ofOctree = octreeDescs();
    descs.insert(descs.end(), ofOctree.begin(), ofOctree.end());
    return descs;
}

}  // namespace conelight::thesis

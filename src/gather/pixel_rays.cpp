// SPDX-License-Identifier: MIT
#include "gather/pixel_rays.h"

#include <algorithm>
#include <array>
#include <utility>

#include "gather/pixel_list.h"
#include "gl/gl.h"
#include "gl/pace.h"
#include "gl/picture_pass.h"
#include "light/firefly_clamp.h"
#include "light/inject_light.h"

namespace conelight::gather {
namespace {

// The picture so far counts for a point where its surface is within half a voxel of the point's plane: voxels
// tell no finer.
constexpr float kPlaneTolerance = 0.5f;
// Reach of component occlusion, as a part of the grid's longest side.
constexpr float kOcclusionReach = 0.1f;
// A ray into a lobe goes on so often where it meets metal; after that metals reflect lights in their lobe and
// all else as if diffuse. Three mirrors in a row are seen, more are hardly told apart. Rays for irradiance go
// on only where many are averaged: what few bring from a lobe is speckles.
constexpr std::uint32_t kLobeReflections = 3;
constexpr int kReflectedRays = 128;

constexpr std::array<std::uint32_t, 5> kEmptyLobeList{LOBE_GROUPS_X, 0, 1, 0, 0};
constexpr float kBeforeEye = 1e-3f;  // voxels; corners of boxes nearer than that are behind the eye
constexpr int kGroupEdge = 8;        // of passes over all pixels

gl::ProgramDesc selectDesc(bool coats) { return {{"gather/lobe_select.comp.glsl"}, surfaceDefines(coats)}; }

const char* const kGatherPass[] = {"diffuse rays", "specular rays", "coat rays", "occlusion rays",
                                   "rays to lamps"};
const char* const kLabel[] = {"gathered diffuse", "gathered specular", "gathered coat", "gathered occlusion",
                              "gathered lamps"};

// How many passes lib/temporal.glsl averages, far from what `changed` and there. Where that may be anywhere, few everywhere.
void setMeans(gpu::PixelRayConstants& constants, const RayPass& pass, const light::SceneEdits& changed) {
    const int longest = std::max(pass.longest, 1);
    const int shortest = pass.shortest > 0 ? std::min(pass.shortest, longest) : longest;
    constants.longestMean = static_cast<float>(changed ? longest : shortest);
    constants.shortestMean = static_cast<float>(shortest);
    const auto atMost = [&](int passes) {
        return passes > 0 ? static_cast<float>(std::min(passes, longest)) : constants.shortestMean;
    };
    constants.shortestLightMean = atMost(pass.shortestOfLight);
    constants.shortestLobeMean = constants.shortestMean;
    if (!changed) return;
    // A lobe may show anything that a light shines on.
    constants.shortestLobeMean = !changed->ofLight() ? atMost(pass.shortestOfLobes)
                                 : changed->most     ? constants.shortestLightMean
                                                     : constants.shortestMean;
    light::putEdits(constants, *changed, pass.light != LightSoFar::Unknown);
    if (pass.light == LightSoFar::Now) constants.lightScale = glm::vec3(1);
}

}  // namespace

void RayInputs::declare(gl::Inputs& inputs) const {
    inputs.add(scene).add(lights).add(surfaces);
    // Pictures of direct light alone are drawn without lit voxels, most of them without any.
    if (lit.revision()) inputs.add(lit);
    if (!voxels.revision()) return;
    inputs.add(voxels);
    voxels.surface().declareTriangles(inputs);
}

gl::Texture makePixelPicture(int width, int height, const char* label) {
    gl::Texture picture({GL_TEXTURE_2D, GL_RGBA32UI, width, height}, label);
    picture.parameter(GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    picture.parameter(GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    picture.clear(0, GL_RGBA_INTEGER, GL_UNSIGNED_INT, nullptr);
    return picture;
}

void setPictureSoFar(gpu::PixelRayConstants& constants, const gpu::FrameConstants& view,
                     const voxels::VoxelGrid& grid) {
    constants.oldClipFromWorld = view.clipFromWorld;
    constants.oldEye = view.eye;
    constants.oldForward = view.viewForward;
    constants.oldRight = view.viewRight;
    constants.oldUp = view.viewUp;
    constants.oldParallel = view.parallel;
    constants.planeTolerance = kPlaneTolerance * grid.voxelSize;
}

// One that reaches behind the eye may be anywhere.
PixelRectangle rectangleOf(const view::Surfaces& surfaces, const scene::GpuScene& scene, float nearest,
                           const std::function<bool(const gpu::Instance&)>& counts) {
    const gpu::FrameConstants& view = surfaces.view();
    const glm::ivec2 size(view.width, view.height);
    if (surfaces.areHosts()) return {glm::ivec2(0), size};
    PixelRectangle all{size, glm::ivec2(0)};
    const std::vector<gpu::Instance>& instances = scene.instances();
    for (std::size_t i = 0; i < instances.size(); ++i) {
        if (!counts(instances[i])) continue;
        const Aabb& box = scene.instanceBounds(i);
        glm::vec2 lowest(1e9f), highest(-1e9f);
        int before = 0;
        for (int corner = 0; corner < 8; ++corner) {
            const glm::vec3 at((corner & 1) != 0 ? box.max.x : box.min.x,
                               (corner & 2) != 0 ? box.max.y : box.min.y,
                               (corner & 4) != 0 ? box.max.z : box.min.z);
            const glm::vec4 clip = view.clipFromWorld * glm::vec4(at, 1);
            if (view.parallel == 0 && clip.w < nearest) continue;
            ++before;
            // Far outside all is the same; numbers stay small enough for integers.
            const glm::vec2 place = glm::clamp(glm::vec2(clip) / clip.w, -2.0f, 2.0f);
            lowest = glm::min(lowest, place);
            highest = glm::max(highest, place);
        }
        if (before == 0) continue;
        if (before < 8) return {glm::ivec2(0), size};
        // One pixel more on each side, for rounding.
        all.lowest = glm::min(all.lowest, glm::ivec2((lowest * 0.5f + 0.5f) * glm::vec2(size)) - 1);
        all.end = glm::max(all.end, glm::ivec2((highest * 0.5f + 0.5f) * glm::vec2(size)) + 2);
    }
    // Whole groups of 8 pixels, as in a dispatch over all.
    all.lowest = glm::max(all.lowest, 0) / 8 * 8;
    all.end = glm::max(glm::min(all.end, size), all.lowest);
    return all;
}

bool mayHaveLobe(const scene::GpuScene& scene, const gpu::Instance& instance, float roughest) {
    const gpu::Material& m = scene.materials()[instance.material];
    const bool textured = (m.flags & MATERIAL_DETAIL_TEXTURES) != 0;
    const bool reflects = m.metallic > 0 || m.specularF0 != glm::vec3(0);
    const bool drawn = (instance.flags & INSTANCE_VISIBLE) != 0 && !scene::isGlass(instance);
    return drawn && (m.flags & MATERIAL_UNLIT) == 0 && reflects && (textured || m.roughness <= roughest);
}

bool mayHaveCoatLobe(const scene::GpuScene& scene, const gpu::Instance& instance) {
    return view::isLayered(scene, instance) && scene.materials()[instance.material].coat > 0;
}

bool PixelRays::has(int width, int height) const {
    const gl::Texture& picture = current_.texture;
    return picture && picture.width() == width && picture.height() == height;
}

void PixelRays::clearWritten(Picture& picture) {
    const glm::ivec2 size = picture.written.end - picture.written.lowest;
    if (size.x > 0 && size.y > 0)
        picture.texture.clearRegion(0, glm::ivec3(picture.written.lowest, 0), glm::ivec3(size, 1),
                                    GL_RGBA_INTEGER, GL_UNSIGNED_INT);
}

PixelRayKey PixelRays::key(const RayInputs& inputs, const RayPass& pass) const {
    PixelRayKey key{.kind = kind_,
                    .motion = pass.reuse != Reuse::Reproject ? Motion::None
                              : inputs.surfaces.haveMotion() ? Motion::Vectors
                              : pass.motion != nullptr       ? Motion::Instances
                                                             : Motion::None,
                    .counts = pass.lookupCounters != nullptr,
                    .listed = isOfLobes(kind_)};
    // Rectangles of light are reflected without rays; few of them find other lamps.
    key.aims = isOfLobes(kind_) && light::hasOtherEmitters(inputs.scene, inputs.lights);
    key.triangles = isOfLobes(kind_) ? pass.settings.exactMirrors : pass.settings.exactNear;
    if (kind_ == RayPicture::Occlusion) return key;
    if (kind_ == RayPicture::Lamps) {
        key.triangles = false;
        key.lamps = inputs.lights.lampKey();
        return key;
    }
    key.hits = inputs.lights.hitKey(inputs.scene, pass.settings.exactHits);
    return key;
}

gpu::PixelRayConstants PixelRays::packed(const RayInputs& inputs, const RayPass& pass) const {
    const voxels::VoxelGrid& grid = inputs.voxels.grid();
    gpu::PixelRayConstants c{};
    setPictureSoFar(c, seenFrom_, grid);
    c.reuse = static_cast<std::uint32_t>(pass.reuse);
    c.motionScaleX = inputs.surfaces.motionScale().x;
    c.motionScaleY = inputs.surfaces.motionScale().y;
    c.motionStep = static_cast<std::uint32_t>(inputs.surfaces.motionStep());
    c.pass = pass.number;
    c.rays = static_cast<std::uint32_t>(std::max(pass.rays, 1));
    setMeans(c, pass, inputs.lit.changed());
    c.specularLimit = pass.settings.specularLimit;
    c.reach = kOcclusionReach * static_cast<float>(std::max({grid.size.x, grid.size.y, grid.size.z}));
    const bool lobes = isOfLobes(kind_);
    const int averaged = (lobes ? 1 : 2) * pass.rays * pass.longest;
    c.reflections = lobes ? kLobeReflections : (averaged >= kReflectedRays ? 1u : 0u);
    // With a limited number of bounces none: a reflection is a bounce more.
    if (pass.settings.bounces) c.reflections = 0;
    c.fireflyClamp = light::fireflyClamp(averaged);
    c.inverseVoxelSize = 1.0f / grid.voxelSize;
    return c;
}

// Returns whether what was there is gone.
bool PixelRays::resize(int width, int height) {
    if (!constants_) constants_ = gl::Buffer(sizeof(gpu::PixelRayConstants), "pixel rays constants");
    if (has(width, height)) return false;
    filtered_ = {};
    lobeList_ = {};
    for (Picture* picture : {&current_, &other_})
        *picture = {makePixelPicture(width, height, kLabel[static_cast<int>(kind_)]), {}};
    return true;
}

gl::Inputs PixelRays::passInputs(const RayInputs& inputs, const RayPass& pass) const {
    gl::Inputs given;
    given.add(inputs)
        .uniform("PixelRayBlock", constants_)
        .texture("pixelHistory", current_.texture)
        .image("result", other_.texture, gl::ImageUse::Write);
    if (pass.motion != nullptr) given.storage("Motion", *pass.motion);
    if (pass.lookupCounters != nullptr) given.storage("LookupTable", *pass.lookupCounters);
    return given;
}

void PixelRays::record(const gl::Device& device, const RayInputs& inputs, const RayPass& pass,
                       StepRecorder& recorder) {
    resize(inputs.surfaces.width(), inputs.surfaces.height());
    RayPass one = pass;
    one.reuse = Reuse::None;
    one.motion = one.lookupCounters = nullptr;
    PixelRayKey key = this->key(inputs, one);
    key.listed = false;
    key.records = true;
    gl::Inputs given = passInputs(inputs, one);
    // Declared by the shader; the one pixel is not looked up there.
    if (kind_ == RayPicture::Specular) given.storage("LobeList", lobeList());
    constants_.update(packed(inputs, one));
    recorder.record(device, key.desc(), given, 1.0f / static_cast<float>(one.longest));
}

// The list of pixels that need rays into their lobe, for pictures of this size.
const gl::Buffer& PixelRays::lobeList() {
    const std::size_t pixels = static_cast<std::size_t>(current_.texture.width()) *
                               static_cast<std::size_t>(current_.texture.height());
    if (!lobeList_) lobeList_ = gl::Buffer(sizeof kEmptyLobeList + 4 * pixels, "pixels with lobes");
    return lobeList_;
}

// Lists the pixels that need rays into their lobe; those that are not listed hold nothing.
void PixelRays::listLobes(const gl::Device& device, gl::Inputs& inputs, const PixelRectangle& lobes) {
    inputs.storage("LobeList", lobeList());
    lobeList_.update(kEmptyLobeList);
    const glm::ivec2 extent = lobes.end - lobes.lowest;
    if (extent.x > 0 && extent.y > 0)
        device.get(selectDesc(kind_ == RayPicture::Coat)).dispatch(inputs, extent.x, extent.y);
    clearWritten(other_);
    other_.written = lobes;
    gl::barrier(gl::Access::ShaderStorage | gl::Access::Indirect | gl::Access::Update);
}

base::Steps PixelRays::gatherInSteps(const gl::Device& device, const RayInputs& inputs,
                                     const RayPass& wanted) {
    const char* const name = kGatherPass[static_cast<int>(kind_)];
    const view::Surfaces& surfaces = inputs.surfaces;
    RayPass pass = wanted;
    if (resize(surfaces.width(), surfaces.height())) pass.reuse = Reuse::None;
    PixelRectangle lobes;
    const float limit = pass.settings.specularLimit;
    if (isOfLobes(kind_))
        lobes = rectangleOf(surfaces, inputs.scene, kBeforeEye * inputs.voxels.grid().voxelSize,
                            [&](const gpu::Instance& one) {
                                return kind_ == RayPicture::Coat ? mayHaveCoatLobe(inputs.scene, one)
                                                                 : mayHaveLobe(inputs.scene, one, limit);
                            });
    gpu::PixelRayConstants constants = packed(inputs, pass);
    constants.lowestX = static_cast<std::uint32_t>(lobes.lowest.x);
    constants.lowestY = static_cast<std::uint32_t>(lobes.lowest.y);
    constants_.update(constants);
    gl::Inputs given = passInputs(inputs, pass);
    const gl::ProgramDesc desc = key(inputs, pass).desc();
    if (isOfLobes(kind_)) {
        {
            const gl::PassScope scope(device.profiler, name);
            listLobes(device, given, lobes);
        }
        co_await dispatchListed(device, {name, desc, given, lobeList_});
    } else {
        for (gl::Pieces rows(device, surfaces.height(), kGroupEdge); rows.next();) {
            {
                const gl::PassScope scope(device.profiler, name);
                constants.lowestY = static_cast<std::uint32_t>(rows.first());
                constants_.update(constants);
                device.get(desc).dispatch(given, surfaces.width(), rows.count());
            }
            co_await gl::rest(device);
        }
    }
    gl::barrier(gl::Access::TextureFetch | gl::Access::Update);
    std::swap(current_, other_);
    shown_ = &current_.texture;
    seenFrom_ = surfaces.view();
}

base::Steps PixelRays::filterInSteps(const gl::Device& device, const RayInputs& inputs, int levels) {
    const int width = current_.texture.width(), height = current_.texture.height();
    if (levels > 0 && !filtered_.texture)
        filtered_ = {makePixelPicture(width, height, "filtered picture"), {}};
    // From level to level between two textures; the second is what the next pass writes, so its content is
    // free. An even number of levels ends there as well.
    const Picture* from = &current_;
    for (int level = 0; level < levels; ++level) {
        Picture* to = level % 2 == 0 ? &filtered_ : &other_;
        const bool lobes = isOfLobes(kind_);
        constexpr const char* kName = "edge filter";
        gl::Inputs given;
        given.add(inputs)
            .uniform("PixelRayBlock", constants_)
            .texture("source", from->texture)
            .image("result", to->texture, gl::ImageUse::Write);
        const gl::ProgramDesc filter = EdgeFilterKey{1 << level, lobes, kind_ == RayPicture::Coat}.desc();
        if (lobes) {
            // Pixels that are not listed count for nothing.
            clearWritten(*to);
            to->written = current_.written;
            given.storage("LobeList", lobeList_);
            co_await dispatchListed(device, {kName, filter, given, lobeList_});
        } else {
            co_await gl::dispatchPicture(device, {kName, filter, given, {width, height}});
        }
        gl::barrier(gl::Access::TextureFetch | gl::Access::Update);
        from = to;
    }
    shown_ = &from->texture;
}

std::vector<gl::ProgramDesc> PixelRays::programDescs() {
    std::vector<gl::ProgramDesc> descs = {selectDesc(false), selectDesc(true)};
    for (const PixelRayKey& key : PixelRayKey::all()) descs.push_back(key.desc());
    for (const EdgeFilterKey& key : EdgeFilterKey::all()) descs.push_back(key.desc());
    return descs;
}

}  // namespace conelight::gather

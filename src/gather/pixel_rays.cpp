// SPDX-License-Identifier: MIT
#include "gather/pixel_rays.h"

#include <algorithm>
#include <array>
#include <utility>

#include "gl/gl.h"
#include "light/irradiance_cache.h"
#include "shared/bindings.h"
#include "shared/lookups.h"

namespace conelight::gather {
namespace {

// The picture so far counts for a point where its surface is within half a voxel of the point's plane: voxels
// tell no finer.
constexpr float kPlaneTolerance = 0.5f;
// Reach of component occlusion, as a part of the grid's longest side.
constexpr float kOcclusionReach = 0.1f;
// A ray into a lobe goes on so often where it meets metal; after that metals reflect lights in their lobe and
// all else as if matt. Three mirrors in a row are seen, more are hardly told apart. Rays for irradiance go on
// only where many are averaged: what few bring from a lobe is speckles.
constexpr std::uint32_t kLobeReflections = 3;
constexpr int kReflectedRays = 128;

// Occlusion asks for no light.
const gl::Defines kNoHitLights = {{"EXACT_DIRECT", "0"}, {"LOBES", "0"}};

// Which pixels get rays into their lobe (LOBE_LISTED).
enum class LobePixels { All, Listed };

gl::ProgramDesc gatherDesc(RayPicture kind, Reuse reuse, bool motion, bool countLookups,
                           const gl::Defines& hitLights, LobePixels lobes = LobePixels::All) {
    gl::ProgramDesc desc;
    desc.files = {kind == RayPicture::Specular ? "gather/ray_specular.comp.glsl"
                                               : "gather/ray_diffuse.comp.glsl"};
    desc.defines = {{"TEMPORAL", std::to_string(static_cast<int>(reuse))},
                    {"MOTION", motion && reuse == Reuse::Reproject ? "1" : "0"}};
    if (kind != RayPicture::Specular)
        desc.defines.emplace_back("OCCLUSION", kind == RayPicture::Occlusion ? "1" : "0");
    if (lobes == LobePixels::Listed) desc.defines.emplace_back("LOBE_LISTED", "1");
    if (countLookups) desc.defines.emplace_back("COUNT_LOOKUPS", "1");
    desc.defines.insert(desc.defines.end(), hitLights.begin(), hitLights.end());
    return desc;
}

// What rays look up where they hit.
gl::Defines hitDefines(RayPicture kind, const PixelRayFrame& frame, const TracedSettings& settings) {
    if (kind == RayPicture::Occlusion) return kNoHitLights;
    gl::Defines defines = light::hitLightDefines(frame.scene, frame.light, settings.exactHits);
    if (kind == RayPicture::Specular && settings.exactMirrors) defines.emplace_back("TRIANGLE_HITS", "1");
    return defines;
}

gl::ProgramDesc selectDesc() { return {{"gather/lobe_select.comp.glsl"}, {}}; }

gl::ProgramDesc filterDesc(int step, bool specular) {
    return {{"gather/edge_filter.comp.glsl"},
            {{"FILTER_STEP", std::to_string(step)}, {"SPECULAR", specular ? "1" : "0"}}};
}

const char* const kGatherPass[] = {"diffuse rays", "specular rays", "occlusion rays"};
const char* const kLabel[] = {"gathered diffuse", "gathered specular", "gathered occlusion"};

gl::Texture makePicture(int width, int height, const char* label) {
    gl::Texture picture({GL_TEXTURE_2D, GL_RGBA32UI, width, height}, label);
    picture.parameter(GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    picture.parameter(GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    picture.clear(0, GL_RGBA_INTEGER, GL_UNSIGNED_INT, nullptr);
    return picture;
}

void bindPicture(const gl::Texture& picture, unsigned unit) {
    picture.bind(unit);
    gl::unbindSampler(unit);
}

}  // namespace

bool mayHaveLobe(const scene::GpuScene& scene, const gpu::Instance& instance, float roughest) {
    const gpu::Material& m = scene.materials()[instance.material];
    const bool textured = (m.flags & MATERIAL_DETAIL_TEXTURES) != 0;
    const bool reflects = m.metallic > 0 || m.specularF0 != glm::vec3(0);
    return (instance.flags & INSTANCE_VISIBLE) != 0 && (m.flags & MATERIAL_UNLIT) == 0 && reflects &&
           (textured || m.roughness <= roughest);
}

bool PixelRays::has(int width, int height) const {
    const gl::Texture& picture = current_.texture;
    return picture && picture.width() == width && picture.height() == height;
}

// About the boxes of all instances that may have lobes. One that reaches behind the eye may be anywhere.
PixelRectangle PixelRays::lobeRectangle(const PixelRayFrame& frame, float roughest) {
    const glm::ivec2 size(frame.view.width, frame.view.height);
    PixelRectangle all{size, glm::ivec2(0)};
    const std::vector<gpu::Instance>& instances = frame.scene.instances();
    for (std::size_t i = 0; i < instances.size(); ++i) {
        if (!mayHaveLobe(frame.scene, instances[i], roughest)) continue;
        const Aabb& box = frame.scene.instanceBounds(i);
        glm::vec2 lowest(1e9f), highest(-1e9f);
        int before = 0;
        for (int corner = 0; corner < 8; ++corner) {
            const glm::vec3 at((corner & 1) != 0 ? box.max.x : box.min.x,
                               (corner & 2) != 0 ? box.max.y : box.min.y,
                               (corner & 4) != 0 ? box.max.z : box.min.z);
            const glm::vec4 clip = frame.view.clipFromWorld * glm::vec4(at, 1);
            if (clip.w < 1e-3f * frame.voxelSize) continue;
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

void PixelRays::clearWritten(Picture& picture) {
    const glm::ivec2 size = picture.written.end - picture.written.lowest;
    if (size.x > 0 && size.y > 0)
        picture.texture.clearRegion(0, glm::ivec3(picture.written.lowest, 0), glm::ivec3(size, 1),
                                    GL_RGBA_INTEGER, GL_UNSIGNED_INT);
}

gpu::PixelRayConstants PixelRays::packed(const PixelRayFrame& frame, const TracedSettings& settings, int rays,
                                         std::uint32_t pass, int longest) const {
    gpu::PixelRayConstants c{};
    c.oldClipFromWorld = seenFrom_.clipFromWorld;
    c.oldEye = seenFrom_.eye;
    c.oldForward = seenFrom_.viewForward;
    c.oldRight = seenFrom_.viewRight;
    c.oldUp = seenFrom_.viewUp;
    c.planeTolerance = kPlaneTolerance * frame.voxelSize;
    c.pass = pass;
    c.rays = static_cast<std::uint32_t>(std::max(rays, 1));
    c.longestMean = static_cast<float>(std::max(longest, 1));
    c.specularLimit = settings.specularLimit;
    c.reach = kOcclusionReach * frame.gridLength;
    const bool lobes = kind_ == RayPicture::Specular;
    const int averaged = (lobes ? 1 : 2) * rays * longest;
    c.reflections = lobes ? kLobeReflections : (averaged >= kReflectedRays ? 1u : 0u);
    // With a limited number of bounces none: a reflection is a bounce more.
    if (settings.bounces) c.reflections = 0;
    c.reflectedLimit = light::reflectedLimit(averaged);
    c.inverseVoxelSize = 1.0f / frame.voxelSize;
    return c;
}

// Returns whether what was there is gone.
bool PixelRays::resize(int width, int height) {
    if (has(width, height)) return false;
    filtered_ = {};
    lobeList_ = {};
    for (Picture* picture : {&current_, &other_})
        *picture = {makePicture(width, height, kLabel[static_cast<int>(kind_)]), {}};
    return true;
}

void PixelRays::record(const PixelRayFrame& frame, const TracedSettings& settings, int rays, int passes,
                       StepRecorder& recorder) {
    resize(static_cast<int>(frame.view.width), static_cast<int>(frame.view.height));
    if (!constants_) constants_ = gl::Buffer(sizeof(gpu::PixelRayConstants), "pixel rays constants");
    bindPicture(current_.texture, PIXEL_UNIT_HISTORY);
    other_.texture.bindImage(0, 0, GL_WRITE_ONLY);
    const gl::Defines lights = hitDefines(kind_, frame, settings);
    for (int pass = 0; pass < passes; ++pass) {
        constants_.update(packed(frame, settings, rays, static_cast<std::uint32_t>(pass), passes));
        constants_.bindUniform(BINDING_PASS);
        recorder.record(frame.programs, gatherDesc(kind_, Reuse::None, false, false, lights),
                        1.0f / static_cast<float>(passes));
    }
}

void PixelRays::gather(const PixelRayFrame& frame, const TracedSettings& settings, Reuse reuse, int rays,
                       std::uint32_t pass, int longest) {
    const gl::PassScope scope(frame.profiler, kGatherPass[static_cast<int>(kind_)]);
    const int width = static_cast<int>(frame.view.width);
    const int height = static_cast<int>(frame.view.height);
    if (resize(width, height)) reuse = Reuse::None;
    if (!constants_) constants_ = gl::Buffer(sizeof(gpu::PixelRayConstants), "pixel rays constants");
    gpu::PixelRayConstants constants = packed(frame, settings, rays, pass, longest);
    PixelRectangle lobes;
    if (kind_ == RayPicture::Specular) lobes = lobeRectangle(frame, settings.specularLimit);
    constants.lobesX = static_cast<std::uint32_t>(lobes.lowest.x);
    constants.lobesY = static_cast<std::uint32_t>(lobes.lowest.y);
    constants_.update(constants);
    constants_.bindUniform(BINDING_PASS);
    if (frame.motion != nullptr) frame.motion->bindStorage(PIXEL_MOTION);
    bindPicture(current_.texture, PIXEL_UNIT_HISTORY);
    other_.texture.bindImage(0, 0, GL_WRITE_ONLY);
    const gl::Defines lights = hitDefines(kind_, frame, settings);
    const bool counts = frame.lookupCounters != nullptr;
    if (counts) frame.lookupCounters->bindStorage(LOOKUP_TABLE);
    const bool moving = frame.motion != nullptr;
    if (kind_ == RayPicture::Specular) {
        constexpr std::array<std::uint32_t, 4> kEmptyList{LOBE_GROUPS_X, 0, 1, 0};
        if (!lobeList_)
            lobeList_ = gl::Buffer(sizeof kEmptyList + std::size_t{4} * static_cast<std::size_t>(width) *
                                                           static_cast<std::size_t>(height),
                                   "pixels with lobes");
        lobeList_.update(kEmptyList);
        lobeList_.bindStorage(PIXEL_LOBE_LIST);
        const glm::ivec2 extent = lobes.end - lobes.lowest;
        if (extent.x > 0 && extent.y > 0) frame.programs.get(selectDesc()).dispatch(extent.x, extent.y);
        // Pixels that are not listed hold nothing.
        clearWritten(other_);
        other_.written = lobes;
        gl::barrier(gl::Access::ShaderStorage | gl::Access::Indirect);
        frame.programs.get(gatherDesc(kind_, reuse, moving, counts, lights, LobePixels::Listed))
            .dispatchIndirect(lobeList_);
    } else {
        frame.programs.get(gatherDesc(kind_, reuse, moving, counts, lights)).dispatch(width, height);
    }
    gl::barrier(gl::Access::TextureFetch | gl::Access::Update);
    std::swap(current_, other_);
    seenFrom_ = frame.view;
}

const gl::Texture& PixelRays::filtered(const PixelRayFrame& frame, int levels) {
    if (levels == 0) return current_.texture;
    const gl::PassScope scope(frame.profiler, "edge filter");
    const int width = current_.texture.width(), height = current_.texture.height();
    if (!filtered_.texture) filtered_ = {makePicture(width, height, "filtered picture"), {}};
    constants_.bindUniform(BINDING_PASS);
    // From level to level between two textures; the second is what gather() writes next, so its content is
    // free. An even number of levels ends there as well.
    const Picture* from = &current_;
    for (int level = 0; level < levels; ++level) {
        Picture* to = level % 2 == 0 ? &filtered_ : &other_;
        bindPicture(from->texture, PIXEL_UNIT_HISTORY);
        to->texture.bindImage(0, 0, GL_WRITE_ONLY);
        const bool lobes = kind_ == RayPicture::Specular;
        const gl::Program& filter = frame.programs.get(filterDesc(1 << level, lobes));
        if (lobes) {
            // Pixels that are not listed count for nothing.
            clearWritten(*to);
            to->written = current_.written;
            lobeList_.bindStorage(PIXEL_LOBE_LIST);
            filter.dispatchIndirect(lobeList_);
        } else {
            filter.dispatch(width, height);
        }
        gl::barrier(gl::Access::TextureFetch | gl::Access::Update);
        from = to;
    }
    return from->texture;
}

std::vector<gl::ProgramDesc> PixelRays::programDescs() {
    std::vector<gl::ProgramDesc> descs = {selectDesc()};
    const auto add = [&](RayPicture kind, Reuse reuse, bool motion) {
        const bool lobes = kind == RayPicture::Specular;
        for (gl::ProgramDesc& desc : light::hitLightVariants(
                 gatherDesc(kind, reuse, motion, false, {}, lobes ? LobePixels::Listed : LobePixels::All)))
            descs.push_back(std::move(desc));
    };
    for (const RayPicture kind : {RayPicture::Diffuse, RayPicture::Specular}) {
        for (const Reuse reuse : {Reuse::None, Reuse::SameView, Reuse::Reproject}) add(kind, reuse, false);
        add(kind, Reuse::Reproject, true);
        descs.push_back(gatherDesc(kind, Reuse::SameView, false, true, {{"EXACT_DIRECT", "0"}},
                                   kind == RayPicture::Specular ? LobePixels::Listed : LobePixels::All));
    }
    for (const Reuse reuse : {Reuse::None, Reuse::SameView, Reuse::Reproject})
        descs.push_back(gatherDesc(RayPicture::Occlusion, reuse, false, false, kNoHitLights));
    for (const RayPicture kind : {RayPicture::Diffuse, RayPicture::Specular})
        for (const gl::ProgramDesc& desc :
             light::hitLightVariants(gatherDesc(kind, Reuse::None, false, false, {})))
            descs.push_back(StepRecorder::variant(desc));
    descs.push_back(
        StepRecorder::variant(gatherDesc(RayPicture::Occlusion, Reuse::None, false, false, kNoHitLights)));
    // Mirrors that show triangles.
    const LobePixels listed = LobePixels::Listed;
    for (gl::ProgramDesc& desc : light::hitLightVariants(gatherDesc(
             RayPicture::Specular, Reuse::SameView, false, false, {{"TRIANGLE_HITS", "1"}}, listed)))
        descs.push_back(std::move(desc));
    descs.push_back(gatherDesc(RayPicture::Specular, Reuse::SameView, false, true,
                               {{"EXACT_DIRECT", "0"}, {"TRIANGLE_HITS", "1"}}, listed));
    descs.push_back(StepRecorder::variant(gatherDesc(RayPicture::Specular, Reuse::None, false, false,
                                                     {{"EXACT_DIRECT", "0"}, {"TRIANGLE_HITS", "1"}})));
    for (const int step : {1, 2, 4, 8})
        for (const bool specular : {false, true}) descs.push_back(filterDesc(step, specular));
    return descs;
}

}  // namespace conelight::gather

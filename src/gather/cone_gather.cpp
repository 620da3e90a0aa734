// SPDX-License-Identifier: MIT
#include "gather/cone_gather.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "gather/cone_set.h"
#include "gather/pixel_ray_key.h"
#include "gl/gl.h"
#include "gl/picture_pass.h"
#include "shared/cones.h"

namespace conelight::gather {
namespace {

static_assert(kMaxCones == MAX_CONES);

using Part = ConeGather::Part;

// What all cones ask of the volume.
struct VolumeKey {
    int blocks;
    OpacityModel opacity;
    bool octree = false;
    bool fractional = false;
    bool environment = false;  // cones see a picture behind all surfaces, not the constant sky alone

    gl::Defines defines() const {
        gl::Defines defines{{"DIRECTIONAL", blocks == 6 ? "1" : "0"},
                            {"AREA", opacity == OpacityModel::Area ? "1" : "0"},
                            {"OCTREE", octree ? "1" : "0"}};
        if (fractional) defines.emplace_back("FRACTIONAL", "1");
        if (environment) defines.emplace_back("ENVIRONMENT", "1");
        return defines;
    }

    static std::vector<VolumeKey> all() {
        std::vector<VolumeKey> keys;
        for (int bits = 0; bits < 8; ++bits)
            for (const int blocks : {1, 6})
                for (const OpacityModel opacity : {OpacityModel::Fog, OpacityModel::Area})
                    keys.push_back({blocks, opacity, (bits & 1) != 0, (bits & 2) != 0, (bits & 4) != 0});
        return keys;
    }
};

VolumeKey keyOf(const RadianceVolume& volume, OpacityModel opacity, bool fractional,
                const light::Lights& lights) {
    return {volume.layout().blocks, opacity, volume.isOctree(), fractional, lights.hasEnvironment()};
}

struct ConeKey {
    VolumeKey volume;
    Part part;
    bool counts = false;   // lookups
    bool records = false;  // steps of one pixel

    gl::ProgramDesc desc() const {
        const bool lobes = part == Part::Specular || part == Part::Coat;
        gl::ProgramDesc desc{{lobes ? "gather/cone_specular.comp.glsl" : "gather/cone_diffuse.comp.glsl"},
                             volume.defines()};
        for (auto& define : surfaceDefines(part == Part::Coat)) desc.defines.push_back(std::move(define));
        if (!lobes) desc.defines.emplace_back("OCCLUSION", part == Part::Occlusion ? "1" : "0");
        desc.defines.emplace_back("COUNT_LOOKUPS", counts ? "1" : "0");
        return records ? StepRecorder::variant(std::move(desc)) : desc;
    }
    static std::vector<ConeKey> all() {
        std::vector<ConeKey> keys;
        for (const VolumeKey& volume : VolumeKey::all())
            for (const Part part : {Part::Diffuse, Part::Specular, Part::Coat, Part::Occlusion}) {
                for (const bool counts : {false, true}) keys.push_back({volume, part, counts});
                if (part != Part::Coat) keys.push_back({volume, part, false, true});
            }
        return keys;
    }
};

gl::ProgramDesc bounceDesc(const VolumeKey& volume, bool corrected) {
    gl::ProgramDesc desc{{"gather/cone_bounce.comp.glsl"}, volume.defines()};
    if (corrected) desc.defines.emplace_back("CORRECTED", "1");
    return desc;
}

// Cones to lights see no sky.
std::vector<VolumeKey> shadowKeys() {
    std::vector<VolumeKey> keys;
    for (const VolumeKey& key : VolumeKey::all())
        if (!key.environment) keys.push_back(key);
    return keys;
}

const char* passName(Part part) {
    switch (part) {
        case Part::Diffuse:
            return "diffuse cones";
        case Part::Specular:
            return "specular cones";
        case Part::Coat:
            return "coat cones";
        case Part::Occlusion:
            break;
    }
    return "occlusion cones";
}

}  // namespace

ConeGather::ConeGather() : block_(sizeof(gpu::ConeConstants), "cone constants") {}

void ConeGather::configure(const ConesSettings& settings, const RadianceLayout& layout) {
    opacity_ = settings.opacity;
    fractional_ = settings.fractionalLevels;
    const float h = layout.grid.voxelSize;
    const glm::vec3 extent = glm::vec3(layout.grid.size) * h;
    const float longest = std::max({extent.x, extent.y, extent.z});

    gpu::ConeConstants constants{};
    constants.step = settings.step;
    constants.offset = settings.offset * h;
    // Twice the volume's diagonal is beyond its far side from wherever a surface is.
    constants.maxDistance = settings.maxDistance.resolve(2 * glm::length(glm::vec3(layout.size) * h));
    constants.shadowTan = std::tan(0.5f * settings.shadowAperture);
    constants.specularMinTan = std::tan(0.5f * settings.specularMinAperture);
    constants.occlusionDistance = settings.occlusionDistance.resolve(0.1f * longest);

    const std::vector<Cone> cones = coneSet(settings);
    constants.count = static_cast<std::uint32_t>(cones.size());
    for (std::size_t i = 0; i < cones.size(); ++i) {
        constants.cone[i] = glm::vec4(cones[i].direction, cones[i].weight / std::numbers::pi_v<float>);
        constants.aperture[i] = glm::vec4(cones[i].tanHalfAngle(), 0, 0, 0);
    }
    block_.update(constants);
}

gl::Inputs ConeGather::given(const ConeInputs& inputs, const gl::Texture& result) const {
    gl::Inputs given;
    given.add(inputs.pixels)
        .add(inputs.volume)
        .uniform("ConeBlock", block_)
        .image("result", result, gl::ImageUse::Write);
    return given;
}

base::Steps ConeGather::gatherInSteps(const gl::Device& device, const ConeInputs& inputs, Part part,
                                      const gl::Texture& result, const gl::Buffer* counters) const {
    gl::Inputs given = this->given(inputs, result);
    if (counters != nullptr) given.storage("LookupCounters", *counters);
    const ConeKey key{keyOf(inputs.volume, opacity_, fractional_, inputs.pixels.lights), part,
                      counters != nullptr};
    const gl::ProgramDesc desc = key.desc();
    const glm::ivec2 size(result.width(), result.height());
    co_await gl::dispatchPicture(device, {passName(part), desc, given, size});
}

void ConeGather::record(const gl::Device& device, const ConeInputs& inputs, Part part,
                        const gl::Texture& result, StepRecorder& recorder) const {
    const ConeKey key{keyOf(inputs.volume, opacity_, fractional_, inputs.pixels.lights), part, false, true};
    recorder.record(device, key.desc(), given(inputs, result));
}

void ConeGather::gatherBounce(const gl::Device& device, const BounceInputs& inputs,
                              const light::LitFaces& faces) const {
    const gl::PassScope pass(device.profiler, "bounce cones");
    gl::Inputs given;
    given.add(inputs.lights).add(inputs.volume).add(inputs.surface).add(faces).uniform("ConeBlock", block_);
    const bool corrected = inputs.corrections != nullptr;
    if (corrected) given.storage("FaceCorrectionTable", *inputs.corrections);
    device.get(bounceDesc(keyOf(inputs.volume, opacity_, fractional_, inputs.lights), corrected))
        .dispatchLinear(given, inputs.surface.mostFaces());
    gl::barrier(gl::Access::ShaderStorage | gl::Access::TextureFetch);
}

ConeShadows ConeGather::shadows(const RadianceVolume& volume) const {
    return {volume, block_,
            VolumeKey{volume.layout().blocks, opacity_, volume.isOctree(), fractional_}.defines()};
}

std::vector<gl::Defines> ConeGather::shadowDefines() {
    std::vector<gl::Defines> all;
    for (const VolumeKey& key : shadowKeys()) all.push_back(key.defines());
    return all;
}

std::vector<gl::ProgramDesc> ConeGather::programDescs() {
    std::vector<gl::ProgramDesc> descs;
    for (const ConeKey& key : ConeKey::all()) descs.push_back(key.desc());
    for (const VolumeKey& key : VolumeKey::all())
        for (const bool corrected : {false, true}) descs.push_back(bounceDesc(key, corrected));
    return descs;
}

}  // namespace conelight::gather

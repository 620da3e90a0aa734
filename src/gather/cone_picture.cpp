// SPDX-License-Identifier: MIT
#include "gather/cone_picture.h"

#include "gl/gl.h"
#include "gl/picture_pass.h"

namespace conelight::gather {
namespace {

constexpr const char* kCompose = "compose";

struct ComposeKey {
    PictureParts parts;
    bool caustics;  // with diffuse light

    gl::ProgramDesc desc() const {
        gl::ProgramDesc desc{{"gather/cone_compose.comp.glsl"},
                             {{"SHOW_DIRECT", parts.direct ? "1" : "0"},
                              {"SHOW_DIFFUSE", parts.diffuse ? "1" : "0"},
                              {"SHOW_SPECULAR", parts.specular ? "1" : "0"}}};
        if (caustics && parts.diffuse) desc.defines.emplace_back("CAUSTICS", "1");
        return desc;
    }
    static std::vector<ComposeKey> all() {
        std::vector<ComposeKey> keys;
        for (int bits = 0; bits < 16; ++bits)
            if ((bits & 2) != 0 || (bits & 8) == 0)
                keys.push_back({{(bits & 1) != 0, (bits & 2) != 0, (bits & 4) != 0}, (bits & 8) != 0});
        return keys;
    }
};

gl::ProgramDesc coneOcclusionDesc() { return {{"gather/cone_occlusion.comp.glsl"}, {}}; }

const gl::Texture& resized(gl::Texture& picture, const view::Surfaces& surfaces, const char* label) {
    if (!picture || picture.width() != surfaces.width() || picture.height() != surfaces.height()) {
        picture = {};
        picture = gl::Texture({GL_TEXTURE_2D, GL_RGBA16F, surfaces.width(), surfaces.height()}, label);
    }
    return picture;
}

}  // namespace

PictureParts ConePicture::partsOf(const Settings& settings) {
    const PictureParts parts = gather::partsOf(settings.component);
    const bool gathers = settings.cones.bounces > 0;
    return {parts.direct, parts.diffuse && gathers, parts.specular && gathers};
}

base::Steps ConePicture::drawOcclusion(const gl::Device& device, const DirectInputs& pixels,
                                       const ConeVolume& volume, Target target) {
    const gl::Texture& open = resized(diffuse_, pixels.surfaces, "gathered diffuse");
    const ConeInputs inputs{pixels, volume.volume()};
    co_await volume.cones().gatherInSteps(device, inputs, ConeGather::Part::Occlusion, open,
                                          target.lookupCounters);
    gl::barrier(gl::Access::TextureFetch);
    gl::Inputs given;
    given.add(pixels).texture("occlusion", open).image("result", target.output, gl::ImageUse::Write);
    const gl::ProgramDesc desc = coneOcclusionDesc();
    const glm::ivec2 size(open.width(), open.height());
    co_await gl::dispatchPicture(device, {kCompose, desc, given, size});
}

base::Steps ConePicture::drawInSteps(const gl::Device& device, const DirectInputs& pixels,
                                     const ConeVolume& volume, PictureParts parts, Target target) {
    const ConeInputs inputs{pixels, volume.volume()};
    gl::Inputs given;
    given.add(pixels).image("result", target.output, gl::ImageUse::Write);
    if (parts.direct) {
        const ConeShadows shadows = volume.cones().shadows(volume.volume());
        co_await direct_.drawInSteps(device, pixels, volume.shadowsByCones() ? &shadows : nullptr);
        given.texture("directDiffuse", direct_.diffuse()).texture("directSpecular", direct_.specular());
    }
    if (parts.diffuse && target.diffuse != nullptr) {
        given.texture("diffuseIrradiance", *target.diffuse);
    } else if (parts.diffuse) {
        const gl::Texture& picture = resized(diffuse_, pixels.surfaces, "gathered diffuse");
        co_await volume.cones().gatherInSteps(device, inputs, ConeGather::Part::Diffuse, picture,
                                              target.lookupCounters);
        given.texture("diffuseIrradiance", picture);
    }
    if (parts.specular) {
        const gl::Texture& picture = resized(specular_, pixels.surfaces, "gathered specular");
        co_await volume.cones().gatherInSteps(device, inputs, ConeGather::Part::Specular, picture,
                                              target.lookupCounters);
        given.texture("specularRadiance", picture);
    }
    gl::barrier(gl::Access::TextureFetch);
    const gl::ProgramDesc desc = ComposeKey{parts, pixels.lights.hasCaustics()}.desc();
    const glm::ivec2 size(pixels.surfaces.width(), pixels.surfaces.height());
    co_await gl::dispatchPicture(device, {kCompose, desc, given, size});
    if (pixels.surfaces.haveLayers()) co_await drawLayers(device, inputs, volume, parts, target);
}

// Coat and sheen on top. Their direct light is in the shadow of maps.
base::Steps ConePicture::drawLayers(const gl::Device& device, const ConeInputs& inputs,
                                    const ConeVolume& volume, PictureParts parts, Target target) {
    const ConeGather& cones = volume.cones();
    LayerShade::Wanted wanted{.parts = parts};
    if (parts.specular) {
        const view::Surfaces& surfaces = inputs.pixels.surfaces;
        const gl::Texture& coat = resized(coat_, surfaces, "gathered coat");
        co_await cones.gatherInSteps(device, inputs, ConeGather::Part::Coat, coat, target.lookupCounters);
        wanted.gathered.coneLobe = &coat;
        wanted.gathered.coneIrradiance = target.diffuse;
        if (target.diffuse == nullptr) {
            const gl::Texture& diffuse = resized(diffuse_, surfaces, "gathered diffuse");
            if (!parts.diffuse)
                co_await cones.gatherInSteps(device, inputs, ConeGather::Part::Diffuse, diffuse,
                                             target.lookupCounters);
            wanted.gathered.coneIrradiance = &diffuse;
        }
        gl::barrier(gl::Access::TextureFetch);
    }
    co_await layers_.drawInSteps(device, inputs.pixels, wanted, target.output);
}

void ConePicture::record(const gl::Device& device, const DirectInputs& pixels, const ConeVolume& volume,
                         ConeGather::Part part, StepRecorder& recorder) {
    const gl::Texture& picture = resized(diffuse_, pixels.surfaces, "gathered diffuse");
    volume.cones().record(device, {pixels, volume.volume()}, part, picture, recorder);
}

std::vector<gl::ProgramDesc> ConePicture::programDescs() {
    std::vector<gl::ProgramDesc> descs = {coneOcclusionDesc()};
    for (const ComposeKey& key : ComposeKey::all()) descs.push_back(key.desc());
    for (const auto& more : {ConeGather::programDescs(), DirectLight::programDescs(),
                             LayerShade::programDescs(), DirectLight::coneDescs(ConeGather::shadowDefines())})
        descs.insert(descs.end(), more.begin(), more.end());
    return descs;
}

}  // namespace conelight::gather

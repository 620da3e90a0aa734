// SPDX-License-Identifier: MIT
#include "gather/layer_shade.h"

#include <algorithm>
#include <array>

#include "gather/pixel_lights.h"
#include "gl/gl.h"
#include "gl/pace.h"
#include "math/sheen.h"
#include "view/layer_picture.h"

namespace conelight::gather {
namespace {

constexpr const char* kLayersPass = "coat and sheen";
constexpr float kNearestPart = 1e-6f;  // of the scene's extent; corners nearer than that are behind the eye
constexpr std::array<std::uint32_t, 5> kEmptyLayerList{LOBE_GROUPS_X, 0, 1, 0, 0};

gl::ProgramDesc layerSelectDesc() { return {{"gather/layer_select.comp.glsl"}, {}}; }

bool anySheen(const scene::GpuScene& scene) {
    return std::any_of(scene.materials().begin(), scene.materials().end(),
                       [](const gpu::Material& m) { return m.sheenColor != glm::vec3(0); });
}

gl::Texture makeSheenTable() {
    gl::Texture table({GL_TEXTURE_2D, GL_R32F, math::kSheenTableEdge, math::kSheenTableEdge, 1, 1},
                      "sheen table");
    table.upload(0, GL_RED, GL_FLOAT, math::sheenTable().data());
    for (const auto filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
        table.parameter(filter, GL_LINEAR);
    for (const auto wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T}) table.parameter(wrap, GL_CLAMP_TO_EDGE);
    return table;
}

}  // namespace

struct LayerShade::Key {
    bool direct = false, specular = false;
    int irradiance = 0, lobe = 0;  // as the shader has them
    bool sheen = false;
    light::LightKey lights;   // of direct light
    bool visibility = false;  // of lights without extent, from a picture

    gl::ProgramDesc desc() const {
        const auto number = [](int value) { return std::to_string(value); };
        gl::ProgramDesc desc{{"gather/layer_shade.comp.glsl"},
                             {{"SHOW_DIRECT", number(direct)},
                              {"SHOW_SPECULAR", number(specular)},
                              {"IRRADIANCE", number(specular ? irradiance : 0)},
                              {"LOBE", number(specular ? lobe : 0)},
                              {"SHEEN", number(sheen)}}};
        if (visibility) desc.defines.emplace_back("VISIBILITY_PICTURE", "1");
        if (direct)
            for (auto& define : lights.defines()) desc.defines.push_back(std::move(define));
        return desc;
    }

    static std::vector<Key> all() {
        std::vector<Key> keys;
        for (const bool sheen : {false, true}) {
            keys.push_back({.sheen = sheen});
            std::vector<Key> gathers = {{.specular = true}};
            for (const auto& [irradiance, lobe] : {std::pair{0, 1}, {1, 0}, {1, 1}, {2, 2}})
                gathers.push_back({.specular = true, .irradiance = irradiance, .lobe = lobe});
            for (Key& key : gathers) key.sheen = sheen;
            keys.insert(keys.end(), gathers.begin(), gathers.end());
            gathers.push_back({.sheen = sheen});
            for (const light::LightKey& lights : light::LightKey::ofPixels())
                for (Key key : gathers) {
                    key.direct = true;
                    key.lights = lights;
                    keys.push_back(key);
                    if (!lights.hasSharpShadows() || key.irradiance == 2) continue;
                    key.visibility = true;
                    keys.push_back(key);
                }
        }
        return keys;
    }
};

// Lists the pixels that have layers, in the rectangle of instances that do.
const gl::Buffer& LayerShade::listPixels(const gl::Device& device, const DirectInputs& inputs,
                                         const gl::Inputs& given, const gl::Texture& output) {
    const gl::PassScope scope(device.profiler, kLayersPass);
    const float nearest = kNearestPart * glm::length(inputs.scene.bounds().extent());
    const PixelRectangle where =
        rectangleOf(inputs.surfaces, inputs.scene, nearest,
                    [&](const gpu::Instance& one) { return view::isLayered(inputs.scene, one); });
    const std::size_t pixels =
        static_cast<std::size_t>(output.width()) * static_cast<std::size_t>(output.height());
    if (listedPixels_ != pixels)
        list_ = gl::Buffer(sizeof kEmptyLayerList + 4 * pixels, "pixels with layers");
    listedPixels_ = pixels;
    list_.update(kEmptyLayerList);
    gpu::PixelRayConstants constants{};
    constants.lowestX = static_cast<std::uint32_t>(where.lowest.x);
    constants.lowestY = static_cast<std::uint32_t>(where.lowest.y);
    constants_.update(constants);
    gl::Inputs selecting = given;
    selecting.storage("LobeList", list_);
    const glm::ivec2 extent = where.end - where.lowest;
    if (extent.x > 0 && extent.y > 0) device.get(layerSelectDesc()).dispatch(selecting, extent.x, extent.y);
    gl::barrier(gl::Access::ShaderStorage | gl::Access::Indirect | gl::Access::Update);
    return list_;
}

base::Steps LayerShade::drawInSteps(const gl::Device& device, const DirectInputs& inputs,
                                    const Wanted& wanted, const gl::Texture& output) {
    if (!inputs.surfaces.haveLayers()) co_return;
    if (!constants_) constants_ = gl::Buffer(sizeof(gpu::PixelRayConstants), "layer constants");
    gl::Inputs given;
    if (wanted.rays != nullptr)
        given.add(*wanted.rays);
    else
        given.add(inputs);
    given.uniform("PixelRayBlock", constants_);
    listPixels(device, inputs, given, output);
    gpu::PixelRayConstants constants{};
    constants.specularLimit = wanted.specularLimit;
    constants_.update(constants);

    const Gathered& gathered = wanted.gathered;
    Key key{
        .direct = wanted.parts.direct,
        .specular = wanted.parts.specular,
        .irradiance = gathered.coneIrradiance != nullptr ? 2 : (gathered.irradiance != nullptr ? 1 : 0),
        .lobe = gathered.coneLobe != nullptr ? 2 : (gathered.lobe != nullptr ? 1 : 0),
        .sheen = anySheen(inputs.scene),
        .lights = wanted.parts.direct ? lightsOfPixels(inputs.lights, inputs.surfaces) : light::LightKey{},
        .visibility = wanted.parts.direct && wanted.visibility != nullptr};
    if (key.sheen && !sheenTable_) sheenTable_ = makeSheenTable();
    given.storage("LobeList", list_).image("result", output, gl::ImageUse::ReadWrite);
    if (key.sheen) given.texture("sheenTable", sheenTable_);
    if (gathered.irradiance != nullptr) given.texture("irradiancePicture", *gathered.irradiance);
    if (gathered.lobe != nullptr) given.texture("lobePicture", *gathered.lobe);
    if (gathered.coneIrradiance != nullptr) given.texture("diffuseIrradiance", *gathered.coneIrradiance);
    if (gathered.coneLobe != nullptr) given.texture("specularRadiance", *gathered.coneLobe);
    if (key.visibility) given.texture("visibilityPicture", *wanted.visibility);
    gl::barrier(gl::Access::ImageAccess | gl::Access::TextureFetch);
    const gl::ProgramDesc desc = key.desc();
    co_await dispatchListed(device, {kLayersPass, desc, given, list_});
    gl::barrier(gl::Access::TextureFetch | gl::Access::ImageAccess | gl::Access::Framebuffer);
}

std::vector<gl::ProgramDesc> LayerShade::programDescs() {
    std::vector<gl::ProgramDesc> descs = {layerSelectDesc()};
    for (const Key& key : Key::all()) descs.push_back(key.desc());
    return descs;
}

}  // namespace conelight::gather

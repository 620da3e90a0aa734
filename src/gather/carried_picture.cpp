// SPDX-License-Identifier: MIT
#include "gather/carried_picture.h"

namespace conelight::gather {
namespace {

struct CarryKey {
    bool lobes, cached, coats;
    gl::ProgramDesc desc() const {
        gl::ProgramDesc desc{{"gather/carry.comp.glsl"},
                             {{"LOBES", lobes ? "1" : "0"}, {"CACHED", cached ? "1" : "0"}}};
        for (auto& define : surfaceDefines(coats)) desc.defines.push_back(std::move(define));
        return desc;
    }
    static std::vector<CarryKey> all() {
        return {{false, true, false}, {true, true, false}, {true, true, true}, {false, false, false}};
    }
};

}  // namespace

const gl::Texture& CarriedPicture::carry(const gl::Device& device, const RayInputs& inputs,
                                         const From& from) {
    const gl::PassScope pass(device.profiler, "carry to view");
    const glm::ivec2 size(inputs.surfaces.width(), inputs.surfaces.height());
    if (!texture_ || texture_.width() != size.x || texture_.height() != size.y)
        texture_ = makePixelPicture(size.x, size.y, "carried picture");
    if (!constants_) constants_ = gl::Buffer(sizeof(gpu::PixelRayConstants), "carry constants");
    const bool sameSize = size == glm::ivec2(from.picture.width(), from.picture.height());
    const PixelRectangle where =
        from.lobes != nullptr && sameSize ? *from.lobes : PixelRectangle{glm::ivec2(0), size};
    gpu::PixelRayConstants constants{};
    setPictureSoFar(constants, from.view, inputs.voxels.grid());
    constants.reuse = REUSE_REPROJECTED;
    constants.specularLimit = from.specularLimit;
    constants.lowestX = static_cast<std::uint32_t>(where.lowest.x);
    constants.lowestY = static_cast<std::uint32_t>(where.lowest.y);
    constants_.update(constants);
    gl::Inputs given;
    given.add(inputs)
        .uniform("PixelRayBlock", constants_)
        .texture("pixelHistory", from.picture)
        .image("result", texture_, gl::ImageUse::Write);
    const glm::ivec2 extent = where.end - where.lowest;
    if (extent.x > 0 && extent.y > 0)
        device.get(CarryKey{from.lobes != nullptr, from.cached, from.coats}.desc())
            .dispatch(given, extent.x, extent.y);
    gl::barrier(gl::Access::TextureFetch | gl::Access::Update);
    return texture_;
}

std::vector<gl::ProgramDesc> CarriedPicture::programDescs() {
    std::vector<gl::ProgramDesc> descs;
    for (const CarryKey& key : CarryKey::all()) descs.push_back(key.desc());
    return descs;
}

}  // namespace conelight::gather

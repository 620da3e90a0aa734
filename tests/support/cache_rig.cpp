// SPDX-License-Identifier: MIT
#include "support/cache_rig.h"

#include <bit>
#include <glm/gtc/packing.hpp>

#include "light/emissive_quads.h"
#include "light/inject_light.h"
#include "math/octahedral.h"
#include "shared/bindings.h"
#include "shared/irradiance.h"
#include "view/camera.h"
#include "voxels/voxel_record.h"

namespace conelight::test {

CacheRig::CacheRig(gl::ProgramLibrary& library, const Scene& from, int voxels)
    : programs(library), source(from), scene(source), frameBlock(sizeof(gpu::FrameConstants), "frame") {
    voxelSettings.size = voxels;
    voxelize();
    relight();
}

void CacheRig::voxelize() {
    cache.beforeVoxelize(profiler, surface);
    surface.build(programs, profiler, scene, voxelSettings);
    octants.build(programs, profiler, surface);
    emissionFit.known = false;
    cache.afterVoxelize(programs, profiler, surface);
}

void CacheRig::relight() {
    light::setEmissiveQuads(scene, source, light.emissiveQuads);
    scene.bind();
    shadows.update(programs, profiler, scene, light);
    frameBlock.update(view::frameConstants(frameCamera(scene.bounds()), 8, 8, scene, source.sky, 0, 1));
    frameBlock.bindUniform(BINDING_FRAME);
    scene.bind();
    shadows.bind();
    octants.bind();
    light::injectLight(programs, profiler, scene, light, surface, &surface.secondFaceScratch(), &emissionFit);
    cache.lightChanged();
}

void CacheRig::update(int passes) {
    frameBlock.bindUniform(BINDING_FRAME);
    scene.bind();
    shadows.bind();
    surface.bind();
    octants.bind();
    cache.update(programs, profiler, scene, light, surface, settings, passes);
}

std::vector<CachedFace> CacheRig::faces() const {
    const auto records = surface.faces().read<gpu::FaceRecord>(surface.faceCount());
    const auto sources = surface.faceSources().read<std::uint32_t>(2 * std::size_t{surface.faceCount()});
    const float h = surface.grid().voxelSize;
    std::vector<CachedFace> faces;
    for (std::size_t i = 0; i < records.size(); ++i) {
        const gpu::FaceRecord& r = records[i];
        CachedFace face;
        face.normal = math::octDecode(math::unpackSnorm2x16(r.normal));
        face.position =
            surface.grid().worldFromGrid(glm::vec3(voxels::unpackVoxel(r.voxel & 0x3fffffffu)) + 0.5f +
                                         face.normal * voxels::unpackOffset(r.offsetWeight));
        face.albedo = voxels::unpackAlbedo(r.albedo);
        face.radiance = voxels::unpackRgb9e5(r.radiance);
        const glm::vec2 rg = glm::unpackHalf2x16(r.irradiance0), b = glm::unpackHalf2x16(r.irradiance1);
        face.irradiance = {rg.x, rg.y, b.x};
        face.area = voxels::unpackArea({sources[2 * i], sources[2 * i + 1]}) * h * h;
        face.dead = (r.irradiance1 & FACE_DEAD) != 0;
        faces.push_back(face);
    }
    return faces;
}

double CacheRig::mean(const std::function<double(const CachedFace&)>& f,
                      const std::function<bool(const CachedFace&)>& counts) const {
    double sum = 0, area = 0;
    for (const CachedFace& face : faces()) {
        if (face.dead || (counts && !counts(face))) continue;
        sum += f(face) * static_cast<double>(face.area);
        area += static_cast<double>(face.area);
    }
    return area > 0 ? sum / area : 0;
}

double CacheRig::meanIrradiance() const {
    return mean([](const CachedFace& f) {
        return static_cast<double>(f.irradiance.x + f.irradiance.y + f.irradiance.z) / 3;
    });
}

}  // namespace conelight::test

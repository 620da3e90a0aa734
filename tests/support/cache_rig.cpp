// SPDX-License-Identifier: MIT
#include "support/cache_rig.h"

#include <bit>
#include <glm/gtc/packing.hpp>

#include "gl/gl.h"
#include "light/inject_light.h"
#include "math/octahedral.h"
#include "shared/irradiance.h"
#include "voxels/voxel_record.h"

namespace conelight::test {

CacheRig::CacheRig(gl::ProgramLibrary& library, const Scene& from, int voxelSize)
    : device{library, profiler}, scene(from), surface(voxels.surface()) {
    voxelSettings.size = voxelSize;
    light.smallLamps = false;  // what shines does so by its voxels, unless a test asks
    voxelize();
    relight();
}

void CacheRig::voxelize() {
    voxels.build(device, scene, voxelSettings, voxels::Rays::Yes);
    cache.adopt(device, voxels);
    const std::size_t bytes = std::size_t{4} * surface.faceCount();
    if (directLight.bytes() >= bytes) return;
    directTexels = {};
    directLight = gl::Buffer(bytes, "direct light");
    directTexels = gl::Texture(directLight, GL_R32UI, "direct light");
}

void CacheRig::relight() {
    lights.update(device, scene,
                  {.settings = light, .emissiveQuads = light.emissiveQuads, .smallLamps = light.smallLamps});
    const bool fits = light::hasOtherEmitters(scene, lights);
    if (fits) fit.update(device, this->scene, voxels);
    const light::RayLight rays{directLight, fits ? &fit : nullptr};
    light::injectLight(device, {scene, lights, surface}, lit, &rays);
    cache.restartAverages();
}

void CacheRig::update(int passes) {
    cache.update(device, {scene, lights, voxels, directTexels, lit}, settings, passes);
}

std::vector<CachedFace> CacheRig::faces() const {
    const auto records = surface.faces().read<gpu::FaceRecord>(surface.faceCount());
    const auto materials = surface.faceMaterials().read<gpu::FaceMaterial>(surface.faceCount());
    const auto litFaces = lit.buffer().read<gpu::LitFace>(surface.faceCount());
    const auto shown = cache.atPixels().read<glm::uvec2>(surface.faceCount());
    const float h = surface.grid().voxelSize;
    std::vector<CachedFace> faces;
    for (std::size_t i = 0; i < records.size(); ++i) {
        const gpu::FaceRecord& r = records[i];
        const gpu::LitFace& l = litFaces[i];
        CachedFace face;
        face.normal = math::octDecode(math::unpackSnorm2x16(r.normal));
        face.position =
            surface.grid().worldFromGrid(glm::vec3(voxels::unpackVoxel(r.voxel & 0x3fffffffu)) + 0.5f +
                                         face.normal * voxels::unpackOffset(r.offsetWeight));
        face.albedo = voxels::unpackAlbedo(l.albedo);
        face.radiance = voxels::unpackRgb9e5(l.radiance);
        const glm::vec2 rg = glm::unpackHalf2x16(l.irradiance0), b = glm::unpackHalf2x16(l.irradiance1);
        face.irradiance = {rg.x, rg.y, b.x};
        face.atPixels = {glm::unpackHalf2x16(shown[i].x), glm::unpackHalf2x16(shown[i].y).x};
        face.area = voxels::unpackArea(materials[i]) * h * h;
        face.dead = (l.irradiance1 & FACE_INTERIOR) != 0;
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

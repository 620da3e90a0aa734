// SPDX-License-Identifier: MIT
#include "voxels/surface_keys.h"

namespace conelight::voxels {
namespace {

const char* flag(bool on) { return on ? "1" : "0"; }

gl::ProgramDesc shader(const char* name, gl::Defines defines = {}) {
    return {{std::string("voxels/") + name + ".comp.glsl"}, std::move(defines)};
}

gl::Defines with(gl::Defines defines, const char* name, bool on) {
    defines.emplace_back(name, flag(on));
    return defines;
}

template <class Key>
void addAll(std::vector<gl::ProgramDesc>& descs) {
    for (const Key& key : Key::all()) descs.push_back(key.desc());
}

}  // namespace

gl::ProgramDesc SurfaceCountKey::desc() const {
    return shader("surface_count", {{"OF_BRICKS", flag(ofBricks)}});
}

gl::ProgramDesc SurfaceScanKey::desc() const {
    return shader("surface_scan", {{"STEP", std::to_string(static_cast<int>(counted))}});
}

gl::ProgramDesc SurfaceMarkKey::desc() const {
    const char* const name = pass == Pass::Setup   ? "surface_setup"
                             : pass == Pass::Tiles ? "surface_tiles"
                                                   : "surface_faces";
    return shader(name, {{"SURFACE_UPDATE", flag(update)}});
}

std::vector<SurfaceMarkKey> SurfaceMarkKey::all() {
    std::vector<SurfaceMarkKey> keys;
    for (const Pass pass : {Pass::Setup, Pass::Tiles, Pass::Faces})
        for (const bool update : {false, true}) keys.push_back({pass, update});
    return keys;
}

gl::Defines SurfaceMaterialKey::defines() const {
    return {{"SURFACE_EMISSION", flag(emission)}, {"SURFACE_LOBES", flag(lobes)}};
}

gl::ProgramDesc SurfaceClipKey::desc() const {
    gl::Defines defines = material.defines();
    defines.insert(defines.begin(), {"SURFACE_DETAIL", std::to_string(detail)});
    return shader("surface_clip", with(std::move(defines), "SURFACE_UPDATE", update));
}

std::vector<SurfaceClipKey> SurfaceClipKey::all() {
    std::vector<SurfaceClipKey> keys;
    // Only the pass with textures evaluates more than a colour, which lobes need.
    for (const SurfaceMaterialKey& material : SurfaceMaterialKey::all())
        for (int detail = material.lobes ? 1 : 0; detail < 3; ++detail)
            for (const bool update : {false, true}) keys.push_back({detail, material, update});
    return keys;
}

gl::ProgramDesc SurfaceResolveKey::desc() const {
    return shader("surface_resolve", with(material.defines(), "SURFACE_UPDATE", update));
}

std::vector<SurfaceResolveKey> SurfaceResolveKey::all() {
    std::vector<SurfaceResolveKey> keys;
    for (const SurfaceMaterialKey& material : SurfaceMaterialKey::all())
        for (const bool update : {false, true}) keys.push_back({material, update});
    return keys;
}

gl::ProgramDesc SurfaceLayersKey::desc() const {
    return shader("surface_layers", with(material.defines(), "SURFACE_ONLY_WIDE", onlyWide));
}

std::vector<SurfaceLayersKey> SurfaceLayersKey::all() {
    std::vector<SurfaceLayersKey> keys;
    for (const SurfaceMaterialKey& material : SurfaceMaterialKey::all())
        for (const bool onlyWide : {false, true}) keys.push_back({material, onlyWide});
    return keys;
}

gl::ProgramDesc descOf(SurfacePass pass) {
    constexpr const char* kNames[] = {"surface_bricks", "surface_carry", "surface_copy", "surface_drop",
                                      "surface_shift"};
    return shader(kNames[static_cast<int>(pass)]);
}

std::vector<gl::ProgramDesc> surfaceProgramDescs() {
    std::vector<gl::ProgramDesc> descs;
    for (const SurfacePass pass :
         {SurfacePass::Bricks, SurfacePass::Carry, SurfacePass::Copy, SurfacePass::Drop, SurfacePass::Shift})
        descs.push_back(descOf(pass));
    addAll<SurfaceCountKey>(descs);
    addAll<SurfaceScanKey>(descs);
    addAll<SurfaceMarkKey>(descs);
    addAll<SurfaceClipKey>(descs);
    addAll<SurfaceResolveKey>(descs);
    addAll<SurfaceLayersKey>(descs);
    return descs;
}

}  // namespace conelight::voxels

// SPDX-License-Identifier: MIT
// Light fields for C, in the caller's context.
#include "conelight/light_field.h"

#include <memory>
#include <vector>

#include "changes.h"
#include "settings.h"
#include "structs.h"

using namespace conelight;
using c::guarded;
using c::need;

struct conelight_light_field {
    std::unique_ptr<LightField> field;
    mutable std::vector<PassStats> passes;  // as the last _get_stats found them
};

namespace {

// A field during a call.
class Use {
  public:
    explicit Use(const conelight_light_field* field) : field_(*need(field, "field").field) {}
    LightField* operator->() const { return &field_; }

  private:
    LightField& field_;
};

NormalEncoding encodingOf(std::int32_t value) {
    constexpr auto kLast = static_cast<std::int32_t>(NormalEncoding::Octahedral);
    if (value < 0 || value > kLast)
        c::failUsage("surfaces.normal_encoding: " + std::to_string(value) + "; 0 to " +
                     std::to_string(kLast) + " would be right");
    return static_cast<NormalEncoding>(value);
}

HostSurfaces surfacesOf(const conelight_surfaces& values) {
    HostSurfaces surfaces;
    surfaces.width = values.width;
    surfaces.height = values.height;
    surfaces.viewFromWorld = c::matrixOf(values.view_from_world);
    surfaces.clipFromView = c::matrixOf(values.clip_from_view);
    surfaces.clipDepthZeroToOne = values.clip_depth_zero_to_one != 0;
    surfaces.depth = values.depth;
    surfaces.background = values.background;
    surfaces.normal = values.normal;
    surfaces.geometricNormal = values.geometric_normal;
    surfaces.normalEncoding = encodingOf(values.normal_encoding);
    surfaces.roughness = values.roughness;
    surfaces.roughnessChannel = values.roughness_channel;
    surfaces.reflectance = values.reflectance;
    surfaces.instances = values.instances;
    surfaces.motion = values.motion;
    surfaces.motionScale = {values.motion_scale[0], values.motion_scale[1]};
    return surfaces;
}

}  // namespace

conelight_result conelight_light_field_create(const char* shader_directory, conelight_light_field** field) {
    return guarded([&] {
        need(field, "field");
        RendererOptions options;
        options.shaderDirectory = c::textOf(shader_directory);
        auto made = std::make_unique<conelight_light_field>();
        made->field = std::make_unique<LightField>(options);
        *field = made.release();
    });
}

void conelight_light_field_destroy(conelight_light_field* field) { delete field; }

conelight_result conelight_light_field_set_scene(conelight_light_field* field, const conelight_scene* scene) {
    return c::setScene<Use>(field, scene);
}

conelight_result conelight_light_field_set_transform(conelight_light_field* field, size_t instance,
                                                     const float world_from_object[16]) {
    return c::setTransform<Use>(field, instance, world_from_object);
}

conelight_result conelight_light_field_set_instance(conelight_light_field* field, size_t index,
                                                    const conelight_instance* instance) {
    return c::setInstance<Use>(field, index, instance);
}

conelight_result conelight_light_field_set_mesh(conelight_light_field* field, size_t index,
                                                const conelight_mesh* mesh) {
    return c::setMesh<Use>(field, index, mesh);
}

conelight_result conelight_light_field_set_host_mesh(conelight_light_field* field, size_t index,
                                                     const conelight_host_mesh* mesh) {
    return c::setHostMesh<Use>(field, index, mesh);
}

conelight_result conelight_light_field_set_host_texture(conelight_light_field* field, size_t index,
                                                        const conelight_host_texture* texture) {
    return c::setHostTexture<Use>(field, index, texture);
}

conelight_result conelight_light_field_set_texture(conelight_light_field* field, size_t index,
                                                   const conelight_texture* texture) {
    return c::setTexture<Use>(field, index, texture);
}

conelight_result conelight_light_field_set_material(conelight_light_field* field, size_t index,
                                                    const conelight_material* material) {
    return c::setMaterial<Use>(field, index, material);
}

conelight_result conelight_light_field_set_light(conelight_light_field* field, size_t index,
                                                 const conelight_light* light) {
    return c::setLight<Use>(field, index, light);
}

conelight_result conelight_light_field_set_lights(conelight_light_field* field,
                                                  const conelight_scene* scene) {
    return c::setLights<Use>(field, scene);
}

conelight_result conelight_light_field_set_sky(conelight_light_field* field, const float radiance[3]) {
    return c::setSky<Use>(field, radiance);
}

conelight_result conelight_light_field_set_environment(conelight_light_field* field,
                                                       const conelight_scene* scene) {
    return c::setEnvironment<Use>(field, scene);
}

conelight_result conelight_light_field_add_mesh(conelight_light_field* field, const conelight_mesh* mesh,
                                                int32_t* index) {
    return c::addMesh<Use>(field, mesh, index);
}

conelight_result conelight_light_field_add_host_mesh(conelight_light_field* field,
                                                     const conelight_host_mesh* mesh, int32_t* index) {
    return c::addHostMesh<Use>(field, mesh, index);
}

conelight_result conelight_light_field_add_host_texture(conelight_light_field* field,
                                                        const conelight_host_texture* texture,
                                                        int32_t* index) {
    return c::addHostTexture<Use>(field, texture, index);
}

conelight_result conelight_light_field_add_texture(conelight_light_field* field,
                                                   const conelight_texture* texture, int32_t* index) {
    return c::addTexture<Use>(field, texture, index);
}

conelight_result conelight_light_field_add_material(conelight_light_field* field,
                                                    const conelight_material* material, int32_t* index) {
    return c::addMaterial<Use>(field, material, index);
}

conelight_result conelight_light_field_add_instance(conelight_light_field* field,
                                                    const conelight_instance* instance, int32_t* index) {
    return c::addInstance<Use>(field, instance, index);
}

conelight_result conelight_light_field_remove_instance(conelight_light_field* field, size_t index) {
    return c::removeInstance<Use>(field, index);
}

conelight_result conelight_light_field_remove_mesh(conelight_light_field* field, size_t index) {
    return c::removeMesh<Use>(field, index);
}

conelight_result conelight_light_field_set_region(conelight_light_field* field, const float low[3],
                                                  const float high[3]) {
    return c::setRegion<Use>(field, low, high);
}

conelight_result conelight_light_field_set_settings(conelight_light_field* field,
                                                    const conelight_settings* settings) {
    return guarded([&] {
        const Use use(field);
        use->setSettings(need(settings, "settings").settings);
    });
}

conelight_result conelight_light_field_update(conelight_light_field* field, const conelight_budget* budget,
                                              int32_t* updates) {
    return guarded([&] {
        const Use use(field);
        LightBudget spent;
        if (budget != nullptr) {
            const conelight_budget& given = c::readStruct(budget, "budget");
            spent = {given.updates, given.faces, given.milliseconds};
        }
        const int had = use->update(spent);
        if (updates != nullptr) *updates = had;
    });
}

conelight_result conelight_light_field_add_view(conelight_light_field* field, int32_t* view) {
    return guarded([&] {
        const Use use(field);
        need(view, "view") = use->addView();
    });
}

conelight_result conelight_light_field_remove_view(conelight_light_field* field, int32_t view) {
    return guarded([&] { Use(field)->removeView(view); });
}

conelight_result conelight_light_field_gather(conelight_light_field* field, int32_t view,
                                              const conelight_surfaces* surfaces, int32_t reduction,
                                              conelight_gathered* gathered) {
    return guarded([&] {
        const Use use(field);
        c::readStruct(gathered, "gathered");
        const HostSurfaces seen = surfacesOf(c::readStruct(surfaces, "surfaces"));
        const GatheredLight light = use->gather(view, seen, {reduction});
        c::writeStruct(gathered,
                       conelight_gathered{0, light.diffuse, light.specular, light.width, light.height},
                       "gathered");
    });
}

conelight_result conelight_lookups_glsl(int32_t first_block, int32_t first_texture, const char** text) {
    return guarded([&] {
        static thread_local std::string kept;
        need(text, "text");
        kept = lookupsGlsl({first_block, first_texture});
        *text = kept.c_str();
    });
}

conelight_result conelight_light_field_bind_lookups(const conelight_light_field* field, int32_t first_block,
                                                    int32_t first_texture) {
    return guarded([&] { Use(field)->bindLookups({first_block, first_texture}); });
}

conelight_result conelight_light_field_set_profiling(conelight_light_field* field, int on) {
    return guarded([&] { Use(field)->setProfiling(on != 0); });
}

conelight_result conelight_light_field_get_stats(const conelight_light_field* field,
                                                 conelight_light_field_stats* stats) {
    return guarded([&] {
        const Use use(field);
        c::readStruct(stats, "stats");
        const LightFieldStats& of = use->stats();
        conelight_light_field_stats found{0, of.voxels, of.faces, of.facesUpdated, 0, of.passes.size(),
                                          0, 0,         -1};
        for (const MemoryStats& object : of.memory) found.memory_bytes += object.bytes;
        if (!of.passes.empty()) {
            const PassStats& whole = of.passes.front();  // "update" has the others in it
            found.cpu_ms = whole.cpuMs;
            found.wall_ms = whole.wallMs;
            found.gpu_ms = whole.gpuMs;
        }
        need(field, "field").passes = of.passes;
        c::writeStruct(stats, found, "stats");
    });
}

conelight_result conelight_light_field_get_pass(const conelight_light_field* field, size_t index,
                                                conelight_pass* pass) {
    return guarded([&] {
        const PassStats& of = c::elementOf(need(field, "field").passes, index, "pass");
        c::writeStruct(pass, conelight_pass{0, of.name.c_str(), of.cpuMs, of.wallMs, of.gpuMs}, "pass");
    });
}

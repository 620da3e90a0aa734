// SPDX-License-Identifier: MIT
// The table of the settings of mode `thesis`: for each its place in the structs, its range, its unit, its
// help.
#include "conelight/thesis/settings.h"

#include "settings/registry.h"

namespace conelight::thesis {
namespace {

using settings::Choice;
using settings::Numbers;
using settings::Place;
using settings::Setting;
using settings::within;

constexpr Choice<ConeVariant> kConeVariants[] = {{"regular", ConeVariant::Regular},
                                                 {"customised", ConeVariant::Customised}};
constexpr Choice<VolumeStorage> kVolumeStorages[] = {{"dense", VolumeStorage::Dense},
                                                     {"octree", VolumeStorage::Octree}};
constexpr Choice<VoxelizationAxis> kVoxelizationAxes[] = {{"dominant", VoxelizationAxis::Dominant},
                                                          {"x", VoxelizationAxis::X},
                                                          {"y", VoxelizationAxis::Y},
                                                          {"z", VoxelizationAxis::Z},
                                                          {"three", VoxelizationAxis::Three}};
constexpr Choice<VolumeFilter> kVolumeFilters[] = {{"linear", VolumeFilter::Linear},
                                                   {"nearest", VolumeFilter::Nearest}};
constexpr Choice<ThesisVoxelView> kThesisVoxelViews[] = {{"cubes", ThesisVoxelView::Cubes},
                                                         {"surfaces", ThesisVoxelView::Surfaces}};

std::vector<Setting<ThesisSettings>> pictureTable() {
    return {
        {"published", &ThesisSettings::published, "all of thesis.defects.* on: the original's picture"},
        {"phong", &ThesisSettings::phong, "direct light"},
        {"phong_ambient", &ThesisSettings::phongAmbient,
         "ambient part of direct light (without diffuse cones)"},
        {"phong_diffuse", &ThesisSettings::phongDiffuse, "diffuse part of direct light"},
        {"phong_specular", &ThesisSettings::phongSpecular, "gloss of direct light"},
        {"vox_diffuse", &ThesisSettings::voxDiffuse, "diffuse cones: indirect light"},
        {"vox_specular", &ThesisSettings::voxSpecular, "specular cones: reflections"},
        {"vox_shadows", &ThesisSettings::voxShadows, "occlusion cones: shadows in direct light"},
        {"front_cone", &ThesisSettings::frontCone, "one diffuse cone along the normal"},
        {"side_cones", &ThesisSettings::sideCones, "four diffuse cones along the surface"},
        {"intermediate_cones", &ThesisSettings::intermediateCones, "four diffuse cones at 45 degrees"},
        {"diffuse.variant", within(&ThesisSettings::diffuse, &ThesisCones::variant), kConeVariants,
         "regular: cones march through the volume (thesis, chapter 4); customised: they end at the first hit "
         "(chapter 5)"},
        {"diffuse.aperture", within(&ThesisSettings::diffuse, &ThesisCones::aperture), Numbers{0.001, 3},
         "rad", "full angle of diffuse cones"},
        {"diffuse.dist_factor", within(&ThesisSettings::diffuse, &ThesisCones::distFactor), Numbers{0.001, 4},
         "diameters", "step of diffuse cones"},
        {"diffuse.offset", within(&ThesisSettings::diffuse, &ThesisCones::offset), Numbers{0.0001, 10}, "m",
         "first sample of diffuse cones"},
        {"diffuse.origin_offset", &ThesisSettings::diffuseOriginOffset, Numbers{0, 10}, "m",
         "start of diffuse cones along the normal"},
        {"specular.variant", within(&ThesisSettings::specular, &ThesisCones::variant), kConeVariants,
         "regular: reflections as traced; customised: weighted by the angle to the light"},
        {"specular.aperture", within(&ThesisSettings::specular, &ThesisCones::aperture), Numbers{0.001, 3},
         "rad", "full angle of specular cones; auto: by shininess"},
        {"specular.dist_factor", within(&ThesisSettings::specular, &ThesisCones::distFactor),
         Numbers{0.001, 4}, "diameters", "step of specular cones"},
        {"specular.offset", within(&ThesisSettings::specular, &ThesisCones::offset), Numbers{0.0001, 10}, "m",
         "first sample of specular cones"},
        {"specular.shininess_falloff", &ThesisSettings::shininessFalloff, Numbers{0, 100}, "",
         "exponent of the angular weight"},
        {"specular.min_weight", &ThesisSettings::minSpecular, Numbers{0, 1}, "",
         "reflections of less weight are not traced"},
        {"occlusion.variant", within(&ThesisSettings::occlusion, &ThesisCones::variant), kConeVariants,
         "regular: occlusion as traced; customised: damped near the surface"},
        {"occlusion.aperture", within(&ThesisSettings::occlusion, &ThesisCones::aperture), Numbers{0.001, 3},
         "rad", "full angle of occlusion cones"},
        {"occlusion.dist_factor", within(&ThesisSettings::occlusion, &ThesisCones::distFactor),
         Numbers{0.001, 4}, "diameters", "step of occlusion cones"},
        {"occlusion.offset", within(&ThesisSettings::occlusion, &ThesisCones::offset), Numbers{0.0001, 10},
         "m", "first sample of occlusion cones"},
        {"occlusion.shadow_str", &ThesisSettings::shadowStr, Numbers{0, 100}, "",
         "gain of the customised occlusion"},
    };
}

std::vector<Setting<ThesisSettings>> volumeTable() {
    return {
        {"bounces", &ThesisSettings::bounces, Numbers{1, 8}, "", "bounces of indirect light"},
        {"storage", &ThesisSettings::storage, kVolumeStorages,
         "where the volume lies; dense: in textures of all voxels; octree: the same picture from a sparse "
         "octree"},
        {"voxelize_along", &ThesisSettings::voxelizeAlong, kVoxelizationAxes,
         "axis along which triangles are cut into voxels: of each its normal's largest part, one axis for "
         "all, or three passes"},
        {"filter", &ThesisSettings::filter, kVolumeFilters,
         "between texels and levels of the volume: a mean by distance, or the nearest (an octree mixes its "
         "levels)"},
        {"max_samples", &ThesisSettings::maxSamples, Numbers{1, 16384}, "samples",
         "most samples that a cone takes"},
        {"voxel_level", &ThesisSettings::voxelLevel, Numbers{0, 8}, "", "level that component voxels shows"},
        {"voxel_view", &ThesisSettings::voxelView, kThesisVoxelViews,
         "component voxels; cubes: the voxels as cubes; surfaces: their colours on the surfaces"},
    };
}

std::vector<Setting<ThesisDefects>> defectTable() {
    return {
        {"racing_stores", &ThesisDefects::racingStores, "of several fragments in a voxel the last one stays"},
        {"center_coverage", &ThesisDefects::centerCoverage,
         "only triangles that cover pixel centres become voxels"},
        {"binary_opacity", &ThesisDefects::binaryOpacity, "whatever is touched is opaque"},
        {"face_rounding", &ThesisDefects::faceRounding, "surfaces on voxel faces fall to a side by rounding"},
        {"unattenuated_voxels", &ThesisDefects::unattenuatedVoxels,
         "voxel light does not fall off with distance"},
        {"unshadowed_voxels", &ThesisDefects::unshadowedVoxels, "voxel light passes through everything"},
        {"clipped_radiance", &ThesisDefects::clippedRadiance,
         "the volume holds 8 bits per channel, at most 1"},
        {"dark_emitters", &ThesisDefects::darkEmitters, "emission is left out of the volume"},
        {"volume_mips", &ThesisDefects::volumeMips,
         "opacity averaged over volume: walls fade in coarse levels"},
        {"isotropic_opacity", &ThesisDefects::isotropicOpacity,
         "voxels are as opaque from every side: walls beside wide occlusion cones are in their way"},
        {"whole_grid", &ThesisDefects::wholeGrid,
         "the grid of a thesis-format scene is [-1,1]^3, whatever it holds"},
        {"capped_levels", &ThesisDefects::cappedLevels, "the volume has at most seven levels"},
        {"ten_lights", &ThesisDefects::tenLights, "lights after the tenth are ignored"},
        {"pointlike_rectangles", &ThesisDefects::pointlikeRectangles,
         "rectangular lights act from their centre and have no size"},
        {"coarse_lod", &ThesisDefects::coarseLod, "the volume is read one level too coarse"},
        {"no_step_correction", &ThesisDefects::noStepCorrection,
         "a sample's opacity counts in full whatever the step"},
        {"forget_near_color", &ThesisDefects::forgetNearColor,
         "near colour is scaled down by what comes later"},
        {"double_alpha", &ThesisDefects::doubleAlpha,
         "opacity is multiplied into colour that holds it already"},
        {"last_step", &ThesisDefects::lastStep,
         "the last occlusion sample counts in full: rings around lights"},
        {"premultiplied_first_hit", &ThesisDefects::premultipliedFirstHit,
         "the first hit's colour fades with its opacity"},
        {"hard_first_hit", &ThesisDefects::hardFirstHit,
         "a diffuse cone ends at the first sample of opacity above 0.01"},
        {"fixed_offsets", &ThesisDefects::fixedOffsets,
         "cones start at fixed distances and meet their own surface"},
        {"short_reach", &ThesisDefects::shortReach, "diffuse and specular cones end after 1 m"},
        {"nan_axes", &ThesisDefects::nanAxes, "cones have no direction where the normal is parallel to z"},
        {"short_side_axis", &ThesisDefects::shortSideAxis,
         "the axis of a cone is shorter than 1, so its tilt varies"},
        {"grazing_side_cones", &ThesisDefects::grazingSideCones, "side cones lie in the surface"},
        {"no_cosine_weights", &ThesisDefects::noCosineWeights, "every diffuse cone counts alike, times 5"},
        {"no_albedo", &ThesisDefects::noAlbedo, "indirect diffuse light takes no colour from the surface"},
        {"occlusion_fudge", &ThesisDefects::occlusionFudge, "near occluders are damped in absolute units"},
        {"occluded_indirect", &ThesisDefects::occludedIndirect, "indirect light only where a lamp shines"},
        {"specular_per_light", &ThesisDefects::specularPerLight,
         "an equal specular cone for every light, all added"},
        {"occluded_specular", &ThesisDefects::occludedSpecular, "reflections only where a lamp shines"},
        {"shininess_saturation", &ThesisDefects::shininessSaturation,
         "no angular effect above shininess 125"},
        {"fixed_specular_aperture", &ThesisDefects::fixedSpecularAperture,
         "all materials reflect through one aperture"},
        {"ambient_twice", &ThesisDefects::ambientTwice, "ambient light on top of indirect light"},
        {"unbounded_specular", &ThesisDefects::unboundedSpecular,
         "reflections come on top of all diffuse light, whatever adds up"},
        {"fine_steps", &ThesisDefects::fineSteps, "steps by the original's table, down to 1/100 voxel"},
    };
}

}  // namespace

std::vector<bool*> thesisDefectFlags(ThesisDefects& defects) {
    static const std::vector<Setting<ThesisDefects>> rows = defectTable();
    std::vector<bool*> flags;
    for (const Setting<ThesisDefects>& row : rows)
        flags.push_back(&std::get<Place<ThesisDefects, bool>>(row.field).edit(defects));
    return flags;
}

void registerSettings() {
    std::vector<Setting<ThesisSettings>> rows = pictureTable();
    for (const Setting<ThesisSettings>& row : volumeTable()) rows.push_back(row);
    const auto defects = settings::placeOf<ThesisSettings>(&ThesisSettings::defects);
    for (const Setting<ThesisDefects>& row : defectTable()) rows.push_back(within("defects.", defects, row));
    settings::registerSettings("thesis.", rows, "cones.");
    settings::registerModeName(kMode, Mode::Cones);
}

}  // namespace conelight::thesis

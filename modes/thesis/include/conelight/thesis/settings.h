// SPDX-License-Identifier: MIT
// Settings of mode `thesis`: a group of Settings::groups. What a setting does, its unit and its range stand
// once, in the table of modes/thesis/render/settings.cpp; docs/guide/thesis_mode.md tells the defects.
//
//     settings.mode = conelight::thesis::kMode;
//     settings.groups.of<conelight::thesis::ThesisSettings>().published = true;
#pragma once

#include <vector>

#include "conelight/export.h"
#include "conelight/mode.h"
#include "conelight/settings.h"

namespace conelight::thesis {

// The renderer of the bachelor's thesis that Conelight grew from.
inline constexpr Mode kMode{"thesis"};

// Defects of the original program (docs/guide/thesis_mode.md: what each does, its cure, how to see it). All
// are mended unless switched on.
struct ThesisDefects {
    // Volume
    bool racingStores = false;
    bool centerCoverage = false;
    bool binaryOpacity = false;
    bool faceRounding = false;
    bool unattenuatedVoxels = false;
    bool unshadowedVoxels = false;
    bool clippedRadiance = false;
    bool darkEmitters = false;
    bool volumeMips = false;
    bool isotropicOpacity = false;
    bool wholeGrid = false;
    bool cappedLevels = false;
    bool tenLights = false;
    bool pointlikeRectangles = false;
    // Cones
    bool coarseLod = false;
    bool noStepCorrection = false;
    bool forgetNearColor = false;
    bool doubleAlpha = false;
    bool lastStep = false;
    bool premultipliedFirstHit = false;
    bool hardFirstHit = false;
    bool fixedOffsets = false;
    bool shortReach = false;
    bool nanAxes = false;
    bool shortSideAxis = false;
    bool grazingSideCones = false;
    bool noCosineWeights = false;
    bool noAlbedo = false;
    bool occlusionFudge = false;
    bool occludedIndirect = false;
    bool specularPerLight = false;
    bool occludedSpecular = false;
    bool shininessSaturation = false;
    bool fixedSpecularAperture = false;
    bool ambientTwice = false;
    bool unboundedSpecular = false;
    bool fineSteps = false;
    bool operator==(const ThesisDefects&) const = default;
};
// Pointers to all of them, in the order above.
CONELIGHT_API std::vector<bool*> thesisDefectFlags(ThesisDefects& defects);

// Regular: as in the thesis's chapter 4. Customised: as its chapter 5 changed it.
enum class ConeVariant { Regular, Customised };

// The axis along which triangles are voxelized (thesis, "Rasterization"): the largest part of their normal, one axis
// for all, or all three, one pass each.
enum class VoxelizationAxis { Dominant, X, Y, Z, Three };

// How the volume is read between the centres of texels and between levels (thesis, "Texture Filtering").
enum class VolumeFilter { Linear, Nearest };

// What component `voxels` shows.
enum class ThesisVoxelView { Cubes, Surfaces };

// The thesis's VoxSettings. `auto` numbers: with the defect that goes with them on, the original's table for
// 64, 128 and 256 voxels; else a value that does not depend on the size (docs/guide/thesis_mode.md).
struct ThesisCones {
    ConeVariant variant = ConeVariant::Customised;
    AutoFloat aperture;
    AutoFloat distFactor;
    AutoFloat offset;
    bool operator==(const ThesisCones&) const = default;
};

struct CONELIGHT_API ThesisSettings {
    bool published = false;
    // Parts of the picture
    bool phong = true;
    bool phongAmbient = true;
    bool phongDiffuse = true;
    bool phongSpecular = false;
    bool voxDiffuse = true;
    bool voxSpecular = true;
    bool voxShadows = true;
    bool frontCone = true, sideCones = false, intermediateCones = true;
    ThesisCones diffuse, specular, occlusion;
    AutoFloat diffuseOriginOffset;
    AutoFloat shininessFalloff;
    float shadowStr = 1.5f;
    float minSpecular = 0.004f;  // 1/256 of white; 0 traces all
    int maxSamples = 4096;
    int bounces = 1;
    VolumeStorage storage = VolumeStorage::Dense;
    VoxelizationAxis voxelizeAlong = VoxelizationAxis::Dominant;
    VolumeFilter filter = VolumeFilter::Linear;
    int voxelLevel = 0;
    ThesisVoxelView voxelView = ThesisVoxelView::Cubes;
    ThesisDefects defects;
    bool operator==(const ThesisSettings&) const = default;
};

// Adds the settings `thesis.*` and the name of the mode to the library's lists. Call at the start of a
// program, before other threads use settings; a second call does nothing.
CONELIGHT_API void registerSettings();

}  // namespace conelight::thesis

// SPDX-License-Identifier: MIT
// Every knob of the renderer as plain structs with defaults. The same list, with unit, range and one line of
// explanation, is given by settingInfos() and is what `--set KEY=VALUE`, `conelight settings`, the
// documentation and the viewer show: src/modes/settings.cpp is the single source of those texts.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

namespace conelight {

enum class Mode {
    Phong,   // local illumination only, the thesis's Phong model with its attenuation
    Thesis,  // the thesis's renderer
    Cones,   // energy-normalised cone tracing, physically based shading
    Traced,  // rays through surface voxels, irradiance cached per voxel face, unlimited bounces
};

// What is shown. Indirect = Diffuse + Specular (the gathered parts).
enum class Component {
    Full,
    Direct,
    Indirect,
    Diffuse,
    Specular,
    Occlusion,
    Albedo,
    Normal,
    Depth,
    Voxels,
    Emission,
    ShadowMap
};

enum class ToneMap { None, Reinhard, Aces };

struct VoxelSettings {
    int size = 128;         // voxels along the longest axis of the grid; 8..512, divisible by 4
    float padding = 0.03f;  // grid is larger than the scene's bounds by this fraction on each side
    glm::vec3 shift{0};  // moves the lattice toward lower coordinates, voxels; 0..1 (to measure its effect)
    bool operator==(const VoxelSettings&) const = default;
};

struct LightSettings {
    int shadowSize = 1024;  // texels per edge of a shadow map (cube faces: half); 0 = no shadows; 64..8192
    int shadowFilter = 0;   // blur of shadow edges in texels to either side; 0..4
    int areaSamples = 16;   // points per rectangular light; 1, 4, 9, 16, 25 ... 64
    bool emissiveQuads = true;  // flat rectangular emitters are lit exactly, as area lights (cones mode)
    bool operator==(const LightSettings&) const = default;
};

// A number with a default that depends on the voxel size; set with `auto` or a number.
struct AutoFloat {
    bool isAuto = true;
    float value = 0;
    float resolve(float automatic) const { return isAuto ? automatic : value; }
    bool operator==(const AutoFloat&) const = default;
};

// Off, on, or what suits the scene.
enum class Toggle { Auto, Off, On };

struct PhongSettings {
    // Shadow maps in mode `phong`. Auto: on, but off in scenes of the thesis's format, whose program had
    // none.
    Toggle shadows = Toggle::Auto;
    bool operator==(const PhongSettings&) const = default;
};

// Defects of the original program (docs/guide/thesis_mode.md: what each does, its cure, how to see it). All
// are mended unless switched on.
struct ThesisDefects {
    // Volume
    bool racingStores = false;        // the last of several fragments stays in a voxel
    bool centerCoverage = false;      // only triangles that cover pixel centres become voxels
    bool binaryOpacity = false;       // whatever is touched is opaque
    bool faceRounding = false;        // surfaces on voxel faces fall to a side by rounding
    bool unattenuatedVoxels = false;  // voxel light does not fall off
    bool unshadowedVoxels = false;    // voxel light passes through everything
    bool clippedRadiance = false;     // 8 bits per channel, at most 1
    bool darkEmitters = false;        // emission is left out of the volume
    bool volumeMips = false;          // opacity averaged over volume: walls fade in coarse levels
    bool wholeGrid = false;           // the grid is [-1,1]^3 whatever the scene (thesis-format scenes)
    bool cappedLevels = false;        // seven levels
    bool tenLights = false;           // the first ten lights only
    // Cones
    bool coarseLod = false;              // one level too coarse
    bool noStepCorrection = false;       // a sample's opacity counts in full whatever the step
    bool forgetNearColor = false;        // near colour is scaled down by what comes later
    bool doubleAlpha = false;            // opacity multiplied into premultiplied colour
    bool lastStep = false;               // the last occlusion sample counts in full: rings
    bool premultipliedFirstHit = false;  // the first hit's colour fades with its opacity
    bool hardFirstHit = false;           // the first sample with opacity above 0.01 is all
    bool fixedOffsets = false;           // cones start and grow regardless of the own surface
    bool shortReach = false;             // cones end after 1 m
    bool nanAxes = false;                // undefined cone axes where the normal is parallel to z
    bool shortSideAxis = false;          // a cone axis of less than unit length
    bool grazingSideCones = false;       // side cones lie in the surface
    bool noCosineWeights = false;        // every diffuse cone counts alike, times 5
    bool noAlbedo = false;               // indirect diffuse light takes no colour from the surface
    bool occlusionFudge = false;         // damping of occlusion in absolute units
    bool occludedIndirect = false;       // indirect light where a lamp shines only
    bool specularPerLight = false;       // one equal specular cone per light
    bool occludedSpecular = false;       // reflections where a lamp shines only
    bool shininessSaturation = false;    // no angular effect above shininess 125
    bool fixedSpecularAperture = false;  // all materials reflect through the same aperture
    bool ambientTwice = false;           // ambient light on top of indirect light
    bool unboundedSpecular = false;      // reflections on top of all diffuse light, strength above 1 allowed
    bool fineSteps = false;              // steps in diameters, down to 1/100 voxel
    bool operator==(const ThesisDefects&) const = default;
};
// Pointers to all of them, in the order above.
std::vector<bool*> thesisDefectFlags(ThesisDefects& defects);

// Regular: as in the thesis's chapter 4. Customised: as its chapter 5 changed it.
enum class ConeVariant { Regular, Customised };

enum class ThesisVoxelView { Cubes, Surfaces };

// The thesis's VoxSettings. `auto` numbers: with the defect that goes with them on, the original's table for
// 64, 128 and 256 voxels; else a value that does not depend on the size (docs/guide/thesis_mode.md).
struct ThesisCones {
    ConeVariant variant = ConeVariant::Customised;
    AutoFloat aperture;    // full angle, rad; 0.001..3
    AutoFloat distFactor;  // step as part of the diameter; 0.001..4
    AutoFloat offset;      // distance of the first sample, m; 0.0001..10
};

struct ThesisSettings {
    bool published = false;  // every defect on: the picture of the original program
    // Parts of the picture
    bool phong = true;           // direct light
    bool phongAmbient = true;    // its ambient part; only without diffuse cones, unless defects.ambient_twice
    bool phongDiffuse = true;    // its diffuse part
    bool phongSpecular = false;  // its gloss
    bool voxDiffuse = true;      // indirect diffuse light
    bool voxSpecular = true;     // reflections
    bool voxShadows = true;      // occlusion of direct light
    bool frontCone = true, sideCones = false, intermediateCones = true;
    ThesisCones diffuse, specular, occlusion;
    AutoFloat diffuseOriginOffset;  // diffuse cones start this far along the normal, m; 0..10
    AutoFloat shininessFalloff;     // exponent of the angular weight; 0..100
    float shadowStr = 1.5f;         // gain of the customised occlusion; 0..100
    float minSpecular =
        0.004f;             // reflections of less weight are not traced (1/256 of white); 0 traces all; 0..1
    int maxSamples = 4096;  // per cone; 1..16384
    int voxelLevel = 0;     // level that component `voxels` shows; 0..8
    ThesisVoxelView voxelView = ThesisVoxelView::Cubes;  // cubes, or their colours on the surfaces
    ThesisDefects defects;
};

// Cones that gather the light at matt surfaces (docs/theory/4_gather.md): one, or a polar cone and rings of
// 4, 5 or 4 + 4 round it, or Fibonacci of any number.
enum class DiffuseSet { One, Five, Six, Nine, Fibonacci };
// What a texel of the radiance volume keeps: one colour and opacity, or one per facing direction.
enum class VolumeDirections { Isotropic, Six };
// How opacity adds up along a cone and over levels. Fog: texels are mist of unrelated droplets (Crassin et
// al. 2011). Area: texels hold connected surface, whose projected areas add up until nothing is left to see.
enum class OpacityModel { Fog, Area };

struct ConesSettings {
    DiffuseSet diffuseSet = DiffuseSet::Six;
    int count = 16;  // cones of DiffuseSet::Fibonacci; 1..64
    VolumeDirections directional = VolumeDirections::Six;
    OpacityModel opacity = OpacityModel::Area;
    float step = 1.0f;                 // step / footprint; 0.1..2
    float offset = 1.0f;               // start off the surface, voxels along the geometric normal; 0..4
    float maxFootprint = 0.25f;        // largest footprint / longest side of the grid; 0.01..1
    AutoFloat maxDistance;             // m; auto: all the way through the grid
    float specularMinAperture = 0.1f;  // rad, full angle of the narrowest cone; 0.01..1
    AutoFloat occlusionDistance;       // m, of component occlusion; auto: a tenth of the grid's longest side
    int bounces = 2;     // of indirect light; 0: only light that comes straight from lights; 0..8
    int voxelLevel = 0;  // level shown by component voxels; 0..6
    bool operator==(const ConesSettings&) const = default;
};

// How much work mode `traced` spends on a picture; each fills in TracedSettings (applyQuality).
enum class Quality { Draft, Interactive, High, Converged };

// Defaults are those of Quality::Interactive.
struct TracedSettings {
    Quality quality = Quality::Interactive;  // the preset that was applied last; of no effect by itself
    // Pixels
    int pixelRays = 1;  // rays by the cosine per pixel and pass, as many again to bright faces; 0: the cache
                        // is shown; 0..64
    int specularRays = 1;        // rays per pixel and pass into the specular lobe; 0..16
    float specularLimit = 0.6f;  // rougher surfaces reflect their irradiance instead; 0..1
    int passes = 16;             // of pixel rays that are averaged; 1..1024
    int filterLevels = 3;        // of the edge-stopping filter: 0 none, 1 3x3, 2 7x7, 3 15x15 pixels; 0..4
    // Cache of irradiance
    int cacheRays = 2;      // rays by the cosine per face and update, as many again to bright faces; 1..64
    int cacheUpdates = 32;  // updates of all faces until the cache is left as it is; 1..4096
    int faceBudget = 0;     // faces updated per call when budgeted; 0: all
    int bounces = 16;       // of indirect light; 16: all; 0..16
    bool exactHits = true;  // light of point, spot and directional lights is looked up where rays hit
    bool exactMirrors = false;  // rays from smooth surfaces meet triangles, not what voxels keep of them
    // Off: a call returns a finished picture, with all updates and passes. On: each call does one update and
    // one pass, and what came before is reused where it is still seen.
    bool budgeted = false;
    bool operator==(const TracedSettings&) const = default;
};
// Fills in all fields but `bounces` and `budgeted`.
void applyQuality(TracedSettings& settings, Quality quality);

// Edges of the scene's triangles: over the picture, hidden ones left out, or alone, all of them.
enum class Wireframe { Off, Over, Alone };

// What views of voxels show. Mode thesis keeps radiance and opacity only: Radiance, Coverage, Level.
enum class VoxelData {
    Radiance,    // W/(sr m^2), what cones and rays read
    Irradiance,  // cached or gathered indirect irradiance / pi
    Age,  // updates behind that, as a colour: blue none, red 256 and more, magenta inside closed objects
    Albedo,
    Normal,  // axes from [-1,1] to [0,1]
    Emission,
    Coverage,  // share of the voxel's side that surface covers, 0..1
    Bricks,    // occupied voxels per brick of 4^3, as a colour: blue 1, red 64
    Level      // number of the level that is read, as a colour: blue 0, red 6
};

// Auto: what the mode's rays or cones meet. Faces: plane pieces in the voxels (mode traced).
// Edges: cubes as wireframes. Volume: by opacity, front to back. Surfaces: on the picture's surfaces.
enum class VoxelShape { Auto, Cubes, Edges, Faces, Volume, Surfaces };

// Views that look inside; they change what is drawn, not the light.
struct ViewSettings {
    Wireframe wireframe = Wireframe::Off;
    bool voxels = false;  // voxels among the objects of the picture; component voxels shows them alone
    VoxelData voxelData = VoxelData::Radiance;
    VoxelShape voxelShape = VoxelShape::Auto;
    AutoFloat voxelLevel;       // 0..8; auto: cones.voxel_level, thesis.voxel_level, else 0
    float voxelAperture = 0;    // full angle, rad; 0..1.5: each voxel in the level that a cone of it from the
                                // eye would read there; 0: voxelLevel everywhere
    float voxelDensity = 1.0f;  // of VoxelShape::Volume: opacity is 1 - (1 - coverage)^density; 0.001..1
    int light = 0;              // whose shadow map is shown, in the scene's order; 0..4095
};

struct ImageSettings {
    float exposure =
        0.0f;  // stops: the linear image is multiplied by 2^exposure before the tone map; -20..20
    ToneMap toneMap = ToneMap::Aces;  // thesis and phong modes of a thesis-format scene default to None
    bool srgb = true;                 // encode 8-bit output as sRGB; the original wrote linear values
};

struct Settings {
    Mode mode = Mode::Traced;
    Component component = Component::Full;
    VoxelSettings voxels;
    LightSettings light;
    PhongSettings phong;
    ThesisSettings thesis;
    ConesSettings cones;
    TracedSettings traced;
    ViewSettings view;
    ImageSettings image;
};

struct SettingInfo {
    std::string key;    // "thesis.diffuse.aperture"
    std::string type;   // "bool", "int", "float", "auto float", "choice"
    std::string unit;   // "rad", "voxels", "" ...
    std::string range;  // "0.01..3.14", "true,false", "none,reinhard,aces"
    std::string defaultValue;
    std::string help;  // one line
};

// All settings, in the order of the structs.
const std::vector<SettingInfo>& settingInfos();

// Sets one value. Throws Error(Usage): unknown key (names the nearest known one), unreadable or out of range.
void setSetting(Settings& settings, const std::string& key, const std::string& value);
// The value as text that setSetting reads back as the same value.
std::string getSetting(const Settings& settings, const std::string& key);
// Throws Error(Usage) that names the first value out of range; for values written into the structs directly.
void validateSettings(const Settings& settings);

}  // namespace conelight

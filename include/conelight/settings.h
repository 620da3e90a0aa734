// SPDX-License-Identifier: MIT
// Every setting of the renderer: plain structs with defaults. What a setting does, its unit and its range
// stand once, in the table of src/settings/table.cpp. settingInfos() gives it to programs; `conelight
// settings` and docs/reference/settings.md print it; setSetting() and validateSettings() enforce it.
#pragma once

#include <glm/glm.hpp>
#include <optional>
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
    int size = 128;
    float padding = 0.03f;
    glm::vec3 shift{0};  // moves the lattice toward lower coordinates
    bool operator==(const VoxelSettings&) const = default;
};

struct LightSettings {
    int shadowSize = 1024;  // cube faces: half
    int shadowFilter = 0;
    int areaSamples = 16;
    bool emissiveQuads = true;  // of mode cones
    bool operator==(const LightSettings&) const = default;
};

// A number with a default that depends on the voxel size; set with `auto` or a number.
struct AutoFloat {
    bool isAuto = true;
    float value = 0;
    float resolve(float automatic) const { return isAuto ? automatic : value; }
    bool operator==(const AutoFloat& other) const {
        return isAuto == other.isAuto && (isAuto || value == other.value);
    }
};

// Auto: the scene's conventions decide.
enum class Toggle { Auto, Off, On };

struct PhongSettings {
    Toggle shadows = Toggle::Auto;  // shadow maps in mode `phong`
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
    bool operator==(const ThesisCones&) const = default;
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
    bool operator==(const ThesisSettings&) const = default;
};

// Cones that gather light at diffuse surfaces (docs/theory/4_gather.md): one, or a polar cone and rings of
// 4, 5 or 4 + 4 round it, or Fibonacci of any number.
enum class DiffuseSet { One, Five, Six, Nine, Fibonacci };
// What a texel of the radiance volume keeps: one colour and opacity, or one per facing direction.
enum class VolumeDirections { Isotropic, Six };
// How opacity adds up along a cone and over levels. Fog: texels are mist of unrelated droplets (Crassin et
// al. 2011). Area: texels hold connected surface, whose projected areas add up until nothing is left to see.
enum class OpacityModel { Fog, Area };

struct ConesSettings {
    DiffuseSet diffuseSet = DiffuseSet::Six;
    int count = 16;
    VolumeDirections directional = VolumeDirections::Six;
    OpacityModel opacity = OpacityModel::Area;
    float step = 1.0f;
    float offset = 1.0f;  // along the geometric normal
    float maxFootprint = 0.25f;
    AutoFloat maxDistance;
    float specularMinAperture = 0.1f;
    AutoFloat occlusionDistance;
    int bounces = 2;
    int voxelLevel = 0;
    bool operator==(const ConesSettings&) const = default;
};

// How much work mode `traced` spends on a picture.
enum class Quality { Draft, Interactive, High, Converged };

// Defaults are those of Quality::Interactive.
struct TracedSettings {
    // Pixels
    int pixelRays = 1;
    int specularRays = 1;
    float specularLimit = 0.6f;
    int passes = 16;
    int filterLevels = 3;
    // Cache of irradiance
    int cacheRays = 2;
    int cacheUpdates = 32;
    int faceBudget = 0;
    std::optional<int> bounces;  // nothing: all
    bool exactHits = true;
    bool exactMirrors = false;
    // Off: a call returns a finished picture, with all updates and passes. On: each call does one update and
    // one pass, and reuses what was gathered for pixels that are still seen.
    bool budgeted = false;
    bool operator==(const TracedSettings&) const = default;
};
// Fills in all fields but `bounces` and `budgeted`.
void applyQuality(TracedSettings& settings, Quality quality);
// The quality that gives these settings, whatever `bounces` and `budgeted` are; nothing when none does.
std::optional<Quality> qualityOf(const TracedSettings& settings);

// Edges of the scene's triangles: over the picture, hidden ones left out, or alone, all of them.
enum class Wireframe { Off, Over, Alone };

// What views of voxels show. Modes that keep no more than radiance and opacity show Radiance, Coverage,
// Level.
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
    bool voxels = false;
    VoxelData voxelData = VoxelData::Radiance;
    VoxelShape voxelShape = VoxelShape::Auto;
    AutoFloat voxelLevel;
    float voxelAperture = 0;  // 0: voxelLevel everywhere
    float voxelDensity = 1.0f;
    int light = 0;  // in the scene's order
    bool operator==(const ViewSettings&) const = default;
};

struct ImageSettings {
    float exposure = 0.0f;
    ToneMap toneMap = ToneMap::Aces;
    bool srgb = true;
    bool operator==(const ImageSettings&) const = default;
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
    bool operator==(const Settings&) const = default;
};

enum class SettingKind { Bool, Int, Float, Choice };

struct SettingInfo {
    std::string key;  // "cones.max_distance"
    SettingKind kind = SettingKind::Bool;
    // Of Int and Float: the numbers it takes, both ends included.
    double low = 0, high = 0;
    int step = 1;                      // Int: multiples of it only
    bool zeroToo = false;              // 0 as well, outside low..high
    bool squares = false;              // Int: square numbers only
    std::string word;                  // taken in place of a number: "auto", "all"; empty: none
    std::vector<std::string> choices;  // of Bool and Choice: the words it takes
    std::string unit;                  // "rad", "voxels", "" ...
    std::string defaultValue;
    std::string help;       // one line
    bool isPreset = false;  // a word that fills in several settings (presetInfos)

    bool isNumber() const { return kind == SettingKind::Int || kind == SettingKind::Float; }
};

// The range as the documentation prints it: "8..512 by 4", "auto, 0..8", "none,reinhard,aces".
std::string rangeText(const SettingInfo& info);

// All settings, in the order of the table. The reference holds until a guest registers settings of its own.
const std::vector<SettingInfo>& settingInfos();

// Words that fill in several settings at once, taken wherever a setting is: `traced.quality=draft`. A word
// writes its settings when it is read; what is set after it stands.
const std::vector<SettingInfo>& presetInfos();

// A setting or a preset word by its key; nullptr when there is none.
const SettingInfo* findSetting(const std::string& key);

// Sets one value, or all values of a preset word. Throws Error(Usage): unknown key (names the nearest known
// one), unreadable or out of range. `settings` is as before then.
void setSetting(Settings& settings, const std::string& key, const std::string& value);
// The value as text that setSetting reads back as the same value. Of a preset: the word that makes these
// settings; "custom" when none does, which setSetting does not take.
std::string getSetting(const Settings& settings, const std::string& key);
// Throws Error(Usage) that names the first value out of range; for values written into the structs directly.
void validateSettings(const Settings& settings);

}  // namespace conelight

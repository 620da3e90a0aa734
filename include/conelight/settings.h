// SPDX-License-Identifier: MIT
// Every setting of the renderer: plain structs with defaults. What a setting does, its unit and its range
// stand once, in the table of src/settings/table.cpp. settingInfos() gives it to programs; `conelight
// settings` and docs/reference/settings.md print it; setSetting() and validateSettings() enforce it.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "conelight/export.h"
#include "conelight/glm_layout.h"
#include "conelight/mode.h"
#include "conelight/settings_groups.h"

namespace conelight {

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

// Agx and Neutral (Khronos PBR Neutral) keep hues; Neutral keeps colours below 0.76 as they are.
enum class ToneMap { None, Reinhard, Aces, Agx, Neutral };

// What 8-bit pictures show in place of colours: stripes where all channels are black (blue) or one is at its most (red);
// luminance in stops as colours (falseColor).
enum class ExposureCheck { Off, Clipping, FalseColor };

// A number, or `auto`: one that follows from the scene, its voxels or its picture.
struct AutoFloat {
    bool isAuto = true;
    float value = 0;
    float resolve(float automatic) const { return isAuto ? automatic : value; }
    bool operator==(const AutoFloat& other) const {
        return isAuto == other.isAuto && (isAuto || value == other.value);
    }
};

// The point, m, world space, that the finest of nested grids lie round. Axes that are auto follow the eye. With a point
// of the host's all views of a scene have the same voxels, wherever their eyes are.
struct VoxelAnchor {
    AutoFloat x, y, z;
    static VoxelAnchor at(const glm::vec3& point) {
        return {{false, point.x}, {false, point.y}, {false, point.z}};
    }
    bool isPoint() const { return !x.isAuto && !y.isAuto && !z.isAuto; }  // whatever the eye
    glm::vec3 around(const glm::vec3& eye) const {
        return {x.resolve(eye.x), y.resolve(eye.y), z.resolve(eye.z)};
    }
    bool operator==(const VoxelAnchor&) const = default;
};

struct VoxelSettings {
    int size = 128;
    float padding = 0.03f;
    glm::vec3 shift{0};  // moves the lattice toward lower coordinates
    int levels = 1;      // nested grids in mode traced; 1: one grid; 0: as the scene needs
    VoxelAnchor anchor;  // of these
    bool operator==(const VoxelSettings&) const = default;
};

struct LightSettings {
    int shadowSize = 1024;  // cube faces: half
    int shadowFilter = 0;
    int areaSamples = 16;
    bool emissiveQuads = true;  // flat emitters are area lights
    bool smallLamps = true;     // of modes phong, cones and traced: small bulbs and thin boxes are, too
    int caustics = 65536;       // paths per solid of glass and light; 0: light goes straight through solids
    int exactLamps = 64;        // of mode traced: more points and spots are drawn by chance
    bool operator==(const LightSettings&) const = default;
};

// Auto: who draws decides, or the scene's conventions.
enum class Toggle { Auto, Off, On };

struct PhongSettings {
    Toggle shadows = Toggle::Auto;  // shadow maps in mode `phong`
    bool operator==(const PhongSettings&) const = default;
};

// Cones that gather light at diffuse surfaces (docs/theory/4a_cones.md): one, or a polar cone and rings of
// 4, 5 or 4 + 4 round it, or Fibonacci of any number; the best of 6, 9, 12, 16 that a search found; or those of
// ConesSettings::ownSet.
enum class DiffuseSet { One, Five, Six, Nine, Fibonacci, Best6, Best9, Best12, Best16, Own };
// A cone of a set that is given.
struct SetCone {
    glm::vec3 direction{0, 0, 1};  // any length > 0; z >= 0 is the surface's normal
    float aperture = 1;            // full angle, rad, (0, 2.4]
    float weight = 1;              // > 0; the weights of a set are scaled to the sum pi
    bool operator==(const SetCone&) const = default;
};
// What a texel of the radiance volume keeps: one colour and opacity, or one per facing direction.
enum class VolumeDirections { Isotropic, Six };
// Where those texels lie: in a texture with a texel for every voxel, or in an octree with bricks of texels where
// surface is, which gives the same picture from less memory in more time.
enum class VolumeStorage { Dense, Octree };
// How opacity adds up along a cone and over levels. Fog: texels are mist of unrelated droplets (Crassin et
// al. 2011). Area: texels hold connected surface, whose projected areas add up until nothing is left to see.
enum class OpacityModel { Fog, Area };
// Where the volume's indirect light comes from: cones at voxel faces, one bounce after the other, or the
// cache of mode `traced`, filled by rays as TracedSettings say.
enum class ConesIndirect { Cones, Cache };
// What tells whether light reaches a pixel: shadow maps, or a cone to the light through the volume.
enum class ConesShadows { Maps, Cones };

struct ConesSettings {
    DiffuseSet diffuseSet = DiffuseSet::Six;
    int count = 16;
    std::vector<SetCone> ownSet;  // where diffuseSet is Own: at most 64 cones; none: as Six
    VolumeDirections directional = VolumeDirections::Six;
    VolumeStorage storage = VolumeStorage::Dense;
    OpacityModel opacity = OpacityModel::Area;
    float step = 1.0f;
    float offset = 1.0f;  // along the geometric normal
    float maxFootprint = 0.25f;
    AutoFloat maxDistance;
    float specularMinAperture = 0.1f;
    AutoFloat occlusionDistance;
    int bounces = 2;
    ConesIndirect indirect = ConesIndirect::Cones;
    bool fractionalLevels = false;
    ConesShadows shadows = ConesShadows::Maps;
    float shadowAperture = 0.2f;
    bool refraction = true;  // glass by a reflected and a refracted cone per pixel; else as panes
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
    // Rays for irradiance of one of reduction x reduction pixels, 1 to 4; all show what those about them gathered on the same
    // surface. For a LightField see GatherOptions.
    int reduction = 1;
    // Cache of irradiance
    int cacheRays = 2;
    int cacheUpdates = 16;
    int faceBudget = 0;
    float timeBudget = 0;
    std::optional<int> bounces;  // nothing: all
    bool exactHits = true;
    bool exactMirrors = true;
    bool exactNear = true;
    bool exactShadows = true;
    // Off: a call returns a finished picture, with all updates and passes. On: each call does one update and
    // one pass, and reuses what was gathered for pixels that are still seen.
    bool budgeted = false;
    bool operator==(const TracedSettings&) const = default;
};
// Fills in all fields but `reduction`, `bounces` and `budgeted`.
CONELIGHT_API void applyQuality(TracedSettings& settings, Quality quality);
// The quality that gives these settings, whatever those three are; nothing when none does.
CONELIGHT_API std::optional<Quality> qualityOf(const TracedSettings& settings);

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
    float shrink = 0;  // of each triangle's extent, about its middle
    bool voxels = false;
    VoxelData voxelData = VoxelData::Radiance;
    VoxelShape voxelShape = VoxelShape::Auto;
    AutoFloat voxelLevel;
    float voxelAperture = 0;  // 0: voxelLevel everywhere
    float voxelDensity = 1.0f;
    bool voxelsInside = false;  // an eye outside looks through the first wall
    int light = 0;              // in the scene's order
    bool operator==(const ViewSettings&) const = default;
};

struct ImageSettings {
    // Stills: the mean of so many views of the scene, at offsets within a pixel (traced.budgeted off). 0: one
    // view, of the pixels' centres.
    int antialiasing = 0;
    // Moving pictures: each call draws one view at an offset within a pixel and adds it to the pictures before, which
    // follow what moves (docs/theory/5_image.md, "Over frames"). Takes the place of antialiasing. Auto: Renderer and
    // stills: off; the viewer: on, in mode traced once its light has settled.
    Toggle temporal = Toggle::Auto;
    float bloom = 0;                  // part of the light that spreads, in 8-bit pictures only; 0: none
    AutoFloat exposure{false, 0.0f};  // stops; auto: autoExposure() of the picture
    // The light that 8-bit pictures show as white: that of a lamp, from 4000 K on of daylight, of so many K, and how far
    // beside it towards green, thousandths of Duv. 6500, 0: colours as they are.
    float whiteBalance = 6500;
    float tint = 0;
    ToneMap toneMap = ToneMap::Aces;
    ExposureCheck check = ExposureCheck::Off;
    bool srgb = true;
    bool operator==(const ImageSettings&) const = default;
};

struct Settings {
    Mode mode = Mode::Traced;
    Component component = Component::Full;
    VoxelSettings voxels;
    LightSettings light;
    PhongSettings phong;
    ConesSettings cones;
    TracedSettings traced;
    ViewSettings view;
    ImageSettings image;
    SettingsGroups groups;  // of guests
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
CONELIGHT_API std::string rangeText(const SettingInfo& info);

// All settings, in the order of the table. The reference holds until a guest registers settings of its own.
CONELIGHT_API const std::vector<SettingInfo>& settingInfos();

// Words that fill in several settings at once, taken wherever a setting is: `traced.quality=draft`. A word
// writes its settings when it is read; what is set after it stands.
CONELIGHT_API const std::vector<SettingInfo>& presetInfos();

// A setting or a preset word by its key; nullptr when there is none.
CONELIGHT_API const SettingInfo* findSetting(const std::string& key);

// Sets one value, or all values of a preset word. Throws Error(Usage): unknown key (names the nearest known
// one), unreadable or out of range. `settings` is as before then.
CONELIGHT_API void setSetting(Settings& settings, const std::string& key, const std::string& value);
// The value as text that setSetting reads back as the same value. Of a preset: the word that makes these
// settings; "custom" when none does, which setSetting does not take.
CONELIGHT_API std::string getSetting(const Settings& settings, const std::string& key);
// Throws Error(Usage) that names the first value out of range; for values written into the structs directly.
CONELIGHT_API void validateSettings(const Settings& settings);

}  // namespace conelight

// SPDX-License-Identifier: MIT
// The list of settings: key, unit, range, help, in one place; set, get and describe walk over it.
#include "conelight/settings.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>

#include "base/log.h"

namespace conelight {
namespace {

template <class T>
struct Choice {
    const char* name;
    T value;
};

constexpr Choice<Mode> kModes[] = {
    {"phong", Mode::Phong}, {"thesis", Mode::Thesis}, {"cones", Mode::Cones}, {"traced", Mode::Traced}};
constexpr Choice<Component> kComponents[] = {
    {"full", Component::Full},       {"direct", Component::Direct},     {"indirect", Component::Indirect},
    {"diffuse", Component::Diffuse}, {"specular", Component::Specular}, {"occlusion", Component::Occlusion},
    {"albedo", Component::Albedo},   {"normal", Component::Normal},     {"depth", Component::Depth},
    {"voxels", Component::Voxels},   {"emission", Component::Emission}, {"shadow_map", Component::ShadowMap}};
constexpr Choice<DiffuseSet> kDiffuseSets[] = {{"1", DiffuseSet::One},
                                               {"5", DiffuseSet::Five},
                                               {"6", DiffuseSet::Six},
                                               {"9", DiffuseSet::Nine},
                                               {"fibonacci", DiffuseSet::Fibonacci}};
constexpr Choice<VolumeDirections> kVolumeDirections[] = {{"isotropic", VolumeDirections::Isotropic},
                                                          {"six", VolumeDirections::Six}};
constexpr Choice<OpacityModel> kOpacityModels[] = {{"fog", OpacityModel::Fog}, {"area", OpacityModel::Area}};
constexpr Choice<ToneMap> kToneMaps[] = {
    {"none", ToneMap::None}, {"reinhard", ToneMap::Reinhard}, {"aces", ToneMap::Aces}};

template <class S, class V>
void visitCones(S& s, V& visit) {
    visit.choice("cones.diffuse_set", s.diffuseSet, kDiffuseSets,
                 "cones per hemisphere at matt surfaces; the time grows with them");
    visit.integer("cones.count", s.count, 1, 64, 1, "", "number of cones of the set fibonacci");
    visit.choice(
        "cones.directional", s.directional, kVolumeDirections,
        "radiance per voxel: one value, or six by facing direction (six times the memory, closed walls)");
    visit.choice("cones.opacity", s.opacity, kOpacityModels,
                 "how opacity adds up: as fog of unrelated droplets, or as connected surface area");
    visit.number("cones.step", s.step, 0.1, 2.0, "footprints", "distance between samples along a cone");
    visit.number("cones.offset", s.offset, 0.0, 4.0, "voxels", "where cones start, above the surface");
    visit.number("cones.max_footprint", s.maxFootprint, 0.01, 1.0, "",
                 "largest footprint as a fraction of the grid; smaller is slower, leaks less and may miss "
                 "small lights");
    visit.autoNumber("cones.max_distance", s.maxDistance, 0.0, 1e6, "m",
                     "length of cones; beyond it they see the sky; auto: through the grid");
    visit.number("cones.specular_min_aperture", s.specularMinAperture, 0.01, 1.0, "rad",
                 "full angle of the narrowest specular cone; narrower is sharper and slower");
    visit.autoNumber("cones.occlusion_distance", s.occlusionDistance, 0.0, 1e6, "m",
                     "reach of component occlusion; auto: a tenth of the grid");
    visit.integer("cones.bounces", s.bounces, 0, 8, 1, "", "bounces of indirect light; 0: none");
    visit.integer("cones.voxel_level", s.voxelLevel, 0, 6, 1, "",
                  "level of the volume that component voxels shows");
}

constexpr Choice<Quality> kQualities[] = {{"draft", Quality::Draft},
                                          {"interactive", Quality::Interactive},
                                          {"high", Quality::High},
                                          {"converged", Quality::Converged}};

template <class S, class V>
void visitTraced(S& s, V& visit) {
    visit.choice("traced.quality", s.quality, kQualities,
                 "fills in the other settings of this group (all but bounces and budgeted); set it first");
    visit.integer("traced.pixel_rays", s.pixelRays, 0, 64, 1, "",
                  "rays by the cosine per pixel and pass, as many again to bright faces; 0: the cache alone");
    visit.integer("traced.specular_rays", s.specularRays, 0, 16, 1, "",
                  "rays per pixel and pass into the specular lobe");
    visit.number("traced.specular_limit", s.specularLimit, 0.0, 1.0, "",
                 "surfaces of more roughness reflect their irradiance, without rays");
    visit.integer("traced.passes", s.passes, 1, 1024, 1, "", "passes of pixel rays that are averaged");
    visit.integer("traced.filter_levels", s.filterLevels, 0, 4, 1, "",
                  "edge-stopping filter: 0 none, 1 3x3, 2 7x7, 3 15x15, 4 31x31 pixels");
    visit.integer("traced.cache_rays", s.cacheRays, 1, 64, 1, "",
                  "rays by the cosine per voxel face and update, as many again to bright faces");
    visit.integer("traced.cache_updates", s.cacheUpdates, 1, 4096, 1, "",
                  "updates of all faces after a change, until the cache is left as it is");
    visit.integer("traced.face_budget", s.faceBudget, 0, 100000000, 1, "faces",
                  "faces updated per budgeted frame; 0: all");
    visit.integer("traced.bounces", s.bounces, 0, 16, 1, "", "bounces of indirect light; 16: all");
    visit.boolean("traced.exact_hits", s.exactHits,
                  "look up the light of point, spot and directional lights where rays hit, by shadow map");
    visit.boolean(
        "traced.exact_mirrors", s.exactMirrors,
        "rays from mirrors (roughness up to 0.3) meet triangles with their textures, not what voxels keep "
        "of them; off: voxels, faster");
    visit.boolean("traced.budgeted", s.budgeted,
                  "one update and one pass per frame, reusing frames before, for moving pictures; off: every "
                  "frame is finished");
}

constexpr Choice<Wireframe> kWireframes[] = {
    {"off", Wireframe::Off}, {"over", Wireframe::Over}, {"alone", Wireframe::Alone}};
constexpr Choice<VoxelData> kVoxelData[] = {
    {"radiance", VoxelData::Radiance}, {"irradiance", VoxelData::Irradiance},
    {"age", VoxelData::Age},           {"albedo", VoxelData::Albedo},
    {"normal", VoxelData::Normal},     {"emission", VoxelData::Emission},
    {"coverage", VoxelData::Coverage}, {"bricks", VoxelData::Bricks},
    {"level", VoxelData::Level}};
constexpr Choice<VoxelShape> kVoxelShapes[] = {
    {"auto", VoxelShape::Auto},   {"cubes", VoxelShape::Cubes},   {"edges", VoxelShape::Edges},
    {"faces", VoxelShape::Faces}, {"volume", VoxelShape::Volume}, {"surfaces", VoxelShape::Surfaces}};

template <class S, class V>
void visitView(S& s, V& visit) {
    visit.choice("view.wireframe", s.wireframe, kWireframes,
                 "edges of the triangles: over the picture without hidden ones, or alone");
    visit.boolean(
        "view.voxels", s.voxels,
        "voxels among the objects, whichever is nearer, but in mode phong (component voxels: alone)");
    visit.choice("view.voxel_data", s.voxelData, kVoxelData,
                 "what voxels show; age, bricks and level as colours from blue (none, 1, 0) to red (256 "
                 "updates, 64 voxels, level 6); mode thesis has radiance, coverage and level");
    visit.choice("view.voxel_shape", s.voxelShape, kVoxelShapes,
                 "how voxels are drawn; auto: as the mode's rays or cones meet them; faces: plane pieces, "
                 "mode traced only; surfaces: their colours on the objects");
    visit.autoNumber("view.voxel_level", s.voxelLevel, 0.0, 8.0, "",
                     "level that is shown, voxels of 2^level; auto: cones.voxel_level or "
                     "thesis.voxel_level, in mode traced 0");
    visit.number("view.voxel_aperture", s.voxelAperture, 0.0, 1.5, "rad",
                 "show the level that a cone of this full angle from the eye reads at the distance; 0: one "
                 "level everywhere");
    visit.number("view.voxel_density", s.voxelDensity, 0.001, 1.0, "",
                 "of shape volume: a voxel hides 1 - (1 - coverage)^density");
    visit.integer("view.light", s.light, 0, 4095, 1, "",
                  "number of the light whose shadow map component shadow_map shows");
}

constexpr Choice<Toggle> kToggles[] = {{"auto", Toggle::Auto}, {"off", Toggle::Off}, {"on", Toggle::On}};
constexpr Choice<ConeVariant> kConeVariants[] = {{"regular", ConeVariant::Regular},
                                                 {"customised", ConeVariant::Customised}};
constexpr Choice<ThesisVoxelView> kThesisVoxelViews[] = {{"cubes", ThesisVoxelView::Cubes},
                                                         {"surfaces", ThesisVoxelView::Surfaces}};

template <class D, class V>
void visitThesisDefects(D& d, V&& visit) {
    const auto defect = [&](const char* key, auto& flag, const char* help) {
        visit.boolean(key, flag, help);
    };
    defect("thesis.defects.racing_stores", d.racingStores, "the last of several fragments stays in a voxel");
    defect("thesis.defects.center_coverage", d.centerCoverage,
           "only triangles that cover pixel centres become voxels");
    defect("thesis.defects.binary_opacity", d.binaryOpacity, "whatever is touched is opaque");
    defect("thesis.defects.face_rounding", d.faceRounding,
           "surfaces on voxel faces fall to a side by rounding");
    defect("thesis.defects.unattenuated_voxels", d.unattenuatedVoxels,
           "voxel light does not fall off with distance");
    defect("thesis.defects.unshadowed_voxels", d.unshadowedVoxels, "voxel light passes through everything");
    defect("thesis.defects.clipped_radiance", d.clippedRadiance,
           "the volume holds 8 bits per channel, at most 1");
    defect("thesis.defects.dark_emitters", d.darkEmitters, "emission is left out of the volume");
    defect("thesis.defects.volume_mips", d.volumeMips,
           "opacity averaged over volume: walls fade in coarse levels");
    defect("thesis.defects.whole_grid", d.wholeGrid,
           "the grid of a thesis-format scene is [-1,1]^3, whatever it holds");
    defect("thesis.defects.capped_levels", d.cappedLevels, "the volume has at most seven levels");
    defect("thesis.defects.ten_lights", d.tenLights, "lights after the tenth are ignored");
    defect("thesis.defects.coarse_lod", d.coarseLod, "the volume is read one level too coarse");
    defect("thesis.defects.no_step_correction", d.noStepCorrection,
           "a sample's opacity counts in full whatever the step");
    defect("thesis.defects.forget_near_color", d.forgetNearColor,
           "near colour is scaled down by what comes later");
    defect("thesis.defects.double_alpha", d.doubleAlpha,
           "opacity is multiplied into colour that holds it already");
    defect("thesis.defects.last_step", d.lastStep,
           "the last occlusion sample counts in full: rings around lights");
    defect("thesis.defects.premultiplied_first_hit", d.premultipliedFirstHit,
           "the first hit's colour fades with its opacity");
    defect("thesis.defects.hard_first_hit", d.hardFirstHit,
           "a diffuse cone ends at the first sample of opacity above 0.01");
    defect("thesis.defects.fixed_offsets", d.fixedOffsets,
           "cones start at fixed distances and meet their own surface");
    defect("thesis.defects.short_reach", d.shortReach, "diffuse and specular cones end after 1 m");
    defect("thesis.defects.nan_axes", d.nanAxes, "cones without direction where the normal is parallel to z");
    defect("thesis.defects.short_side_axis", d.shortSideAxis,
           "a cone axis of less than unit length: tilt varies");
    defect("thesis.defects.grazing_side_cones", d.grazingSideCones, "side cones lie in the surface");
    defect("thesis.defects.no_cosine_weights", d.noCosineWeights, "every diffuse cone counts alike, times 5");
    defect("thesis.defects.no_albedo", d.noAlbedo, "indirect diffuse light takes no colour from the surface");
    defect("thesis.defects.occlusion_fudge", d.occlusionFudge, "near occluders are damped in absolute units");
    defect("thesis.defects.occluded_indirect", d.occludedIndirect, "indirect light only where a lamp shines");
    defect("thesis.defects.specular_per_light", d.specularPerLight,
           "an equal specular cone for every light, all added");
    defect("thesis.defects.occluded_specular", d.occludedSpecular, "reflections only where a lamp shines");
    defect("thesis.defects.shininess_saturation", d.shininessSaturation,
           "no angular effect above shininess 125");
    defect("thesis.defects.fixed_specular_aperture", d.fixedSpecularAperture,
           "all materials reflect through one aperture");
    defect("thesis.defects.ambient_twice", d.ambientTwice, "ambient light on top of indirect light");
    defect("thesis.defects.unbounded_specular", d.unboundedSpecular,
           "reflections come on top of all diffuse light, whatever adds up");
    defect("thesis.defects.fine_steps", d.fineSteps, "steps by the original's table, down to 1/100 voxel");
}

template <class T, class V>
void visitThesis(T& t, V&& visit) {
    visit.boolean("thesis.published", t.published, "all of thesis.defects.* on: the original's picture");
    visit.boolean("thesis.phong", t.phong, "direct light");
    visit.boolean("thesis.phong_ambient", t.phongAmbient,
                  "ambient part of direct light (without diffuse cones)");
    visit.boolean("thesis.phong_diffuse", t.phongDiffuse, "diffuse part of direct light");
    visit.boolean("thesis.phong_specular", t.phongSpecular, "gloss of direct light");
    visit.boolean("thesis.vox_diffuse", t.voxDiffuse, "diffuse cones: indirect light");
    visit.boolean("thesis.vox_specular", t.voxSpecular, "specular cones: reflections");
    visit.boolean("thesis.vox_shadows", t.voxShadows, "occlusion cones: shadows in direct light");
    visit.boolean("thesis.front_cone", t.frontCone, "one diffuse cone along the normal");
    visit.boolean("thesis.side_cones", t.sideCones, "four diffuse cones along the surface");
    visit.boolean("thesis.intermediate_cones", t.intermediateCones, "four diffuse cones at 45 degrees");
    visit.choice("thesis.diffuse.variant", t.diffuse.variant, kConeVariants,
                 "march through (chapter 4) or first hit (chapter 5)");
    visit.autoNumber("thesis.diffuse.aperture", t.diffuse.aperture, 0.001, 3.0, "rad",
                     "full angle of diffuse cones");
    visit.autoNumber("thesis.diffuse.dist_factor", t.diffuse.distFactor, 0.001, 4.0, "diameters",
                     "step of diffuse cones");
    visit.autoNumber("thesis.diffuse.offset", t.diffuse.offset, 0.0001, 10.0, "m",
                     "first sample of diffuse cones");
    visit.autoNumber("thesis.diffuse.origin_offset", t.diffuseOriginOffset, 0.0, 10.0, "m",
                     "start of diffuse cones along the normal");
    visit.choice("thesis.specular.variant", t.specular.variant, kConeVariants,
                 "as traced, or weighted by the angle to the light");
    visit.autoNumber("thesis.specular.aperture", t.specular.aperture, 0.001, 3.0, "rad",
                     "full angle of specular cones; auto: by shininess");
    visit.autoNumber("thesis.specular.dist_factor", t.specular.distFactor, 0.001, 4.0, "diameters",
                     "step of specular cones");
    visit.autoNumber("thesis.specular.offset", t.specular.offset, 0.0001, 10.0, "m",
                     "first sample of specular cones");
    visit.autoNumber("thesis.specular.shininess_falloff", t.shininessFalloff, 0.0, 100.0, "",
                     "exponent of the angular weight");
    visit.number("thesis.specular.min_weight", t.minSpecular, 0.0, 1.0, "",
                 "reflections of less weight are not traced");
    visit.choice("thesis.occlusion.variant", t.occlusion.variant, kConeVariants,
                 "plain, or damped near the surface");
    visit.autoNumber("thesis.occlusion.aperture", t.occlusion.aperture, 0.001, 3.0, "rad",
                     "full angle of occlusion cones");
    visit.autoNumber("thesis.occlusion.dist_factor", t.occlusion.distFactor, 0.001, 4.0, "diameters",
                     "step of occlusion cones");
    visit.autoNumber("thesis.occlusion.offset", t.occlusion.offset, 0.0001, 10.0, "m",
                     "first sample of occlusion cones");
    visit.number("thesis.occlusion.shadow_str", t.shadowStr, 0.0, 100.0, "",
                 "gain of the customised occlusion");
    visit.integer("thesis.max_samples", t.maxSamples, 1, 16384, 1, "samples", "limit per cone");
    visit.integer("thesis.voxel_level", t.voxelLevel, 0, 8, 1, "", "level that component voxels shows");
    visit.choice("thesis.voxel_view", t.voxelView, kThesisVoxelViews,
                 "component voxels: as cubes, or on the surfaces");
    visitThesisDefects(t.defects, visit);
}

// A set of whole numbers.
struct Whole {
    int low, high, multiple = 1;
    bool orZero = false;  // 0 too, below `low`
    bool square = false;  // squares only

    bool holds(int value) const {
        if (orZero && value == 0) return true;
        if (value < low || value > high || value % multiple != 0) return false;
        const int root = static_cast<int>(std::lround(std::sqrt(static_cast<double>(value))));
        return !square || root * root == value;
    }
    std::string range() const {
        if (!square)
            return (orZero ? "0, " : "") + std::to_string(low) + ".." + std::to_string(high) +
                   (multiple > 1 ? " by " + std::to_string(multiple) : "");
        std::string all;
        for (int value = low; value <= high; ++value)
            if (holds(value)) all += (all.empty() ? "" : ",") + std::to_string(value);
        return all;
    }
    std::string sentence() const {
        if (square) return "one of " + range();
        return (orZero ? "0 or a whole number from " : "a whole number from ") + std::to_string(low) +
               " to " + std::to_string(high) +
               (multiple > 1 ? ", a multiple of " + std::to_string(multiple) : "");
    }
};

// Calls visit.KIND(key, field, ...) for every setting. Kinds: boolean, integer (low, high, multiple of),
// whole (any other set of whole numbers), number, autoNumber, choice.
template <class S, class V>
void visitAll(S& s, V&& visit) {
    visit.choice("mode", s.mode, kModes, "how the picture is made");
    visit.choice("component", s.component, kComponents, "the part of the picture that is shown");
    visit.integer("voxels.size", s.voxels.size, 8, 512, 4, "voxels",
                  "voxels along the longest axis of the grid");
    visit.number("voxels.padding", s.voxels.padding, 0.0, 1.0, "",
                 "grid beyond the scene's bounds, as a fraction per side");
    constexpr const char* shift = "moves the grid, to see what its place changes (conelight score shift)";
    visit.number("voxels.shift_x", s.voxels.shift.x, 0.0, 1.0, "voxels", shift);
    visit.number("voxels.shift_y", s.voxels.shift.y, 0.0, 1.0, "voxels", shift);
    visit.number("voxels.shift_z", s.voxels.shift.z, 0.0, 1.0, "voxels", shift);
    visit.whole("light.shadow_size", s.light.shadowSize, Whole{64, 8192, 1, true, false}, "texels",
                "edge of a shadow map; 0: no shadows");
    visit.integer("light.shadow_filter", s.light.shadowFilter, 0, 4, 1, "texels",
                  "blur of shadow edges to either side; 0: as sharp as the map");
    visit.whole("light.area_samples", s.light.areaSamples, Whole{1, 64, 1, false, true}, "",
                "points per rectangular light, a square number");
    visit.boolean("light.emissive_quads", s.light.emissiveQuads,
                  "light flat rectangular emitters exactly, as area lights");
    visit.choice("phong.shadows", s.phong.shadows, kToggles,
                 "shadow maps in mode phong; auto: not in scenes of the thesis's format");
    visitThesis(s.thesis, visit);
    visitCones(s.cones, visit);
    visitTraced(s.traced, visit);
    visitView(s.view, visit);
    visit.number("image.exposure", s.image.exposure, -20.0, 20.0, "stops",
                 "brightness before the tone map: 2^exposure");
    visit.choice("image.tone_map", s.image.toneMap, kToneMaps,
                 "curve from linear radiance to the 8-bit picture");
    visit.boolean("image.srgb", s.image.srgb, "encode 8-bit pictures as sRGB");
}

// Numbers as text and back, the same under any locale of the host (printf and strtod follow it).
std::string numberText(double value) {
    char text[32];
    return std::string(text,
                       std::to_chars(text, text + sizeof text, value, std::chars_format::general, 6).ptr);
}
// The shortest text that reads back as the same float.
std::string numberText(float value) {
    char text[32];
    return std::string(text, std::to_chars(text, text + sizeof text, value).ptr);
}
std::optional<double> parsedNumber(const std::string& text) {
    const char* first = text.data();
    const char* const last = first + text.size();
    if (first != last && *first == '+') ++first;
    double value = 0;
    const auto [end, fault] = std::from_chars(first, last, value);
    if (fault != std::errc{} || end != last || first == last || !std::isfinite(value)) return std::nullopt;
    return value;
}

template <class T, std::size_t N>
std::string choiceNames(const Choice<T> (&choices)[N]) {
    std::string names;
    for (const auto& choice : choices) names += (names.empty() ? "" : ",") + std::string(choice.name);
    return names;
}

struct Getter {
    const std::string& key;
    std::string result;
    bool found = false;

    bool is(const char* name) { return key == name && (found = true); }
    void boolean(const char* name, const bool& value, const char*) {
        if (is(name)) result = value ? "true" : "false";
    }
    void integer(const char* name, const int& value, int low, int high, int multiple, const char* unit,
                 const char* help) {
        whole(name, value, Whole{low, high, multiple}, unit, help);
    }
    void whole(const char* name, const int& value, const Whole&, const char*, const char*) {
        if (is(name)) result = std::to_string(value);
    }
    void number(const char* name, const float& value, double, double, const char*, const char*) {
        if (is(name)) result = numberText(value);
    }
    void autoNumber(const char* name, const AutoFloat& value, double, double, const char*, const char*) {
        if (is(name)) result = value.isAuto ? "auto" : numberText(value.value);
    }
    template <class T, std::size_t N>
    void choice(const char* name, const T& value, const Choice<T> (&choices)[N], const char*) {
        if (!is(name)) return;
        for (const auto& one : choices)
            if (one.value == value) result = one.name;
    }
};

struct Setter {
    const std::string& key;
    const std::string& text;
    bool found = false;

    bool is(const char* name) { return key == name && (found = true); }
    [[noreturn]] void reject(const std::string& right) const {
        base::fail(ErrorKind::Usage, "setting %s: '%s' is not usable; %s would be right", key.c_str(),
                   text.c_str(), right.c_str());
    }
    float parse(double low, double high, const std::string& also) const {
        const std::optional<double> value = parsedNumber(text);
        if (!value || *value < low || *value > high)
            reject("a number from " + numberText(low) + " to " + numberText(high) + also);
        return static_cast<float>(*value);
    }
    void boolean(const char* name, bool& value, const char*) {
        if (!is(name)) return;
        if (text == "true" || text == "on" || text == "1")
            value = true;
        else if (text == "false" || text == "off" || text == "0")
            value = false;
        else
            reject("true or false");
    }
    void integer(const char* name, int& value, int low, int high, int multiple, const char* unit,
                 const char* help) {
        whole(name, value, Whole{low, high, multiple}, unit, help);
    }
    void whole(const char* name, int& value, const Whole& allowed, const char*, const char*) {
        if (!is(name)) return;
        const std::optional<double> parsed = parsedNumber(text);
        // Checked as a double first: a number beyond int has no value as one.
        if (!parsed || *parsed != std::floor(*parsed) || std::abs(*parsed) > allowed.high ||
            !allowed.holds(static_cast<int>(*parsed)))
            reject(allowed.sentence());
        value = static_cast<int>(*parsed);
    }
    void number(const char* name, float& value, double low, double high, const char*, const char*) {
        if (is(name)) value = parse(low, high, "");
    }
    void autoNumber(const char* name, AutoFloat& value, double low, double high, const char*, const char*) {
        if (!is(name)) return;
        if (text == "auto")
            value = AutoFloat{};
        else
            value = AutoFloat{false, parse(low, high, " or auto")};
    }
    template <class T, std::size_t N>
    void choice(const char* name, T& value, const Choice<T> (&choices)[N], const char*) {
        if (!is(name)) return;
        for (const auto& one : choices) {
            if (text != one.name) continue;
            value = one.value;
            return;
        }
        reject("one of " + choiceNames(choices));
    }
};

struct Describer {
    std::vector<SettingInfo> infos;

    void boolean(const char* name, const bool& value, const char* help) {
        infos.push_back({name, "bool", "", "true,false", value ? "true" : "false", help});
    }
    void integer(const char* name, const int& value, int low, int high, int multiple, const char* unit,
                 const char* help) {
        whole(name, value, Whole{low, high, multiple}, unit, help);
    }
    void whole(const char* name, const int& value, const Whole& allowed, const char* unit, const char* help) {
        infos.push_back({name, "int", unit, allowed.range(), std::to_string(value), help});
    }
    void number(const char* name, const float& value, double low, double high, const char* unit,
                const char* help) {
        infos.push_back(
            {name, "float", unit, numberText(low) + ".." + numberText(high), numberText(value), help});
    }
    void autoNumber(const char* name, const AutoFloat& value, double low, double high, const char* unit,
                    const char* help) {
        infos.push_back({name, "auto float", unit, "auto, " + numberText(low) + ".." + numberText(high),
                         value.isAuto ? "auto" : numberText(value.value), help});
    }
    template <class T, std::size_t N>
    void choice(const char* name, const T& value, const Choice<T> (&choices)[N], const char* help) {
        std::string current;
        for (const auto& one : choices)
            if (one.value == value) current = one.name;
        infos.push_back({name, "choice", "", choiceNames(choices), current, help});
    }
};

// Rejects values that a host wrote into the structs past setSetting.
struct Checker {
    [[noreturn]] static void reject(const char* name, const std::string& value, const std::string& right) {
        base::fail(ErrorKind::Usage, "setting %s: '%s' is not usable; %s would be right", name, value.c_str(),
                   right.c_str());
    }
    void boolean(const char*, const bool&, const char*) {}
    void integer(const char* name, const int& value, int low, int high, int multiple, const char* unit,
                 const char* help) {
        whole(name, value, Whole{low, high, multiple}, unit, help);
    }
    void whole(const char* name, const int& value, const Whole& allowed, const char*, const char*) {
        if (!allowed.holds(value)) reject(name, std::to_string(value), allowed.sentence());
    }
    void number(const char* name, const float& value, double low, double high, const char*, const char*) {
        // As floats: the nearest float to a bound is the bound. NaN fails both.
        if (!(value >= static_cast<float>(low) && value <= static_cast<float>(high)))
            reject(name, numberText(value), "a number from " + numberText(low) + " to " + numberText(high));
    }
    void autoNumber(const char* name, const AutoFloat& value, double low, double high, const char* unit,
                    const char* help) {
        if (!value.isAuto) number(name, value.value, low, high, unit, help);
    }
    template <class T, std::size_t N>
    void choice(const char* name, const T& value, const Choice<T> (&choices)[N], const char*) {
        for (const auto& one : choices)
            if (one.value == value) return;
        reject(name, std::to_string(static_cast<int>(value)), "one of " + choiceNames(choices));
    }
};

// Edit distance, for naming the nearest known key.
std::size_t editDistance(const std::string& a, const std::string& b) {
    std::vector<std::size_t> row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t above = row[j];
            row[j] = std::min({row[j] + 1, row[j - 1] + 1, diagonal + (a[i - 1] != b[j - 1] ? 1u : 0u)});
            diagonal = above;
        }
    }
    return row[b.size()];
}

[[noreturn]] void unknownKey(const std::string& key) {
    const SettingInfo* nearest = nullptr;
    std::size_t best = std::numeric_limits<std::size_t>::max();
    for (const SettingInfo& info : settingInfos()) {
        const std::size_t distance = editDistance(key, info.key);
        if (distance < best) {
            best = distance;
            nearest = &info;
        }
    }
    base::fail(
        ErrorKind::Usage,
        "setting %s: there is no such setting; %s would be the nearest (`conelight settings` lists all)",
        key.c_str(), nearest->key.c_str());
}

}  // namespace

std::vector<bool*> thesisDefectFlags(ThesisDefects& defects) {
    struct Collector {
        std::vector<bool*> flags;
        void boolean(const char*, bool& flag, const char*) { flags.push_back(&flag); }
    } collector;
    visitThesisDefects(defects, collector);
    return collector.flags;
}

const std::vector<SettingInfo>& settingInfos() {
    static const std::vector<SettingInfo> infos = [] {
        Describer describer;
        const Settings defaults;
        visitAll(defaults, describer);
        return describer.infos;
    }();
    return infos;
}

void setSetting(Settings& settings, const std::string& key, const std::string& value) {
    Setter setter{key, value};
    visitAll(settings, setter);
    if (!setter.found) unknownKey(key);
    if (key == "traced.quality") applyQuality(settings.traced, settings.traced.quality);
}

void applyQuality(TracedSettings& settings, Quality quality) {
    const int bounces = settings.bounces;
    const bool budgeted = settings.budgeted;
    TracedSettings s;  // interactive
    s.quality = quality;
    switch (quality) {
        case Quality::Draft:
            s.pixelRays = 0;
            s.specularLimit = 0.4f;
            s.passes = 4;
            s.filterLevels = 1;
            s.cacheUpdates = 48;
            break;
        case Quality::Interactive:
            break;
        case Quality::High:
            s.pixelRays = 4;
            s.specularRays = 2;
            s.specularLimit = 1;
            s.cacheUpdates = 64;
            break;
        case Quality::Converged:
            s.pixelRays = 8;
            s.filterLevels = 2;
            s.specularRays = 8;
            s.specularLimit = 1;
            s.cacheRays = 8;
            s.cacheUpdates = 46;
            break;
    }
    s.bounces = bounces;
    s.budgeted = budgeted;
    settings = s;
}

void validateSettings(const Settings& settings) {
    Checker checker;
    visitAll(settings, checker);
}

std::string getSetting(const Settings& settings, const std::string& key) {
    Getter getter{key, {}};
    visitAll(settings, getter);
    if (!getter.found) unknownKey(key);
    return getter.result;
}

}  // namespace conelight

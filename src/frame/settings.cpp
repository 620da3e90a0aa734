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

constexpr Choice<Mode> kModes[] = {{"phong", Mode::Phong}, {"thesis", Mode::Thesis}, {"cones", Mode::Cones}};
constexpr Choice<Component> kComponents[] = {
    {"full", Component::Full},       {"direct", Component::Direct},     {"indirect", Component::Indirect},
    {"diffuse", Component::Diffuse}, {"specular", Component::Specular}, {"occlusion", Component::Occlusion},
    {"albedo", Component::Albedo},   {"normal", Component::Normal},     {"depth", Component::Depth},
    {"voxels", Component::Voxels},   {"emission", Component::Emission}};
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

constexpr Choice<Toggle> kToggles[] = {
    {"auto", Toggle::Auto}, {"off", Toggle::Off}, {"on", Toggle::On}};

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
    visit.whole("light.shadow_size", s.light.shadowSize, Whole{64, 8192, 1, true, false}, "texels",
                "edge of a shadow map; 0: no shadows");
    visit.integer("light.shadow_filter", s.light.shadowFilter, 0, 4, 1, "texels",
                  "radius of the shadow filter");
    visit.whole("light.area_samples", s.light.areaSamples, Whole{1, 64, 1, false, true}, "",
                "points per rectangular light, a square number");
    visit.boolean("light.emissive_quads", s.light.emissiveQuads,
                  "light flat rectangular emitters exactly, as area lights");
    visit.choice("phong.shadows", s.phong.shadows, kToggles,
                 "shadow maps in mode phong; auto: not in scenes of the thesis's format");
    visitCones(s.cones, visit);
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

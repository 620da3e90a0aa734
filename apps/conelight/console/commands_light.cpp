// SPDX-License-Identifier: MIT
// `light`: print, add, change and delete lights.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "conelight/error.h"
#include "console/console.h"
#include "console/names.h"
#include "io/files.h"
#include "io/light_profile_file.h"
#include "io/scene_info.h"
#include "session/light_edit.h"
#include "session/light_units.h"
#include "session/usage.h"

namespace conelight::program {
namespace {

constexpr LightType kTypes[] = {LightType::Point, LightType::Spot, LightType::Directional,
                                LightType::Rect,  LightType::Disk, LightType::Sphere};

void printLight(const CommandContext& context, std::size_t index) {
    const Light& light = context.session.scene().lights[index];
    std::string line =
        fmt::format("{:3} {:<16} {:<11} intensity {} {}", index, light.name, io::lightTypeName(light.type),
                    textOf(light.intensity), io::lightUnit(light.type));
    if (const auto flux = radiantFlux(light)) line += "  flux " + textOf(*flux) + " W";
    for (const LightUnit unit : unitsOf(light))
        if (unit == LightUnit::Luminous || unit == LightUnit::LuminousFlux)
            line += fmt::format("  {:.4g} {}", strengthIn(light, unit), unitName(light.type, unit));
    if (const auto kelvin = kelvinOf(light.intensity); kelvin && light.intensity != glm::vec3(0))
        line += fmt::format("  {:.0f} K", *kelvin);
    if (light.type != LightType::Directional) line += "  at " + textOf(light.position);
    if (hasDirection(light.type) || light.profile != nullptr)
        line += "  direction " + textOf(light.direction);
    if (light.type == LightType::Spot)
        line += fmt::format("  angles {:.4g} {:.4g} deg", glm::degrees(light.innerAngle),
                            glm::degrees(light.outerAngle));
    if (light.type == LightType::Sphere) line += fmt::format("  radius {:.4g} m", glm::length(light.halfU));
    if (light.type == LightType::Rect || light.type == LightType::Disk)
        line +=
            fmt::format("  size {:.4g} {:.4g} m", 2 * glm::length(light.halfU), 2 * glm::length(light.halfV));
    if (light.profile != nullptr) line += "  profile " + io::oneLine(light.profile->file);
    if (light.range > 0) line += fmt::format("  range {:.4g} m", light.range);
    if (light.customFalloff) line += "  falloff " + textOf(light.falloff);
    if (!light.castsShadow) line += "  no shadows";
    if (!light.enabled) line += "  off";
    context.print(line);
}

std::vector<float> numbers(const std::string& what, const std::vector<std::string>& words, std::size_t count,
                           double low, double high, const char* unit) {
    if (words.size() != count)
        usage(fmt::format("light: {} takes {} number{}, got {}", what, count, count == 1 ? "" : "s",
                          words.size()));
    std::vector<float> values;
    for (const std::string& word : words) {
        const double value = numberFrom("light: " + what, word);
        if (value < low || value > high)
            usage(fmt::format("light: {}: '{}' is not usable; {:g} to {:g}{}{} would be right", what, word,
                              low, high, *unit == '\0' ? "" : " ", unit));
        values.push_back(static_cast<float>(value));
    }
    return values;
}

glm::vec3 vector(const std::vector<float>& v) { return {v[0], v[1], v[2]}; }

void aim(Light& light, const glm::vec3& direction) {
    if (!(glm::length(direction) > 0)) usage("light: direction has no length");
    aimLight(light, direction);
}

bool onOff(const std::string& what, const std::vector<std::string>& words) {
    const std::string word = words.size() == 1 ? words[0] : "";
    if (word == "on" || word == "true") return true;
    if (word == "off" || word == "false") return false;
    usage(fmt::format("light: {}: on or off would be right", what));
}

void needs(const Light& light, const std::string& what, bool fits) {
    if (!fits) usage(fmt::format("light: {}: a {} light has none", what, io::lightTypeName(light.type)));
}

const std::vector<std::string> kWords = {
    "intensity", "flux",      "lumen", "candela", "lux", "nit", "kelvin",  "angles",  "size", "radius",
    "position",  "direction", "range", "falloff", "on",  "off", "shadows", "profile", "name", "delete"};

void changeShape(Light& light, const std::string& what, const std::vector<std::string>& words) {
    if (what == "angles") {
        needs(light, what, light.type == LightType::Spot);
        const std::vector<float> v = numbers(what, words, 2, 0, 90, "deg");
        if (!(v[0] < v[1])) usage("light: angles: the inner one must be less than the outer one");
        light.innerAngle = glm::radians(v[0]);
        light.outerAngle = glm::radians(v[1]);
    } else if (what == "radius") {
        needs(light, what, light.type == LightType::Disk || light.type == LightType::Sphere);
        const float radius = numbers(what, words, 1, 1e-6, 1e6, "m")[0];
        light.halfU = radius * glm::normalize(light.halfU);
        light.halfV = radius * glm::normalize(light.halfV);
    } else {
        needs(light, what, light.type == LightType::Rect || light.type == LightType::Disk);
        const std::vector<float> v = numbers(what, words, 2, 1e-6, 1e6, "m");
        light.halfU = 0.5f * v[0] * glm::normalize(light.halfU);
        light.halfV = 0.5f * v[1] * glm::normalize(light.halfV);
    }
}

// profile FILE|none
void changeProfile(Light& light, const std::vector<std::string>& words) {
    needs(light, "profile", light.type == LightType::Point || light.type == LightType::Spot);
    if (words.empty()) usage("light: profile takes an IES file, or none");
    std::string file = words[0];
    for (std::size_t i = 1; i < words.size(); ++i) file += " " + words[i];
    if (file == "none")
        light.profile = nullptr;
    else
        io::setLightProfile(light, io::readLightProfile(file));
}

void changeFalloff(Light& light, const std::vector<std::string>& words) {
    needs(light, "falloff", light.type == LightType::Point || light.type == LightType::Spot);
    if (words.size() == 1 && words[0] == "off") {
        light.customFalloff = false;
        return;
    }
    const glm::vec3 falloff = vector(numbers("falloff", words, 3, 0, 1e6, ""));
    if (falloff == glm::vec3(0)) usage("light: falloff: not all three may be 0");
    light.customFalloff = true;
    light.falloff = falloff;
}

[[noreturn]] void hasNoFlux(const Light& light, const std::string& what) {
    usage("light: " + what +
          (light.type == LightType::Directional
               ? ": a directional light has none; its irradiance (intensity, lux) would be right"
               : ": with a falloff of its own it has no physical unit; `falloff off` first would be right"));
}

// Strength in photometric units, colour by temperature: one number each.
void changePhotometric(Light& light, const std::string& what, const std::vector<std::string>& words) {
    const bool isKelvin = what == "kelvin";
    const std::string unit = isKelvin ? "K" : what == "lumen" ? "lm" : "";
    const float value =
        numbers(what, words, 1, isKelvin ? kLeastKelvin : 0, isKelvin ? kMostKelvin : 1e12, unit.c_str())[0];
    if (isKelvin) return setKelvin(light, value, LightUnit::Luminous);
    if (what == "candela")
        needs(light, "luminous intensity", light.type == LightType::Point || light.type == LightType::Spot);
    if (what == "lux") needs(light, "illuminance", light.type == LightType::Directional);
    if (what == "nit") needs(light, "luminance", hasArea(light.type));
    if (what == "lumen" && !radiantFlux(light)) hasNoFlux(light, what);
    setStrength(light, what == "lumen" ? LightUnit::LuminousFlux : LightUnit::Luminous, value);
}

void change(Light& light, const std::string& what, std::vector<std::string> words) {
    if (what == "intensity") {
        if (words.size() == 1) words.resize(3, words[0]);
        light.intensity = vector(numbers(what, words, 3, 0, 1e9, io::lightUnit(light.type)));
    } else if (what == "flux") {
        if (words.size() == 1) words.resize(3, words[0]);
        if (!setRadiantFlux(light, vector(numbers(what, words, 3, 0, 1e9, "W")))) hasNoFlux(light, what);
    } else if (what == "lumen" || what == "candela" || what == "lux" || what == "nit" || what == "kelvin") {
        changePhotometric(light, what, words);
    } else if (what == "position") {
        needs(light, what, light.type != LightType::Directional);
        light.position = vector(numbers(what, words, 3, -1e6, 1e6, "m"));
    } else if (what == "direction") {
        needs(light, what, hasDirection(light.type) || light.profile != nullptr);
        aim(light, vector(numbers(what, words, 3, -1e6, 1e6, "")));
    } else if (what == "angles" || what == "size" || what == "radius") {
        changeShape(light, what, words);
    } else if (what == "range") {
        light.range = numbers(what, words, 1, 0, 1e6, "m")[0];
    } else if (what == "profile") {
        changeProfile(light, words);
    } else if (what == "falloff") {
        changeFalloff(light, words);
    } else if (what == "on" || what == "off") {
        numbers(what, words, 0, 0, 0, "");
        light.enabled = what == "on";
    } else if (what == "shadows") {
        light.castsShadow = onOff(what, words);
    } else if (what == "name") {
        if (words.size() != 1) usage("light: name: takes one word");
        light.name = words[0];
    } else {
        const std::string near = nearest(what, kWords);
        std::string all;
        for (const std::string& word : kWords) all += (all.empty() ? "" : ", ") + word;
        usage(fmt::format("light: there is no property '{}'; {} would be right", what,
                          near.empty() ? "one of " + all : near));
    }
}

void addLight(const CommandContext& context) {
    if (context.count() < 2 || context.count() > 3)
        usage(
            "light add: takes a type and a name; light add point|spot|directional|rect|disk|sphere [NAME] "
            "would be right");
    const auto type = std::find_if(std::begin(kTypes), std::end(kTypes),
                                   [&](LightType one) { return context.words[1] == io::lightTypeName(one); });
    if (type == std::end(kTypes))
        usage(fmt::format(
            "light add: there is no type '{}'; point, spot, directional, rect, disk or sphere would be right",
            context.words[1]));
    std::vector<Light> lights = context.session.scene().lights;
    const std::string name = context.count() == 3 ? context.words[2] : fmt::format("light{}", lights.size());
    lights.push_back(lightAt(context.session.camera(), *type, name));
    context.session.setLights(lights, "light add " + name);
    context.session.select({SelectionKind::Light, lights.size() - 1});
}

void light(const CommandContext& context) {
    Session& session = context.session;
    if (context.count() == 0) return printLights(context);
    if (context.words[0] == "add") return addLight(context);
    std::vector<std::string> words = context.words;
    if (words[0] == "delete" && words.size() == 2) std::swap(words[0], words[1]);
    requireName("light", "light", lightNames(session), words[0]);
    const std::vector<std::size_t> found = lightsNamed(session, words[0]);
    if (words.size() == 1) {
        for (const std::size_t index : found) printLight(context, index);
        return;
    }
    std::vector<Light> lights = session.scene().lights;
    if (words[1] == "delete") {
        if (words.size() > 2) usage("light: delete takes nothing more");
        for (auto index = found.rbegin(); index != found.rend(); ++index)
            lights.erase(lights.begin() + static_cast<std::ptrdiff_t>(*index));
    } else {
        for (const std::size_t index : found)
            change(lights[index], words[1], {words.begin() + 2, words.end()});
    }
    session.setLights(lights, "light " + words[0] + " " + words[1]);
}

}  // namespace

void printLights(const CommandContext& context) {
    for (std::size_t i = 0; i < context.session.scene().lights.size(); ++i) printLight(context, i);
    if (context.session.scene().lights.empty()) context.print("no lights");
}

Command lightCommand() {
    Command command;
    command.name = "light";
    command.arguments = {{"NAME", ArgumentKind::Light, true},
                         {"PROPERTY", ArgumentKind::Choice, true, false, "", 0, 0, {}},
                         {"VALUE", ArgumentKind::Text, true, true}};
    command.arguments[1].kind = ArgumentKind::Text;
    command.arguments[1].choices = kWords;
    command.help = "print, add, change or delete lights";
    command.details =
        "light                      all of them\n"
        "light add TYPE [NAME]      point, spot, directional, rect, disk or sphere; at the eye, along the "
        "view\n"
        "light NAME                 one of them\n"
        "light NAME intensity R G B W/sr (point, spot), W/m^2 (directional), W/(sr m^2) (rect, disk, "
        "sphere)\n"
        "light NAME position X Y Z  m\n"
        "light NAME direction X Y Z where it shines (not point, sphere)\n"
        "light NAME angles IN OUT   half angles of a spot, degrees\n"
        "light NAME size W H        of a rect or disk, m; light NAME radius M: of a disk or sphere\n"
        "light NAME range M         0: unlimited\n"
        "light NAME flux R G B      all that it sends out, W: sets the intensity for its shape\n"
        "light NAME lumen V         the same in lm; 683 lm/W times the luminance of its colour, which stays\n"
        "light NAME candela V       its intensity in cd (point, spot); lux V (directional), nit V: cd/m^2 "
        "(rect, disk, sphere)\n"
        "light NAME kelvin T        colour of a black body, 1000 to 40000 K; candela, lux or nit stay\n"
        "light NAME profile FILE   strength by direction, and the strength, of an IES file (point, spot); "
        "none: even\n"
        "light NAME falloff C L Q   1 / (C + L d + Q d^2); off: the inverse square\n"
        "light NAME on|off          light NAME shadows on|off\n"
        "light NAME name NEW        light NAME delete";
    command.run = light;
    return command;
}

}  // namespace conelight::program

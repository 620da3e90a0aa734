// SPDX-License-Identifier: MIT
// Values of settings as text and back, the same under any locale of the host (printf and strtod follow it).
#include "settings/setting.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/log.h"

namespace conelight {
namespace {

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

std::string joined(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : ",") + word;
    return text;
}

// Whether a whole number is one of those that the setting takes.
bool holds(const SettingInfo& info, double value) {
    if (value != std::floor(value)) return false;
    if (info.zeroToo && value == 0) return true;
    if (value < info.low || value > info.high || std::fmod(value, info.step) != 0) return false;
    const double root = std::round(std::sqrt(value));
    return !info.squares || root * root == value;
}

std::string squaresText(const SettingInfo& info) {
    std::vector<std::string> all;
    for (int value = static_cast<int>(info.low); value <= static_cast<int>(info.high); ++value)
        if (holds(info, value)) all.push_back(std::to_string(value));
    return joined(all);
}

std::string limitText(const SettingInfo& info, double limit) {
    return info.kind == SettingKind::Int ? std::to_string(static_cast<int>(limit)) : numberText(limit);
}

// What would be right, for messages.
std::string rightText(const SettingInfo& info) {
    if (info.kind == SettingKind::Bool) return "true or false";
    if (info.kind == SettingKind::Choice) return "one of " + joined(info.choices);
    if (info.squares) return "one of " + squaresText(info);
    const std::string ends = limitText(info, info.low) + " to " + limitText(info, info.high);
    std::string text = info.kind == SettingKind::Float ? "a number from " : "a whole number from ";
    if (info.zeroToo) text = "0 or " + text;
    text += ends;
    if (info.step > 1) text += ", a multiple of " + std::to_string(info.step);
    if (!info.word.empty()) text += " or " + info.word;
    return text;
}

}  // namespace

std::string rangeText(const SettingInfo& info) {
    if (!info.isNumber()) return joined(info.choices);
    if (info.squares) return squaresText(info);
    std::string text = info.word.empty() ? "" : info.word + ", ";
    if (info.zeroToo) text += "0, ";
    text += limitText(info, info.low) + ".." + limitText(info, info.high);
    if (info.step > 1) text += " by " + std::to_string(info.step);
    return text;
}

namespace settings {
namespace {

[[noreturn]] void reject(const SettingInfo& info, const std::string& value) {
    base::fail(ErrorKind::Usage, "setting %s: '%s' is not usable; %s would be right", info.key.c_str(),
               value.c_str(), rightText(info).c_str());
}

int wholeFrom(const SettingInfo& info, const std::string& text) {
    const std::optional<double> value = parsedNumber(text);
    // Checked as a double first: a number beyond int has no value as one.
    if (!value || !holds(info, *value)) reject(info, text);
    return static_cast<int>(*value);
}

float floatFrom(const SettingInfo& info, const std::string& text) {
    const std::optional<double> value = parsedNumber(text);
    if (!value || *value < info.low || *value > info.high) reject(info, text);
    return static_cast<float>(*value);
}

bool boolFrom(const SettingInfo& info, const std::string& text) {
    if (text == "true" || text == "on" || text == "1") return true;
    if (text != "false" && text != "off" && text != "0") reject(info, text);
    return false;
}

std::string textOf(bool value) { return value ? "true" : "false"; }
std::string textOf(int value) { return std::to_string(value); }
std::string textOf(const std::optional<int>& value) { return value ? std::to_string(*value) : "all"; }
std::string textOf(float value) { return numberText(value); }
std::string textOf(const AutoFloat& value) { return value.isAuto ? "auto" : numberText(value.value); }

void parse(const Setting<Settings>& setting, const std::string& text, bool& value) {
    value = boolFrom(setting.info, text);
}
void parse(const Setting<Settings>& setting, const std::string& text, int& value) {
    value = wholeFrom(setting.info, text);
}
void parse(const Setting<Settings>& setting, const std::string& text, std::optional<int>& value) {
    const bool isWord =
        text == setting.info.word || (setting.wordNumber && parsedNumber(text) == setting.wordNumber);
    value = isWord ? std::nullopt : std::optional<int>(wholeFrom(setting.info, text));
}
void parse(const Setting<Settings>& setting, const std::string& text, float& value) {
    value = floatFrom(setting.info, text);
}
void parse(const Setting<Settings>& setting, const std::string& text, AutoFloat& value) {
    value = text == "auto" ? AutoFloat{} : AutoFloat{false, floatFrom(setting.info, text)};
}

bool usable(const SettingInfo&, bool) { return true; }
bool usable(const SettingInfo& info, int value) { return holds(info, value); }
bool usable(const SettingInfo& info, const std::optional<int>& value) {
    return !value || holds(info, *value);
}
// As floats: the nearest float to a bound is the bound. NaN fails both.
bool usable(const SettingInfo& info, float value) {
    return value >= static_cast<float>(info.low) && value <= static_cast<float>(info.high);
}
bool usable(const SettingInfo& info, const AutoFloat& value) {
    return value.isAuto || usable(info, value.value);
}

}  // namespace

std::string textOf(const Setting<Settings>& setting, const Settings& settings) {
    return std::visit(
        [&](const auto& field) -> std::string {
            if constexpr (requires { field.choose; })
                return field.name(settings);
            else
                return textOf(field.get(settings));
        },
        setting.field);
}

void setFromText(const Setting<Settings>& setting, Settings& settings, const std::string& text) {
    std::visit(
        [&](const auto& field) {
            if constexpr (requires { field.choose; }) {
                const std::vector<std::string>& words = setting.info.choices;
                const auto found = std::find(words.begin(), words.end(), text);
                if (found == words.end()) reject(setting.info, text);
                field.choose(settings, static_cast<std::size_t>(found - words.begin()));
            } else {
                parse(setting, text, field.edit(settings));
            }
        },
        setting.field);
}

void check(const Setting<Settings>& setting, const Settings& settings) {
    const bool right = std::visit(
        [&](const auto& field) {
            if constexpr (requires { field.choose; }) {
                const std::vector<std::string>& words = setting.info.choices;
                return std::find(words.begin(), words.end(), field.name(settings)) != words.end();
            } else {
                return usable(setting.info, field.get(settings));
            }
        },
        setting.field);
    if (!right) reject(setting.info, textOf(setting, settings));
}

}  // namespace settings
}  // namespace conelight

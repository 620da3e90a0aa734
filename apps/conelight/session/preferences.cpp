// SPDX-License-Identifier: MIT
#include "session/preferences.h"

#include <fmt/core.h>

#include <functional>
#include <map>
#include <sstream>

#include "conelight/error.h"
#include "conelight/settings.h"

namespace conelight::program {
namespace {

constexpr const char* kFirstLine = "conelight preferences";

// A number in a range, in any locale; false for anything else.
bool takeNumber(const std::string& text, float low, float high, float& value) {
    std::istringstream stream(text);
    stream.imbue(std::locale::classic());
    float number = 0;
    char more = 0;
    if (!(stream >> number) || stream >> more || !(number >= low && number <= high)) return false;
    value = number;
    return true;
}

bool takeWhole(const std::string& text, float low, float high, int& value) {
    float number = 0;
    if (!takeNumber(text, low, high, number) || number != static_cast<float>(static_cast<int>(number)))
        return false;
    value = static_cast<int>(number);
    return true;
}

bool takeWord(const std::string& text, const char* yes, const char* no, bool& value) {
    if (text != yes && text != no) return false;
    value = text == yes;
    return true;
}

}  // namespace

std::string textOf(const Preferences& p) {
    const auto onOff = [](bool on) { return on ? "on" : "off"; };
    return fmt::format(
        "{}\nui_scale {:g}\ntheme {}\nside_width {:g}\nconsole_height {:g}\nside_panels {}\nconsole {}\n"
        "window_width {}\nwindow_height {}\n",
        kFirstLine, p.uiScale, p.light ? "light" : "dark", p.sideEm, p.consoleEm, onOff(p.side),
        onOff(p.console), p.width, p.height);
}

Preferences preferencesOf(const std::string& text) {
    Preferences p;
    constexpr float kLargest = 16384;
    const std::map<std::string, std::function<bool(const std::string&)>> takers = {
        {"ui_scale", [&](const std::string& v) { return v == "0" || takeNumber(v, 0.5f, 4, p.uiScale); }},
        {"theme", [&](const std::string& v) { return takeWord(v, "light", "dark", p.light); }},
        {"side_width", [&](const std::string& v) { return takeNumber(v, 10, 60, p.sideEm); }},
        {"console_height", [&](const std::string& v) { return takeNumber(v, 4, 60, p.consoleEm); }},
        {"side_panels", [&](const std::string& v) { return takeWord(v, "on", "off", p.side); }},
        {"console", [&](const std::string& v) { return takeWord(v, "on", "off", p.console); }},
        {"window_width",
         [&](const std::string& v) { return v == "0" || takeWhole(v, 160, kLargest, p.width); }},
        {"window_height",
         [&](const std::string& v) { return v == "0" || takeWhole(v, 120, kLargest, p.height); }}};
    std::istringstream stream(text);
    std::string line;
    for (int number = 1; std::getline(stream, line); ++number) {
        const std::size_t space = line.find(' ');
        const auto taker = takers.find(line.substr(0, space));
        const bool first = number == 1;
        const bool good = first ? line == kFirstLine
                          : taker == takers.end()
                              ? space != std::string::npos
                              : space != std::string::npos && taker->second(line.substr(space + 1));
        if (!good) throw Error(ErrorKind::BadInput, fmt::format("line {} is not usable", number));
    }
    return p;
}

}  // namespace conelight::program

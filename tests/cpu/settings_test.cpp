// SPDX-License-Identifier: MIT
// Every setting: text goes in and comes out the same, values out of range do not, and each has what the
// documentation shows.
#include "conelight/settings.h"

#include <gtest/gtest.h>

#include <clocale>
#include <cmath>
#include <limits>
#include <set>

#include "conelight/error.h"

namespace conelight::test {
namespace {

// The message of the Error(Usage) that setting `key` to `value` throws, empty when it throws none.
std::string failureOf(const std::string& key, const std::string& value) {
    Settings settings;
    try {
        setSetting(settings, key, value);
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::Usage);
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
        return error.what();
    }
    return "";
}

std::vector<std::string> split(const std::string& text, char at) {
    std::vector<std::string> parts(1);
    for (const char c : text) {
        if (c == at)
            parts.emplace_back();
        else
            parts.back().push_back(c);
    }
    return parts;
}

// The two ends of "0.1..2", "0, 64..8192", "8..512 by 4" or "auto, 0..1e+06".
std::pair<double, double> endsOf(const std::string& range) {
    const std::size_t comma = range.find(", ");
    const std::string numbers = comma == std::string::npos ? range : range.substr(comma + 2);
    const std::size_t dots = numbers.find("..");
    EXPECT_NE(dots, std::string::npos) << range;
    return {std::stod(numbers), std::stod(numbers.substr(dots + 2))};
}

bool isNumber(const SettingInfo& info) {
    return info.type == "int" || info.type == "float" || info.type == "auto float";
}

// Values that the setting must take, from its own description.
std::vector<std::string> goodValues(const SettingInfo& info) {
    if (!isNumber(info)) return split(info.range, ',');
    if (info.range.find("..") == std::string::npos) return split(info.range, ',');
    std::vector<std::string> values{info.defaultValue};
    const auto [low, high] = endsOf(info.range);
    char text[64];
    for (const double value : {low, high}) {
        std::snprintf(text, sizeof text, "%.9g", value);
        values.emplace_back(text);
    }
    if (info.type == "auto float") values.emplace_back("auto");
    if (info.range.rfind("0, ", 0) == 0) values.emplace_back("0");
    return values;
}

}  // namespace

TEST(SettingsTest, EachHasWhatTheManualShows) {
    const std::set<std::string> types{"bool", "int", "float", "auto float", "choice"};
    const std::set<std::string> units{"",          "rad",   "m",   "voxels",  "texels", "stops", "footprints",
                                      "diameters", "cones", "deg", "samples", "steps",  "faces"};
    std::set<std::string> keys;
    for (const SettingInfo& info : settingInfos()) {
        EXPECT_TRUE(keys.insert(info.key).second) << info.key << " twice";
        EXPECT_EQ(info.key.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789._"), std::string::npos)
            << info.key;
        EXPECT_TRUE(types.count(info.type)) << info.key << ": " << info.type;
        EXPECT_TRUE(units.count(info.unit))
            << info.key << ": unit '" << info.unit << "'; add it here if it is one";
        EXPECT_FALSE(info.range.empty()) << info.key;
        EXPECT_FALSE(info.defaultValue.empty()) << info.key;
        EXPECT_GE(info.help.size(), 10u) << info.key;
        EXPECT_EQ(info.help.find('\n'), std::string::npos) << info.key;
        EXPECT_NE(info.help.back(), '.') << info.key << ": a phrase, no sentence";
        if (isNumber(info) && info.range.find("..") != std::string::npos) {
            EXPECT_LT(endsOf(info.range).first, endsOf(info.range).second) << info.key;
        }
    }
    EXPECT_GE(keys.size(), 20u);
}

TEST(SettingsTest, DefaultsAreUsableAndAreTheStructs) {
    const Settings settings;
    for (const SettingInfo& info : settingInfos())
        EXPECT_EQ(getSetting(settings, info.key), info.defaultValue) << info.key;
    EXPECT_NO_THROW(validateSettings(settings));
    EXPECT_EQ(getSetting(settings, "voxels.size"), "128");
    EXPECT_EQ(getSetting(settings, "voxels.padding"), "0.03");
    EXPECT_EQ(getSetting(settings, "mode"), "traced");
    EXPECT_EQ(getSetting(settings, "cones.max_distance"), "auto");
}

// A quality fills in the group, which stays open to single settings; bounces and budgeted are not its own.
TEST(SettingsTest, QualityFillsInItsGroup) {
    Settings settings;
    setSetting(settings, "traced.bounces", "3");
    setSetting(settings, "traced.budgeted", "true");
    setSetting(settings, "traced.quality", "draft");
    EXPECT_EQ(getSetting(settings, "traced.pixel_rays"), "0");
    EXPECT_EQ(getSetting(settings, "traced.bounces"), "3");
    EXPECT_EQ(getSetting(settings, "traced.budgeted"), "true");
    setSetting(settings, "traced.pixel_rays", "5");
    EXPECT_EQ(settings.traced.pixelRays, 5);
    setSetting(settings, "traced.quality", "interactive");
    setSetting(settings, "traced.bounces", "16");
    setSetting(settings, "traced.budgeted", "false");
    EXPECT_EQ(settings.traced, TracedSettings{});
}

TEST(SettingsTest, EachTakesItsRangeAndGivesItBack) {
    for (const SettingInfo& info : settingInfos()) {
        if (info.key == "traced.quality") continue;  // sets others as well: the test above
        for (const std::string& value : goodValues(info)) {
            Settings settings;
            ASSERT_NO_THROW(setSetting(settings, info.key, value)) << info.key << "=" << value;
            const std::string text = getSetting(settings, info.key);
            if (!isNumber(info) || value == "auto")
                EXPECT_EQ(text, value) << info.key;
            else
                EXPECT_EQ(std::stof(text), std::stof(value)) << info.key;
            // Text to value to text is stable, and other settings are untouched.
            Settings again;
            setSetting(again, info.key, text);
            for (const SettingInfo& other : settingInfos())
                EXPECT_EQ(getSetting(again, other.key), other.key == info.key ? text : other.defaultValue)
                    << other.key;
            EXPECT_NO_THROW(validateSettings(again)) << info.key << "=" << value;
        }
    }
}

TEST(SettingsTest, FloatsKeepEveryBit) {
    Settings settings;
    float value = 0.01f;
    while (value < 1.0f) {
        settings.voxels.padding = value;
        Settings again;
        setSetting(again, "voxels.padding", getSetting(settings, "voxels.padding"));
        ASSERT_EQ(again.voxels.padding, value);
        value = std::nextafter(value * 1.01f, 2.0f);
    }
}

TEST(SettingsTest, EachRejectsWhatIsOutOfRange) {
    for (const SettingInfo& info : settingInfos()) {
        std::vector<std::string> bad{"", " ", "nonsense", "nan", "inf", "1e999", "--1", "0x10", "1,5", "1 "};
        if (isNumber(info) && info.range.find("..") != std::string::npos) {
            const auto [low, high] = endsOf(info.range);
            bad.push_back(std::to_string(low - 1));
            bad.push_back(std::to_string(high + 1));
        }
        if (info.type == "int") bad.insert(bad.end(), {"1.5", "1e10", "-99999999999999", "2147483648"});
        for (const std::string& value : bad) {
            Settings settings;
            EXPECT_THROW(setSetting(settings, info.key, value), Error) << info.key << "='" << value << "'";
            EXPECT_EQ(getSetting(settings, info.key), info.defaultValue)
                << info.key << " changed by a rejected value";
        }
    }
}

TEST(SettingsTest, MessagesSayWhatWouldBeRight) {
    EXPECT_EQ(failureOf("voxels.size", "130"),
              "setting voxels.size: '130' is not usable; a whole number from 8 to 512, a multiple of 4 would "
              "be right");
    EXPECT_EQ(failureOf("voxels.padding", "2"),
              "setting voxels.padding: '2' is not usable; a number from 0 to 1 would be right");
    EXPECT_EQ(
        failureOf("light.shadow_size", "63"),
        "setting light.shadow_size: '63' is not usable; 0 or a whole number from 64 to 8192 would be right");
    EXPECT_EQ(failureOf("light.area_samples", "15"),
              "setting light.area_samples: '15' is not usable; one of 1,4,9,16,25,36,49,64 would be right");
    EXPECT_EQ(failureOf("image.srgb", "maybe"),
              "setting image.srgb: 'maybe' is not usable; true or false would be right");
    EXPECT_EQ(failureOf("image.tone_map", "filmic"),
              "setting image.tone_map: 'filmic' is not usable; one of none,reinhard,aces would be right");
    EXPECT_EQ(
        failureOf("cones.max_distance", "far"),
        "setting cones.max_distance: 'far' is not usable; a number from 0 to 1e+06 or auto would be right");
    for (const char* value : {"on", "1", "true", "off", "0", "false"})
        EXPECT_EQ(failureOf("image.srgb", value), "");
    EXPECT_EQ(failureOf("voxels.size", "+64"), "");
}

TEST(SettingsTest, AnUnknownKeyNamesTheNearest) {
    const auto nearest = [](const std::string& key) {
        const std::string message = failureOf(key, "1");
        EXPECT_EQ(message.rfind("setting " + key + ": there is no such setting; ", 0), 0u) << message;
        return message;
    };
    EXPECT_NE(nearest("voxels.sise").find("; voxels.size would be the nearest"), std::string::npos);
    EXPECT_NE(nearest("image.tonemap").find("; image.tone_map would be"), std::string::npos);
    EXPECT_NE(nearest("MODE").find("; mode would be"), std::string::npos);
    nearest("");
    EXPECT_THROW(getSetting(Settings{}, "voxels"), Error);
}

// A host may write the structs past setSetting; the renderer checks before it draws.
TEST(SettingsTest, ValuesWrittenIntoTheStructsAreChecked) {
    const auto failure = [](auto change) -> std::string {
        Settings settings;
        change(settings);
        try {
            validateSettings(settings);
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::Usage);
            return error.what();
        }
        return "";
    };
    EXPECT_EQ(failure([](Settings& s) { s.voxels.size = 130; }),
              "setting voxels.size: '130' is not usable; a whole number from 8 to 512, a multiple of 4 would "
              "be right");
    EXPECT_NE(failure([](Settings& s) { s.image.exposure = std::numeric_limits<float>::quiet_NaN(); }), "");
    EXPECT_NE(failure([](Settings& s) { s.cones.maxDistance = {false, -1.0f}; }), "");
    EXPECT_EQ(failure([](Settings& s) { s.cones.maxDistance = {true, -1.0f}; }), "");
    EXPECT_NE(failure([](Settings& s) { s.mode = static_cast<Mode>(99); }), "");
    EXPECT_NE(failure([](Settings& s) { s.light.areaSamples = 2; }), "");
}

// The host's locale must not change how numbers are read.
TEST(SettingsTest, LocaleDoesNotMatter) {
    const std::string old = std::setlocale(LC_ALL, nullptr);
    const char* comma = nullptr;
    for (const char* name : {"de_DE.UTF-8", "fr_FR.UTF-8", "de_DE.utf8"})
        if (comma == nullptr) comma = std::setlocale(LC_ALL, name);
    Settings settings;
    setSetting(settings, "voxels.padding", "0.5");
    EXPECT_EQ(settings.voxels.padding, 0.5f);
    EXPECT_EQ(getSetting(settings, "voxels.padding"), "0.5");
    std::setlocale(LC_ALL, old.c_str());
    if (comma == nullptr) GTEST_SKIP() << "no locale with a decimal comma is installed";
}

}  // namespace conelight::test

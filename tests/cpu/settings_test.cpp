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

std::string textOf(double value) {
    char text[64];
    std::snprintf(text, sizeof text, "%.9g", value);
    return text;
}

// Values that the setting must take, from its own description.
std::vector<std::string> goodValues(const SettingInfo& info) {
    if (!info.isNumber()) return info.choices;
    std::vector<std::string> values{info.defaultValue, textOf(info.low), textOf(info.high)};
    if (!info.word.empty()) values.push_back(info.word);
    if (info.zeroToo) values.emplace_back("0");
    for (int root = 1; info.squares && root * root <= info.high; ++root)
        values.push_back(std::to_string(root * root));
    return values;
}

}  // namespace

TEST(SettingsTest, EachHasWhatTheManualShows) {
    const std::set<std::string> units{"",        "rad",        "m",         "voxels", "texels",
                                      "stops",   "footprints", "diameters", "cones",  "deg",
                                      "samples", "steps",      "faces",     "ms",     "K"};
    std::set<std::string> keys;
    for (const SettingInfo& info : settingInfos()) {
        EXPECT_TRUE(keys.insert(info.key).second) << info.key << " twice";
        EXPECT_EQ(info.key.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789._"), std::string::npos)
            << info.key;
        EXPECT_TRUE(units.count(info.unit))
            << info.key << ": unit '" << info.unit << "'; add it here if it is one";
        EXPECT_FALSE(rangeText(info).empty()) << info.key;
        EXPECT_FALSE(info.defaultValue.empty()) << info.key;
        EXPECT_GE(info.help.size(), 10u) << info.key;
        EXPECT_EQ(info.help.find('\n'), std::string::npos) << info.key;
        EXPECT_NE(info.help.back(), '.') << info.key << ": a phrase, no sentence";
        if (info.isNumber())
            EXPECT_LT(info.low, info.high) << info.key;
        else
            EXPECT_GE(info.choices.size(), 2u) << info.key;
        EXPECT_EQ(findSetting(info.key), &info);
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
    setSetting(settings, "traced.bounces", "all");
    setSetting(settings, "traced.budgeted", "false");
    EXPECT_EQ(settings.traced, TracedSettings{});
}

TEST(SettingsTest, EachTakesItsRangeAndGivesItBack) {
    for (const SettingInfo& info : settingInfos()) {
        for (const std::string& value : goodValues(info)) {
            Settings settings;
            ASSERT_NO_THROW(setSetting(settings, info.key, value)) << info.key << "=" << value;
            const std::string text = getSetting(settings, info.key);
            if (!info.isNumber() || value == info.word)
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
        if (info.isNumber()) {
            bad.push_back(std::to_string(info.low - 1));
            // The number after the last bounce is read as `all`.
            bad.push_back(std::to_string(info.high + (info.word == "all" ? 2 : 1)));
        }
        if (info.kind == SettingKind::Int)
            bad.insert(bad.end(), {"1.5", "1e10", "-99999999999999", "2147483648"});
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
              "setting image.tone_map: 'filmic' is not usable; one of none,reinhard,aces,agx,neutral would "
              "be right");
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
    EXPECT_NE(failure([](Settings& s) {
                  s.image.exposure = {false, std::numeric_limits<float>::quiet_NaN()};
              }),
              "");
    EXPECT_NE(failure([](Settings& s) { s.cones.maxDistance = {false, -1.0f}; }), "");
    EXPECT_EQ(failure([](Settings& s) { s.cones.maxDistance = {true, -1.0f}; }), "");
    EXPECT_NE(failure([](Settings& s) { s.mode = Mode("nobody"); }), "");
    EXPECT_NE(failure([](Settings& s) { s.light.areaSamples = 2; }), "");
}

TEST(SettingsTest, RangesAreNumbers) {
    const SettingInfo& size = *findSetting("voxels.size");
    EXPECT_EQ(size.kind, SettingKind::Int);
    EXPECT_EQ(size.low, 8);
    EXPECT_EQ(size.high, 512);
    EXPECT_EQ(size.step, 4);
    EXPECT_EQ(rangeText(size), "8..512 by 4");
    EXPECT_TRUE(findSetting("light.shadow_size")->zeroToo);
    EXPECT_EQ(rangeText(*findSetting("light.shadow_size")), "0, 64..8192");
    EXPECT_TRUE(findSetting("light.area_samples")->squares);
    EXPECT_EQ(rangeText(*findSetting("light.area_samples")), "1,4,9,16,25,36,49,64");
    EXPECT_EQ(findSetting("cones.max_distance")->word, "auto");
    EXPECT_EQ(rangeText(*findSetting("cones.max_distance")), "auto, 0..1e+06");
    EXPECT_EQ(rangeText(*findSetting("image.tone_map")), "none,reinhard,aces,agx,neutral");
    EXPECT_EQ(rangeText(*findSetting("image.srgb")), "true,false");
    EXPECT_EQ(findSetting("nothing.of.the.kind"), nullptr);
}

// Two settings are equal when every value is: each changed value is seen, and setting it back is too.
TEST(SettingsTest, EqualityLooksAtEveryValue) {
    for (const SettingInfo& info : settingInfos()) {
        Settings settings;
        EXPECT_EQ(settings, Settings{});
        for (const std::string& value : goodValues(info)) {
            setSetting(settings, info.key, value);
            EXPECT_EQ(settings == Settings{}, getSetting(settings, info.key) == info.defaultValue)
                << info.key << "=" << value;
        }
        setSetting(settings, info.key, info.defaultValue);
        EXPECT_EQ(settings, Settings{}) << info.key;
    }
}

TEST(SettingsTest, AutomaticNumbersAreEqualWhateverTheyHold) {
    EXPECT_EQ((AutoFloat{true, 1}), (AutoFloat{true, 2}));
    EXPECT_FALSE((AutoFloat{false, 1}) == (AutoFloat{false, 2}));
    EXPECT_FALSE((AutoFloat{true, 1}) == (AutoFloat{false, 1}));
}

// The word in the settings is found from the settings: one change makes them nobody's, taking it back undoes
// that. Bounces and budgeted belong to none.
TEST(SettingsTest, PresetWordsAreFoundFromTheSettings) {
    ASSERT_EQ(presetInfos().size(), 1u);
    const SettingInfo& quality = presetInfos().front();
    EXPECT_EQ(quality.key, "traced.quality");
    EXPECT_EQ(quality.defaultValue, "interactive");
    EXPECT_EQ(findSetting(quality.key), &quality);
    Settings settings;
    for (const std::string& word : quality.choices) {
        setSetting(settings, quality.key, word);
        EXPECT_EQ(getSetting(settings, quality.key), word);
        setSetting(settings, "traced.bounces", "2");
        EXPECT_EQ(getSetting(settings, quality.key), word);
        const Settings preset = settings;
        setSetting(settings, "traced.passes", "77");
        EXPECT_EQ(getSetting(settings, quality.key), "custom");
        EXPECT_FALSE(qualityOf(settings.traced));
        setSetting(settings, "traced.passes", getSetting(preset, "traced.passes"));
        EXPECT_EQ(settings, preset);
    }
    EXPECT_EQ(
        failureOf("traced.quality", "best"),
        "setting traced.quality: 'best' is not usable; one of draft,interactive,high,converged would be "
        "right");
}

// Scripts and files say 16 for all bounces; the value itself is no number.
TEST(SettingsTest, AllBouncesAreAWord) {
    Settings settings;
    EXPECT_EQ(settings.traced.bounces, std::nullopt);
    setSetting(settings, "traced.bounces", "0");
    EXPECT_EQ(settings.traced.bounces, 0);
    for (const char* all : {"all", "16"}) {
        setSetting(settings, "traced.bounces", "15");
        EXPECT_EQ(settings.traced.bounces, 15);
        setSetting(settings, "traced.bounces", all);
        EXPECT_EQ(settings.traced.bounces, std::nullopt);
        EXPECT_EQ(getSetting(settings, "traced.bounces"), "all");
    }
    EXPECT_EQ(
        failureOf("traced.bounces", "17"),
        "setting traced.bounces: '17' is not usable; a whole number from 0 to 15 or all would be right");
    settings.traced.bounces = 16;
    EXPECT_THROW(validateSettings(settings), Error);
}

// Each axis is a number or the eye's.
TEST(SettingsTest, AnAnchorIsAPointOrFollowsTheEye) {
    Settings settings;
    EXPECT_EQ(settings.voxels.anchor.around({1, 2, 3}), glm::vec3(1, 2, 3));
    EXPECT_FALSE(settings.voxels.anchor.isPoint());
    setSetting(settings, "voxels.anchor_y", "-4.5");
    EXPECT_EQ(settings.voxels.anchor.around({1, 2, 3}), glm::vec3(1, -4.5f, 3));
    EXPECT_FALSE(settings.voxels.anchor.isPoint());
    setSetting(settings, "voxels.anchor_x", "7");
    setSetting(settings, "voxels.anchor_z", "0");
    EXPECT_EQ(settings.voxels.anchor, VoxelAnchor::at({7, -4.5f, 0}));
    EXPECT_TRUE(settings.voxels.anchor.isPoint());
    EXPECT_EQ(
        failureOf("voxels.anchor_x", "nan"),
        "setting voxels.anchor_x: 'nan' is not usable; a number from -1e+09 to 1e+09 or auto would be right");
    for (const float bad :
         {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        settings.voxels.anchor = VoxelAnchor::at({0, 0, bad});
        EXPECT_THROW(validateSettings(settings), Error);
    }
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

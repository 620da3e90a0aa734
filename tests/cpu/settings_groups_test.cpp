// SPDX-License-Identifier: MIT
// Settings of a guest: a struct that the library does not know, found by key as
// the library's own are.
#include <gtest/gtest.h>

#include <algorithm>

#include "conelight/error.h"
#include "conelight/settings.h"
#include "settings/registry.h"

namespace conelight::test {
namespace {

enum class Waves { Calm, High };

struct Water {
    float depth = 2;
    AutoFloat tint;
    Waves waves = Waves::Calm;
    bool operator==(const Water&) const = default;
};

constexpr settings::Choice<Waves> kWaves[] = {{"calm", Waves::Calm}, {"high", Waves::High}};
constexpr Mode kRiver{"river"};

void registerWater() {
    const std::vector<settings::Setting<Water>> rows{
        {"depth", &Water::depth, settings::Numbers{0.5, 100}, "m", "height of the water"},
        {"tint", &Water::tint, settings::Numbers{0, 1}, "", "share of light that it keeps"},
        {"waves", &Water::waves, kWaves, "how rough the surface is"},
    };
    settings::registerSettings("water.", rows, "view.");
    settings::registerModeName(kRiver, Mode::Traced);
}

class SettingsGroupsTest : public testing::Test {
  protected:
    SettingsGroupsTest() { registerWater(); }
};

}  // namespace

TEST_F(SettingsGroupsTest, KeysReachTheGroup) {
    Settings settings;
    EXPECT_EQ(getSetting(settings, "water.depth"), "2");
    EXPECT_EQ(getSetting(settings, "water.tint"), "auto");
    setSetting(settings, "water.depth", "7.5");
    setSetting(settings, "water.waves", "high");
    EXPECT_EQ(settings.groups.of<Water>().depth, 7.5f);
    EXPECT_EQ(settings.groups.of<Water>().waves, Waves::High);
    EXPECT_THROW(setSetting(settings, "water.depth", "0.1"), Error);
    EXPECT_THROW(setSetting(settings, "water.waves", "low"), Error);
    EXPECT_EQ(getSetting(settings, "water.depth"), "7.5");
    settings.groups.of<Water>().depth = 1000;
    EXPECT_THROW(validateSettings(settings), Error);
}

TEST_F(SettingsGroupsTest, CopiesAreDeepAndComparedByValue) {
    Settings a;
    const Settings untouched;
    EXPECT_EQ(a.groups.of<Water>().depth,
              2);  // writes the group, as it is by default
    EXPECT_EQ(a, untouched);
    EXPECT_EQ(untouched, a);
    Settings b = a;
    b.groups.of<Water>().depth = 3;
    EXPECT_EQ(a.groups.of<Water>().depth, 2);
    EXPECT_NE(a, b);
    EXPECT_NE(b, untouched);
    EXPECT_NE(untouched, b);
    setSetting(b, "water.depth", "2");
    EXPECT_EQ(b, untouched);
}

TEST_F(SettingsGroupsTest, ListsHaveTheGroupOnceInItsPlace) {
    registerWater();
    const std::vector<SettingInfo>& infos = settingInfos();
    const auto isWater = [](const SettingInfo& info) { return info.key.compare(0, 6, "water.") == 0; };
    EXPECT_EQ(std::count_if(infos.begin(), infos.end(), isWater), 3);
    const auto first = std::find_if(infos.begin(), infos.end(), isWater);
    ASSERT_NE(first, infos.end());
    EXPECT_EQ(first->key, "water.depth");
    EXPECT_EQ(first->low, 0.5);
    EXPECT_EQ(first->unit, "m");
    EXPECT_EQ((first + 3)->key.compare(0, 5, "view."), 0);
    const std::vector<settings::Setting<Water>> again{
        {"size", &Water::depth, settings::Numbers{0, 1}, "m", "x"}};
    EXPECT_THROW(settings::registerSettings("voxels.", again), Error);
    EXPECT_EQ(findSetting("voxels.size")->unit, "voxels");
}

TEST_F(SettingsGroupsTest, ModesHaveNames) {
    const std::vector<std::string>& names = findSetting("mode")->choices;
    EXPECT_EQ(std::count(names.begin(), names.end(), "river"), 1);
    const auto river = std::find(names.begin(), names.end(), "river");
    EXPECT_EQ(*(river + 1), "traced");
    Settings settings;
    EXPECT_EQ(settings.mode, Mode::Traced);
    setSetting(settings, "mode", "river");
    EXPECT_EQ(settings.mode, kRiver);
    EXPECT_EQ(settings.mode.name(), "river");
    EXPECT_NO_THROW(validateSettings(settings));
    EXPECT_THROW(setSetting(settings, "mode", "sea"), Error);
    settings.mode = Mode("sea");
    EXPECT_THROW(validateSettings(settings), Error);
    EXPECT_LT(Mode::Cones, Mode::Traced);
}

}  // namespace conelight::test

// SPDX-License-Identifier: MIT
// Settings for C: by name and text, from the library's table.
#include "settings.h"

#include "conelight/light_field.h"
#include "guests.h"
#include "structs.h"

using namespace conelight;
using c::guarded;
using c::need;

conelight_result conelight_settings_create(conelight_settings** settings) {
    return guarded([&] {
        c::registerGuests();
        need(settings, "settings") = new conelight_settings;
    });
}

conelight_result conelight_settings_create_realtime(conelight_settings** settings) {
    return guarded([&] {
        c::registerGuests();
        need(settings, "settings") = new conelight_settings{realtimeSettings()};
    });
}

void conelight_settings_destroy(conelight_settings* settings) { delete settings; }

conelight_result conelight_settings_set(conelight_settings* settings, const char* key, const char* value) {
    return guarded(
        [&] { setSetting(need(settings, "settings").settings, &need(key, "key"), &need(value, "value")); });
}

conelight_result conelight_settings_follow(conelight_settings* settings, const conelight_scene* scene) {
    return guarded([&] {
        Settings followed = need(settings, "settings").settings;
        for (const auto& [key, value] : need(scene, "scene").scene.settings) setSetting(followed, key, value);
        settings->settings = followed;
    });
}

conelight_result conelight_settings_get(conelight_settings* settings, const char* key, const char** value) {
    return guarded([&] {
        need(settings, "settings");
        need(value, "value");
        const std::string name = &need(key, "key");
        if (findSetting(name) == nullptr) {
            Settings scratch;
            setSetting(scratch, name, "");  // throws, and names the nearest
        }
        settings->text = getSetting(settings->settings, name);
        *value = settings->text.c_str();
    });
}

const char* conelight_setting_key(size_t index) {
    const char* key = nullptr;
    static_cast<void>(guarded([&] {
        c::registerGuests();
        if (index < settingInfos().size()) key = settingInfos()[index].key.c_str();
    }));
    return key;
}

const char* conelight_setting_help(size_t index) {
    const char* help = nullptr;
    static_cast<void>(guarded([&] {
        c::registerGuests();
        if (index < settingInfos().size()) help = settingInfos()[index].help.c_str();
    }));
    return help;
}

// SPDX-License-Identifier: MIT
#pragma once

#include "conelight.h"
#include "conelight/settings.h"

struct conelight_settings {
    conelight::Settings settings;
    std::string text;  // what conelight_settings_get returned last
};

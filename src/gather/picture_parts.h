// SPDX-License-Identifier: MIT
// Which gathered parts a component of the picture is made of; none for views of something else.
#pragma once

#include "conelight/settings.h"

namespace conelight::gather {

struct PictureParts {
    bool direct = false, diffuse = false, specular = false;
};

inline PictureParts partsOf(Component component) {
    switch (component) {
        case Component::Full:
            return {true, true, true};
        case Component::Direct:
            return {true, false, false};
        case Component::Indirect:
            return {false, true, true};
        case Component::Diffuse:
            return {false, true, false};
        case Component::Specular:
            return {false, false, true};
        default:
            return {};
    }
}

}  // namespace conelight::gather

// SPDX-License-Identifier: MIT
// What a picture of the window depends on.
#pragma once

#include <cstdint>

#include "session/session.h"

namespace conelight::program {

// What the picture depends on; selection and the list of cameras are not part of it.
struct PictureKey {
    std::uint64_t tables = 0, settings = 0, camera = 0, flags = 0;
    bool operator==(const PictureKey&) const = default;
};
inline PictureKey keyOf(const Revisions& r) { return {r.sceneTables(), r.settings, r.camera, r.flags}; }

// Whether two settings give the same linear picture: all but exposure, bloom, tone map and encoding.
inline bool sameButLook(Settings a, const Settings& b) {
    const ImageSettings own = a.image;
    a.image = b.image;
    return a == b && own.antialiasing == b.image.antialiasing && own.temporal == b.image.temporal;
}

}  // namespace conelight::program

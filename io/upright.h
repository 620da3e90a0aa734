// SPDX-License-Identifier: MIT
// Which way up a model stands, where its file does not say.
#pragma once

#include "conelight/scene.h"

namespace conelight::io {

// For formats whose models mostly stand along z, and do not say so: turns the scene so that +z becomes +y, unless it
// stands along y far better. A model stands on what lies in the lowest 3 % of its height; one that stands better has
// at least twice as large a part of its outline between the ends of that. Adds a note when it turns.
void turnUpright(Scene& scene);

}  // namespace conelight::io

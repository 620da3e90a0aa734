// SPDX-License-Identifier: MIT
// Inputs for programs of the host's: uniform blocks and textures at binding points and units that it chose. They stay
// bound: it is the host's state that is changed here.
#pragma once

#include <span>

#include "gl/inputs.h"

namespace conelight::gl {

struct HostSlots {
    std::span<const ResourceName> blocks;  // in the order of their binding points
    int firstBlock;
    std::span<const ResourceName> textures;  // in the order of their units
    int firstTexture;
};
// Throws Error(Usage) for points or units that the driver has not. What `given` lacks is bound to nothing; textures
// without a sampler of their own get theirs.
void bindForHost(const Inputs& given, const HostSlots& slots);

}  // namespace conelight::gl

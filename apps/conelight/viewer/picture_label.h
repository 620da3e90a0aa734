// SPDX-License-Identifier: MIT
// How far the picture of a mode is, in a line: modes that work in the background, and those that settle over passes.
#pragma once

#include <optional>
#include <string>

#include "viewer/background_reference.h"
#include "viewer/bake_progress.h"

namespace conelight::program {

// `preview`: until then another mode's picture stands there.
std::string referenceLabel(const ReferenceStatus& status, bool preview);
std::string beamsLabel(const ReferenceStatus& status, bool preview);
std::string radiosityLabel(const BakeStatus& status, bool preview);
std::string hybridLabel(const BakeStatus& status, bool baked);  // `baked`: shown with some baked light
// `passes` of `all` are drawn.
std::string tracedLabel(int passes, int all, const std::optional<double>& noise);

}  // namespace conelight::program

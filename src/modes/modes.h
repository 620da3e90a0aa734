// SPDX-License-Identifier: MIT
// Which class draws which mode.
#pragma once

#include <memory>

#include "conelight/settings.h"
#include "modes/frame_context.h"

namespace conelight::modes {

std::unique_ptr<ModeRenderer> makeModeRenderer(Mode mode);

}  // namespace conelight::modes

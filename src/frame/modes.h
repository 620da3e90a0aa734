// SPDX-License-Identifier: MIT
// Which class draws which mode.
#pragma once

#include <memory>

#include "conelight/settings.h"
#include "frame/frame_context.h"

namespace conelight::frame {

std::unique_ptr<ModeRenderer> makeModeRenderer(Mode mode);

}  // namespace conelight::frame

// SPDX-License-Identifier: MIT
#include "modes/modes.h"

#include "base/log.h"
#include "conelight/thesis/settings.h"
#include "modes/cones_mode.h"
#include "modes/phong_mode.h"
#include "modes/thesis_mode.h"
#include "modes/traced_mode.h"

namespace conelight::modes {

std::unique_ptr<ModeRenderer> makeModeRenderer(Mode mode) {
    if (mode == Mode::Phong) return std::make_unique<PhongMode>();
    if (mode == thesis::kMode) return std::make_unique<ThesisMode>();
    if (mode == Mode::Cones) return std::make_unique<ConesMode>();
    if (mode == Mode::Traced) return std::make_unique<TracedMode>();
    base::fail(ErrorKind::Usage, "mode: nothing draws '%s'", std::string(mode.name()).c_str());
}

}  // namespace conelight::modes

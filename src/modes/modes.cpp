// SPDX-License-Identifier: MIT
#include "modes/modes.h"

#include "base/log.h"
#include "modes/cones_mode.h"
#include "modes/phong_mode.h"
#include "modes/traced_mode.h"
#include "thesis/render/mode.h"

namespace conelight::modes {

std::unique_ptr<ModeRenderer> makeModeRenderer(Mode mode) {
    switch (mode) {
        case Mode::Phong:
            return std::make_unique<PhongMode>();

        case Mode::Thesis:
            return std::make_unique<ThesisMode>();

        case Mode::Cones:
            return std::make_unique<ConesMode>();

        case Mode::Traced:
            return std::make_unique<TracedMode>();
    }
    base::fail(ErrorKind::Usage, "mode: not built yet");
}

}  // namespace conelight::modes

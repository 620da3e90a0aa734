// SPDX-License-Identifier: MIT
#include "frame/modes.h"

#include "base/log.h"
#include "frame/cones_mode.h"
#include "frame/phong_mode.h"
#include "frame/thesis_mode.h"
#include "frame/traced_mode.h"

namespace conelight::frame {

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

}  // namespace conelight::frame

// SPDX-License-Identifier: MIT
#include "guests.h"

#include "conelight/thesis/thesis.h"
#include "thesis/console/commands.h"
#include "thesis/format/format.h"

namespace conelight::program {

void registerGuests() {
    thesis::registerThesis();
    thesis::registerThesisFormat();
    thesis::registerThesisCommands();
}

}  // namespace conelight::program

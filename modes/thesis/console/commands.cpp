// SPDX-License-Identifier: MIT
#include "thesis/console/commands.h"

namespace conelight::thesis {

void registerThesisCommands() {
    program::registerCommands(viewCommands);
    program::registerCommands(coneCommands);
    program::registerCommands(modelCommands);
}

}  // namespace conelight::thesis

// SPDX-License-Identifier: MIT
// Commands of the thesis's program for the console, with what differs here (`conelight commands --original`).
#pragma once

#include "console/command_table.h"

namespace conelight::thesis {

// Call before a console is used, from one thread; a second call does nothing.
void registerThesisCommands();

program::CommandGroup viewCommands();   // commands_view.cpp
program::CommandGroup coneCommands();   // commands_cones.cpp
program::CommandGroup modelCommands();  // commands_models.cpp

}  // namespace conelight::thesis

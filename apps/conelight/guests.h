// SPDX-License-Identifier: MIT
// Modes with a folder of their own (modes/) that the program brings along.
#pragma once

namespace conelight::program {

// Adds modes, scene formats and console commands of all guests to the lists. First thing in main().
void registerGuests();

}  // namespace conelight::program

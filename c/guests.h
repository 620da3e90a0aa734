// SPDX-License-Identifier: MIT
#pragma once

namespace conelight::c {

// Adds the modes of modes/ and their settings to the library's lists. Any thread, any number of times.
void registerGuests();

}  // namespace conelight::c

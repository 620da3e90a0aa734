// SPDX-License-Identifier: MIT
// What was typed, in a shell or the console, cannot be done as it was typed.
#pragma once

#include <string>

#include "conelight/error.h"

namespace conelight::program {

[[noreturn]] inline void usage(const std::string& message) { throw Error(ErrorKind::Usage, message); }

}  // namespace conelight::program

// SPDX-License-Identifier: MIT
// Messages to the host's callback (setLogCallback) and printf-style text, so that the core needs no
// formatting library.
#pragma once

#include <string>

#include "conelight/error.h"

namespace conelight::base {

// printf into a std::string; arguments are checked by the compiler.
[[gnu::format(printf, 1, 2)]] std::string format(const char* pattern, ...);

// Sends one line to the host's callback. Thread-safe.
void log(LogLevel level, const std::string& message);

// Throws Error(kind) with a printf-style message.
[[noreturn, gnu::format(printf, 2, 3)]] void fail(ErrorKind kind, const char* pattern, ...);

}  // namespace conelight::base

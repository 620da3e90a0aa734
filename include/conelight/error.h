// SPDX-License-Identifier: MIT
// Errors and messages of the library. See docs/development/errors.md for which kind is used when.
#pragma once

#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>

#include "conelight/export.h"

namespace conelight {

// What kind of failure an Error reports; the program turns each kind into an exit status.
enum class ErrorKind {
    Runtime,   // failed while running (exit 1)
    Usage,     // wrong settings or arguments (exit 2)
    BadInput,  // a file that cannot be used (exit 3)
    NoGl,      // no usable OpenGL 4.5 (exit 4)
};

// A failure at run time. what() is one line: "FILE: where: what is wrong; what would be right".
class CONELIGHT_API Error : public std::runtime_error {
  public:
    Error(ErrorKind kind, const std::string& message) : std::runtime_error(message), kind_(kind) {}
    ErrorKind kind() const noexcept { return kind_; }

  private:
    ErrorKind kind_;
};

enum class LogLevel { Debug, Info, Warning, Error };
using LogCallback = std::function<void(LogLevel, std::string_view message)>;

// Sets where messages go (process-wide; empty: nowhere, which is the default). The library itself prints
// nothing. The callback may be called from any thread that calls the library, one call at a time.
CONELIGHT_API void setLogCallback(LogCallback callback);

}  // namespace conelight

// SPDX-License-Identifier: MIT
#include "base/log.h"

#include <cstdarg>
#include <cstdio>
#include <memory>
#include <mutex>

namespace conelight {
namespace {
std::recursive_mutex callbackMutex;  // recursive: a callback may log, or set another callback
std::shared_ptr<const LogCallback> callback;

std::string formatList(const char* pattern, va_list arguments) {
    va_list copy;
    va_copy(copy, arguments);
    const int length = std::vsnprintf(nullptr, 0, pattern, copy);
    va_end(copy);
    std::string text(length > 0 ? static_cast<std::size_t>(length) : 0, '\0');
    if (length > 0) std::vsnprintf(text.data(), text.size() + 1, pattern, arguments);
    return text;
}
}  // namespace

void setLogCallback(LogCallback newCallback) {
    auto shared = newCallback ? std::make_shared<const LogCallback>(std::move(newCallback)) : nullptr;
    const std::lock_guard lock(callbackMutex);
    callback.swap(shared);
}

namespace base {

std::string format(const char* pattern, ...) {
    va_list arguments;
    va_start(arguments, pattern);
    std::string text = formatList(pattern, arguments);
    va_end(arguments);
    return text;
}

void log(LogLevel level, const std::string& message) {
    const std::lock_guard lock(callbackMutex);
    // Kept alive over the call, in which the host may set another.
    const auto current = callback;
    if (current) (*current)(level, message);
}

void fail(ErrorKind kind, const char* pattern, ...) {
    va_list arguments;
    va_start(arguments, pattern);
    std::string text = formatList(pattern, arguments);
    va_end(arguments);
    throw Error(kind, text);
}

}  // namespace base
}  // namespace conelight

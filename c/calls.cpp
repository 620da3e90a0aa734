// SPDX-License-Identifier: MIT
#include "calls.h"

#include <new>

#include "conelight/version.h"

namespace conelight::c {
namespace {

thread_local std::string kept;
thread_local const char* message = "";

conelight_result keep(conelight_result result, const char* what) noexcept {
    try {
        kept = what;
        message = kept.c_str();
    } catch (...) {
        message = "memory: there is none left";
    }
    return result;
}

conelight_result resultOf(ErrorKind kind) {
    switch (kind) {
        case ErrorKind::Runtime:
            return CONELIGHT_RUNTIME;
        case ErrorKind::Usage:
            return CONELIGHT_USAGE;
        case ErrorKind::BadInput:
            return CONELIGHT_BAD_INPUT;
        case ErrorKind::NoGl:
            return CONELIGHT_NO_GL;
    }
    return CONELIGHT_RUNTIME;
}

}  // namespace

conelight_result resultOfException() noexcept {
    try {
        throw;
    } catch (const Error& error) {
        return keep(resultOf(error.kind()), error.what());
    } catch (const std::bad_alloc&) {
        return keep(CONELIGHT_RUNTIME, "memory: there is none left");
    } catch (const std::exception& error) {
        return keep(CONELIGHT_RUNTIME, error.what());
    } catch (...) {
        return keep(CONELIGHT_RUNTIME, "an unknown exception");
    }
}

void failUsage(const std::string& text) { throw Error(ErrorKind::Usage, text); }

}  // namespace conelight::c

using namespace conelight;

const char* conelight_message(void) { return c::message; }

uint32_t conelight_version(void) {
    return CONELIGHT_VERSION_MAJOR * 65536 + CONELIGHT_VERSION_MINOR * 256 + CONELIGHT_VERSION_PATCH;
}

conelight_result conelight_set_log(conelight_log log, void* user) {
    return c::guarded([&] {
        if (log == nullptr) return setLogCallback({});
        setLogCallback([log, user](LogLevel level, std::string_view text) {
            log(static_cast<int>(level), std::string(text).c_str(), user);
        });
    });
}

// SPDX-License-Identifier: MIT
#include "calls.h"

#include <fmt/core.h>

#include <mutex>
#include <utility>
#include <vector>

namespace conelight::python {
namespace {

struct Waiting {
    std::mutex mutex;
    std::vector<std::pair<LogLevel, std::string>> messages;
};
// Never destroyed: threads may still log while the process ends.
Waiting& waiting() {
    static Waiting* const all = new Waiting;
    return *all;
}

const char* methodOf(LogLevel level) {
    switch (level) {
        case LogLevel::Debug:
            return "debug";
        case LogLevel::Info:
            return "info";
        case LogLevel::Warning:
            return "warning";
        case LogLevel::Error:
            return "error";
    }
    return "info";
}

}  // namespace

void keepMessages() {
    setLogCallback([](LogLevel level, std::string_view message) {
        Waiting& all = waiting();
        const std::lock_guard lock(all.mutex);
        constexpr std::size_t kMost = 10000;
        if (all.messages.size() < kMost) all.messages.emplace_back(level, message);
    });
}

void passMessages() {
    std::vector<std::pair<LogLevel, std::string>> messages;
    {
        Waiting& all = waiting();
        const std::lock_guard lock(all.mutex);
        messages.swap(all.messages);
    }
    if (messages.empty()) return;
    // An error on its way keeps its place.
    const py::error_scope kept;
    try {
        const py::object logger = py::module_::import("logging").attr("getLogger")("conelight");
        for (const auto& [level, message] : messages) logger.attr(methodOf(level))("%s", message);
    } catch (py::error_already_set& error) {
        error.discard_as_unraisable("conelight");
    }
}

py::object Keywords::take(const char* name) {
    return left_.contains(name) ? py::object(left_.attr("pop")(name)) : py::none();
}

void Keywords::finish() const {
    for (const auto& [name, value] : left_)
        throw py::type_error(call_ + "() got an unexpected keyword argument '" + std::string(py::str(name)) +
                             "'");
}

int bouncesOf(const py::object& given, int least) {
    if (given.is_none() || (py::isinstance<py::str>(given) && given.cast<std::string>() == "all")) return -1;
    try {
        const int bounces = given.cast<int>();
        if (bounces >= least && bounces <= 1000) return bounces;
    } catch (const py::cast_error&) {
    }
    throw Error(ErrorKind::Usage,
                fmt::format("bounces: {} is out of range; {} to 1000, or 'all', would be right",
                            std::string(py::repr(given)), least));
}

}  // namespace conelight::python

// SPDX-License-Identifier: MIT
// What all calls share: long work without Python's lock, the library's messages as Python's logging, keyword
// arguments by name.
#pragma once

#include <pybind11/pybind11.h>

#include <exception>
#include <optional>
#include <string>
#include <string_view>

#include "conelight/error.h"

namespace conelight::python {

namespace py = pybind11;

// Messages of the library, from any thread, wait here until a call hands them to logging.getLogger("conelight").
void keepMessages();
// Needs Python's lock.
void passMessages();

// Runs `work` without Python's lock, then passes the messages on.
template <class Work>
auto unlocked(Work&& work) {
    struct AtEnd {
        std::optional<py::gil_scoped_release> released{std::in_place};
        ~AtEnd() {
            released.reset();
            passMessages();
        }
    } atEnd;
    return work();
}

// Keyword arguments that a call takes by name. Those left over when finish() is called are unknown to it: TypeError.
class Keywords {
  public:
    Keywords(std::string call, const py::kwargs& given)
        : call_(std::move(call)), left_(given.attr("copy")()) {}

    // None when not given.
    py::object take(const char* name);
    template <class T>
    T take(const char* name, T otherwise) {
        const py::object value = take(name);
        if (value.is_none()) return otherwise;
        try {
            return value.cast<T>();
        } catch (const py::cast_error&) {
            throw py::type_error(call_ + "(): " + name + ": " + std::string(py::repr(value)) +
                                 " is of the wrong type");
        }
    }
    void finish() const;

  private:
    std::string call_;
    py::dict left_;
};

// The argument `progress` of long calls, which work without Python's lock: looks for Ctrl-C and asks the callback.
class ProgressCall {
  public:
    explicit ProgressCall(py::object callback) : callback_(std::move(callback)) {}
    // Whether to go on; what Python raises is kept.
    template <class Now>
    bool operator()(const Now& now) {
        const py::gil_scoped_acquire locked;
        try {
            if (PyErr_CheckSignals() != 0) throw py::error_already_set();
            if (callback_.is_none()) return true;
            const py::object answer = callback_(now);
            if (answer.is_none()) return true;
            const int isTrue = PyObject_IsTrue(answer.ptr());
            if (isTrue < 0) throw py::error_already_set();
            stopped_ = isTrue == 0;
        } catch (...) {
            failure_ = std::current_exception();
            return false;
        }
        return !stopped_;
    }
    bool stopped() const { return stopped_; }  // by the callback
    void rethrow() const {
        if (failure_) std::rethrow_exception(failure_);
    }

  private:
    py::object callback_;
    std::exception_ptr failure_;
    bool stopped_ = false;
};

// Bounces of indirect light: -1 for None and 'all', else `least` to 1000.
int bouncesOf(const py::object& given, int least);

}  // namespace conelight::python

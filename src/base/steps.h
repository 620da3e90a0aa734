// SPDX-License-Identifier: MIT
// Work in steps: a coroutine that rests where it says `co_await` of something that rests (gl::rest), and goes on when
// step() is called. Steps that wait for others are one piece of work. Work that is destroyed before it is done goes no
// further: its locals are destroyed.
//
// What a coroutine is given by reference has to live until it is done.
#pragma once

#include <coroutine>
#include <exception>
#include <utility>

namespace conelight::base {

class [[nodiscard]] Steps {
  public:
    struct promise_type;
    using Handle = std::coroutine_handle<promise_type>;

    Steps() = default;  // nothing to do
    Steps(Steps&& other) noexcept : handle_(std::exchange(other.handle_, nullptr)) {}
    Steps& operator=(Steps&& other) noexcept {
        std::swap(handle_, other.handle_);
        return *this;
    }
    ~Steps() {
        if (handle_) handle_.destroy();
    }

    bool done() const { return !handle_ || handle_.done(); }
    // Goes on to the next rest. Throws what the work throws; it is done then.
    void step();
    void finish() {
        while (!done()) step();
    }

    struct Whole;
    Whole operator co_await() const noexcept;  // within other steps: all of these

  private:
    explicit Steps(Handle handle) : handle_(handle) {}
    Handle handle_ = nullptr;
};

struct Steps::promise_type {
    promise_type* outermost = this;
    Handle innermost;  // of the outermost: what is to go on
    Handle outer;      // which waits for this one
    std::exception_ptr failure;

    // Back to who waits.
    struct End {
        bool await_ready() const noexcept { return false; }
        std::coroutine_handle<> await_suspend(Handle ended) const noexcept {
            const promise_type& promise = ended.promise();
            if (!promise.outer) return std::noop_coroutine();
            promise.outermost->innermost = promise.outer;
            return promise.outer;
        }
        void await_resume() const noexcept {}
    };

    Steps get_return_object() {
        innermost = Handle::from_promise(*this);
        return Steps(innermost);
    }
    std::suspend_always initial_suspend() const noexcept { return {}; }
    End final_suspend() const noexcept { return {}; }
    void return_void() const noexcept {}
    void unhandled_exception() { failure = std::current_exception(); }
};

struct Steps::Whole {
    Handle inner;
    bool await_ready() const noexcept { return !inner || inner.done(); }
    Handle await_suspend(Handle outer) const noexcept {
        inner.promise().outer = outer;
        inner.promise().outermost = outer.promise().outermost;
        inner.promise().outermost->innermost = inner;
        return inner;
    }
    void await_resume() const {
        if (inner && inner.promise().failure)
            std::rethrow_exception(std::exchange(inner.promise().failure, nullptr));
    }
};

inline Steps::Whole Steps::operator co_await() const noexcept { return {handle_}; }

inline void Steps::step() {
    if (done()) return;
    handle_.promise().innermost.resume();
    if (handle_.done() && handle_.promise().failure)
        std::rethrow_exception(std::exchange(handle_.promise().failure, nullptr));
}

}  // namespace conelight::base

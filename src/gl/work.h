// SPDX-License-Identifier: MIT
// What a renderer is at, for who waits for it: a pass, programs that are built, textures that are handed to the driver.
// Told on the thread of the context while a WorkScope lives there; asked from any thread.
#pragma once

#include <cstddef>
#include <mutex>
#include <string>

namespace conelight::gl {

class Work {
  public:
    struct Piece {
        std::string name;                 // empty: nothing was told since the last begin()
        std::size_t done = 0, total = 0;  // total 0: not known
    };
    void begin();  // a picture or a scene; programs are counted from here on
    void tell(const char* name, std::size_t done = 0, std::size_t total = 0);
    Piece now() const;

    // Of this thread; null: nobody asks.
    static Work* current();

  private:
    friend class ProgramWork;
    mutable std::mutex mutex_;
    Piece piece_;
    std::size_t programs_ = 0;
};

// A program is built while it lives; what was told before goes on behind it.
class ProgramWork {
  public:
    ProgramWork();
    ~ProgramWork();
    ProgramWork(const ProgramWork&) = delete;
    ProgramWork& operator=(const ProgramWork&) = delete;

  private:
    Work* work_;
    Work::Piece before_;
};

// What is done on this thread is told to `work`, while it lives.
class WorkScope {
  public:
    explicit WorkScope(Work& work);
    ~WorkScope();
    WorkScope(const WorkScope&) = delete;
    WorkScope& operator=(const WorkScope&) = delete;

  private:
    Work* outer_;
};

}  // namespace conelight::gl

// SPDX-License-Identifier: MIT
// Lines of standard input for the console. One thread sleeps until there is input, and hands lines over
// through a queue without locks (one writer, one reader); at the end of input, or when the reader is
// destroyed, it ends. A program in the background of a terminal leaves the terminal's input alone: reading
// would stop it.
#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <thread>

namespace conelight::program {

class LineReader {
  public:
    // Reads `descriptor`, which stays the caller's. `wake` (may be empty) is called on the reading thread
    // after a line or the end came, to end a wait of the main loop.
    explicit LineReader(int descriptor, std::function<void()> wake = {});
    ~LineReader();
    LineReader(const LineReader&) = delete;
    LineReader& operator=(const LineReader&) = delete;

    bool take(std::string& line);  // the next line, without its end; false: none yet. One thread only.
    bool ended() const { return ended_.load(std::memory_order_acquire); }  // no line will come any more

  private:
    struct Node {
        std::string line;
        std::atomic<Node*> next{nullptr};
    };
    void run();
    void push(std::string line);

    int descriptor_;
    int wakePipe_[2] = {-1, -1};
    std::function<void()> wake_;
    Node* head_;  // the main loop's: the node last taken
    Node* tail_;  // the thread's: the node last pushed
    std::atomic<bool> ended_{false};
    std::thread thread_;
};

}  // namespace conelight::program

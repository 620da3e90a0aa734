// SPDX-License-Identifier: MIT
#include "console/line_reader.h"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <cerrno>

#include "conelight/error.h"

namespace conelight::program {
namespace {

// A line longer than this is cut into several: nobody types it, and a stream of zeros must not fill memory.
constexpr std::size_t kLongestLine = 1 << 20;
constexpr int kBackgroundWaitMs = 500;

bool inBackground(int descriptor) {
    if (isatty(descriptor) == 0) return false;
    const pid_t foreground = tcgetpgrp(descriptor);
    return foreground >= 0 && foreground != getpgrp();
}

}  // namespace

LineReader::LineReader(int descriptor, std::function<void()> wake)
    : descriptor_(descriptor), wake_(std::move(wake)), head_(new Node), tail_(head_) {
    if (pipe2(wakePipe_, O_CLOEXEC) != 0) {
        delete head_;
        throw Error(ErrorKind::Runtime, "standard input: no pipe; fewer open files would be right");
    }
    thread_ = std::thread([this] { run(); });
}

LineReader::~LineReader() {
    const char stop = 0;
    [[maybe_unused]] const ssize_t written = write(wakePipe_[1], &stop, 1);
    thread_.join();
    close(wakePipe_[0]);
    close(wakePipe_[1]);
    while (head_ != nullptr) {
        Node* next = head_->next.load();
        delete head_;
        head_ = next;
    }
}

void LineReader::push(std::string line) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    Node* node = new Node;
    node->line = std::move(line);
    tail_->next.store(node, std::memory_order_release);
    tail_ = node;
    if (wake_) wake_();
}

bool LineReader::take(std::string& line) {
    Node* next = head_->next.load(std::memory_order_acquire);
    if (next == nullptr) return false;
    line = std::move(next->line);
    delete head_;
    head_ = next;
    return true;
}

void LineReader::run() {
    std::string partial;
    char buffer[4096];
    for (;;) {
        const bool away = inBackground(descriptor_);
        pollfd watched[2] = {{wakePipe_[0], POLLIN, 0}, {descriptor_, POLLIN, 0}};
        const int ready = poll(watched, away ? 1 : 2, away ? kBackgroundWaitMs : -1);
        if (ready < 0 && errno != EINTR) break;
        if (watched[0].revents != 0) return;
        if (ready <= 0 || away || watched[1].revents == 0) continue;
        const ssize_t count = read(descriptor_, buffer, sizeof buffer);
        if (count < 0 && (errno == EINTR || errno == EAGAIN)) continue;
        if (count <= 0) break;
        for (ssize_t i = 0; i < count; ++i) {
            if (buffer[i] == '\n' || partial.size() >= kLongestLine) {
                push(std::move(partial));
                partial.clear();
            }
            if (buffer[i] != '\n') partial += buffer[i];
        }
    }
    if (!partial.empty()) push(std::move(partial));
    ended_.store(true, std::memory_order_release);
    if (wake_) wake_();
}

}  // namespace conelight::program

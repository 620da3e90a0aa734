// SPDX-License-Identifier: MIT
#include "gl/work.h"

#include <utility>

namespace conelight::gl {
namespace {

thread_local Work* told = nullptr;

}  // namespace

WorkScope::WorkScope(Work& work) : outer_(std::exchange(told, &work)) {}
WorkScope::~WorkScope() { told = outer_; }
Work* Work::current() { return told; }

void Work::begin() {
    const std::lock_guard lock(mutex_);
    piece_ = {};
    programs_ = 0;
}

void Work::tell(const char* name, std::size_t done, std::size_t total) {
    const std::lock_guard lock(mutex_);
    piece_ = {name, done, total};
}

Work::Piece Work::now() const {
    const std::lock_guard lock(mutex_);
    return piece_;
}

ProgramWork::ProgramWork() : work_(Work::current()) {
    if (work_ == nullptr) return;
    const std::lock_guard lock(work_->mutex_);
    before_ = std::exchange(work_->piece_, {"building programs", ++work_->programs_, 0});
}

ProgramWork::~ProgramWork() {
    if (work_ == nullptr) return;
    const std::lock_guard lock(work_->mutex_);
    work_->piece_ = before_;
}

}  // namespace conelight::gl

// SPDX-License-Identifier: MIT
#include "gl/pace.h"

#include "base/clock.h"

namespace conelight::gl {

void Pace::begin(double milliseconds) {
    milliseconds_ = milliseconds;
    before_ += now_;
    now_ = 0;
    start_ = base::wallMs();
}

bool Pace::over() {
    finish();
    now_ = base::wallMs() - start_;
    return now_ >= milliseconds_;
}

bool PassSteps::Rest::await_ready() {
    if (pass.device_.pace == nullptr) return true;
    pass.scope_.reset();
    return !pass.device_.pace->over();
}

bool Pieces::next() {
    first_ += count_;
    if (first_ >= total_) return false;
    // A fifth to half of a part's time.
    if (pace_ != nullptr && count_ > 0) {
        const double took = pace_->worked() - since_;
        if (took < 0.2 * pace_->part()) most_ *= 2;
        if (took > 0.5 * pace_->part()) most_ = std::max(most_ / (2 * unit_), 1) * unit_;
    }
    if (pace_ != nullptr) since_ = pace_->worked();
    count_ = std::min(most_, total_ - first_);
    return true;
}

}  // namespace conelight::gl

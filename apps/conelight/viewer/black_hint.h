// SPDX-License-Identifier: MIT
// Why there is nothing to see: reasons for a black picture, shown over it until there is another.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "session/picker.h"
#include "session/session.h"
#include "viewer/picture_view.h"

namespace conelight::program {

class BlackHint {
  public:
    // Looks at a picture at rest, once each, because reading it back costs.
    void follow(const Session& session, Picker& picker, PictureView& view);
    const std::optional<std::string>& text() const { return text_; }

  private:
    std::optional<std::string> text_;
    std::uint64_t version_ = 0;  // of the picture that was looked at
};

}  // namespace conelight::program

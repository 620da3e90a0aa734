// SPDX-License-Identifier: MIT
#include "viewer/work_bar.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

namespace conelight::program {

void showWorkBar(const std::string& text, double part, float width) {
    const double phase = std::fmod(ImGui::GetTime(), 2.0);
    ImGui::ProgressBar(static_cast<float>(part >= 0 ? part : std::min(phase, 2 - phase)), {width, 0},
                       text.c_str());
}

}  // namespace conelight::program

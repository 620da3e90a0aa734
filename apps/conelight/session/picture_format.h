// SPDX-License-Identifier: MIT
// How a picture or a film is written: its size, what a channel has, whether it is clear where there is no surface.
#pragma once

#include <string>

namespace conelight::program {

struct PictureFormat {
    int width = 0, height = 0;  // 0: as large as it is shown
    int bits = 8;               // of a channel, in .png
    bool alpha = false;         // clear where only the surroundings are seen: .png, .exr, films in .mov
};

// A word as `1920x1080`, `alpha`, `16bit`. Returns whether it was one; throws Error(Usage) for a size that no
// picture can have.
bool takeFormatWord(PictureFormat& format, const std::string& word);
// Throws Error(Usage) where a file with this ending cannot be so.
void checkFormat(const PictureFormat& format, const std::string& file);

}  // namespace conelight::program

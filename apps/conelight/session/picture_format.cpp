// SPDX-License-Identifier: MIT
#include "session/picture_format.h"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <filesystem>

#include "conelight/error.h"

namespace conelight::program {
namespace {

constexpr int kLeastEdge = 2, kLongestEdge = 16384;  // Renderer::render's limit

}  // namespace

bool takeFormatWord(PictureFormat& format, const std::string& word) {
    if (word == "alpha")
        format.alpha = true;
    else if (word == "16bit" || word == "8bit")
        format.bits = word == "16bit" ? 16 : 8;
    else if (int width = 0, height = 0, end = 0;
             std::sscanf(word.c_str(), "%6dx%6d%n", &width, &height, &end) == 2 &&
             static_cast<std::size_t>(end) == word.size()) {
        if (std::min(width, height) < kLeastEdge || std::max(width, height) > kLongestEdge)
            throw Error(ErrorKind::Usage, "the size " + word + ": edges of 2 to 16384 pixels would be right");
        format.width = width;
        format.height = height;
    } else {
        return false;
    }
    return true;
}

void checkFormat(const PictureFormat& format, const std::string& file) {
    std::string ending = std::filesystem::path(file).extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (format.alpha && ending != ".png" && ending != ".exr" && ending != ".mov")
        throw Error(ErrorKind::Usage, file + ": alpha is kept in .png, .exr and .mov");
    if (format.bits == 16 && ending != ".png")
        throw Error(ErrorKind::Usage, file + ": 16bit is for .png; .exr has 32 in any case");
}

}  // namespace conelight::program

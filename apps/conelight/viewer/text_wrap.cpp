// SPDX-License-Identifier: MIT
#include "viewer/text_wrap.h"

#include <imgui.h>

#include <algorithm>

namespace conelight::program {
namespace {

float widthOf(const std::string& text) { return ImGui::CalcTextSize(text.c_str()).x; }

// The bytes at the start of `word` that fit, at least one character (UTF-8).
std::size_t fitting(const std::string& word, float room) {
    std::size_t fits = 0;
    for (std::size_t end = 1; end <= word.size(); ++end) {
        const bool isWhole = end == word.size() || (static_cast<unsigned char>(word[end]) & 0xc0) != 0x80;
        if (!isWhole) continue;
        if (fits > 0 && widthOf(word.substr(0, end)) > room) break;
        fits = end;
    }
    return fits;
}

}  // namespace

std::string wrappedAtSpaces(const std::string& text, float room) {
    if (widthOf(text) <= room) return text;
    std::string out;
    float width = 0;
    for (std::size_t from = 0; from < text.size();) {
        const std::size_t to = std::min(text.find(' ', from + 1), text.size());
        std::string word = text.substr(from, to - from);
        from = to;
        float wide = widthOf(word);
        if (width > 0 && width + wide > room) {
            out += "\n";
            word = word.substr(word.front() == ' ' ? 1 : 0);
            width = 0;
            wide = widthOf(word);
        }
        while (wide > room) {
            const std::size_t part = fitting(word, room);
            if (part >= word.size()) break;
            out += word.substr(0, part) + "\n";
            word = word.substr(part);
            wide = widthOf(word);
        }
        out += word;
        width += wide;
    }
    return out;
}

}  // namespace conelight::program

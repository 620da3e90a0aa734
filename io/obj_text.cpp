// SPDX-License-Identifier: MIT
// One pass over the lines. Names (of files, groups, materials) stay as they are, for they may hold any
// character; only statements of numbers lose comments and get other spellings. See obj_text.h.
#include "io/obj_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <iterator>
#include <string_view>

namespace conelight::io {

namespace {

constexpr std::array<std::string_view, 5> kIndices = {"f", "fo", "l", "p", "s"};
constexpr std::array<std::string_view, 21> kNumbers = {"v",  "vt", "vn", "vp", "Ka",  "Kd",    "Ks",
                                                       "Ke", "Tf", "Ns", "Ni", "d",   "Tr",    "illum",
                                                       "Pr", "Pm", "Ps", "Pc", "Pcr", "aniso", "anisor"};

template <std::size_t N>
bool holds(const std::array<std::string_view, N>& words, std::string_view word) {
    return std::find(words.begin(), words.end(), word) != words.end();
}

bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\f' || c == '\v'; }
bool isDigit(char c) { return c >= '0' && c <= '9'; }

// Digits first, or behind a minus: read by everybody.
bool isUsual(std::string_view word) {
    if (!word.empty() && word.front() == '-') word.remove_prefix(1);
    return !word.empty() && isDigit(word.front());
}

void appendNumber(std::string_view word, Bytes& out) {
    const auto append = [&out](std::string_view text) { out.insert(out.end(), text.begin(), text.end()); };
    if (isUsual(word)) return append(word);
    const std::string_view unsignedWord = word.substr(word.empty() || word.front() != '+' ? 0 : 1);
    double value = 0;
    const auto [end, failure] =
        std::from_chars(unsignedWord.data(), unsignedWord.data() + unsignedWord.size(), value);
    const bool whole = failure == std::errc() && end == unsignedWord.data() + unsignedWord.size();
    if (!whole || !std::isfinite(value)) return append(word);
    fmt::format_to(std::back_inserter(out), "{:.9g}", value);  // nine digits name every float
}

class Lines {
  public:
    explicit Lines(Bytes& out) : out_(out) {}

    void add(std::string_view line) {
        while (!line.empty() && isBlank(line.front())) line.remove_prefix(1);
        const bool continued = !line.empty() && line.back() == '\\';
        if (!continues_)
            keyword_ = line.substr(0, std::find_if(line.begin(), line.end(), isBlank) - line.begin());
        const bool numbers = holds(kNumbers, keyword_);
        if (numbers || holds(kIndices, keyword_)) line = line.substr(0, line.find('#'));
        while (!line.empty() && isBlank(line.back())) line.remove_suffix(1);
        continues_ = continued && !line.empty() && line.back() == '\\';
        if (numbers)
            addWords(line);
        else
            for (const char c : line) out_.push_back(std::uint8_t(isBlank(c) ? ' ' : c));
    }

  private:
    void addWords(std::string_view line) {
        for (std::size_t at = 0; at < line.size();) {
            const std::size_t end = std::size_t(
                std::find_if(line.begin() + std::ptrdiff_t(at), line.end(), isBlank) - line.begin());
            if (end > at) appendNumber(line.substr(at, end - at), out_);
            if (end < line.size() && end > at) out_.push_back(' ');
            at = end + 1;
        }
    }

    Bytes& out_;
    std::string_view keyword_;
    bool continues_ = false;
};

}  // namespace

Bytes plainObjText(const Bytes& bytes) {
    std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (text.substr(0, 3) == "\xEF\xBB\xBF") text.remove_prefix(3);
    Bytes out;
    out.reserve(text.size());
    Lines lines(out);
    while (!text.empty()) {
        const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
        lines.add(text.substr(0, end));
        if (end < text.size()) out.push_back(std::uint8_t(text[end]));
        text.remove_prefix(std::min(end + 1, text.size()));
        // The second half of a Windows line end is no line of its own.
        if (!text.empty() && text.front() == '\n' && !out.empty() && out.back() == '\r') {
            out.push_back('\n');
            text.remove_prefix(1);
        }
    }
    return out;
}

}  // namespace conelight::io

// SPDX-License-Identifier: MIT
#include "console/statements.h"

#include <algorithm>
#include <cctype>
#include <numeric>

namespace conelight::program {
namespace {

bool isSpace(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }

std::string lower(std::string text) {
    for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

// Levenshtein distance.
std::size_t edits(const std::string& a, const std::string& b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t(0));
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
            diagonal = row[j];
            row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
        }
    }
    return row[b.size()];
}

class Parser {
  public:
    explicit Parser(std::string_view text) : text_(text) {}

    std::vector<Statement> parse() {
        while (at_ < text_.size()) {
            const char c = text_[at_];
            if (c == '\n' || c == ';') {
                end();
                if (c == '\n') ++line_;
                ++at_;
            } else if (isSpace(c)) {
                ++at_;
            } else if (c == '#') {
                while (at_ < text_.size() && text_[at_] != '\n') ++at_;
            } else {
                word();
            }
        }
        end();
        return std::move(statements_);
    }

  private:
    void end() {
        if (!current_.words.empty() || !current_.error.empty()) statements_.push_back(std::move(current_));
        current_ = {};
    }

    void word() {
        if (current_.words.empty()) current_.line = line_;
        std::string word;
        while (at_ < text_.size() && !isSpace(text_[at_]) && text_[at_] != '\n' && text_[at_] != ';') {
            if (text_[at_] == '"' || text_[at_] == '\'')
                quote(word);
            else
                word += text_[at_++];
        }
        current_.words.push_back(std::move(word));
    }

    void quote(std::string& word) {
        const char mark = text_[at_++];
        while (at_ < text_.size() && text_[at_] != mark && text_[at_] != '\n') {
            const bool escapes = mark == '"' && text_[at_] == '\\' && at_ + 1 < text_.size() &&
                                 (text_[at_ + 1] == '"' || text_[at_ + 1] == '\\');
            if (escapes) ++at_;
            word += text_[at_++];
        }
        if (at_ < text_.size() && text_[at_] == mark)
            ++at_;
        else
            current_.error = std::string("a ") + mark + " is never closed; a second " + mark +
                             " on the same line would be right";
    }

    std::string_view text_;
    std::size_t at_ = 0;
    int line_ = 1;
    Statement current_;
    std::vector<Statement> statements_;
};

}  // namespace

std::vector<Statement> parseStatements(std::string_view text) { return Parser(text).parse(); }

std::string quoted(const std::string& word) {
    const bool plain =
        !word.empty() && word.find_first_of(" \t;'\"\\\n") == std::string::npos && word.front() != '#';
    if (plain) return word;
    std::string text = "\"";
    for (const char c : word) {
        if (c == '"' || c == '\\') text += '\\';
        text += c == '\n' ? ' ' : c;
    }
    return text + '"';
}

std::string nearest(const std::string& word, const std::vector<std::string>& candidates) {
    const std::string wanted = lower(word);
    std::string best;
    std::size_t bestEdits = ~std::size_t(0);
    for (const std::string& candidate : candidates) {
        const std::string known = lower(candidate);
        std::size_t distance = edits(wanted, known);
        // A beginning counts as near, whatever is missing.
        if (wanted.size() >= 2 && known.compare(0, wanted.size(), wanted) == 0)
            distance = std::min<std::size_t>(distance, 1);
        if (distance < bestEdits) {
            bestEdits = distance;
            best = candidate;
        }
    }
    return bestEdits <= std::max<std::size_t>(1, wanted.size() / 3) ? best : std::string();
}

}  // namespace conelight::program

// SPDX-License-Identifier: MIT
// Words and tree of the thesis's scene text format: see syntax.h. The tree is built with an own stack,
// so that depth costs memory, not the call stack.
#include "thesis/format/syntax.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>

#include "conelight/error.h"
#include "io/files.h"

namespace conelight::thesis {

using io::oneLine;

namespace {

struct Token {
    std::string text;
    int line = 0;
    bool cut = false;
    bool is(char c) const { return text.size() == 1 && text[0] == c; }
};

[[noreturn]] void fail(const std::string& file, int line, const std::string& why) {
    throw Error(ErrorKind::BadInput, fmt::format("{}:{}: {}", file, line, why));
}

bool isSpace(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\v' || c == '\f'; }

// A value's last characters: closing braces become tokens of their own, one ',' or ';' goes.
void pushValue(std::vector<Token>& tokens, std::string word, int line) {
    int closing = 0;
    bool cut = false;
    while (word.size() > 1) {
        const char last = word.back();
        const auto opened = std::count(word.begin(), word.end(), '{');
        const auto closed = std::count(word.begin(), word.end(), '}');
        if (last == '}' && closed > opened)
            ++closing;
        else if ((last == ',' || last == ';') && !cut)
            cut = true;
        else
            break;
        word.pop_back();
    }
    tokens.push_back({std::move(word), line, cut});
    for (int i = 0; i < closing; ++i) tokens.push_back({"}", line, false});
}

std::vector<Token> tokensOf(std::string_view text, const std::string& file) {
    std::vector<Token> tokens;
    int line = 1;
    std::size_t at = 0;
    if (text.substr(0, 3) == "\xEF\xBB\xBF")
        at = 3;  // byte order mark: glued to the first key in the original
    while (at < text.size()) {
        const char c = text[at];
        if (c == '\n') ++line;
        if (isSpace(c)) {
            ++at;
            continue;
        }
        if (c == '\0') fail(file, line, "holds a zero byte: not a text file");
        if (c == '#' || text.substr(at, 2) == "//") {
            while (at < text.size() && text[at] != '\n') ++at;
            continue;
        }
        if (c == '=' || c == '{' || c == '}') {
            tokens.push_back({std::string(1, c), line, false});
            ++at;
            continue;
        }
        // After '=' a word runs to the next white space ('=' may be part of a path); else it ends at = { }.
        const bool isValue = !tokens.empty() && tokens.back().is('=');
        const std::size_t start = at;
        while (at < text.size() && !isSpace(text[at]) && text[at] != '\0' &&
               (isValue || (text[at] != '=' && text[at] != '{' && text[at] != '}')))
            ++at;
        const std::string word(text.substr(start, at - start));
        if (isValue)
            pushValue(tokens, word, line);
        else
            tokens.push_back({word, line, false});
    }
    return tokens;
}

// Keys whose value is a block even when stray words stand between '=' and '{'.
bool isBlockKey(const std::string& key) {
    static constexpr std::array kBlocks = {"scene", "model",    "light",  "position", "rotation",
                                           "color", "material", "camera", "settings"};
    return std::any_of(kBlocks.begin(), kBlocks.end(), [&](const char* block) { return key == block; });
}

bool isPunctuation(const std::string& word) { return word == "," || word == ";"; }

class Parser {
  public:
    Parser(std::vector<Token> tokens, const std::string& file) : tokens_(std::move(tokens)), file_(file) {}

    ThesisText parse() {
        ThesisText out;
        out.blank = tokens_.empty();
        stack_.push_back({{}, 0});
        for (at_ = 0; at_ < tokens_.size() && !done_; ++at_) step(out);
        if (stack_.size() > 1)
            fail(file_, stack_.back().item.line,
                 fmt::format("'{{' of {} is never closed; add '}}'", oneLine(stack_.back().item.key)));
        out.items = std::move(stack_[0].item.children);
        return out;
    }

  private:
    struct Open {
        ThesisItem item;  // the block being filled
        int openLine = 0;
    };

    void step(ThesisText& out) {
        const Token& token = tokens_[at_];
        Open& open = stack_.back();
        if (token.is('}')) {
            if (stack_.size() == 1) {
                if (open.item.children.empty()) fail(file_, token.line, "'}' without a '{' before it");
                out.notes.push_back(
                    fmt::format("line {}: '}}' without a '{{'; the rest of the file is skipped", token.line));
                done_ = true;
                return;
            }
            flushPending();
            ThesisItem closed = std::move(open.item);
            stack_.pop_back();
            stack_.back().item.children.push_back(std::move(closed));
        } else if (token.is('=')) {
            value();
        } else if (token.is('{')) {
            // A brace that no '=' introduces: its content is skipped, as in the original.
            flushPending();
            skipBlock();
        } else {
            flushPending();
            pending_ = at_;
        }
    }

    // A word that turned out to be no key.
    void flushPending() {
        if (pending_ == kNone) return;
        const std::string& word = tokens_[pending_].text;
        if (!isPunctuation(word)) stack_.back().item.words.push_back(word);
        pending_ = kNone;
    }

    void value() {
        const int line = tokens_[at_].line;
        if (pending_ == kNone) fail(file_, line, "'=' without a key before it");
        ThesisItem item;
        item.key = tokens_[pending_].text;
        item.line = tokens_[pending_].line;
        pending_ = kNone;
        const std::string key = oneLine(item.key);
        if (isBlockKey(item.key)) {
            while (at_ + 1 < tokens_.size() && !tokens_[at_ + 1].is('{') && !tokens_[at_ + 1].is('=') &&
                   !tokens_[at_ + 1].is('}'))
                ++at_;
            if (at_ + 1 >= tokens_.size() || !tokens_[at_ + 1].is('{'))
                fail(file_, item.line, fmt::format("{}: '{{' expected after '='", key));
        }
        if (at_ + 1 >= tokens_.size())
            fail(file_, line, fmt::format("{}: the file ends where a value should be", key));
        const Token& next = tokens_[++at_];
        if (next.is('=') || next.is('}'))
            fail(file_, next.line, fmt::format("{}: a value expected, found '{}'", key, next.text));
        if (next.is('{')) {
            if (stack_.size() > 1000) fail(file_, next.line, "more than 1000 nested blocks");
            item.isBlock = true;
            stack_.push_back({std::move(item), next.line});
        } else {
            item.word = next.text;
            item.cut = next.cut;
            stack_.back().item.children.push_back(std::move(item));
        }
    }

    void skipBlock() {
        const int line = tokens_[at_].line;
        int depth = 1;
        while (depth > 0) {
            if (++at_ >= tokens_.size()) fail(file_, line, "'{' is never closed; add '}'");
            if (tokens_[at_].is('{')) ++depth;
            if (tokens_[at_].is('}')) --depth;
        }
    }

    static constexpr std::size_t kNone = ~std::size_t(0);
    std::vector<Token> tokens_;
    const std::string& file_;
    std::vector<Open> stack_;
    std::size_t at_ = 0;
    std::size_t pending_ = kNone;
    bool done_ = false;
};

}  // namespace

ThesisText parseThesisText(std::string_view text, const std::string& file) {
    return Parser(tokensOf(text, file), file).parse();
}

}  // namespace conelight::thesis

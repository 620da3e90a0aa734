// SPDX-License-Identifier: MIT
// Words and tree of the thesis's scene text format: item := KEY '=' (WORD | '{' item* '}'). Private to this
// room.
//
// Read as the original reads it: words are split at white space; the key is the word before '=', and words
// that are neither key nor value are skipped. Additions that no shipped file can notice: '#' or '//' at the
// start of a word begins a comment to the end of the line; '=', '{' and '}' need no space around them in
// front of a value; one ',' or ';' glued to a value is cut off. What made the original crash or misread (a
// brace without partner, '=' without key or value) is an error with its line.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace conelight::thesis {

struct ThesisItem {
    std::string key;
    std::string word;  // value, when not a block
    bool isBlock = false;
    std::vector<ThesisItem> children;  // items of the block
    std::vector<std::string> words;    // all words of the block that belong to no item, in order
    int line = 0;                      // of the key, from 1
    bool cut = false;                  // a ',' or ';' was cut off the word
};

struct ThesisText {
    std::vector<ThesisItem> items;   // top level
    bool blank = true;               // nothing but white space and comments
    std::vector<std::string> notes;  // "LINE: ..."
};

// `file` starts error lines. Throws Error(BadInput) "FILE:LINE: ...".
ThesisText parseThesisText(std::string_view text, const std::string& file);

}  // namespace conelight::thesis

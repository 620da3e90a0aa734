// SPDX-License-Identifier: MIT
#include "thesis/format/values.h"

#include <fmt/core.h>
#include <locale.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "conelight/error.h"
#include "io/files.h"

namespace conelight::thesis {

using io::oneLine;

namespace {

// strtof in the "C" locale whatever the program has set.
float cStrtof(const char* text, char** end) {
    static const locale_t kLocale = ::newlocale(LC_ALL_MASK, "C", locale_t(0));
    return ::strtof_l(text, end, kLocale);
}

}  // namespace

void BlockValues::fail(int line, const std::string& why) const {
    throw Error(ErrorKind::BadInput, fmt::format("{}:{}: {}", file_, line, why));
}

void BlockValues::note(int line, const std::string& text) {
    notes_.push_back(fmt::format("line {}: {}", line, text));
}

const ThesisItem* BlockValues::first(const Item& block, const char* key) const {
    const auto found = std::find_if(block.children.begin(), block.children.end(),
                                    [&](const Item& item) { return item.key == key; });
    return found == block.children.end() ? nullptr : &*found;
}

const std::string* BlockValues::word(const Item& block, const char* key) const {
    const Item* item = first(block, key);
    if (item == nullptr) return nullptr;
    if (item->isBlock) fail(item->line, fmt::format("{}: a single word expected, found a block", key));
    return &item->word;
}

float BlockValues::toNumber(const Item& item, const std::string& text) {
    char* end = nullptr;
    const float value = cStrtof(text.c_str(), &end);
    if (end == text.c_str())
        note(item.line, fmt::format("{}: '{}' is no number; read as 0", oneLine(item.key), oneLine(text)));
    if (!std::isfinite(value))
        fail(item.line, fmt::format("{}: '{}' is not a finite number", oneLine(item.key), oneLine(text)));
    return value;
}

float BlockValues::number(const Item& block, const char* key, float otherwise) {
    const std::string* text = word(block, key);
    return text == nullptr ? otherwise : toNumber(*first(block, key), *text);
}

bool BlockValues::boolean(const Item& block, const char* key, bool otherwise) {
    const std::string* text = word(block, key);
    if (text == nullptr) return otherwise;
    const Item& item = *first(block, key);
    if (item.cut && *text == "true")
        note(item.line, fmt::format("{}: 'true' with a comma read as true (the original reads false)", key));
    if (*text != "true" && *text != "false")
        note(item.line, fmt::format("{}: '{}' read as false; only 'true' is true", key, oneLine(*text)));
    return *text == "true";
}

glm::vec3 BlockValues::triple(const Item& block, const char* key, const char* names,
                              const glm::vec3& otherwise) {
    const Item* item = first(block, key);
    if (item == nullptr) return otherwise;
    if (!item->isBlock)
        fail(item->line, fmt::format("{}: a block {{ {} = .. {} = .. {} = .. }} expected", key, names[0],
                                     names[1], names[2]));
    if (item->children.empty() && item->words.size() == 3) {
        glm::vec3 out(0);
        for (int c = 0; c < 3; ++c) out[c] = toNumber(*item, item->words[std::size_t(c)]);
        return out;
    }
    if (item->children.empty()) {
        note(item->line, fmt::format("{}: empty block; the default is used", key));
        return otherwise;
    }
    glm::vec3 out(0);
    for (int c = 0; c < 3; ++c) {
        const char name[2] = {names[c], 0};
        if (first(*item, name) == nullptr)
            note(item->line, fmt::format("{}: '{}' is missing; read as 0", key, name));
        out[c] = number(*item, name, 0.0f);
    }
    return out;
}

void BlockValues::checkKeys(const Item& block, std::initializer_list<const char*> known) {
    for (const Item& item : block.children) {
        const bool isKnown =
            std::any_of(known.begin(), known.end(), [&](const char* key) { return item.key == key; });
        if (!isKnown && unknownKeys_.insert(item.key).second)
            note(item.line, fmt::format("unknown key '{}' skipped", oneLine(item.key, 60)));
    }
}

}  // namespace conelight::thesis

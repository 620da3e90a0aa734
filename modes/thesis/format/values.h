// SPDX-License-Identifier: MIT
// Values of a block of the thesis's text format: by key, or as they are by default. What is odd is noted,
// what cannot be meant is an error "FILE:LINE: ...". Private to this room.
#pragma once

#include <glm/glm.hpp>
#include <initializer_list>
#include <set>
#include <string>
#include <vector>

#include "thesis/format/syntax.h"

namespace conelight::thesis {

class BlockValues {
  public:
    using Item = ThesisItem;

    // `notes` gets a line for each oddity; it must outlive this.
    BlockValues(std::string file, std::vector<std::string>& notes) : file_(std::move(file)), notes_(notes) {}

    const std::string& file() const { return file_; }
    [[noreturn]] void fail(int line, const std::string& why) const;
    void note(int line, const std::string& text);

    // First item of the block with that key; null when absent.
    const Item* first(const Item& block, const char* key) const;
    const std::string* word(const Item& block, const char* key) const;
    float number(const Item& block, const char* key, float otherwise);
    bool boolean(const Item& block, const char* key, bool otherwise);
    // A block of three named numbers, or (an addition) three bare ones.
    glm::vec3 triple(const Item& block, const char* key, const char* names, const glm::vec3& otherwise);
    // Notes each key that is not `known`, once a file.
    void checkKeys(const Item& block, std::initializer_list<const char*> known);

  private:
    float toNumber(const Item& item, const std::string& text);

    std::string file_;
    std::vector<std::string>& notes_;
    std::set<std::string> unknownKeys_;  // already noted
};

}  // namespace conelight::thesis

// SPDX-License-Identifier: MIT
// A JSON file and the line that each of its values stands in, so that what is wrong in a hand-written file
// can be pointed at. A key that stands twice in one object is an error. At most 16 MiB.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>

namespace conelight::io {

class JsonFile {
  public:
    // Throws Error(BadInput) "FILE: ..." for a file that cannot be read, "FILE:LINE: ..." for what is not
    // JSON.
    explicit JsonFile(const std::string& path);

    const nlohmann::ordered_json& root() const { return root_; }
    // Throws Error(BadInput) "FILE:LINE: message". `pointer` is a JSON pointer, as in /keys/3/eye; one that
    // is not there stands for what holds it.
    [[noreturn]] void fail(std::string pointer, const std::string& message) const;

  private:
    std::string path_;
    nlohmann::ordered_json root_;
    std::map<std::string, int> lines_;
};

}  // namespace conelight::io

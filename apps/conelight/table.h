// SPDX-License-Identifier: MIT
// Text tables on the standard output: first column left, others right, widths by content.
#pragma once

#include <string>
#include <vector>

namespace conelight::program {

class Table {
  public:
    explicit Table(std::vector<std::string> head) : rows_{std::move(head)} {}
    void add(std::vector<std::string> row) { rows_.push_back(std::move(row)); }
    // `leftColumns` of the first columns are flush left.
    void print(std::size_t leftColumns = 1) const;

  private:
    std::vector<std::vector<std::string>> rows_;
};

// Three significant digits: "0.123", "12.3", "1.23e-05"; "-" for what is not a number.
std::string number(double value);
std::string percent(double value);  // "12.3 %"

}  // namespace conelight::program

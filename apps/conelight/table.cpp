// SPDX-License-Identifier: MIT
#include "table.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace conelight::program {

void Table::print(std::size_t leftColumns) const {
    std::vector<std::size_t> widths;
    for (const auto& row : rows_)
        for (std::size_t i = 0; i < row.size(); ++i) {
            if (i >= widths.size()) widths.push_back(0);
            widths[i] = std::max(widths[i], row[i].size());
        }
    for (const auto& row : rows_) {
        std::string line;
        for (std::size_t i = 0; i < row.size(); ++i) {
            if (i > 0) line += "  ";
            line += i < leftColumns ? fmt::format("{:<{}}", row[i], widths[i])
                                    : fmt::format("{:>{}}", row[i], widths[i]);
        }
        line.erase(line.find_last_not_of(' ') + 1);
        fmt::print("{}\n", line);
    }
}

std::string number(double value) {
    if (std::isnan(value)) return "-";
    return fmt::format("{:.3g}", value);
}

std::string percent(double value) {
    if (std::isnan(value)) return "-";
    return fmt::format("{:.3g} %", 100 * value);
}

}  // namespace conelight::program

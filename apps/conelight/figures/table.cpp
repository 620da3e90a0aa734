// SPDX-License-Identifier: MIT
// The list of figures, put together from its two halves; names of kinds and files.
#include "figures/table.h"

#include <fmt/format.h>

#include <vector>

namespace conelight::figures {

std::string_view nameOf(Kind kind) {
    constexpr std::string_view kNames[] = {"drawing", "plot", "render", "series", "table"};
    return kNames[std::size_t(kind)];
}

std::span<const Figure> allFigures() {
    static const std::vector<Figure> all = [] {
        std::vector<Figure> figures;
        for (const std::span<const Figure> part :
             {foundationFigures(), methodFigures(), resultFigures(), beyondFigures()})
            figures.insert(figures.end(), part.begin(), part.end());
        return figures;
    }();
    return all;
}

std::string fileName(const Figure& figure, std::size_t panel, const std::vector<Panel>& panels) {
    // Letters tell panels of one kind apart; files of different kinds need none.
    std::size_t alike = 0, before = 0;
    for (std::size_t i = 0; i < panels.size(); ++i) {
        if (panels[i].extension != panels[panel].extension) continue;
        ++alike;
        before += i < panel;
    }
    const std::string letter = alike > 1 ? std::string(1, char('a' + before)) : std::string();
    return fmt::format("{}{}{}", figure.id, letter, panels[panel].extension);
}

}  // namespace conelight::figures

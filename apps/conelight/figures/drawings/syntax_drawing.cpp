// SPDX-License-Identifier: MIT
// The syntax tree of a scene file beside its text.
#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "figures/drawings/drawing.h"
#include "figures/drawings/drawings.h"

namespace conelight::figures {

std::string drawSyntaxTree(const std::vector<io::SyntaxLine>& tree, const std::string& text) {
    Drawing d;
    constexpr double kRow = 23, kIndent = 34, kSize = 13;
    std::vector<Point> open;  // foot of the node that is open at each depth
    double right = 0;
    for (std::size_t i = 0; i < tree.size(); ++i) {
        const io::SyntaxLine& node = tree[i];
        const bool block = i + 1 < tree.size() && tree[i + 1].depth > node.depth;
        const double width = textWidth(node.text, kSize, block) + 16;
        const Point corner(kIndent * node.depth, kRow * double(i));
        if (node.depth > 0) {
            const Point from = open[std::size_t(node.depth) - 1];
            d.polyline({from, {from.x, corner.y + 9}, {corner.x, corner.y + 9}}, stroke(colour::kPale, 1.2));
        }
        d.rect(corner, {width, 18},
               {.stroke = block ? colour::kBlue : colour::kPale,
                .width = 1,
                .fill = block ? "#d9ecf7" : colour::kPaper},
               4);
        d.text(corner + Point(8, 13.5), node.text, {.size = kSize, .anchor = Anchor::Start, .bold = block});
        d.text(Point(-12, corner.y + 13.5), fmt::format("{}", node.line),
               {.size = 11, .anchor = Anchor::End, .colour = colour::kPale});
        open.resize(std::size_t(node.depth) + 1);
        open[std::size_t(node.depth)] = corner + Point(14, 18);
        right = std::max(right, corner.x + width);
    }
    // The text, in the same order, to the right of the widest node.
    std::istringstream lines(text);
    std::string line;
    const double left = right + 90, step = kRow * double(tree.size()) / 26;
    for (int number = 1; std::getline(lines, line); ++number) {
        const double y = step * number;
        const std::size_t indent = line.find_first_not_of(' ');
        d.text({left - 14, y}, fmt::format("{}", number),
               {.size = 11, .anchor = Anchor::End, .colour = colour::kPale});
        if (indent != std::string::npos)
            d.text({left + 7.0 * double(indent), y}, line.substr(indent),
                   {.size = kSize, .anchor = Anchor::Start});
    }
    return d.svg("Syntax tree of a scene file, beside its text");
}

}  // namespace conelight::figures

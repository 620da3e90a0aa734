// SPDX-License-Identifier: MIT
#include "thesis/format/format.h"

#include "conelight/thesis/thesis.h"
#include "io/scene_format.h"
#include "thesis/format/generated_rooms.h"
#include "thesis/format/scene.h"
#include "thesis/format/syntax.h"
#include "thesis/format/write.h"

namespace conelight::thesis {
namespace {

void addLines(const std::vector<ThesisItem>& items, int depth, std::vector<io::SyntaxLine>& lines) {
    for (const ThesisItem& item : items) {
        lines.push_back({depth, item.isBlock ? item.key : item.key + " = " + item.word, item.line});
        addLines(item.children, depth + 1, lines);
    }
}

std::vector<io::SyntaxLine> syntaxOf(std::string_view text, const std::string& file) {
    std::vector<io::SyntaxLine> lines;
    addLines(parseThesisText(text, file).items, 0, lines);
    return lines;
}

}  // namespace

void registerThesisFormat() {
    io::registerSceneFormat({kSceneFormat,
                             "the thesis's format",
                             {".txt", ".scene"},
                             loadThesisScene,
                             writeThesisScene,
                             syntaxOf});
    registerThesisScenes();
}

}  // namespace conelight::thesis

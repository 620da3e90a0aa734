// SPDX-License-Identifier: MIT
// The command that looks into a pixel.
#include "console/console.h"

namespace conelight::program {
namespace {

void inspect(const CommandContext& context) {
    Request request{RequestKind::Inspect};
    request.x = static_cast<int>(context.number(0));
    request.y = static_cast<int>(context.number(1));
    request.steps = context.count() > 2;
    context.session.request(std::move(request));
}

}  // namespace

CommandGroup inspectCommands() {
    return {"Seeing inside",
            {
                command("inspect",
                        {{"X", ArgumentKind::Whole, false, false, "pixels", 0, 16383, {}},
                         {"Y", ArgumentKind::Whole, false, false, "pixels", 0, 16383, {}},
                         {"STEPS", ArgumentKind::Choice, true, false, "", 0, 0, {"steps"}}},
                        "the cones or rays that gathered the light of a pixel", inspect,
                        "X, Y: from the upper left corner of the picture. Without `steps` one line per cone "
                        "or ray; in the window the panel Pixel shows them, and they are drawn over the "
                        "picture."),
            }};
}

}  // namespace conelight::program

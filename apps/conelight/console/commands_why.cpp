// SPDX-License-Identifier: MIT
// `why`: the usual reasons for a black picture, looked for.
#include "console/console.h"
#include "session/why_black.h"

namespace conelight::program {
namespace {

void why(const CommandContext& context) {
    const std::vector<std::string> reasons = whyBlack(context.session, context.console.picker());
    for (const std::string& reason : reasons) context.print(reason);
    if (reasons.empty())
        context.print(
            "nothing found that makes a picture black: there is light, and it reaches what is in view");
}

}  // namespace

Command whyCommand() {
    return command("why", {}, "why the picture is black: light, camera, voxels, exposure", why,
                   "`render` says so by itself when its picture is black.");
}

}  // namespace conelight::program

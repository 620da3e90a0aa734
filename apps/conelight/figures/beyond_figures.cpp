// SPDX-License-Identifier: MIT
// Figures of what the thesis names and draws no figure of: beam tracing.
#include "figures/renders.h"
#include "figures/table.h"

namespace conelight::figures {
namespace {

const Figure kBeyondFigures[] = {
    {"B01", "Beams and their tree",
     "No figure of the thesis: the beam tracing that its section 3.4.3 describes",
     "Above a room with two mirrors from above, traced by mode `beams`. The beam of the eye (1) ends on what "
     "it sees, "
     "each part seen wholly. Where it ends on a mirror a further beam leaves, whose apex is the mirror image "
     "of the one "
     "before. Below the tree of these beams, each with what it ends on, nearest first.",
     Kind::Drawing, drawBeams},
    {"B02", "A hall of mirrors by beams",
     "No figure of the thesis: what beam tracing is good for, and what it leaves out",
     "First mode `beams`: three mirrors, two lamps, shadows and images of images. Then the path tracer with "
     "the same "
     "light, and with all of it, which brightens what beams leave black. Last a cut-out, enlarged: edges by "
     "beams and by "
     "one point per pixel.",
     Kind::Render, renderMirrorHall},
};

}  // namespace

std::span<const Figure> beyondFigures() { return kBeyondFigures; }

}  // namespace conelight::figures

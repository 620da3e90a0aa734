// SPDX-License-Identifier: MIT
// Drawings of the rendering equation and of the local model.
#include <algorithm>
#include <cmath>

#include "figures/drawings/drawings.h"
#include "figures/drawings/flat_room.h"

namespace conelight::figures {
namespace {

// Pieces of a formula side by side, each in its colour.
void drawFormula(Drawing& d, Point at, const std::vector<std::pair<std::string, std::string>>& pieces,
                 double size) {
    for (const auto& [text, colour] : pieces) {
        d.text(at, text, {.size = size, .anchor = Anchor::Start, .colour = colour});
        at.x += textWidth(text, size) + 0.1 * size;
    }
}

// The point's surroundings: its surface, the wall that sends light to it, the hemisphere of directions.
void drawPointOnSurface(Drawing& d, Point x, Point wall) {
    d.polygon({x + Point(-250, 0), x + Point(300, 0), x + Point(300, 16), x + Point(-250, 16)},
              filled("#d8dde6"));
    d.line(x + Point(-250, 0), x + Point(300, 0), stroke(colour::kInk, 2));
    d.polygon({wall, wall + Point(0, -190), wall + Point(15, -190), wall + Point(15, 0)}, filled("#f1c7b4"));
    d.line(wall, wall + Point(0, -190), stroke(colour::kRed, 2));
    // The hemisphere of directions.
    const double radius = 120;
    d.polygon(
        [&] {
            std::vector<Point> points;
            for (int i = 0; i <= 48; ++i) points.push_back(x + radius * upTurned(-kPi / 2 + kPi * i / 48));
            return points;
        }(),
        {.stroke = colour::kPale, .width = 1.2, .fill = "#f6f8fb", .dash = "5 4"});
    d.text(x + radius * upTurned(-1.25) + Point(-16, -2), "Ω", {.size = 18, .colour = colour::kNote});
    d.arrow(x, x + Point(0, -165), stroke(colour::kInk, 1.6));
    d.text(x + Point(0, -174), "n", {.size = 18, .italic = true});
}

}  // namespace

std::string drawRenderingEquation() {
    Drawing d;
    const Point x(330, 330);
    const Point wall = x + Point(300, -60);
    drawPointOnSurface(d, x, wall);
    // How the surface spreads light: a lobe about the mirrored direction on an even part.
    const double lampAngle = -0.62, eyeAngle = 1.0;
    std::vector<Point> lobe{x};
    for (int i = 0; i <= 180; ++i) {
        const double angle = -kPi / 2 + kPi * i / 180;
        const double r = 34 + 54 * std::pow(std::max(std::cos(angle + lampAngle), 0.0), 24);
        lobe.push_back(x + r * upTurned(angle));
    }
    d.polygon(lobe, {.stroke = colour::kGreen, .width = 1.6, .fill = "#bfe6d8", .opacity = 0.8});
    d.text(x + Point(-64, -24), "f_{r}", {.size = 18, .colour = colour::kGreen, .italic = true});
    // Light that comes in: from a lamp, and from the wall, which got it elsewhere.
    const Point lamp = x + 290.0 * upTurned(lampAngle), from = wall + Point(0, -70);
    drawBulb(d, lamp);
    d.arrow(lamp + 26.0 * upTurned(lampAngle + kPi), x + 4.0 * upTurned(lampAngle),
            stroke(colour::kOrange, 2.4));
    d.arrow(wall + Point(-120, -230), from, stroke(colour::kOrange, 1.4, "5 4"));
    const Point toWall = glm::normalize(from - x);
    d.arrow(from, x + 4.0 * toWall, stroke(colour::kOrange, 2.4));
    d.circle(from, 4, filled(colour::kInk));
    d.text(from + Point(24, 6), "x'", {.size = 18, .anchor = Anchor::Start, .italic = true});
    d.text(x + 190.0 * upTurned(lampAngle) + Point(-20, 4), "L_{i}",
           {.size = 18, .anchor = Anchor::End, .colour = colour::kOrange});
    d.text(0.5 * (x + from) + Point(26, 26), "L_{i}", {.size = 18, .colour = colour::kOrange});
    d.arc(x, 92, kPi / 2, kPi / 2 - lampAngle, stroke(colour::kPurple, 1.6));
    d.text(x + 106.0 * upTurned(0.5 * lampAngle) + Point(0, 2), "θ_{i}",
           {.size = 16, .colour = colour::kPurple});
    // Light that leaves.
    const Point eye = x + 250.0 * upTurned(eyeAngle * 0.62);
    const Point toEye = glm::normalize(eye - x);
    d.arrow(x + 4.0 * toEye, eye - 24.0 * toEye, stroke(colour::kBlue, 2.6));
    drawEye(d, eye, -toEye);
    d.text(x + 175.0 * toEye + Point(-8, -16), "L_{o}", {.size = 18, .colour = colour::kBlue});
    for (const double angle : {-0.5, -0.17, 0.17, 0.5})
        d.line(x + 8.0 * upTurned(angle * 2.4), x + 24.0 * upTurned(angle * 2.4), stroke(colour::kRed, 2));
    d.text(x + Point(-28, 40), "L_{e}", {.size = 18, .colour = colour::kRed});
    d.circle(x, 5, filled(colour::kInk));
    d.text(x + Point(4, 40), "x", {.size = 19, .italic = true});
    drawFormula(d, {x.x - 262, x.y + 100},
                {{"L_{o}(x, ω_{o})", colour::kBlue},
                 {" = ", colour::kInk},
                 {"L_{e}(x, ω_{o})", colour::kRed},
                 {" + ∫_{Ω} ", colour::kInk},
                 {"f_{r}(x, ω_{i}, ω_{o})", colour::kGreen},
                 {"L_{i}(x, ω_{i})", colour::kOrange},
                 {"cos θ_{i}", colour::kPurple},
                 {" dω_{i}", colour::kInk}},
                20);
    return d.svg("The parts of the rendering equation in a scene");
}

std::string drawLocalModel() {
    Drawing d;
    const Point lamp(120, 20), floor(250, 300), wall(560, 130), eye(470, 60);
    d.line({20, 300}, {560, 300}, stroke("#5b6270", 4));
    d.line({560, 300}, {560, 20}, stroke(colour::kRed, 4));
    drawBulb(d, lamp);
    drawEye(d, eye, Point(-1, 0.35));
    const auto path = [&](const std::vector<Point>& points, const Paint& paint) {
        for (std::size_t i = 1; i < points.size(); ++i) {
            const Point way = glm::normalize(points[i] - points[i - 1]);
            d.arrow(points[i - 1] + way * (i == 1 ? 25.0 : 0.0),
                    points[i] - way * (i + 1 == points.size() ? 22.0 : 2.0), paint);
        }
    };
    path({lamp, eye}, stroke(colour::kOrange, 2.2));
    path({lamp, floor, eye}, stroke(colour::kBlue, 2.2));
    const Point second(430, 300);
    path({lamp, wall, second, eye}, stroke(colour::kPale, 2, "7 5"));
    const Point cross = 0.5 * (wall + second);
    d.line(cross + Point(-9, -9), cross + Point(9, 9), stroke(colour::kRed, 3));
    d.line(cross + Point(-9, 9), cross + Point(9, -9), stroke(colour::kRed, 3));
    d.text({300, 26}, "straight from the lamp", {.size = 14, .colour = "#8a6100"});
    d.text({170, 214}, "once reflected", {.size = 14, .anchor = Anchor::End, .colour = colour::kBlue});
    d.text({580, 210}, "twice reflected:", {.size = 14, .anchor = Anchor::Start, .colour = colour::kNote});
    d.text({580, 230}, "not in the local model",
           {.size = 14, .anchor = Anchor::Start, .colour = colour::kNote});
    d.text({290, 345}, "L_{o} = L_{e} + Σ_{lamps} f_{r} · E_{lamp}", {.size = 19});
    return d.svg("What a local illumination model takes in");
}

}  // namespace conelight::figures

// SPDX-License-Identifier: MIT
// Polar plots of reflection: how much light a surface sends where. The curves come from the renderer's own
// BRDF (src/math/brdf.h) and from the Phong model of mode phong.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "conelight/scene.h"
#include "figures/drawings/drawing.h"
#include "figures/drawings/drawings.h"
#include "math/brdf.h"

namespace conelight::figures {
namespace {

constexpr double kIncoming = 0.7;  // rad from the normal, to the left

// Direction at `angle` from the normal, positive to the right, in the plane y = 0.
glm::vec3 direction(double angle) { return {float(std::sin(angle)), 0, float(std::cos(angle))}; }

using Lobe = std::function<double(double angle)>;

std::vector<Point> polar(Point centre, double scale, const Lobe& lobe) {
    constexpr int kPieces = 1440;  // an eighth of a degree: the sharpest lobe is 2 degrees wide
    std::vector<Point> points{centre};
    for (int i = 0; i <= kPieces; ++i) {
        const double angle = -kPi / 2 + kPi * i / kPieces;
        const double r = scale * std::max(lobe(angle), 0.0);
        points.push_back(centre + r * Point(std::sin(angle), -std::cos(angle)));
    }
    return points;
}

double specular(const glm::vec3& f0, float roughness, double angle) {
    const glm::vec3 n(0, 0, 1), toLight = direction(-kIncoming), toEye = direction(angle);
    if (toEye.z <= 1e-3f) return 0;
    const math::Brdf brdf = math::makeBrdf(f0, 1.0f, roughness, glm::vec3(0.04f), toEye.z);
    return math::brdfSpecular(brdf, n, toLight, toEye).g;
}

// (R . w)^shininess, as mode phong has it.
double phong(float shininess, double angle) {
    return std::pow(std::max(std::cos(angle - kIncoming), 0.0), shininess);
}

double peakOf(const Lobe& lobe) {
    double most = 0;
    for (int i = 0; i <= 1440; ++i) most = std::max(most, lobe(-kPi / 2 + kPi * i / 1440));
    return most;
}

// The surface, its normal, the light that comes in.
void drawGround(Drawing& d, Point centre, double size) {
    d.rect(centre - Point(size, 0), {2 * size, 9}, filled("#d8dde6"));
    d.line(centre - Point(size, 0), centre + Point(size, 0), stroke(colour::kInk, 1.5));
    d.line(centre, centre - Point(0, size), stroke(colour::kPale, 1, "4 4"));
    const Point way(std::sin(-kIncoming), -std::cos(kIncoming));
    d.arrow(centre + way * size, centre + way * 4.0, stroke(colour::kOrange, 2));
}

}  // namespace

std::string plotReflectanceParts() {
    Drawing d;
    const double size = 120;
    const Lobe glossy = [](double a) { return specular(glm::vec3(1), 0.42f, a); };
    const double most = peakOf(glossy);
    // Lambert's part is even: a half circle. Its size beside the lobe is that of a surface of which both
    // reflect alike at the lobe's rim, chosen by eye.
    const double even = 0.38;
    struct Part {
        const char* name;
        const char* colour;
        Lobe lobe;
    };
    const Lobe mirror = [](double a) { return std::abs(a - kIncoming) < 0.012 ? 1.0 : 0.0; };
    const Lobe diffuse = [even](double) { return even; };
    const Lobe lobe = [&](double a) { return 0.92 * glossy(a) / most; };
    const Lobe sum = [&](double a) { return std::max({mirror(a) * 1.12, diffuse(a) + 0.62 * lobe(a)}); };
    const std::vector<Part> parts = {{"ideal specular", colour::kPurple, mirror},
                                     {"ideal diffuse", colour::kBlue, diffuse},
                                     {"directional diffuse (glossy)", colour::kGreen, lobe},
                                     {"sum", colour::kRed, sum}};
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const Point centre(double(i) * 320, 0);
        drawGround(d, centre, size + 10);
        d.polygon(polar(centre, size, parts[i].lobe),
                  {.stroke = parts[i].colour, .width = 2, .fill = parts[i].colour, .opacity = 0.85});
        d.text(centre + Point(0, 40), parts[i].name, {.size = 16});
        if (i + 1 < parts.size())
            d.text(centre + Point(160, -45), i + 2 < parts.size() ? "+" : "=",
                   {.size = 34, .colour = "#4a5160"});
    }
    return d.svg("Reflectance components as polar plots");
}

std::string plotGlossyLobes() {
    Drawing d;
    const double size = 220;
    const float shininess[] = {1, 4, 16, 64, 256};
    constexpr const char* kColours[] = {colour::kBlue, colour::kGreen, colour::kOrange, colour::kRed,
                                        colour::kPurple};
    const std::string titles[] = {"Phong: (R·ω)^{α}", "GGX of the same material"};
    for (int model = 0; model < 2; ++model) {
        const Point centre(model * 540.0, 0);
        drawGround(d, centre, size + 16);
        for (const double r : {0.25, 0.5, 0.75, 1.0})
            d.arc(centre, size * r, 0, kPi, stroke(colour::kPale, 0.6, r < 1 ? "2 4" : ""));
        for (int i = 0; i < 5; ++i) {
            Lobe lobe = [&](double a) { return phong(shininess[i], a); };
            std::string label = fmt::format("α = {:g}", shininess[i]);
            if (model == 1) {
                Material material;
                setPbrFromPhong(material, {.shininess = shininess[i]});
                lobe = [rough = material.roughness](double a) { return specular(glm::vec3(1), rough, a); };
                const double most = peakOf(lobe);
                lobe = [lobe, most](double a) { return lobe(a) / most; };
                label = fmt::format("roughness {:.2f}", material.roughness);
            }
            d.polygon(polar(centre, size, lobe), stroke(kColours[i], 2.2));
            d.line(centre + Point(-size + 10, 52.0 + 24 * i), centre + Point(-size + 44, 52.0 + 24 * i),
                   stroke(kColours[i], 3));
            d.text(centre + Point(-size + 54, 57.0 + 24 * i), label, {.anchor = Anchor::Start});
        }
        d.text(centre + Point(0, -size - 26), titles[model], {.size = 17, .bold = true});
        const Point way(std::sin(kIncoming), -std::cos(kIncoming));
        d.line(centre, centre + way * (size + 14), stroke(colour::kInk, 1, "6 4"));
        d.text(centre + way * (size + 26) + Point(0, 4), "R", {.size = 17, .italic = true});
    }
    d.text({40, 110}, "each lobe is drawn", {.size = 13, .anchor = Anchor::Start, .colour = "#4a5160"});
    d.text({40, 128}, "with its peak at 1", {.size = 13, .anchor = Anchor::Start, .colour = "#4a5160"});
    return d.svg("Glossy lobes for several shininess values");
}

}  // namespace conelight::figures

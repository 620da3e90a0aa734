// SPDX-License-Identifier: MIT
// A vector drawing: lines, areas, arrows, labels -> SVG text. Points are in pixels, y down.
// The picture's frame is found from what was drawn, widths of letters included: nothing is cut off.
// Same calls, same bytes. Letters are those of the reader's sans-serif font.
#pragma once

#include <glm/glm.hpp>

#include <numbers>
#include <string>
#include <vector>

#include "io/image_file.h"

namespace conelight::figures {

using Point = glm::dvec2;

constexpr double kPi = std::numbers::pi;

// Colours of all drawings: told apart by people who do not see red and green alike (Okabe and Ito 2008).
namespace colour {
constexpr const char* kInk = "#1f2430";
constexpr const char* kNote = "#4a5160";
constexpr const char* kPale = "#8b93a3";
constexpr const char* kPaper = "#ffffff";
constexpr const char* kWash = "#eef1f6";
constexpr const char* kBlue = "#0072b2";
constexpr const char* kSky = "#56b4e9";
constexpr const char* kOrange = "#e69f00";
constexpr const char* kRed = "#d55e00";
constexpr const char* kGreen = "#009e73";
constexpr const char* kPurple = "#a04f86";
}  // namespace colour

struct Paint {
    std::string stroke = colour::kInk;  // "none": no outline
    double width = 1.5;
    std::string fill = "none";
    std::string dash;  // "6 4"; empty: unbroken
    double opacity = 1;
};
Paint stroke(const std::string& colour, double width = 1.5, const std::string& dash = {});
Paint filled(const std::string& colour, double opacity = 1);

enum class Anchor { Start, Middle, End };
// Text may hold _{below} and ^{above}.
struct Lettering {
    double size = 15;
    Anchor anchor = Anchor::Middle;
    std::string colour = colour::kInk;
    bool bold = false;
    bool italic = false;
    double turnDeg = 0;  // clockwise, about the anchor
};

// Width of a text in pixels, about: letters are classed by width, never narrower than common fonts have them.
double textWidth(const std::string& text, double size, bool bold = false);

class Drawing {
  public:
    void line(Point from, Point to, const Paint& paint = {});
    void polyline(const std::vector<Point>& points, const Paint& paint = {});
    void polygon(const std::vector<Point>& points, const Paint& paint = {});
    void circle(Point centre, double radius, const Paint& paint = {});
    void rect(Point corner, Point size, const Paint& paint = {}, double rounding = 0);
    // The part of a circle between two angles, rad, counter-clockwise from +x as the reader sees it.
    void arc(Point centre, double radius, double from, double to, const Paint& paint = {});
    // A line with a head at `to`.
    void arrow(Point from, Point to, const Paint& paint = {});
    // An arrow along several points.
    void arrow(const std::vector<Point>& points, const Paint& paint = {});
    // `at`: on the base line.
    void text(Point at, const std::string& text, const Lettering& lettering = {});
    // Lines one below the other, their middle at `at`.
    void textBlock(Point at, const std::vector<std::string>& lines, const Lettering& lettering = {});
    // Pixels, drawn as squares when magnified.
    void image(Point corner, Point size, const io::ByteImage& image);

    // The whole file; `title` is what readers of the picture's words hear.
    std::string svg(const std::string& title) const;

  private:
    void grow(Point p, double by = 0);
    std::string body_;
    Point low_{1e9}, high_{-1e9};
};

// A box with its text in the middle, wide and high enough for it; returned for arrows.
struct Box {
    Point centre, half;
    Point left() const { return centre - Point(half.x, 0); }
    Point right() const { return centre + Point(half.x, 0); }
    Point top() const { return centre - Point(0, half.y); }
    Point bottom() const { return centre + Point(0, half.y); }
};
Box box(Drawing& drawing, Point centre, const std::vector<std::string>& lines, const std::string& fill,
        double least = 0);
// From the border of one box to the border of the other, straight along the line between their centres.
void connect(Drawing& drawing, const Box& from, const Box& to, const Paint& paint = {},
             const std::string& label = {});

}  // namespace conelight::figures

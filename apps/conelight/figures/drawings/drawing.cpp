// SPDX-License-Identifier: MIT
#include "figures/drawings/drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "io/files.h"

namespace conelight::figures {
namespace {

constexpr double kMargin = 12;  // round everything, pixels
constexpr double kLineHeight = 1.3;
constexpr double kSmall = 0.72;  // size of letters below and above the line, of the text's

// Two digits after the point, without trailing noughts: a hundredth of a pixel is enough.
std::string num(double value) {
    std::string text = fmt::format("{:.2f}", value);
    while (text.back() == '0') text.pop_back();
    if (text.back() == '.') text.pop_back();
    return text == "-0" ? "0" : text;
}

std::string escaped(const std::string& text) {
    std::string out;
    for (const char c : text)
        out += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : std::string(1, c);
    return out;
}

std::string attributes(const Paint& paint) {
    std::string text = fmt::format(" fill=\"{}\" stroke=\"{}\"", paint.fill, paint.stroke);
    if (paint.stroke != "none")
        text += fmt::format(" stroke-width=\"{}\" stroke-linejoin=\"round\" stroke-linecap=\"round\"",
                            num(paint.width));
    if (!paint.dash.empty()) text += fmt::format(" stroke-dasharray=\"{}\"", paint.dash);
    if (paint.opacity != 1) text += fmt::format(" opacity=\"{}\"", num(paint.opacity));
    return text;
}

std::string pointList(const std::vector<Point>& points) {
    std::string text;
    for (const Point& p : points) text += fmt::format("{}{},{}", text.empty() ? "" : " ", num(p.x), num(p.y));
    return text;
}

// Pieces of a text: on the line, below it, above it.
struct Piece {
    std::string text;
    int rise = 0;  // -1 below, +1 above
};

std::vector<Piece> piecesOf(const std::string& text) {
    std::vector<Piece> pieces;
    for (std::size_t i = 0; i < text.size();) {
        const bool marked = (text[i] == '_' || text[i] == '^') && i + 1 < text.size() && text[i + 1] == '{';
        const std::size_t end = marked ? text.find('}', i) : std::string::npos;
        if (end != std::string::npos) {
            pieces.push_back({text.substr(i + 2, end - i - 2), text[i] == '_' ? -1 : 1});
            i = end + 1;
            continue;
        }
        if (pieces.empty() || pieces.back().rise != 0) pieces.push_back({});
        pieces.back().text += text[i++];
    }
    return pieces;
}

// In parts of the size: four classes of letters, after Helvetica and DejaVu Sans, the wider of the two.
double letterWidth(unsigned char c) {
    if (c < 0x80) {
        const std::string_view narrow = "ijlI.,:;'|!()[]/ ", wide = "mwMWG@%OQ";
        if (narrow.find(char(c)) != std::string_view::npos) return 0.37;
        if (wide.find(char(c)) != std::string_view::npos) return 0.93;
        return std::isupper(c) != 0 ? 0.70 : 0.61;
    }
    return (c & 0xc0) == 0x80 ? 0 : 0.64;  // one width for each letter of several bytes
}

}  // namespace

Paint stroke(const std::string& colour, double width, const std::string& dash) {
    return {.stroke = colour, .width = width, .dash = dash};
}

Paint filled(const std::string& colour, double opacity) {
    return {.stroke = "none", .fill = colour, .opacity = opacity};
}

double textWidth(const std::string& text, double size, bool bold) {
    double width = 0;
    for (const Piece& piece : piecesOf(text))
        for (const char c : piece.text)
            width += letterWidth(static_cast<unsigned char>(c)) * (piece.rise != 0 ? kSmall : 1.0);
    return width * size * (bold ? 1.1 : 1.0);
}

void Drawing::grow(Point p, double by) {
    low_ = glm::min(low_, p - by);
    high_ = glm::max(high_, p + by);
}

void Drawing::line(Point from, Point to, const Paint& paint) { polyline({from, to}, paint); }

void Drawing::polyline(const std::vector<Point>& points, const Paint& paint) {
    for (const Point& p : points) grow(p, paint.width);
    body_ += fmt::format("<polyline points=\"{}\"{}/>\n", pointList(points), attributes(paint));
}

void Drawing::polygon(const std::vector<Point>& points, const Paint& paint) {
    for (const Point& p : points) grow(p, paint.width);
    body_ += fmt::format("<polygon points=\"{}\"{}/>\n", pointList(points), attributes(paint));
}

void Drawing::circle(Point centre, double radius, const Paint& paint) {
    grow(centre, radius + paint.width);
    body_ += fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"{}\"{}/>\n", num(centre.x), num(centre.y),
                         num(radius), attributes(paint));
}

void Drawing::rect(Point corner, Point size, const Paint& paint, double rounding) {
    grow(corner, paint.width);
    grow(corner + size, paint.width);
    body_ += fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" rx=\"{}\"{}/>\n", num(corner.x),
                         num(corner.y), num(size.x), num(size.y), num(rounding), attributes(paint));
}

void Drawing::arc(Point centre, double radius, double from, double to, const Paint& paint) {
    constexpr int kPieces = 48;
    std::vector<Point> points;
    for (int i = 0; i <= kPieces; ++i) {
        const double angle = from + (to - from) * i / kPieces;
        points.push_back(centre + radius * Point(std::cos(angle), -std::sin(angle)));
    }
    polyline(points, paint);
}

void Drawing::arrow(Point from, Point to, const Paint& paint) { arrow(std::vector<Point>{from, to}, paint); }

void Drawing::arrow(const std::vector<Point>& points, const Paint& paint) {
    const Point tip = points.back(), before = points[points.size() - 2];
    const double length = glm::length(tip - before);
    if (length < 1e-6) return;
    const Point along = (tip - before) / length, across(-along.y, along.x);
    const double head = 5 + 2.2 * paint.width;
    std::vector<Point> shaft = points;
    shaft.back() = tip - along * std::min(0.8 * head, length);  // the head covers the end
    polyline(shaft, paint);
    Paint solid = filled(paint.stroke, paint.opacity);
    polygon({tip, tip - along * head + across * (0.42 * head), tip - along * head - across * (0.42 * head)},
            solid);
}

void Drawing::text(Point at, const std::string& text, const Lettering& lettering) {
    const double width = textWidth(text, lettering.size, lettering.bold);
    const double start = lettering.anchor == Anchor::Start    ? 0
                         : lettering.anchor == Anchor::Middle ? -0.5
                                                              : -1;
    const double angle = lettering.turnDeg * std::numbers::pi / 180;
    for (const double x : {start * width, (start + 1) * width})
        for (const double y : {-0.85 * lettering.size, 0.3 * lettering.size})
            grow(at +
                 Point(std::cos(angle) * x - std::sin(angle) * y, std::sin(angle) * x + std::cos(angle) * y));
    const char* anchors[] = {"start", "middle", "end"};
    body_ += fmt::format("<text x=\"{}\" y=\"{}\" font-size=\"{}\" text-anchor=\"{}\" fill=\"{}\"", num(at.x),
                         num(at.y), num(lettering.size), anchors[int(lettering.anchor)], lettering.colour);
    if (lettering.bold) body_ += " font-weight=\"bold\"";
    if (lettering.italic) body_ += " font-style=\"italic\"";
    if (lettering.turnDeg != 0)
        body_ += fmt::format(" transform=\"rotate({} {} {})\"", num(lettering.turnDeg), num(at.x), num(at.y));
    body_ += ">";
    int rise = 0;
    for (const Piece& piece : piecesOf(text)) {
        if (piece.rise == 0 && rise == 0) {
            body_ += escaped(piece.text);
            continue;
        }
        // From where the piece before left the line.
        const double step = (rise - piece.rise) * 0.28 * lettering.size;
        rise = piece.rise;
        body_ += fmt::format("<tspan dy=\"{}\"{}>{}</tspan>", num(step),
                             rise == 0 ? "" : fmt::format(" font-size=\"{}\"", num(kSmall * lettering.size)),
                             escaped(piece.text));
    }
    body_ += "</text>\n";
}

void Drawing::textBlock(Point at, const std::vector<std::string>& lines, const Lettering& lettering) {
    const double step = kLineHeight * lettering.size;
    const double first = at.y - 0.5 * step * double(lines.size() - 1) + 0.35 * lettering.size;
    for (std::size_t i = 0; i < lines.size(); ++i)
        text({at.x, first + step * double(i)}, lines[i], lettering);
}

void Drawing::image(Point corner, Point size, const io::ByteImage& image) {
    grow(corner);
    grow(corner + size);
    body_ += fmt::format(
        "<image x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" preserveAspectRatio=\"none\" "
        "style=\"image-rendering:pixelated\" href=\"data:image/png;base64,{}\"/>\n",
        num(corner.x), num(corner.y), num(size.x), num(size.y), io::base64Encoded(io::pngBytes(image)));
}

std::string Drawing::svg(const std::string& title) const {
    const Point low = low_ - kMargin, size = high_ - low_ + 2 * kMargin;
    return fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{2}\" height=\"{3}\" viewBox=\"{0} {1} {2} {3}\" "
        "font-family=\"DejaVu Sans, Helvetica, Arial, sans-serif\" role=\"img\" "
        "xml:space=\"preserve\">\n<title>{4}</title>\n"
        "<rect x=\"{0}\" y=\"{1}\" width=\"{2}\" height=\"{3}\" fill=\"#ffffff\"/>\n{5}</svg>\n",
        num(low.x), num(low.y), num(size.x), num(size.y), escaped(title), body_);
}

Box box(Drawing& drawing, Point centre, const std::vector<std::string>& lines, const std::string& fill,
        double least) {
    constexpr double kSize = 14, kPad = 11;
    double width = least;
    for (const std::string& line : lines) width = std::max(width, textWidth(line, kSize) + 2 * kPad);
    const Point half(0.5 * width, 0.5 * (kLineHeight * kSize * double(lines.size()) + 2 * kPad - 4));
    drawing.rect(centre - half, 2.0 * half, {.fill = fill}, 6);
    drawing.textBlock(centre, lines, {.size = kSize});
    return {centre, half};
}

void connect(Drawing& drawing, const Box& from, const Box& to, const Paint& paint, const std::string& label) {
    const Point way = to.centre - from.centre;
    const auto border = [&](const Box& b, double sign) {
        const double x = std::abs(way.x) > 1e-9 ? b.half.x / std::abs(way.x) : 1e9;
        const double y = std::abs(way.y) > 1e-9 ? b.half.y / std::abs(way.y) : 1e9;
        return b.centre + sign * std::min(x, y) * way;
    };
    const Point start = border(from, 1), end = border(to, -1);
    drawing.arrow(start, end - glm::normalize(way) * 2.0, paint);
    if (label.empty()) return;
    const bool upright = std::abs(way.y) > std::abs(way.x);
    drawing.text(0.5 * (start + end) + (upright ? Point(8, 4) : Point(0, -7)), label,
                 {.size = 12, .anchor = upright ? Anchor::Start : Anchor::Middle, .colour = "#4a5160"});
}

}  // namespace conelight::figures

// SPDX-License-Identifier: MIT
#include "scene/surroundings.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "math/brightness.h"

namespace conelight {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

}  // namespace

glm::vec2 environmentUv(const glm::vec3& direction) {
    const bool upright = direction.x == 0 && direction.z == 0;
    const double azimuth =
        upright ? 0 : std::atan2(static_cast<double>(direction.x), -static_cast<double>(direction.z));
    const double polar = std::acos(std::clamp(static_cast<double>(direction.y), -1.0, 1.0));
    const double u = azimuth / kTurn + 0.5;
    return {static_cast<float>(u - std::floor(u)), static_cast<float>(polar / std::numbers::pi)};
}

glm::vec3 environmentDirection(const glm::vec2& uv) {
    const double azimuth = (static_cast<double>(uv.x) - 0.5) * kTurn,
                 polar = static_cast<double>(uv.y) * std::numbers::pi;
    return glm::vec3(glm::dvec3(std::sin(polar) * std::sin(azimuth), std::cos(polar),
                                -std::sin(polar) * std::cos(azimuth)));
}

namespace scene {
namespace {

// One axis of a resampling: the old cells that a new cell covers, with weights that add up to 1.
struct Coverage {
    int first = 0;
    std::vector<double> weights;
};

// `edge(i, count)`: where cell i of `count` begins, rising.
template <class Edge>
std::vector<Coverage> coverages(int from, int to, const Edge& edge) {
    std::vector<Coverage> result(static_cast<std::size_t>(to));
    for (int i = 0; i < to; ++i) {
        const double begin = edge(i, to), end = edge(i + 1, to);
        Coverage& coverage = result[static_cast<std::size_t>(i)];
        // The rows' edges are told apart by their place, which is the same for all kinds of edge.
        coverage.first = static_cast<int>(static_cast<long long>(i) * from / to);
        const int last =
            std::min(from, static_cast<int>((static_cast<long long>(i + 1) * from + to - 1) / to));
        for (int k = coverage.first; k < last; ++k)
            coverage.weights.push_back(
                std::max(std::min(end, edge(k + 1, from)) - std::max(begin, edge(k, from)), 0.0) /
                (end - begin));
    }
    return result;
}

double columnEdge(int i, int count) { return static_cast<double>(i) / count; }
// Rows of equal solid angle would be of equal steps of the cosine.
double rowEdge(int i, int count) { return -std::cos(std::numbers::pi * i / count); }

const glm::vec3& texel(const EnvironmentImage& image, int x, int y) {
    return image.radiance[static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                          static_cast<std::size_t>(x)];
}

// Between the centres of four texels; round the horizon, not over the poles.
glm::vec3 interpolated(const EnvironmentImage& image, const glm::vec2& uv) {
    const float x = uv.x * static_cast<float>(image.width) - 0.5f;
    const float y = std::clamp(uv.y * static_cast<float>(image.height) - 0.5f, 0.0f,
                               static_cast<float>(image.height - 1));
    const float left = std::floor(x), top = std::floor(y);
    const int x0 = (static_cast<int>(left) + image.width) % image.width, x1 = (x0 + 1) % image.width;
    const int y0 = static_cast<int>(top), y1 = std::min(y0 + 1, image.height - 1);
    return glm::mix(glm::mix(texel(image, x0, y0), texel(image, x1, y0), x - left),
                    glm::mix(texel(image, x0, y1), texel(image, x1, y1), x - left), y - top);
}

// The mean over a texel of what is interpolated there, as if all texels had one solid angle.
glm::vec3 meanOver(const EnvironmentImage& image, int x, int y) {
    glm::vec3 sum(0);
    for (int row = -1; row <= 1; ++row)
        for (int column = -1; column <= 1; ++column) {
            const float weight = (row == 0 ? 0.75f : 0.125f) * (column == 0 ? 0.75f : 0.125f);
            sum += weight * texel(image, (x + column + image.width) % image.width,
                                  std::clamp(y + row, 0, image.height - 1));
        }
    return sum;
}

}  // namespace

double texelSolidAngle(const EnvironmentImage& image, int row) {
    return (rowEdge(row + 1, image.height) - rowEdge(row, image.height)) * kTurn / image.width;
}

EnvironmentImage resampled(const EnvironmentImage& image, int width, int height) {
    const std::vector<Coverage> columns = coverages(image.width, width, columnEdge);
    const std::vector<Coverage> rows = coverages(image.height, height, rowEdge);
    EnvironmentImage result{width, height, {}};
    result.radiance.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    std::vector<glm::dvec3> line(static_cast<std::size_t>(image.width));
    for (const Coverage& row : rows) {
        std::fill(line.begin(), line.end(), glm::dvec3(0));
        for (std::size_t i = 0; i < row.weights.size(); ++i)
            for (int x = 0; x < image.width; ++x)
                line[static_cast<std::size_t>(x)] +=
                    row.weights[i] * glm::dvec3(texel(image, x, row.first + static_cast<int>(i)));
        for (const Coverage& column : columns) {
            glm::dvec3 sum(0);
            for (std::size_t i = 0; i < column.weights.size(); ++i)
                sum += column.weights[i] * line[static_cast<std::size_t>(column.first) + i];
            result.radiance.emplace_back(sum);
        }
    }
    return result;
}

Surroundings::Surroundings(const Scene& scene) : sky_(scene.sky), environment_(scene.environment) {
    if (!environment_.used()) return;
    const EnvironmentImage& image = *environment_.image;
    const auto width = static_cast<std::size_t>(image.width), height = static_cast<std::size_t>(image.height);
    rowSums_.resize(height);
    texelSums_.resize(width * height);
    double all = 0;
    for (std::size_t y = 0; y < height; ++y) {
        double sum = 0;
        for (std::size_t x = 0; x < width; ++x) {
            const glm::vec3 mean = meanOver(image, static_cast<int>(x), static_cast<int>(y));
            sum += static_cast<double>(math::brightness(sky_ + environment_.strength * mean));
            texelSums_[y * width + x] = static_cast<float>(sum);
        }
        all += sum * texelSolidAngle(image, static_cast<int>(y));
        rowSums_[y] = all;
    }
    if (!(all > 0)) rowSums_.clear();
}

bool Surroundings::isBlack() const { return math::brightness(sky_) <= 0 && !hasPicture(); }

glm::vec2 Surroundings::turnedUv(const glm::vec3& direction) const {
    glm::vec2 uv = environmentUv(direction);
    uv.x += environment_.rotation / static_cast<float>(kTurn);
    uv.x -= std::floor(uv.x);
    return uv;
}

glm::vec3 Surroundings::pictureRadiance(const glm::vec3& direction) const {
    if (!environment_.used()) return glm::vec3(0);
    return environment_.strength * interpolated(*environment_.image, turnedUv(direction));
}

Surroundings::Draw Surroundings::draw(const glm::vec2& u) const {
    const EnvironmentImage& image = *environment_.image;
    const auto width = static_cast<std::size_t>(image.width);
    // A row, then a texel of it; what is left of each number chooses the place within.
    const double light = static_cast<double>(u.y) * rowSums_.back();
    const auto row = std::min(std::upper_bound(rowSums_.begin(), rowSums_.end(), light), rowSums_.end() - 1);
    const auto y = static_cast<std::size_t>(row - rowSums_.begin());
    const double below = y > 0 ? rowSums_[y - 1] : 0;
    const double inRow = std::clamp((light - below) / std::max(*row - below, 1e-300), 0.0, 1.0);
    const auto first = texelSums_.begin() + static_cast<std::ptrdiff_t>(y * width);
    const auto end = first + static_cast<std::ptrdiff_t>(width);
    const float lightOfRow = u.x * *(end - 1);
    const auto found = std::min(std::upper_bound(first, end, lightOfRow), end - 1);
    const float before = found == first ? 0 : *(found - 1);
    const double inTexel =
        std::clamp(static_cast<double>((lightOfRow - before) / std::max(*found - before, 1e-30f)), 0.0, 1.0);
    const int top = static_cast<int>(y);
    const double cosine = -glm::mix(rowEdge(top, image.height), rowEdge(top + 1, image.height), inRow);
    const double x = (static_cast<double>(found - first) + inTexel) / image.width -
                     static_cast<double>(environment_.rotation) / kTurn;
    Draw draw;
    draw.direction = environmentDirection(
        {static_cast<float>(x),
         static_cast<float>(std::acos(std::clamp(cosine, -1.0, 1.0)) / std::numbers::pi)});
    draw.density = density(draw.direction);
    return draw;
}

float Surroundings::density(const glm::vec3& direction) const {
    const EnvironmentImage& image = *environment_.image;
    const glm::vec2 uv = turnedUv(direction);
    const auto width = static_cast<std::size_t>(image.width);
    const auto x = std::min(static_cast<std::size_t>(uv.x * static_cast<float>(width)), width - 1);
    const auto y = std::min(static_cast<std::size_t>(uv.y * static_cast<float>(image.height)),
                            static_cast<std::size_t>(image.height - 1));
    const std::size_t i = y * width + x;
    const float own = texelSums_[i] - (x > 0 ? texelSums_[i - 1] : 0);
    return own / static_cast<float>(rowSums_.back());
}

}  // namespace scene
}  // namespace conelight

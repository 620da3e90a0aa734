// SPDX-License-Identifier: MIT
// Fits the polynomials of `rectLobe` in shaders/lib/rect_light.glsl: for each roughness and angle of view the
// linearly transformed cosine (Heitz et al. 2016) nearest to the GGX lobe of lib/brdf.glsl, then polynomials
// through what was found. Prints GLSL and how far off both are. Seconds; the same result each time:
//     c++ -O2 -std=c++20 tools/fit_rect_lobe.cpp -o build/fit_rect_lobe && build/fit_rect_lobe
//
// A direction (x, y, z), z along the normal and x to the side of the mirrored view, becomes ((x - shift z) /
// wide.x, y / wide.y, z). The horizon stays where it is. "Nearest": least integral of (f - g)^2 / (f + g)
// over all directions, f and g the two densities.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr int kSamples = 24;   // per dimension, of each of the two densities
constexpr int kRough = 25;     // values of roughness, 0.045 .. 1
constexpr int kViews = 25;     // angles of view, n.v = 0.01 .. 1
constexpr int kS = 5, kR = 5;  // coefficients of the polynomials in s and in roughness
constexpr double kMinRoughness = 0.045;

struct Vec {
    double x, y, z;
};
Vec operator+(Vec a, Vec b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Vec operator*(double s, Vec a) { return {s * a.x, s * a.y, s * a.z}; }
double dot(Vec a, Vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Vec unit(Vec a) { return 1 / std::sqrt(dot(a, a)) * a; }

// The single-scattering GGX lobe times the cosine, without Fresnel's factor, seen from `eye`.
struct Lobe {
    double alpha;
    Vec eye;
    double albedo = 1;

    double lambda(double z) const {
        return 0.5 * (std::sqrt(1 + alpha * alpha * (1 - z * z) / std::max(z * z, 1e-12)) - 1);
    }
    // Density of directions mirrored about visible normals (Heitz 2018).
    double visible(Vec l) const {
        const Vec h = unit(l + eye);
        if (h.z <= 0 || dot(eye, h) <= 0) return 0;
        const double a2 = alpha * alpha, d = (1 - h.z * h.z) + h.z * h.z * a2;
        return a2 / (kPi * d * d) / (1 + lambda(eye.z)) / (4 * eye.z);
    }
    double shadowing(double z) const { return (1 + lambda(eye.z)) / (1 + lambda(eye.z) + lambda(z)); }
    double density(Vec l) const { return l.z <= 1e-6 ? 0 : visible(l) * shadowing(l.z) / albedo; }
    Vec sample(double x1, double x2) const {
        const Vec v = unit({alpha * eye.x, alpha * eye.y, eye.z});
        const double across = std::sqrt(v.x * v.x + v.y * v.y);
        const Vec t1 = across > 1e-7 ? Vec{-v.y / across, v.x / across, 0} : Vec{1, 0, 0};
        const Vec t2{v.y * t1.z - v.z * t1.y, v.z * t1.x - v.x * t1.z, v.x * t1.y - v.y * t1.x};
        const double r = std::sqrt(x1), a = r * std::cos(2 * kPi * x2), s = 0.5 * (1 + v.z);
        const double b = (1 - s) * std::sqrt(std::max(1 - a * a, 0.0)) + s * r * std::sin(2 * kPi * x2);
        const Vec n = a * t1 + b * t2 + std::sqrt(std::max(1 - a * a - b * b, 0.0)) * v;
        const Vec h = unit({alpha * n.x, alpha * n.y, std::max(n.z, 1e-9)});
        return 2 * dot(h, eye) * h + -1 * eye;
    }
};

Lobe makeLobe(double roughness, double NoV) {
    Lobe lobe{roughness * roughness, {-std::sqrt(1 - NoV * NoV), 0, NoV}};
    double sum = 0;
    constexpr int kFine = 64;
    for (int i = 0; i < kFine * kFine; ++i) {
        const Vec l = lobe.sample((i % kFine + 0.5) / kFine, (i / kFine + 0.5) / kFine);
        if (l.z > 0) sum += lobe.shadowing(l.z);
    }
    lobe.albedo = sum / (kFine * kFine);
    return lobe;
}

// Logarithms of the widths and of the shift over the sine of the view's angle.
using Shape = std::array<double, 3>;

struct Stretched {
    double wideX, wideY, shift;
    Stretched(const Shape& s, double NoV)
        : wideX(std::exp(s[0])), wideY(std::exp(s[1])), shift(std::exp(s[2]) * std::sqrt(1 - NoV * NoV)) {}
    Vec sample(double x1, double x2) const {
        const double r = std::sqrt(x1), z = std::sqrt(1 - x1);
        return unit({wideX * r * std::cos(2 * kPi * x2) + shift * z, wideY * r * std::sin(2 * kPi * x2), z});
    }
    double density(Vec l) const {
        if (l.z <= 0) return 0;
        const double u = (l.x - shift * l.z) / wideX, v = l.y / wideY, q = u * u + v * v + l.z * l.z;
        return l.z / (kPi * q * q * wideX * wideY);
    }
};

double difference(const Lobe& lobe, const Shape& shape) {
    const Stretched stretched(shape, lobe.eye.z);
    double sum = 0;
    for (int i = 0; i < kSamples * kSamples; ++i) {
        const double x1 = (i % kSamples + 0.5) / kSamples, x2 = (i / kSamples + 0.5) / kSamples;
        for (const Vec l : {lobe.sample(x1, x2), stretched.sample(x1, x2)}) {
            if (l.z <= 0) continue;
            const double f = lobe.density(l), g = stretched.density(l);
            const double drawn = lobe.visible(l) + g;  // twice the density of these samples
            if (f + g > 0 && drawn > 0) sum += (f - g) * (f - g) / (f + g) / drawn;
        }
    }
    return sum / (kSamples * kSamples);
}

// Downhill simplex (Nelder and Mead 1965) about `start`.
Shape nearest(const Lobe& lobe, const Shape& start, double step) {
    struct Corner {
        Shape at;
        double value;
    };
    const auto corner = [&](const Shape& at) { return Corner{at, difference(lobe, at)}; };
    std::array<Corner, 4> c;
    for (std::size_t i = 0; i < 4; ++i) {
        Shape at = start;
        if (i > 0) at[i - 1] += step;
        c[i] = corner(at);
    }
    for (int turn = 0; turn < 250; ++turn) {
        std::sort(c.begin(), c.end(), [](const Corner& a, const Corner& b) { return a.value < b.value; });
        if (c[3].value - c[0].value < 1e-10) break;
        const auto along = [&](double t) {
            Shape at;
            for (std::size_t k = 0; k < 3; ++k) {
                const double middle = (c[0].at[k] + c[1].at[k] + c[2].at[k]) / 3;
                at[k] = middle + t * (c[3].at[k] - middle);
            }
            return corner(at);
        };
        const Corner mirrored = along(-1);
        if (mirrored.value < c[0].value) {
            const Corner far = along(-2);
            c[3] = far.value < mirrored.value ? far : mirrored;
        } else if (mirrored.value < c[2].value) {
            c[3] = mirrored;
        } else {
            const Corner half = along(mirrored.value < c[3].value ? -0.5 : 0.5);
            if (half.value < std::min(mirrored.value, c[3].value)) {
                c[3] = half;
            } else {
                for (std::size_t i = 1; i < 4; ++i) {
                    Shape at;
                    for (std::size_t k = 0; k < 3; ++k) at[k] = 0.5 * (c[i].at[k] + c[0].at[k]);
                    c[i] = corner(at);
                }
            }
        }
    }
    return std::min_element(c.begin(), c.end(),
                            [](const Corner& a, const Corner& b) { return a.value < b.value; })
        ->at;
}

struct Node {
    double roughness, NoV;
    Shape shape;
    double s() const { return NoV / (NoV + roughness * roughness); }
    // What the polynomials give. For small alpha all three are 1: reflection doubles the angle of the facet,
    // so wide = 2 alpha (1 / NoV^2, 1) and shift = tan; facets that hide each other at grazing angles, by the
    // ratio s of NoV and alpha, keep them finite.
    std::array<double, 3> targets() const {
        const double a = roughness * roughness;
        return {std::sqrt(std::exp(shape[0]) / (2 * a)) * NoV / s(), std::exp(shape[1]) / (2 * a),
                std::exp(shape[2]) * NoV / s()};
    }
    static Shape shapeOf(const std::array<double, 3>& t, double roughness, double NoV) {
        const double a = roughness * roughness, s = NoV / (NoV + a);
        return {2 * std::log(std::max(t[0], 1e-6) * s / NoV) + std::log(2 * a),
                std::log(std::max(t[1], 1e-6) * 2 * a), std::log(std::max(t[2], 1e-6) * s / NoV)};
    }
};

using Polynomial = std::array<double, kS * kR>;

double value(const Polynomial& p, double s, double r) {
    double sum = 0;
    for (int j = kR - 1; j >= 0; --j) {
        double row = 0;
        for (int i = kS - 1; i >= 0; --i) row = row * s + p[static_cast<std::size_t>(j * kS + i)];
        sum = sum * r + row;
    }
    return sum;
}

// Least squares; grazing views, of which a picture has few pixels, count less.
Polynomial fitted(const std::vector<Node>& nodes, std::size_t which) {
    constexpr int n = kS * kR;
    std::vector<std::array<long double, n + 1>> m(n);
    for (const Node& node : nodes) {
        std::array<long double, n> basis;
        for (int j = 0; j < kR; ++j)
            for (int i = 0; i < kS; ++i)
                basis[static_cast<std::size_t>(j * kS + i)] =
                    std::pow(node.s(), i) * std::pow(node.roughness, j);
        const long double weight = node.NoV + 0.05;
        for (std::size_t a = 0; a < n; ++a) {
            for (std::size_t b = 0; b < n; ++b) m[a][b] += weight * basis[a] * basis[b];
            m[a][n] += weight * basis[a] * node.targets()[which];
        }
    }
    for (std::size_t k = 0; k < n; ++k) m[k][k] += 1e-9L;  // keeps coefficients small
    for (std::size_t k = 0; k < n; ++k) {                  // Gauss and Jordan
        std::size_t pivot = k;
        for (std::size_t i = k; i < n; ++i)
            if (std::abs(m[i][k]) > std::abs(m[pivot][k])) pivot = i;
        std::swap(m[k], m[pivot]);
        for (std::size_t i = 0; i < n; ++i) {
            if (i == k) continue;
            const long double f = m[i][k] / m[k][k];
            for (std::size_t j = k; j <= n; ++j) m[i][j] -= f * m[k][j];
        }
    }
    Polynomial p;
    for (std::size_t k = 0; k < n; ++k) p[k] = static_cast<double>(m[k][n] / m[k][k]);
    return p;
}

void print(const char* name, const Polynomial& p) {
    std::printf("    float %s =\n", name);
    for (int j = 0; j < kR; ++j) {
        std::printf("        %s(", j == 0 ? "" : "r * (");
        for (int i = 0; i < kS; ++i)
            std::printf(i + 1 < kS ? "%.6g + s * (" : "%.6g", p[static_cast<std::size_t>(j * kS + i)]);
        for (int i = 0; i < kS; ++i) std::printf(")");
        std::printf(j + 1 < kR ? " +\n" : "");
    }
    for (int j = 1; j < kR; ++j) std::printf(")");
    std::printf(";\n");
}

}  // namespace

int main() {
    std::vector<Node> nodes;
    std::vector<Lobe> lobes;
    double least = 0;
    for (int i = 0; i < kRough; ++i) {
        const double roughness = kMinRoughness + (1 - kMinRoughness) * i / (kRough - 1);
        const double width = std::log(2 * roughness * roughness);
        Shape shape{width, width, 0};
        for (int j = 0; j < kViews; ++j) {  // from above to grazing, each from the one before
            const double t = static_cast<double>(j) / (kViews - 1);
            const double NoV = std::clamp(1 - t * t, 0.01, 0.9999);
            lobes.push_back(makeLobe(roughness, NoV));
            shape = nearest(lobes.back(), nearest(lobes.back(), shape, 0.1), 0.05);
            nodes.push_back({roughness, NoV, shape});
            least += difference(lobes.back(), shape);
        }
    }
    std::array<Polynomial, 3> p;
    for (std::size_t k = 0; k < 3; ++k) p[k] = fitted(nodes, k);
    print("wideX", p[0]);
    print("wideY", p[1]);
    print("shift", p[2]);
    double reached = 0, worst = 0;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const Node& node = nodes[i];
        const Shape shape =
            Node::shapeOf({value(p[0], node.s(), node.roughness), value(p[1], node.s(), node.roughness),
                           value(p[2], node.s(), node.roughness)},
                          node.roughness, node.NoV);
        const double d = difference(lobes[i], shape);
        reached += d;
        if (node.NoV > 0.2) worst = std::max(worst, d - difference(lobes[i], node.shape));
    }
    const double count = static_cast<double>(nodes.size());
    std::printf("// difference, mean: nearest %.4f, by polynomials %.4f; lost at most, NoV > 0.2: %.4f\n",
                least / count, reached / count, worst);
}

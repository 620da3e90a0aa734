// SPDX-License-Identifier: MIT
#include "light/shadow_layout.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/log.h"
#include "scene/gpu_lights.h"
#include "shared/rect_points.h"

namespace conelight::light {
namespace {

// The nearest thing that casts a shadow, as a fraction of the scene's diagonal. Reversed float depth has the
// same relative precision for any value, so it is only bounded by what must not vanish.
constexpr float kNearFraction = 1e-5f;

constexpr int kRectGuard = 2;  // lib/shadow.glsl: filter radius 0 and the move, each one texel

struct Axes {
    glm::vec3 u, v, forward;
};

// Sides of a cube in the order of lib/shadow.glsl's cubeSide, in the frame (x, y, z).
Axes cubeSide(int side, const glm::vec3& x, const glm::vec3& y, const glm::vec3& z) {
    const std::array<glm::vec3, 3> axes{x, y, z};
    const auto axis = static_cast<std::size_t>(side / 2);
    return {axes[(axis + 1) % 3], axes[(axis + 2) % 3], (side & 1) != 0 ? -axes[axis] : axes[axis]};
}

// Rows of a matrix that acts on world points: row_i . (p - origin) + constant_i.
glm::mat4 rows(const glm::vec3& origin, const std::array<glm::vec4, 4>& rowsAndConstants) {
    glm::mat4 m(0.0f);
    for (int i = 0; i < 4; ++i) {
        const glm::vec4& row = rowsAndConstants[static_cast<std::size_t>(i)];
        for (int c = 0; c < 3; ++c) m[c][i] = row[c];
        m[3][i] = row.w - glm::dot(glm::vec3(row), origin);
    }
    return m;
}

// A perspective map: the edge of a texel at distance 1, texels, and the texel in v that the axis meets.
struct Perspective {
    float texel;
    int width, height;
    float middleV;
};

// Reversed depth near / distance.
ShadowView perspectiveView(const glm::vec3& origin, const Axes& axes, float nearDistance,
                           const Perspective& map) {
    const auto [texel, width, height, middleV] = map;
    const float su = 2.0f / (texel * static_cast<float>(width));
    const float sv = 2.0f / (texel * static_cast<float>(height));
    const float shiftV = 2.0f * middleV / static_cast<float>(height) - 1.0f;
    ShadowView view{};
    view.clipFromWorld =
        rows(origin, {glm::vec4(axes.u * su, 0), glm::vec4(axes.v * sv + axes.forward * shiftV, 0),
                      glm::vec4(0, 0, 0, nearDistance), glm::vec4(axes.forward, 0)});
    view.slopeUnit = {0, texel};
    view.surfaces = true;
    view.width = width;
    view.height = height;
    return view;
}

// Places a view in tile `tile` of an array whose layers are cut into n x n tiles.
void place(ShadowView& view, int tile, int n, int layerSize) {
    const int size = layerSize / n;
    view.layer = tile / (n * n);
    view.x = (tile % n) * size;
    view.y = (tile / n % n) * size;
}

// Lays out the maps of a scene's lights and fills in the lights' shadow fields.
class Layouter {
  public:
    // `first`: bounds that do not change when something moves, for the near distance.
    Layouter(const Aabb& bounds, const Aabb& first, const LightSettings& settings, int size)
        : bounds_(bounds),
          aim_(first.empty() ? bounds.center() : first.center()),
          size_(size),
          guard_(guardTexels(settings.shadowFilter, size_)),
          near_(std::max(kNearFraction * glm::length(first.extent()), 1e-12f)) {}

    void add(std::vector<gpu::Light>& lights) {
        // Kinds one after the other, each from a new layer on: tiles of a kind have consecutive numbers.
        // Rectangles last: their layers have no surfaces.
        for (const std::uint32_t kind : {LIGHT_SPOT, LIGHT_DIRECTIONAL, LIGHT_POINT, LIGHT_RECT}) {
            if (kind == LIGHT_RECT) surfaceLayers_ = layers_;
            for (gpu::Light& light : lights)
                if (light.type == kind && (light.flags & LIGHT_CASTS_SHADOW) != 0) addLight(light);
        }
    }
    int size() const { return size_; }
    int layers() const { return layers_; }
    int surfaceLayers() const { return surfaceLayers_; }  // the first ones
    const std::vector<ShadowView>& views() const { return views_; }

  private:
    void addLight(gpu::Light& light) {
        light.shadowNear = near_;
        switch (light.type) {
            case LIGHT_POINT:
                addPoint(light);
                break;
            case LIGHT_SPOT:
                addSpot(light);
                break;
            case LIGHT_DIRECTIONAL:
                addDirectional(light);
                break;
            default:
                if ((light.flags & LIGHT_SPHERE) != 0)
                    addSphere(light);
                else
                    addRect(light);
                break;
        }
    }

    // Takes `count` tiles of layers cut in n x n; returns the number of the first.
    int take(int n, int count) {
        if (n != tilesPerEdge_) {
            tilesPerEdge_ = n;
            nextTile_ = layers_ * n * n;
        }
        const int first = nextTile_;
        nextTile_ += count;
        layers_ = (nextTile_ + n * n - 1) / (n * n);
        return first;
    }

    void addPoint(gpu::Light& light) {
        const int tile = size_ / 2;
        light.shadow = take(2, 6);
        // The square of the side, tangent 1, plus the guard on each edge.
        light.shadowTexel = 2.0f / static_cast<float>(tile - 2 * guard_);
        for (int side = 0; side < 6; ++side) {
            const Axes axes = cubeSide(side, {1, 0, 0}, {0, 1, 0}, {0, 0, 1});
            ShadowView view =
                perspectiveView(light.position, axes, near_,
                                {light.shadowTexel, tile, tile, 0.5f * static_cast<float>(tile)});
            place(view, light.shadow + side, 2, size_);
            views_.push_back(view);
        }
    }

    void addSpot(gpu::Light& light) {
        light.shadow = take(1, 1);
        const float tangent = std::tan(std::acos(light.cosOuter));
        light.shadowTexel = 2.0f * std::max(tangent, 1e-3f) / static_cast<float>(size_ - 2 * guard_);
        ShadowView view =
            perspectiveView(light.position, {light.halfU, light.halfV, light.direction}, near_,
                            {light.shadowTexel, size_, size_, 0.5f * static_cast<float>(size_)});
        place(view, light.shadow, 1, size_);
        views_.push_back(view);
    }

    // Fits the map to the scene's bounds.
    void addDirectional(gpu::Light& light) {
        light.shadow = take(1, 1);
        const ParallelMap map = parallelMapOfAll(light, bounds_, size_, guard_);
        light.position = map.position;
        light.shadowNear = map.shadowNear;
        light.shadowTexel = map.texel;
        ShadowView view = parallelView(light, map, size_);
        place(view, light.shadow, 1, size_);
        views_.push_back(view);
    }

    void addRect(gpu::Light& light) {
        const int tile = size_ / 4;
        const int samples = static_cast<int>(light.sampleGrid * light.sampleGrid);
        light.shadow = take(4, 3 * samples);
        const glm::vec3 u = glm::normalize(light.halfU);
        const glm::vec3 v = glm::cross(light.direction, u);
        const float reach = reachAboutAim(light, {u, v, light.direction});
        const bool aimed = reach < 1;
        if (aimed) {
            const Axes axes{u, v, light.direction};
            const glm::vec2 aside = tangentOf(aim_ - light.position, axes);
            light.shadowNear = glm::dot(aim_ - light.position, light.direction) / LIGHT_AIM_DISTANCE;
            light.cosInner = aside.x;
            light.cosOuter = aside.y;
            light.flags |= LIGHT_AIMED;
        }
        // A half side holds tangents 0 to 1 and a guard at both ends in half a tile.
        light.shadowTexel = reach / static_cast<float>(tile / 2 - 2 * kRectGuard);
        for (int sample = 0; sample < samples; ++sample) {
            const glm::vec3 point = rectSamplePoint(light, sample);
            for (int side = 0; side < 5; ++side) {
                const bool front = side == 4;
                Axes axes = cubeSide(side, u, v, light.direction);
                if (side == 2 || side == 3) std::swap(axes.u, axes.v);
                if (front && aimed) {
                    const glm::vec2 middle = tangentOf(aim_ - point, axes);
                    axes.u -= middle.x * axes.forward;
                    axes.v -= middle.y * axes.forward;
                }
                ShadowView view = perspectiveView(
                    point, axes, light.shadowNear,
                    {light.shadowTexel, tile, front ? tile : tile / 2,
                     front ? 0.5f * static_cast<float>(tile) : static_cast<float>(kRectGuard)});
                view.surfaces = false;
                place(view, light.shadow + 3 * sample + (front ? 0 : 1 + side / 2), 4, size_);
                if (!front && (side & 1) != 0) view.y += tile / 2;
                views_.push_back(view);
            }
        }
    }

    // All sides of a cube about each sample point, with texels as of the front maps of a rectangle.
    void addSphere(gpu::Light& light) {
        const int tile = size_ / 4;
        const int samples = static_cast<int>(light.sampleGrid * light.sampleGrid);
        light.shadow = take(4, 6 * samples);
        light.shadowTexel = 1.0f / static_cast<float>(tile / 2 - 2 * kRectGuard);
        for (int i = 0; i < 6 * samples; ++i) {
            const Axes axes = cubeSide(i % 6, {1, 0, 0}, {0, 1, 0}, {0, 0, 1});
            ShadowView view =
                perspectiveView(rectSamplePoint(light, i / 6), axes, light.shadowNear,
                                {light.shadowTexel, tile, tile, 0.5f * static_cast<float>(tile)});
            view.surfaces = false;
            // The points lie within the ball that shines.
            if ((light.flags & LIGHT_FROM_EMITTER) != 0) view.without = static_cast<int>(light.customFalloff);
            place(view, light.shadow + i, 4, size_);
            views_.push_back(view);
        }
    }

    static glm::vec2 tangentOf(const glm::vec3& d, const Axes& axes) {
        return glm::vec2(glm::dot(d, axes.u), glm::dot(d, axes.v)) / glm::dot(d, axes.forward);
    }

    // How far, as a tangent, the scene reaches from the middle of a front map that is aimed at it, in steps of 2^(1/8),
    // so that shadows do not crawl when the bounds change. 1: part of the scene is not in front of the rectangle.
    float reachAboutAim(const gpu::Light& light, const Axes& axes) const {
        if (bounds_.empty()) return 1;
        float reach = 1e-3f;
        for (int sample = 0; sample < static_cast<int>(light.sampleGrid * light.sampleGrid); ++sample) {
            const glm::vec3 point = rectSamplePoint(light, sample);
            const glm::vec2 middle = tangentOf(aim_ - point, axes);
            for (const glm::vec3& corner : bounds_.corners()) {
                const glm::vec2 tangent = tangentOf(corner - point, axes);
                const float distance = glm::dot(corner - point, axes.forward);
                const bool ahead = distance > 1e-3f * glm::dot(aim_ - point, axes.forward) && distance > 0;
                const glm::vec2 away = glm::abs(tangent - middle), aside = glm::abs(tangent);
                if (!ahead || std::max(aside.x, aside.y) > 0.99f) return 1;
                reach = std::max({reach, away.x, away.y});
            }
        }
        return std::min(std::exp2(std::ceil(8.0f * std::log2(1.01f * reach)) / 8.0f), 1.0f);
    }

    // C++ twins of lib/shadow.glsl's and lib/rect_points.glsl's.
    static glm::vec3 rectSamplePoint(const gpu::Light& light, int k) {
        const auto column = static_cast<std::uint32_t>(k);
        const std::uint32_t grid = light.sampleGrid, count = grid * grid;
        const float lift = 1e-3f * std::min(glm::length(light.halfU), glm::length(light.halfV));
        if ((light.flags & (LIGHT_DISK | LIGHT_SPHERE)) != 0) {
            const glm::vec3 at = roundPointPlace(column, count);
            const bool sphere = (light.flags & LIGHT_SPHERE) != 0;
            return light.position + at.x * light.halfU + at.y * light.halfV +
                   (sphere ? at.z * glm::length(light.halfU) : lift) * light.direction;
        }
        const std::uint32_t row =
            count == RECT_POINT_COUNT ? RECT_POINT_ROW(column) : column % grid * grid + column / grid;
        const glm::vec2 uv = (glm::vec2(column, row) + 0.5f) * (2.0f / static_cast<float>(count)) - 1.0f;
        return light.position + uv.x * light.halfU + uv.y * light.halfV + lift * light.direction;
    }
    static glm::vec3 roundPointPlace(std::uint32_t k, std::uint32_t count) {
        if (count == ROUND_POINT_COUNT) return glm::unpackSnorm4x8(gpu::kRoundPoints[k]);
        glm::vec3 t =
            glm::fract((static_cast<float>(k) + 0.5f) * glm::vec3(0.8191725f, 0.6710436f, 0.5497005f));
        t.y *= 6.2831853f;
        t.z *= 6.2831853f;
        const float r = std::sqrt(1 - t.x);
        return {r * std::cos(t.y), r * std::sin(t.y), std::sqrt(t.x) * std::cos(t.z)};
    }

    Aabb bounds_;
    glm::vec3 aim_;
    int size_, guard_;
    float near_;
    int tilesPerEdge_ = 1, nextTile_ = 0, layers_ = 0, surfaceLayers_ = 0;
    std::vector<ShadowView> views_;
};

constexpr int kSmallestLayer = 64;

// The largest edge of layers, in texels, that the memory holds; how many layers there are does not depend on it.
int sizeWithin(std::size_t bytes, const ShadowLayout& layout) {
    int size = layout.size;
    while (size > kSmallestLayer && layout.bytes(size) > bytes) size -= 8;
    return size;
}

// Points along an edge of a box's side, so that all sides that are seen from anywhere have about as many as one light: the
// largest area that a box shows is that of a box whose edges are the areas of its sides.
std::uint32_t gridOfSide(const gpu::Light& side, const std::vector<gpu::Light>& lights, std::uint32_t grid) {
    float squares = 0;
    for (const gpu::Light& other : lights)
        if ((other.flags & LIGHT_SIDE) != 0 && other.customFalloff == side.customFalloff)
            squares += 0.5f * scene::areaOf(other) * scene::areaOf(other);
    const float share = scene::areaOf(side) / std::max(std::sqrt(squares), 1e-30f);
    const auto part = static_cast<std::uint32_t>(std::lround(static_cast<float>(grid) * std::sqrt(share)));
    return std::min(std::max(part, 2u), grid);
}

}  // namespace

// The filter's reach, and two for rounding.
int guardTexels(int filterRadius, int size) { return std::min(filterRadius + 2, size / 8); }

float halfOfAll(const gpu::Light& light, const Aabb& bounds) {
    float half = 0;
    const glm::vec3 centre = bounds.center();
    for (const glm::vec3& p : bounds.corners())
        half = std::max(
            {half, std::abs(glm::dot(p - centre, light.halfU)), std::abs(glm::dot(p - centre, light.halfV))});
    return std::exp2(std::ceil(8.0f * std::log2(std::max(half, 1e-6f))) / 8.0f);
}

// Texel size and centre move in steps, so that shadows do not crawl when the bounds change: the centre by whole texels.
ParallelMap parallelMapOfAll(const gpu::Light& light, const Aabb& bounds, int size, int guard) {
    const Aabb box = bounds.empty() ? Aabb{glm::vec3(0), glm::vec3(0)} : bounds;
    const glm::vec3 centre = box.center();
    float nearest = 1e30f, farthest = -1e30f;
    for (const glm::vec3& p : box.corners()) {
        nearest = std::min(nearest, glm::dot(p - centre, light.direction));
        farthest = std::max(farthest, glm::dot(p - centre, light.direction));
    }
    // One more texel for the snapped centre.
    const float texel = 2.0f * halfOfAll(light, box) / static_cast<float>(size - 2 * guard - 2);
    const auto snapped = [&](const glm::vec3& axis) {
        return std::floor(glm::dot(centre, axis) / texel) * texel;
    };
    // One percent more on either side, for what rounding puts out of the bounds.
    const float range = std::max(farthest - nearest, 1e-6f) * 1.02f;
    const glm::vec3 position =
        light.halfU * snapped(light.halfU) + light.halfV * snapped(light.halfV) +
        light.direction * (glm::dot(centre, light.direction) + nearest - range * 0.01f);
    return {position, 1.0f / range, texel};
}

ShadowView parallelView(const gpu::Light& light, const ParallelMap& map, int size) {
    const float scale = 2.0f / (map.texel * static_cast<float>(size));
    ShadowView view{};
    view.clipFromWorld =
        rows(map.position, {glm::vec4(light.halfU * scale, 0), glm::vec4(light.halfV * scale, 0),
                            glm::vec4(-light.direction * map.shadowNear, 1), glm::vec4(0, 0, 0, 1)});
    view.slopeUnit = {map.shadowNear * map.texel, 0};
    view.surfaces = true;
    view.width = view.height = size;
    return view;
}

std::size_t ShadowLayout::bytes(int edge) const {
    constexpr std::size_t kDepthBytes = 4, kSurfaceBytes = 8;  // of a texel: light/shadow_maps.cpp
    const auto texels = static_cast<std::size_t>(edge) * static_cast<std::size_t>(edge);
    return texels * (kDepthBytes * static_cast<std::size_t>(layers) +
                     kSurfaceBytes * static_cast<std::size_t>(surfaceLayers));
}

ShadowLayout layOutShadows(const Aabb& bounds, const Aabb& firstBounds, const LightSettings& settings,
                           std::vector<gpu::Light>& lights) {
    const auto grid =
        static_cast<std::uint32_t>(std::lround(std::sqrt(static_cast<float>(settings.areaSamples))));
    for (gpu::Light& light : lights) {
        light.shadow = -1;
        light.flags &= ~LIGHT_AIMED;
        light.sampleGrid = std::max(grid, 1u);
        if ((light.flags & LIGHT_SIDE) != 0) light.sampleGrid = gridOfSide(light, lights, light.sampleGrid);
    }
    const auto laidOut = [&](int size) {
        Layouter layouter(bounds, firstBounds, settings, size);
        if (settings.shadowSize > 0) layouter.add(lights);
        return ShadowLayout{layouter.size(), layouter.layers(), layouter.surfaceLayers(), false,
                            layouter.views()};
    };
    const ShadowLayout asked = laidOut(std::max(settings.shadowSize / 8 * 8, kSmallestLayer));
    if (asked.layers > kMostShadowLayers)
        base::fail(
            ErrorKind::Runtime,
            "shadow maps: %td lights cast shadows and ask for %d layers; at most %d would be right: fewer "
            "lights that cast shadows, or light.shadow_size=0",
            std::count_if(lights.begin(), lights.end(), [](const auto& one) { return one.shadow >= 0; }),
            asked.layers, kMostShadowLayers);
    const int size = sizeWithin(kMostShadowBytes, asked);
    return size == asked.size ? asked : laidOut(size);
}

}  // namespace conelight::light

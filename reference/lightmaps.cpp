// SPDX-License-Identifier: MIT
// Points of a texel are spread over the part of it that its triangles cover. Each is the start of a path, as if it were
// white and diffuse. What lies under something that touches it is left out, and does not darken what is beside it. Texels without
// light of their own take that of their neighbours, then seams are stitched.
#include "reference/lightmaps.h"

#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "base/log.h"
#include "reference/arriving_light.h"
#include "reference/lightmap_seams.h"
#include "reference/lightmap_texels.h"
#include "reference/lights.h"
#include "reference/materials.h"
#include "reference/radiosity_parallel.h"

namespace conelight::reference {
namespace {

// A ray that meets something within this share of a texel above its start comes from a point that is covered.
constexpr float kTouching = 0.01f;
// Texels of which more points than this are covered, or more rays than this meet backs, have no light of their own.
constexpr float kMostCovered = 0.75f, kMostBacks = 0.5f;

struct TexelLight {
    glm::vec3 irradiance{0}, direct{0}, direction{0};
    bool own = false;
};

PathTracerSettings tracerSettings(const LightmapSettings& settings) {
    PathTracerSettings result;
    result.samplesPerPixel = settings.samples;
    result.bounces = settings.bounces;
    result.seed = settings.seed;
    result.smallLamps = false;  // hosts know of none
    return result;
}

class Bake {
  public:
    Bake(const Scene& scene, const LightmapLayout& layout, const LightmapSettings& settings)
        : scene_(scene),
          light_(scene, {settings.samples, settings.bounces, settings.seed}),
          paths_(scene, light_.rays(), tracerSettings(settings)),
          lights_(scene, DirectEmitters{true, false}, true),
          settings_(settings),
          touching_(kTouching * layout.texel) {}

    // `key`: of the texel.
    TexelLight texel(const TexelCover& cover, std::uint32_t instance, std::size_t texel,
                     std::uint32_t key) const {
        const int bits = std::bit_width(static_cast<unsigned>(settings_.samples - 1));
        const std::uint32_t seed = combineBits(mixBits(settings_.seed), key);
        Sum sum;
        PathSample path;
        for (int i = 0; i < settings_.samples; ++i) {
            Sampler sampler(seed, static_cast<std::uint32_t>(i), bits);
            RayHit point;
            point.instance = instance;
            cover.pointOf(texel, sampler.next2(), point.triangle, point.barycentric);
            if (place(point)) addPoint(point, sampler, path, sum);
        }
        TexelLight result;
        const auto all = static_cast<float>(settings_.samples);
        result.own = sum.counted > (1 - kMostCovered) * all && sum.backs <= kMostBacks * sum.counted;
        if (!result.own) return result;
        result.irradiance = sum.irradiance / sum.counted;
        result.direct = sum.direct / sum.counted;
        if (sum.weight > 0) result.direction = sum.direction / sum.weight;
        return result;
    }

  private:
    struct Sum {
        glm::vec3 irradiance{0}, direct{0}, direction{0};
        float weight = 0, counted = 0, backs = 0;
        void point(const glm::vec3& light, const glm::vec3& from) {
            direction += luminance(light) * from;
            weight += luminance(light);
        }
    };

    // The triangle's front, in the world; false for one without area.
    bool place(RayHit& point) const {
        const Instance& instance = scene_.instances[point.instance];
        const Mesh& mesh = scene_.meshes[static_cast<std::size_t>(instance.mesh)];
        std::array<glm::vec3, 3> p;
        for (std::size_t i = 0; i < 3; ++i)
            p[i] = glm::vec3(
                instance.worldFromObject *
                glm::vec4(mesh.positions[mesh.indices[3 * static_cast<std::size_t>(point.triangle) + i]], 1));
        const glm::vec3 cross = glm::cross(p[1] - p[0], p[2] - p[0]);
        const float length = glm::length(cross);
        if (!(length > 0)) return false;
        const bool mirrored = glm::determinant(glm::mat3(instance.worldFromObject)) < 0;
        point.geometricNormal = (mirrored ? -1.0f : 1.0f) * cross / length;
        return true;
    }

    // White, diffuse, without gloss.
    static Surface whiteAt(const SurfacePoint& at, const glm::vec3& up) {
        static const Material kWhiteDiffuse;
        Surface surface;
        surface.position = at.position;
        surface.geometricNormal = up;
        surface.shadingNormal = at.normal;
        surface.material = &kWhiteDiffuse;
        surface.baseColor = glm::vec3(1);
        surface.dielectricF0 = glm::vec3(0);
        return surface;
    }

    void addPoint(const RayHit& point, Sampler& sampler, PathSample& path, Sum& sum) const {
        SurfacePoint at = pointAt(scene_, point);
        if (glm::dot(at.normal, point.geometricNormal) < 0) at.normal = -at.normal;
        // One ray tells whether the point is covered, or in a solid; from where light comes, if that is asked for.
        const glm::vec2 u = sampler.next2();
        const float r = std::sqrt(u.x), phi = 2 * glm::pi<float>() * u.y;
        const glm::vec3 direction = Frame(at.normal).toWorld(
            {r * std::cos(phi), r * std::sin(phi), std::sqrt(std::max(0.0f, 1 - u.x))});
        const glm::vec3 origin = RayScene::offsetOrigin(at.position, point.geometricNormal);
        const float rise = glm::dot(direction, point.geometricNormal);
        RayHit hit;
        const bool above = rise > 0;
        if (above) {
            const Arriving met = light_.meet(origin, direction, hit);
            if (met.distance * rise < touching_) return;
            sum.backs += met.back ? 1.0f : 0.0f;
        }
        sum.counted += 1;
        if (settings_.directions) {
            if (above)
                sum.point(light_.arriving(origin, direction, sampler, path).radiance * glm::pi<float>(),
                          direction);
            if (settings_.direct) addLightDirections(at, point, sampler, sum);
        }
        path.clear();
        paths_.reflectedAt(whiteAt(at, point.geometricNormal), point.instance, sampler, path);
        if (!path.finite()) return;
        sum.irradiance += glm::pi<float>() * path.diffuse;
        if (settings_.direct) sum.direct += glm::pi<float>() * path.direct;
    }

    // Of one light, or of each where they are few.
    void addLightDirections(const SurfacePoint& at, const RayHit& point, Sampler& sampler, Sum& sum) const {
        LightTable::Choice choice;
        lights_.choose(at.position, at.normal, true, choice);
        float number = sampler.next2().x;
        const std::size_t one = choice.each ? 0 : lights_.groupOf(choice, number);
        const std::size_t end = choice.each ? lights_.groupCount() : std::min(one + 1, lights_.groupCount());
        for (std::size_t group = one; group < end; ++group) {
            LightSample light;
            if (!lights_.sample(choice, group, at.position, number, sampler.next2(), light) || !light.direct)
                continue;
            const float cosine = glm::dot(at.normal, light.toLight);
            if (cosine > 0)
                sum.point(seen(at, point, light) * light.radiance * (cosine / light.density), light.toLight);
        }
    }

    // What is left of a light on its way.
    glm::vec3 seen(const SurfacePoint& at, const RayHit& point, const LightSample& light) const {
        if (!light.castsShadow) return glm::vec3(1);
        if (!(glm::dot(point.geometricNormal, light.toLight) > 0)) return glm::vec3(0);
        Ray ray{.origin = RayScene::offsetOrigin(at.position, point.geometricNormal),
                .direction = light.toLight};
        if (std::isfinite(light.distance)) {
            const glm::vec3 way = light.target - ray.origin;
            const float distance = glm::length(way);
            if (distance > 0) ray.direction = way / distance;
            ray.tMax = distance * kRayEnd;
        }
        return light_.rays().transmittance(RayKind::Shadow, ray, !light.extended);
    }

    const Scene& scene_;
    ArrivingLight light_;
    PathIntegrator paths_;
    LightTable lights_;
    LightmapSettings settings_;
    float touching_;
};

// `has`: by texel, whether it has light. Those without take the mean of their neighbours: covered ones wherever they are,
// others up to two away.
void fill(Lightmap& map, std::vector<std::uint8_t>& has, const std::vector<std::uint8_t>& covered) {
    constexpr int kBetween = 2;
    const auto index = [&](int x, int y) {
        return static_cast<std::size_t>(x) +
               static_cast<std::size_t>(y) * static_cast<std::size_t>(map.size.x);
    };
    std::vector<glm::ivec2> left;
    for (int y = 0; y < map.size.y; ++y)
        for (int x = 0; x < map.size.x; ++x)
            if (has[index(x, y)] == 0) left.emplace_back(x, y);
    for (int round = 0; !left.empty(); ++round) {
        std::vector<glm::ivec2> filled, waiting;
        for (const glm::ivec2& texel : left) {
            const std::size_t at = index(texel.x, texel.y);
            if (covered[at] == 0 && round >= kBetween) continue;
            glm::vec3 irradiance(0), direct(0), direction(0);
            float count = 0;
            const glm::ivec2 low = glm::max(texel - 1, glm::ivec2(0)),
                             high = glm::min(texel + 1, map.size - 1);
            for (int j = low.y; j <= high.y; ++j)
                for (int i = low.x; i <= high.x; ++i) {
                    const std::size_t beside = index(i, j);
                    if (has[beside] == 0) continue;
                    irradiance += map.irradiance[beside];
                    direction += map.direction[beside];
                    if (!map.direct.empty()) direct += map.direct[beside];
                    count += 1;
                }
            (count > 0 ? filled : waiting).push_back(texel);
            if (!(count > 0)) continue;
            map.irradiance[at] = irradiance / count;
            map.direction[at] = direction / count;
            if (!map.direct.empty()) map.direct[at] = direct / count;
        }
        for (const glm::ivec2& texel : filled) has[index(texel.x, texel.y)] = 1;
        if (filled.empty() && round >= kBetween) return;
        left = std::move(waiting);
    }
}

struct Item {
    std::uint32_t instance = 0;
    std::uint32_t texel = 0;  // of the mesh's rectangle
};

std::vector<Item> itemsOf(const Scene& scene, const LightmapLayout& layout,
                          const std::vector<TexelCover>& covers) {
    std::vector<Item> items;
    for (std::size_t i = 0; i < layout.places.size(); ++i) {
        if (layout.places[i].map < 0) continue;
        for (const std::uint32_t texel : covers[static_cast<std::size_t>(scene.instances[i].mesh)].texels())
            items.push_back({static_cast<std::uint32_t>(i), texel});
    }
    return items;
}

// Seams of the instances of a map, in its texels.
std::vector<Seam> seamsOf(const Scene& scene, const LightmapLayout& layout, int map) {
    std::vector<Seam> seams;
    for (std::size_t i = 0; i < layout.places.size(); ++i) {
        const LightmapPlace& place = layout.places[i];
        if (place.map != map) continue;
        const glm::vec2 offset(place.offset);
        for (Seam seam : layout.meshes[static_cast<std::size_t>(scene.instances[i].mesh)].seams) {
            for (glm::vec2& end : seam.one) end += offset;
            for (glm::vec2& end : seam.other) end += offset;
            seams.push_back(seam);
        }
    }
    return seams;
}

std::vector<Lightmap> mapsOf(const Scene& scene, const LightmapLayout& layout, bool direct,
                             const std::vector<Item>& items, const std::vector<TexelLight>& light) {
    std::vector<Lightmap> maps;
    std::vector<std::vector<std::uint8_t>> has, covered;
    for (const glm::ivec2& size : layout.sizes) {
        const std::size_t count = static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y);
        maps.push_back({size, std::vector<glm::vec3>(count), std::vector<glm::vec3>(direct ? count : 0),
                        std::vector<glm::vec3>(count)});
        has.emplace_back(count);
        covered.emplace_back(count);
    }
    for (std::size_t k = 0; k < items.size(); ++k) {
        const LightmapPlace& place = layout.places[items[k].instance];
        const auto map = static_cast<std::size_t>(place.map);
        const auto mesh = static_cast<std::size_t>(scene.instances[items[k].instance].mesh);
        const int texel = static_cast<int>(items[k].texel), width = layout.meshes[mesh].size.x;
        const glm::ivec2 at = place.offset + glm::ivec2(texel % width, texel / width);
        const auto index = static_cast<std::size_t>(at.x + maps[map].size.x * at.y);
        maps[map].irradiance[index] = light[k].irradiance;
        maps[map].direction[index] = light[k].direction;
        if (direct) maps[map].direct[index] = light[k].direct;
        has[map][index] = light[k].own ? 1 : 0;
        covered[map][index] = 1;
    }
    for (std::size_t m = 0; m < maps.size(); ++m) {
        fill(maps[m], has[m], covered[m]);
        const std::vector<Seam> seams = seamsOf(scene, layout, static_cast<int>(m));
        stitchSeams(maps[m].irradiance, maps[m].size, seams);
        if (direct) stitchSeams(maps[m].direct, maps[m].size, seams);
    }
    return maps;
}

}  // namespace

std::vector<Lightmap> bakeLightmaps(const Scene& scene, const LightmapLayout& layout,
                                    const LightmapSettings& settings,
                                    const std::function<bool(double)>& onProgress, PartialBake* partial) {
    if (settings.samples < 16 || settings.samples > (1 << 20) || settings.bounces < -1 ||
        settings.bounces == 0 || settings.threads < 0)
        base::fail(ErrorKind::Usage,
                   "light maps: %d samples, %d bounces, %d threads; right would be 16 to 1048576, "
                   "-1 or 1 and more, 0 or more",
                   settings.samples, settings.bounces, settings.threads);
    const Bake bake(scene, layout, settings);
    std::vector<TexelCover> covers;
    for (const ChartedMesh& mesh : layout.meshes) covers.emplace_back(mesh);
    const std::vector<Item> items = itemsOf(scene, layout, covers);
    std::vector<TexelLight> light(items.size());
    if (partial != nullptr) partial->prepare(items.size(), sizeof(TexelLight));
    const auto body = [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) {
            if (partial != nullptr && partial->take(k, light[k])) continue;
            light[k] = bake.texel(covers[static_cast<std::size_t>(scene.instances[items[k].instance].mesh)],
                                  items[k].instance, items[k].texel, static_cast<std::uint32_t>(k));
            if (partial != nullptr) partial->put(k, light[k]);
        }
    };
    if (!parallelFor(items.size(), settings.threads, body, onProgress)) return {};
    return mapsOf(scene, layout, settings.direct, items, light);
}

}  // namespace conelight::reference

// SPDX-License-Identifier: MIT
// Scene -> patches -> radiosity of the patches -> irradiance at the vertices of a finer mesh -> lit scene.
//
// Radiosity equation (Goral et al. 1984, "Modeling the Interaction of Light Between Diffuse Surfaces") by
// gathering: form factors of a patch are counted on cosine-distributed rays (Malley 1988, "A Shading Method
// for Computer Generated Images"; they add up to at most 1 by construction), kept, and iterated by Jacobi's
// method, one bounce each. A second pass gathers at the vertices themselves (Reichert 1992, "A Two-Pass
// Radiosity Method Driven by Lights and Viewer Position"), with the lights by analytic form factors, and
// halves elements where what arrives is not linear (Cohen, Greenberg, Immel and Brock 1986, "An Efficient
// Radiosity Approach for Realistic Image Synthesis"). Vertices that other objects stand on take the light of
// their neighbours, so that no darkness leaks from below.
//
// Limits: diffuse only; shadow edges are as sharp as the smallest elements; emission textures are held by
// vertices. A scene of many more triangles than patches is not simplified.
#include "reference/radiosity.h"

#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <thread>

#include "base/clock.h"
#include "base/log.h"
#include "reference/layers.h"
#include "reference/materials.h"
#include "reference/radiosity_gather.h"
#include "reference/radiosity_mesh.h"
#include "reference/radiosity_parallel.h"
#include "reference/radiosity_result.h"
#include "reference/sampler.h"
#include "reference/surface.h"
#include "scene/surroundings.h"

namespace conelight::reference {
namespace {

// Memory of the form factors: 4 bytes a ray, 256 MB; larger scenes get fewer rays per patch.
constexpr std::size_t kMostLinks = std::size_t{1} << 26;
constexpr std::size_t kMostVertices = std::size_t{1} << 22;  // 4 million; splitting stops there
constexpr std::size_t kMostPatches = std::size_t{1} << 22;
// Receivers stand inside an element that has the vertex as its corner, by this part of the way to its centre:
// exactly on an edge that touches another surface, visibility is undefined.
constexpr double kInset = 0.02;
constexpr std::uint32_t kSky = ~0u, kDark = ~0u - 1;  // what a ray met, if no patch

// Inside of another object there is little to see but backs.
bool isBuried(std::size_t dark, std::size_t sent) { return 4 * dark > 3 * sent; }

struct Patch {
    std::uint32_t element = 0;
    double area = 0;
    glm::vec3 albedo{0};
    glm::vec3 emission{0};     // that rays find: not of area lights
    glm::vec3 direct{0};       // irradiance straight from lights
    glm::vec3 fromPicture{0};  // radiance of the environment's picture, over all rays that met nothing
    glm::vec3 radiance{0};
    bool buried = false;
    std::vector<std::uint32_t> neighbours;  // of a buried patch: those that are not
};

struct VertexLight {
    glm::vec3 irradiance{0};
    bool done = false;
    bool buried = false;
    float deviation = 0;  // from the mean of its parents, relative
};

class Baker {
  public:
    // What vertices hold: the light that patches solve for, without or with what comes straight from lights.
    enum class Vertices { All, Indirect };

    Baker(const Scene& scene, const RadiositySettings& settings, Vertices vertices,
          const std::function<bool(const RadiosityProgress&)>& onProgress)
        : scene_(scene),
          settings_(settings),
          vertices_(vertices),
          onProgress_(onProgress),
          surroundings_(scene),
          rays_(scene),
          lights_(scene, vertices == Vertices::All || settings.emissiveQuads),
          mesh_(scene),
          threads_(settings.threads > 0
                       ? settings.threads
                       : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()))),
          start_(base::wallMs()) {}

    // Irradiance of the vertices of mesh().
    std::vector<glm::vec3> bake(RadiosityStats& stats);
    const ElementMesh& mesh() const { return mesh_; }

  private:
    void makePatches();
    void describe(Patch& patch) const;
    void linkPatches();
    void lightBuriedPatches(std::vector<glm::vec3>& radiance) const;
    void solve();
    void gatherVertices();
    VertexLight gatherAt(std::uint32_t vertex, std::uint64_t& count) const;
    bool splitElements();
    void fillBuried();
    Receiver receiverAt(std::uint32_t element, const glm::dvec3& position, const glm::dvec2& place) const;
    // What a ray meets: a patch, kSky or kDark.
    std::uint32_t meets(const Receiver& at, const glm::vec3& direction) const;
    bool wanted(int bounce) const { return settings_.bounces < 0 || bounce <= settings_.bounces; }
    bool run(std::size_t count, const std::function<void(std::size_t, std::size_t)>& body);
    glm::vec3 given(std::uint32_t met) const {
        if (met == kSky) return scene_.sky;
        return met == kDark ? glm::vec3(0) : patches_[met].radiance + patches_[met].emission;
    }

    const Scene& scene_;
    RadiositySettings settings_;
    Vertices vertices_;
    const std::function<bool(const RadiosityProgress&)>& onProgress_;
    scene::Surroundings surroundings_;
    RayScene rays_;
    RadiosityLights lights_;
    ElementMesh mesh_;
    int threads_;
    double start_;
    double residual_ = 1;
    int iterations_ = 0;
    bool goesOn_ = true;
    std::vector<Patch> patches_;
    std::vector<std::uint32_t> links_;  // raysPerPatch_ of each patch
    std::size_t raysPerPatch_ = 0;
    std::vector<VertexLight> light_;
    float meanIrradiance_ = 0;
    std::atomic<std::uint64_t> rayCount_{0};
};

bool Baker::run(std::size_t count, const std::function<void(std::size_t, std::size_t)>& body) {
    if (!goesOn_ || count == 0) return goesOn_;
    goesOn_ = parallelFor(count, threads_, body, [&](double done) {
        if (!onProgress_) return true;
        const double seconds = (base::wallMs() - start_) * 1e-3;
        return onProgress_({done, residual_, done > 0.05 ? seconds * (1 - done) / done : -1});
    });
    return goesOn_;
}

Receiver Baker::receiverAt(std::uint32_t element, const glm::dvec3& position, const glm::dvec2& place) const {
    const RayHit hit = mesh_.hitAt(element, place);
    Ray ray;
    ray.direction =
        mesh_.surfaces[mesh_.surfaceOf(element)].back ? hit.geometricNormal : -hit.geometricNormal;
    const Surface surface = surfaceAt(scene_, ray, hit);
    return {glm::vec3(position), surface.geometricNormal, surface.shadingNormal,
            scene_.instances[hit.instance].castsShadow};
}

std::uint32_t Baker::meets(const Receiver& at, const glm::vec3& direction) const {
    Ray ray;
    ray.origin = RayScene::offsetOrigin(at.position, at.geometricNormal);
    ray.direction = direction;
    RayHit hit;
    if (!rays_.intersect(RayKind::Bounce, ray, hit)) return kSky;
    const std::uint32_t patch = mesh_.patchAt(hit, glm::dot(hit.geometricNormal, direction) < 0);
    return patch == kNoElement ? kDark : patch;
}

void Baker::makePatches() {
    const glm::vec3 extent = scene_.bounds().extent();
    double size = static_cast<double>(settings_.patchSize);
    if (!(size > 0)) size = static_cast<double>(std::max({extent.x, extent.y, extent.z})) / 16.0;
    for (std::uint32_t e = 0; e < mesh_.elements.size() && mesh_.elements.size() < 2 * kMostPatches; ++e)
        if (mesh_.isLeaf(e) && mesh_.longestEdge(e) > size) mesh_.split(e);
    for (std::uint32_t e = 0; e < mesh_.elements.size(); ++e) {
        if (!mesh_.isLeaf(e)) continue;
        mesh_.elements[e].patch = static_cast<std::uint32_t>(patches_.size());
        Patch patch;
        patch.element = e;
        patch.area = mesh_.area(e);
        patches_.push_back(std::move(patch));
    }
}

// Textures are averaged over the corners of the four quarters' centres.
void Baker::describe(Patch& patch) const {
    const Element& element = mesh_.elements[patch.element];
    const glm::dvec2 center = mesh_.centerBarycentric(patch.element);
    for (int i = 0; i < 4; ++i) {
        const glm::dvec2 place =
            i == 3 ? center : 0.5 * (center + element.barycentric[static_cast<std::size_t>(i)]);
        const RayHit hit = mesh_.hitAt(patch.element, place);
        if (!coversAt(scene_, hit.instance, hit.triangle, hit.barycentric)) continue;
        Ray ray;
        ray.direction =
            mesh_.surfaces[mesh_.surfaceOf(patch.element)].back ? hit.geometricNormal : -hit.geometricNormal;
        const Surface surface = surfaceAt(scene_, ray, hit);
        patch.albedo += 0.25f * evenAlbedoOfLayers(surface, diffusePart(surface) * surface.baseColor);
        if (!lights_.isAreaLight(hit.instance)) patch.emission += 0.25f * surface.emission;
    }
}

void Baker::linkPatches() {
    raysPerPatch_ = static_cast<std::size_t>(settings_.patchRays);
    while (raysPerPatch_ > 16 && raysPerPatch_ * patches_.size() > kMostLinks) raysPerPatch_ /= 2;
    links_.assign(raysPerPatch_ * patches_.size(), kDark);
    run(patches_.size(), [&](std::size_t begin, std::size_t end) {
        std::uint64_t count = 0;
        for (std::size_t i = begin; i < end; ++i) {
            Patch& patch = patches_[i];
            describe(patch);
            const Receiver at = receiverAt(patch.element, mesh_.center(patch.element),
                                           mesh_.centerBarycentric(patch.element));
            patch.direct = lights_.irradiance(rays_, at, settings_.visibilityRays, {true, wanted(1)}, count);
            // A pattern of its own for each patch: errors of neighbours do not add up.
            const std::uint32_t key = combineBits(mixBits(settings_.seed), static_cast<std::uint32_t>(i));
            const glm::vec2 shift(static_cast<float>(key >> 8) * 0x1p-24f,
                                  static_cast<float>(mixBits(key) >> 8) * 0x1p-24f);
            std::size_t sent = 0, dark = 0;
            for (std::uint32_t n = 0; n < raysPerPatch_; ++n) {
                const glm::vec3 direction =
                    cosineDirection(at.shadingNormal, n, static_cast<std::uint32_t>(raysPerPatch_), shift);
                if (!(glm::dot(direction, at.geometricNormal) > 0)) continue;
                const std::uint32_t met = meets(at, direction);
                links_[i * raysPerPatch_ + n] = met;
                if (met == kSky) patch.fromPicture += surroundings_.pictureRadiance(direction);
                ++sent;
                dark += links_[i * raysPerPatch_ + n] == kDark ? 1 : 0;
            }
            count += sent;
            patch.buried = isBuried(dark, sent);
        }
        rayCount_ += count;
    });
    // What sees a patch whose middle is below another object sees the part of it that sticks out.
    std::vector<std::vector<std::uint32_t>> open(mesh_.vertices.size());
    for (std::uint32_t i = 0; i < patches_.size(); ++i)
        if (!patches_[i].buried)
            for (const std::uint32_t v : mesh_.elements[patches_[i].element].vertices) open[v].push_back(i);
    for (Patch& patch : patches_)
        if (patch.buried)
            for (const std::uint32_t v : mesh_.elements[patch.element].vertices)
                patch.neighbours.insert(patch.neighbours.end(), open[v].begin(), open[v].end());
}

void Baker::lightBuriedPatches(std::vector<glm::vec3>& radiance) const {
    for (std::size_t i = 0; i < patches_.size(); ++i) {
        if (patches_[i].neighbours.empty()) continue;
        glm::vec3 sum(0);
        for (const std::uint32_t n : patches_[i].neighbours) sum += radiance[n];
        radiance[i] = sum / static_cast<float>(patches_[i].neighbours.size());
    }
}

// One bounce per iteration, until the light settles or the bounces that are asked for are there: the last one
// is gathered by the vertices.
void Baker::solve() {
    const float perRay = 1.0f / static_cast<float>(raysPerPatch_);
    std::vector<glm::vec3> next;
    for (const Patch& patch : patches_) next.push_back(patch.albedo * patch.direct / glm::pi<float>());
    lightBuriedPatches(next);
    for (std::size_t i = 0; i < patches_.size(); ++i) patches_[i].radiance = next[i];
    constexpr int kMostIterations = 10000;  // albedo 0.999 settles within
    for (iterations_ = 0; iterations_ < kMostIterations && wanted(iterations_ + 2); ++iterations_) {
        if (!run(patches_.size(), [&](std::size_t begin, std::size_t end) {
                for (std::size_t i = begin; i < end; ++i) {
                    glm::vec3 sum = patches_[i].fromPicture;
                    for (std::size_t n = 0; n < raysPerPatch_; ++n)
                        sum += given(links_[i * raysPerPatch_ + n]);
                    next[i] = patches_[i].albedo * (patches_[i].direct / glm::pi<float>() + sum * perRay);
                }
            }))
            return;
        lightBuriedPatches(next);
        double change = 0, all = 0;
        for (std::size_t i = 0; i < patches_.size(); ++i) {
            change +=
                patches_[i].area * std::fabs(static_cast<double>(luminance(next[i] - patches_[i].radiance)));
            all += patches_[i].area * static_cast<double>(luminance(next[i]));
            patches_[i].radiance = next[i];
        }
        const double before = residual_;
        residual_ = all > 0 ? change / all : 0;
        // What is still to come is a geometric series.
        const double ratio = std::clamp(residual_ / std::max(before, 1e-30), 0.0, 0.999);
        if (residual_ == 0 ||
            (iterations_ > 0 && residual_ / (1 - ratio) < static_cast<double>(settings_.residual)))
            return;
    }
}

VertexLight Baker::gatherAt(std::uint32_t vertex, std::uint64_t& count) const {
    const ElementVertex& v = mesh_.vertices[vertex];
    const Element& element = mesh_.elements[v.element];
    VertexLight result;
    result.done = true;
    std::size_t corner = 0;
    while (corner < 2 && element.vertices[corner] != vertex) ++corner;
    const Receiver at =
        receiverAt(v.element, glm::mix(v.position, mesh_.center(v.element), kInset),
                   glm::mix(element.barycentric[corner], mesh_.centerBarycentric(v.element), kInset));
    const RadiosityLights::Kinds kinds{vertices_ == Vertices::All, wanted(1)};
    result.irradiance = lights_.irradiance(rays_, at, settings_.visibilityRays, kinds, count);
    // The same pattern for all vertices: neighbours err alike, which is smooth.
    const auto rays = static_cast<std::uint32_t>(wanted(1) ? settings_.gatherRays : 16);
    const std::uint32_t key = mixBits(settings_.seed);
    const glm::vec2 shift(static_cast<float>(key >> 8) * 0x1p-24f,
                          static_cast<float>(mixBits(key) >> 8) * 0x1p-24f);
    glm::vec3 sum(0);
    std::uint32_t dark = 0, sent = 0;
    for (std::uint32_t n = 0; n < rays; ++n) {
        const glm::vec3 direction = cosineDirection(at.shadingNormal, n, rays, shift);
        if (!(glm::dot(direction, at.geometricNormal) > 0)) continue;
        const std::uint32_t met = meets(at, direction);
        ++sent;
        if (met == kDark) ++dark;
        sum += given(met);
        if (met == kSky) sum += surroundings_.pictureRadiance(direction);
    }
    count += sent;
    if (wanted(1)) result.irradiance += sum * (glm::pi<float>() / static_cast<float>(rays));
    result.buried = isBuried(dark, sent);
    return result;
}

void Baker::gatherVertices() {
    const std::size_t first = light_.size();
    light_.resize(mesh_.vertices.size());
    run(light_.size() - first, [&](std::size_t begin, std::size_t end) {
        std::uint64_t count = 0;
        for (std::size_t i = first + begin; i < first + end; ++i)
            light_[i] = gatherAt(static_cast<std::uint32_t>(i), count);
        rayCount_ += count;
    });
    if (first == 0) {
        double sum = 0;
        for (const VertexLight& l : light_) sum += static_cast<double>(luminance(l.irradiance));
        meanIrradiance_ =
            static_cast<float>(sum / static_cast<double>(std::max<std::size_t>(light_.size(), 1)));
    }
    // A quarter of the mean keeps black corners from counting much.
    for (std::size_t i = first; i < light_.size(); ++i) {
        const ElementVertex& v = mesh_.vertices[i];
        if (v.parentA == kNoElement) continue;
        const VertexLight &a = light_[v.parentA], &b = light_[v.parentB];
        const float linear = 0.5f * (luminance(a.irradiance) + luminance(b.irradiance));
        const float own = luminance(light_[i].irradiance);
        light_[i].deviation =
            std::fabs(own - linear) / std::max({own, linear, 0.25f * meanIrradiance_, 1e-30f});
        if (a.buried != b.buried || a.buried != light_[i].buried) light_[i].deviation = 1;
        if (a.buried && b.buried && light_[i].buried) light_[i].deviation = 0;
    }
}

bool Baker::splitElements() {
    const int most = 2 * settings_.maxSubdivision;  // an edge is halved by two bisections
    std::vector<std::uint32_t> chosen;
    for (std::uint32_t e = 0; e < mesh_.elements.size(); ++e) {
        if (!mesh_.isLeaf(e) || mesh_.elements[e].depth >= most) continue;
        float low = 3e38f, high = 0, deviation = 0;
        int buried = 0;
        for (const std::uint32_t v : mesh_.elements[e].vertices) {
            low = std::min(low, luminance(light_[v].irradiance));
            high = std::max(high, luminance(light_[v].irradiance));
            deviation = std::max(deviation, light_[v].deviation);
            buried += light_[v].buried ? 1 : 0;
        }
        if (buried == 3) continue;
        // Corners that differ a lot may have an edge between them that no middle has met yet.
        constexpr float kContrast = 8;  // times the deviation; by eye
        const float contrast = (high - low) / std::max({high, 0.25f * meanIrradiance_, 1e-30f});
        if (deviation > settings_.subdivideError || contrast > kContrast * settings_.subdivideError ||
            buried > 0)
            chosen.push_back(e);
    }
    for (const std::uint32_t e : chosen) {
        if (mesh_.vertices.size() >= kMostVertices) break;
        mesh_.split(e);
    }
    return mesh_.vertices.size() > light_.size();
}

// Layer by layer from the vertices that have light: the mean of their neighbours.
void Baker::fillBuried() {
    std::vector<bool> known(light_.size());
    for (std::size_t i = 0; i < light_.size(); ++i) known[i] = light_[i].done && !light_[i].buried;
    constexpr int kLayers = 4;  // further away nothing is seen: elements there are below the object
    for (int layer = 0; layer < kLayers; ++layer) {
        std::vector<glm::vec4> sums(light_.size(), glm::vec4(0));
        for (std::uint32_t e = 0; e < mesh_.elements.size(); ++e) {
            if (!mesh_.isLeaf(e)) continue;
            for (const std::uint32_t a : mesh_.elements[e].vertices)
                for (const std::uint32_t b : mesh_.elements[e].vertices)
                    if (!known[a] && known[b]) sums[a] += glm::vec4(light_[b].irradiance, 1);
        }
        for (std::size_t i = 0; i < light_.size(); ++i) {
            if (!(sums[i].w > 0)) continue;
            light_[i].irradiance = glm::vec3(sums[i]) / sums[i].w;
            known[i] = true;
        }
    }
}

std::vector<glm::vec3> Baker::bake(RadiosityStats& stats) {
    makePatches();
    linkPatches();
    solve();
    gatherVertices();
    for (int round = 0; goesOn_ && round < 2 * settings_.maxSubdivision && splitElements(); ++round)
        gatherVertices();
    light_.resize(mesh_.vertices.size());
    fillBuried();
    std::vector<glm::vec3> irradiance;
    for (const VertexLight& l : light_) irradiance.push_back(l.irradiance);
    stats.patches = patches_.size();
    stats.vertices = mesh_.vertices.size();
    for (std::uint32_t e = 0; e < mesh_.elements.size(); ++e) stats.elements += mesh_.isLeaf(e) ? 1 : 0;
    stats.iterations = iterations_;
    stats.residual = residual_;
    stats.rays = rayCount_;
    return irradiance;
}

void check(const RadiositySettings& s) {
    const auto range = [](const char* name, double value, double least, double most) {
        if (!(value >= least && value <= most))
            base::fail(ErrorKind::Usage, "radiosity: %s %g; right would be %g to %g", name, value, least,
                       most);
    };
    range("patch size", static_cast<double>(s.patchSize), 0, 1e9);
    range("halvings", s.maxSubdivision, 0, 8);
    range("subdivision error", static_cast<double>(s.subdivideError), 1e-4, 100);
    range("residual", static_cast<double>(s.residual), 1e-7, 1);
    range("rays per patch", s.patchRays, 16, 65536);
    range("rays per vertex", s.gatherRays, 16, 65536);
    range("visibility rays", s.visibilityRays, 16, 4096);
    range("bounces", s.bounces, -1, 1e6);
    range("threads", s.threads, 0, 4096);
}

}  // namespace

Scene bakeRadiosity(const Scene& scene, const RadiositySettings& settings, RadiosityStats* stats,
                    const std::function<bool(const RadiosityProgress&)>& onProgress) {
    check(settings);
    scene.validate();
    const double cpuStart = base::processCpuMs(), wallStart = base::wallMs();
    RadiosityStats own;
    Baker baker(scene, settings, Baker::Vertices::All, onProgress);
    const std::vector<glm::vec3> irradiance = baker.bake(own);
    Scene lit = litScene(scene, baker.mesh(), irradiance);
    own.cpuSeconds = (base::processCpuMs() - cpuStart) * 1e-3;
    own.wallSeconds = (base::wallMs() - wallStart) * 1e-3;
    if (stats) *stats = own;
    return lit;
}

BakedLight bakeIndirect(const Scene& scene, const RadiositySettings& settings, RadiosityStats* stats,
                        const std::function<bool(const RadiosityProgress&)>& onProgress) {
    check(settings);
    scene.validate();
    const double cpuStart = base::processCpuMs(), wallStart = base::wallMs();
    Scene statics = scene;
    for (Instance& instance : statics.instances) instance.visible = instance.visible && !instance.dynamic;
    // Indirect light is a part of what is seen: coarser by this makes no more error in Cornell boxes, in a quarter of
    // the time.
    constexpr float kCoarser = 2.5f;
    RadiositySettings chosen = settings;
    chosen.subdivideError *= kCoarser;
    RadiosityStats own;
    Baker baker(statics, chosen, Baker::Vertices::Indirect, onProgress);
    const std::vector<glm::vec3> irradiance = baker.bake(own);
    BakedLight baked = bakedLight(statics, baker.mesh(), irradiance);
    own.cpuSeconds = (base::processCpuMs() - cpuStart) * 1e-3;
    own.wallSeconds = (base::wallMs() - wallStart) * 1e-3;
    if (stats) *stats = own;
    return baked;
}

}  // namespace conelight::reference

// SPDX-License-Identifier: MIT
// Rounds of samples over the picture's tiles, on all cores -> PathTracedPicture. A pixel's samples are added
// in their order, whatever the rounds and whoever takes the tile: the picture has the same bits for any
// number of threads. Even samples make up one half, odd ones the other; their numbers are independent, so
// that the difference of the halves tells the variance of their mean. Paths: path_integrator.cpp.
#include "reference/path_tracer.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <mutex>
#include <system_error>
#include <thread>

#include "base/clock.h"
#include "base/log.h"
#include "math/disc.h"
#include "reference/lens.h"
#include "reference/path_integrator.h"

namespace conelight::reference {
namespace {

constexpr int kTile = 16;
constexpr double kRoundMs = 300;  // of a round: short enough to show progress
constexpr int kWaitMs = 200;      // between two calls of onProgress within a round
constexpr int kMaxSide = 16384;   // as Renderer::render
constexpr int kMaxSamples = 1 << 20;
constexpr int kFirstCheck = 16;  // samples after which the noise is looked at for the first time

struct HalfSums {
    glm::vec3 direct{0}, diffuse{0}, specular{0};
    glm::vec3 full() const { return direct + diffuse + specular; }
};

struct PixelSums {
    std::array<HalfSums, 2> half;
    float seen = 0;
};

struct FeatureSums {
    struct Half {
        glm::vec3 albedo{0}, gloss{0}, emission{0};
    };
    std::array<Half, 2> half;
    glm::vec4 normal{0};

    void add(const PathSample& sample, std::size_t of) {
        half[of].albedo += sample.albedo;
        half[of].gloss += sample.gloss;
        half[of].emission += sample.emission;
        normal += glm::vec4(sample.normal, sample.distance);
    }
};

struct Film {
    int width, height, tilesX, tilesY;
    double traced;  // pixels
    std::vector<PixelSums> pixels;
    std::vector<FeatureSums> features;  // empty: not asked for
    std::vector<std::vector<glm::vec3>> bounces;
    std::vector<int> tileSamples;  // taken of each pixel of the tile

    Film(int w, int h, const PathTracerSettings& settings)
        : width(w),
          height(h),
          tilesX((w + kTile - 1) / kTile),
          tilesY((h + kTile - 1) / kTile),
          traced(settings.pixels.empty() ? double(w) * h
                                         : std::count(settings.pixels.begin(), settings.pixels.end(), 1)),
          pixels(static_cast<std::size_t>(w) * static_cast<std::size_t>(h)),
          features(settings.features ? pixels.size() : 0),
          bounces(static_cast<std::size_t>(settings.perBounce), std::vector<glm::vec3>(pixels.size())),
          tileSamples(static_cast<std::size_t>(tilesX) * static_cast<std::size_t>(tilesY)) {}

    int samplesAt(int x, int y) const {
        return tileSamples[static_cast<std::size_t>(y / kTile) * static_cast<std::size_t>(tilesX) +
                           static_cast<std::size_t>(x / kTile)];
    }
    int fewestSamples() const { return *std::min_element(tileSamples.begin(), tileSamples.end()); }
    double noise() const;
};

// Estimated relRMSE. The mean of halves A and B has the expected squared error E[(A - B)^2] / 4.
double Film::noise() const {
    double squares = 0, sum = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const int samples = samplesAt(x, y);
            if (samples == 0) continue;
            const PixelSums& p = pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                                        static_cast<std::size_t>(x)];
            const glm::dvec3 a(p.half[0].full()), b(p.half[1].full());
            const glm::dvec3 error = (a - b) / static_cast<double>(samples);
            const glm::dvec3 mean = (a + b) / static_cast<double>(samples);
            squares += glm::dot(error, error);
            sum += mean.r + mean.g + mean.b;
        }
    const double count = 3.0 * traced;
    return sum > 0 ? std::sqrt(squares / count) / (sum / count) : 0;
}

void checkArguments(const Camera& camera, int width, int height, const PathTracerSettings& s) {
    if (width < 1 || height < 1 || width > kMaxSide || height > kMaxSide)
        base::fail(ErrorKind::Usage, "reference: picture of %d x %d pixels; right would be 1 to %d a side",
                   width, height, kMaxSide);
    if (s.samplesPerPixel < 1 || s.samplesPerPixel > kMaxSamples)
        base::fail(ErrorKind::Usage, "reference: %d samples per pixel; right would be 1 to %d",
                   s.samplesPerPixel, kMaxSamples);
    if (!(s.noise >= 0 && s.noise < 1))
        base::fail(ErrorKind::Usage, "reference: noise of %g; right would be 0 to below 1", s.noise);
    if (s.bounces < -1 || s.perBounce < 0 || s.perBounce > 64 || s.threads < 0)
        base::fail(
            ErrorKind::Usage,
            "reference: bounces %d, bounce pictures %d, threads %d; right would be -1 or more, 0 to 64, 0 "
            "or more",
            s.bounces, s.perBounce, s.threads);
    if (!s.pixels.empty() &&
        s.pixels.size() != static_cast<std::size_t>(width) * static_cast<std::size_t>(height))
        base::fail(ErrorKind::Usage,
                   "reference: %zu pixels are chosen of %d x %d; one number for each would be right",
                   s.pixels.size(), width, height);
    if (!(camera.zNear > 0 && camera.zFar > camera.zNear))
        base::fail(ErrorKind::Usage, "reference: camera sees from %g to %g m; right would be 0 < near < far",
                   static_cast<double>(camera.zNear), static_cast<double>(camera.zFar));
}

// Samples [begin, end) of every pixel, tile by tile, until done or cancelled.
class Round {
  public:
    Round(const PathIntegrator& integrator, const Lens& lens, const PathTracerSettings& settings, Film& film,
          int begin, int end)
        : integrator_(integrator), lens_(lens), settings_(settings), film_(film), begin_(begin), end_(end) {}

    // Calls `onWait` from this thread now and then; stops early when it returns false.
    bool run(int threads, const std::function<bool(double done)>& onWait);
    std::uint64_t rays() const { return rays_; }
    std::uint64_t badSamples() const { return badSamples_; }

  private:
    void work();
    void renderTile(int tile, PathSample& sample, std::uint64_t& bad);

    const PathIntegrator& integrator_;
    const Lens& lens_;
    const PathTracerSettings& settings_;
    Film& film_;
    int begin_, end_;
    std::atomic<int> nextTile_{0};
    std::atomic<bool> cancelled_{false};
    std::mutex mutex_;
    std::condition_variable changed_;
    int running_ = 0;
    std::uint64_t rays_ = 0, badSamples_ = 0;
};

void Round::renderTile(int tile, PathSample& sample, std::uint64_t& bad) {
    const int x0 = tile % film_.tilesX * kTile, y0 = tile / film_.tilesX * kTile;
    const int bits = std::bit_width(static_cast<unsigned>((settings_.samplesPerPixel + 1) / 2 - 1));
    for (int y = y0; y < std::min(y0 + kTile, film_.height); ++y)
        for (int x = x0; x < std::min(x0 + kTile, film_.width); ++x) {
            const std::size_t at = static_cast<std::size_t>(y) * static_cast<std::size_t>(film_.width) +
                                   static_cast<std::size_t>(x);
            if (!settings_.pixels.empty() && settings_.pixels[at] == 0) continue;
            PixelSums& sums = film_.pixels[at];
            const std::uint32_t key = combineBits(mixBits(settings_.seed), static_cast<std::uint32_t>(at));
            const glm::dvec2 size(film_.width, film_.height);
            const glm::dvec2 middle = (glm::dvec2(x, y) + 0.5) / size * 2.0 - 1.0;
            const PathIntegrator::PixelTurns turns = {{lens_.turn({middle.x, -middle.y}, {2 / size.x, 0}),
                                                       lens_.turn({middle.x, -middle.y}, {0, 2 / size.y})},
                                                      lens_.parallel};
            const bool box = settings_.filter == PixelFilter::Box;
            for (int i = begin_; i < end_; ++i) {
                const auto half = static_cast<std::uint32_t>(i & 1);
                Sampler sampler(combineBits(key, half), static_cast<std::uint32_t>(i >> 1), bits);
                const glm::dvec2 inPixel = box ? glm::dvec2(sampler.next2()) : glm::dvec2(0.5);
                const glm::dvec2 clip = (glm::dvec2(x, y) + inPixel) / size;
                const glm::dvec2 inLens =
                    lens_.radius > 0 ? math::discFromSquare(glm::dvec2(sampler.next2())) : glm::dvec2(0);
                sample.clear();
                integrator_.trace(lens_.ray({2 * clip.x - 1, 1 - 2 * clip.y}, inLens), box ? nullptr : &turns,
                                  sampler, sample);
                if (!sample.finite()) {
                    ++bad;
                    continue;
                }
                sums.half[half].direct += sample.direct;
                sums.half[half].diffuse += sample.diffuse;
                sums.half[half].specular += sample.specular;
                sums.seen += sample.seen ? 1.0f : 0.0f;
                if (!film_.features.empty()) film_.features[at].add(sample, half);
                for (std::size_t b = 0; b < sample.bounces.size(); ++b)
                    film_.bounces[b][at] += sample.bounces[b];
            }
        }
    film_.tileSamples[static_cast<std::size_t>(tile)] = end_;
}

void Round::work() {
    PathSample sample;
    sample.bounces.resize(film_.bounces.size());
    std::uint64_t bad = 0;
    const int tiles = film_.tilesX * film_.tilesY;
    for (int tile = nextTile_++; tile < tiles && !cancelled_; tile = nextTile_++)
        renderTile(tile, sample, bad);
    const std::lock_guard lock(mutex_);
    rays_ += sample.rays;
    badSamples_ += bad;
    --running_;
    changed_.notify_all();
}

bool Round::run(int threads, const std::function<bool(double)>& onWait) {
    std::vector<std::thread> workers;
    running_ = threads;
    try {
        while (static_cast<int>(workers.size()) < threads) workers.emplace_back([this] { work(); });
    } catch (const std::system_error&) {
        // The system gives no more threads: those that run, or this one, do the work.
        const std::lock_guard lock(mutex_);
        running_ -= threads - static_cast<int>(workers.size());
    }
    if (workers.empty()) {
        running_ = 1;
        work();
    }
    std::unique_lock lock(mutex_);
    while (!changed_.wait_for(lock, std::chrono::milliseconds(kWaitMs), [this] { return running_ == 0; })) {
        lock.unlock();
        const int tiles = film_.tilesX * film_.tilesY;
        if (onWait && !onWait(static_cast<double>(std::min<int>(nextTile_, tiles)) / tiles))
            cancelled_ = true;
        lock.lock();
    }
    lock.unlock();
    for (std::thread& worker : workers) worker.join();
    return !cancelled_;
}

Image emptyImage(const Film& film) {
    return {film.width, film.height, std::vector<glm::vec4>(film.pixels.size())};
}

// `halfScale`: one over the samples of a half.
void setFeatures(FeaturePictures& pictures, const Film& film, std::size_t i, float halfScale) {
    const FeatureSums& f = film.features[i];
    const std::array<HalfSums, 2>& half = film.pixels[i].half;
    pictures.albedoA.pixels[i] = {f.half[0].albedo * halfScale, 1};
    pictures.albedoB.pixels[i] = {f.half[1].albedo * halfScale, 1};
    pictures.glossA.pixels[i] = {f.half[0].gloss * halfScale, 1};
    pictures.glossB.pixels[i] = {f.half[1].gloss * halfScale, 1};
    pictures.emissionA.pixels[i] = {f.half[0].emission * halfScale, 1};
    pictures.emissionB.pixels[i] = {f.half[1].emission * halfScale, 1};
    pictures.diffuseA.pixels[i] = {half[0].diffuse * halfScale, 1};
    pictures.diffuseB.pixels[i] = {half[1].diffuse * halfScale, 1};
    pictures.normal.pixels[i] = f.normal * (0.5f * halfScale);
}

PathTracedPicture pictureOf(const Film& film) {
    PathTracedPicture p;
    for (Image* image : {&p.full, &p.direct, &p.indirect, &p.diffuse, &p.specular, &p.halfA, &p.halfB,
                         &p.indirectA, &p.indirectB})
        *image = emptyImage(film);
    p.bounces.assign(film.bounces.size(), emptyImage(film));
    FeaturePictures& f = p.features;
    if (!film.features.empty())
        for (Image* image : {&f.albedoA, &f.albedoB, &f.glossA, &f.glossB, &f.emissionA, &f.emissionB,
                             &f.normal, &f.diffuseA, &f.diffuseB})
            *image = emptyImage(film);
    for (std::size_t i = 0; i < film.pixels.size(); ++i) {
        const int samples = film.samplesAt(static_cast<int>(i % static_cast<std::size_t>(film.width)),
                                           static_cast<int>(i / static_cast<std::size_t>(film.width)));
        if (samples == 0) continue;
        const PixelSums& s = film.pixels[i];
        const HalfSums &a = s.half[0], &b = s.half[1];
        const float all = 1.0f / static_cast<float>(samples), each = 2.0f * all, seen = s.seen * all;
        p.direct.pixels[i] = {(a.direct + b.direct) * all, seen};
        p.diffuse.pixels[i] = {(a.diffuse + b.diffuse) * all, seen};
        p.specular.pixels[i] = {(a.specular + b.specular) * all, seen};
        p.indirectA.pixels[i] = {(a.diffuse + a.specular) * each, seen};
        p.indirectB.pixels[i] = {(b.diffuse + b.specular) * each, seen};
        p.indirect.pixels[i] = {glm::vec3(p.diffuse.pixels[i] + p.specular.pixels[i]), seen};
        p.full.pixels[i] = {glm::vec3(p.direct.pixels[i] + p.indirect.pixels[i]), seen};
        p.halfA.pixels[i] = {a.full() * each, seen};
        p.halfB.pixels[i] = {b.full() * each, seen};
        for (std::size_t n = 0; n < film.bounces.size(); ++n)
            p.bounces[n].pixels[i] = {film.bounces[n][i] * all, seen};
        if (!film.features.empty()) setFeatures(f, film, i, each);
    }
    return p;
}

// Numbers of samples at which the noise decides: 16, 24, 32, 48, ... so that timing does not.
int nextCheck(int samples) {
    int check = kFirstCheck;
    while (check <= samples)
        check += std::has_single_bit(static_cast<unsigned>(check)) ? check / 2 : check / 3;
    return check;
}

}  // namespace

struct PathTracer::Impl {
    const Scene& scene;
    RayScene rays;
    explicit Impl(const Scene& s) : scene(s), rays(s) {}
};

PathTracer::PathTracer(const Scene& scene) : impl_(std::make_unique<Impl>(scene)) {}
PathTracer::~PathTracer() = default;
PathTracer::PathTracer(PathTracer&&) noexcept = default;
PathTracer& PathTracer::operator=(PathTracer&&) noexcept = default;

PathTracedPicture PathTracer::render(const Camera& camera, int width, int height,
                                     const PathTracerSettings& settings, const OnProgress& onProgress) const {
    checkArguments(camera, width, height, settings);
    const double cpuStart = base::processCpuMs(), wallStart = base::wallMs();
    const PathIntegrator integrator(impl_->scene, impl_->rays, settings);
    const Lens lens(camera, width, height);
    Film film(width, height, settings);
    const int planned = settings.samplesPerPixel + settings.samplesPerPixel % 2;
    const int cores = static_cast<int>(std::max(std::thread::hardware_concurrency(), 1u));
    const int threads = std::min(settings.threads > 0 ? settings.threads : cores, film.tilesX * film.tilesY);

    int done = 0;
    std::uint64_t rays = 0, bad = 0;
    double noise = 0;
    bool goesOn = true;
    const auto report = [&](double samples) {
        if (!onProgress) return true;
        // The noise falls with the square root of the samples.
        double total = planned;
        if (settings.noise > 0 && noise > 0)
            total = std::min(total, done * std::pow(noise / settings.noise, 2));
        const double left = samples > 0 ? (base::wallMs() - wallStart) * 1e-3 * (total / samples - 1) : -1;
        return onProgress(
            {static_cast<int>(samples), planned, noise, samples > 0 ? std::max(left, 0.0) : -1});
    };
    for (int size = 2; goesOn && done < planned;) {
        int end = std::min(done + size, planned);
        if (settings.noise > 0) end = std::min(end, nextCheck(done));
        const double roundStart = base::wallMs();
        Round round(integrator, lens, settings, film, done, end);
        const int before = done, inRound = end - done;
        goesOn = round.run(threads, [&](double part) { return report(before + part * inRound); });
        rays += round.rays();
        bad += round.badSamples();
        if (!goesOn) break;
        done = end;
        noise = film.noise();
        if (settings.noise > 0 && nextCheck(done - 1) == done && noise <= settings.noise) break;
        goesOn = report(done);
        const double msPerSample = std::max((base::wallMs() - roundStart) / inRound, 1e-3);
        size = 2 * std::clamp(static_cast<int>(0.5 * kRoundMs / msPerSample), 1, std::max(done, 1));
    }

    PathTracedPicture picture = pictureOf(film);
    picture.samplesPerPixel = film.fewestSamples();
    picture.noise = film.noise();
    picture.rays = rays;
    picture.badSamples = bad;
    picture.cpuSeconds = (base::processCpuMs() - cpuStart) * 1e-3;
    picture.wallSeconds = (base::wallMs() - wallStart) * 1e-3;
    return picture;
}

}  // namespace conelight::reference

// SPDX-License-Identifier: MIT
// The path tracer: Scene + Camera -> radiance, the truth that every other mode is measured against. Same
// tables, units, materials (src/math/brdf.h) and rules as the GL modes, on all cores. Unbiased; the same bits
// for the same seed, whatever the number of threads. Methods and citations: path_tracer.cpp.
//
// Rules shared with the GL modes: single-sided surfaces are not seen from behind by the camera but block and
// absorb light; instances without castsShadow block no light that comes straight from lights; instances
// without voxelized neither block, bounce nor emit in indirect light; primary rays run from zNear to zFar.
// Unlit surfaces are seen, block light and give none. Backs of single-sided surfaces absorb. Surfaces reflect
// nothing to or from below their geometric horizon, whatever the shading normal says.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "conelight/renderer.h"
#include "conelight/scene.h"

namespace conelight::reference {

// How light is found. Mis is for use, the other two to check it: all three agree within noise.
enum class Estimator { Mis, LightsOnly, MaterialsOnly };
// Center: one point of the pixel, as the GL modes have it, its textures averaged over the pixel as theirs are
// by levels. Box: all of it over the pixel's area, edges of surfaces too.
enum class PixelFilter { Center, Box };
// All: the truth. Mirrors: direct light, seen straight or by way of ideal mirrors alone, which is what mode
// `beams` draws.
enum class Paths { All, Mirrors };

struct PathTracerSettings {
    int samplesPerPixel = 256;  // at most; 1..2^20, rounded up to an even number (two halves)
    double noise = 0;           // stop once the estimated relRMSE of the picture is below; 0: never
    int bounces = -1;  // of indirect light; -1: all (Russian roulette, unbiased); 0: direct light only
    std::uint32_t seed = 1;
    PixelFilter filter = PixelFilter::Center;
    Paths paths = Paths::All;
    Estimator estimator = Estimator::Mis;
    bool emissiveQuads = true;         // as light.emissive_quads: decides what is "direct"
    bool smallLamps = true;            // as light.small_lamps: the same
    int perBounce = 0;                 // fill PathTracedPicture::bounces for bounces 1..perBounce
    bool features = false;             // fill PathTracedPicture::features
    int threads = 0;                   // 0: all cores
    std::vector<std::uint8_t> pixels;  // 1 for those that are traced, rows from the top; empty: all
};

// What is seen, for a filter of noise (denoise.h); means over the samples of a pixel, of the halves where both
// are named. Black where nothing is seen. Of a mirror without a diffuse part: what is seen in it.
struct FeaturePictures {
    Image albedoA, albedoB;  // of the diffuse part, 0..1
    Image glossA, glossB;    // reflectance of the lobe at normal incidence; in mirrors: of all that is seen
    Image emissionA, emissionB;  // radiance given off towards the camera, the sky's included
    Image normal;                // shading normal, rgb; w: distance along the ray, m
    Image diffuseA, diffuseB;    // halves of PathTracedPicture::diffuse
};

// Parts as in Component. direct: emission seen, the sky behind everything, and light that comes straight from
// lights (flat emissive quads and small emissive spheres included, as in the GL modes). indirect = full - direct:
// everything else, light of the sky and of other emitters included; split by the lobe of the first surface that
// reflected it: diffuse + specular = indirect.
struct PathTracedPicture {
    Image full, direct, indirect, diffuse, specular;
    Image halfA, halfB;          // of full, from independent samples; full is their mean
    Image indirectA, indirectB;  // of indirect
    // [n]: what bounce n + 1 adds to `indirect`: light of the sky and of emitters that are not direct light
    // after n + 1 reflections, all other light after n + 2. Empty unless asked for.
    std::vector<Image> bounces;
    FeaturePictures features;  // empty unless asked for
    int samplesPerPixel = 0;   // done
    double noise = 0;          // estimated relRMSE of full: sqrt(mean variance of the pixel means) / mean
    std::uint64_t rays = 0;
    std::uint64_t badSamples = 0;  // not finite: taken as black, and counted here
    double cpuSeconds = 0, wallSeconds = 0;
};

struct PathTracerProgress {
    int samplesDone = 0, samplesPlanned = 0;
    double noise = 0;
    double secondsLeft = -1;  // < 0: unknown yet
};

class PathTracer {
  public:
    // Keeps a reference to `scene`, which must outlive it unchanged. Builds the ray structure. Throws
    // Error(BadInput) when Scene::validate does, Error(Runtime) when memory runs out.
    explicit PathTracer(const Scene& scene);
    ~PathTracer();
    PathTracer(PathTracer&&) noexcept;
    PathTracer& operator=(PathTracer&&) noexcept;

    // Renders in rounds over the whole picture. `onProgress` is called between rounds (at least twice a
    // second if it can be); when it returns false the picture so far is returned.
    using OnProgress = std::function<bool(const PathTracerProgress&)>;
    PathTracedPicture render(const Camera& camera, int width, int height, const PathTracerSettings& settings,
                             const OnProgress& onProgress = {}) const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace conelight::reference

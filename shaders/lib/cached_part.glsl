// SPDX-License-Identifier: MIT
// How much of the light that a face gathers is cached light of other faces (docs/theory/4d_cache.md, "The balance of
// light"). Hooks for lib/voxel_light.glsl; they do nothing but with CACHED_PART 1.
#ifndef CACHED_PART
#define CACHED_PART 0
#endif
#if CACHED_PART
vec3 cachedRadiance;  // what of the radiance of the last ray is cached light that its first hit reflects
vec3 cachedShare;     // the same as a share
vec3 gatheredCached;  // what of the estimate is cached light
// The same by cosine-sampled rays alone. They have no noise in common: all faces draw light samples from one pool.
vec3 returnedCached;

#define CACHED_RADIANCE(value) cachedRadiance = value
#define BEGIN_CACHED() gatheredCached = returnedCached = vec3(0.0)
#define CACHED_SHARE(radiance) cachedShare = min(cachedRadiance / max(radiance, 1e-12), 1.0)
#define ADD_CACHED(contribution, byCosine)        \
    gatheredCached += (contribution)*cachedShare; \
    returnedCached += (byCosine)*cachedShare
#else
#define CACHED_RADIANCE(value)
#define BEGIN_CACHED()
#define CACHED_SHARE(radiance)
#define ADD_CACHED(contribution, byCosine)
#endif

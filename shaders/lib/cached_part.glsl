// SPDX-License-Identifier: MIT
// How much of the light that a face gathers is cached light of other faces (docs/theory/4d_cache.md, "The balance of
// light"). Hooks for lib/voxel_light.glsl; they do nothing but with CACHED_PART 1.
#ifndef CACHED_PART
#define CACHED_PART 0
#endif
#if CACHED_PART
// What of the radiance of the last ray is cached light that its first hit reflects, as a part of its brightness: of which
// colour it is does not matter where all have settled.
float cachedShare;
vec3 gatheredCached;  // what of the estimate is cached light
// The same by cosine-sampled rays alone. They have no noise in common: faces of a cell draw light samples from the same pools.
vec3 returnedCached;

#define CACHED_SHARE(value) cachedShare = value
#define BEGIN_CACHED() gatheredCached = returnedCached = vec3(0.0)
#define ADD_CACHED(contribution, byCosine)        \
    gatheredCached += (contribution)*cachedShare; \
    returnedCached += (byCosine)*cachedShare
#else
#define CACHED_SHARE(value)
#define BEGIN_CACHED()
#define ADD_CACHED(contribution, byCosine)
#endif

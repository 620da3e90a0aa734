// SPDX-License-Identifier: MIT
// Low-discrepancy numbers for paths: (pixel, half, sample, dimension) -> [0,1).
//
// Each pair of dimensions is the two-dimensional Sobol (0,2)-sequence (Sobol 1967), visited in a shuffled
// order and Owen-scrambled (Owen 1995) by hashes (Laine and Karras 2011; Burley 2020, "Practical Hash-based
// Owen Scrambling"), with keys of its own: pairs are independent of each other, and so are pixels and halves.
// Every number alone is uniform, so that estimates are unbiased. Far down a path, where stratification no
// longer shows, plain hashed numbers are cheaper.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>

namespace conelight::reference {

inline std::uint32_t mixBits(std::uint32_t x) {
    // "lowbias32" (Wellons 2018, "Prospecting for Hash Functions").
    x = (x ^ (x >> 16)) * 0x7feb352du;
    x = (x ^ (x >> 15)) * 0x846ca68bu;
    return x ^ (x >> 16);
}
inline std::uint32_t combineBits(std::uint32_t a, std::uint32_t b) {
    return mixBits(a ^ (mixBits(b + 0x9e3779b9u) + 0x9e3779b9u + (a << 6) + (a >> 2)));
}

class Sampler {
  public:
    // `sampleBits`: at most 2^sampleBits samples will be taken of this pixel and half.
    Sampler(std::uint32_t pixelKey, std::uint32_t sample, int sampleBits)
        : key_(pixelKey), sample_(sample), mask_(sampleBits >= 32 ? ~0u : (1u << sampleBits) - 1u) {}

    glm::vec2 next2() {
        const std::uint32_t pair = pair_++;
        const std::uint32_t key = combineBits(key_, pair);
        if (pair >= kStratifiedPairs) {
            const std::uint32_t x = combineBits(key, sample_);
            return {unit(x), unit(mixBits(x ^ 0xa511e9b3u))};
        }
        const std::uint32_t index = owenScrambled(sample_, key) & mask_;
        const std::uint32_t x = owenScrambled(reversed(index), mixBits(key ^ 0x68bc21ebu));
        const std::uint32_t y = owenScrambled(secondDimension(index), mixBits(key ^ 0x02e5be93u));
        return {unit(x), unit(y)};
    }

  private:
    // Seven vertices of a path at four pairs each, and the pixel's.
    static constexpr std::uint32_t kStratifiedPairs = 29;

    // The upper 24 bits: every one of them below 1 as a float.
    static float unit(std::uint32_t x) { return static_cast<float>(x >> 8) * 0x1p-24f; }

    static std::uint32_t reversed(std::uint32_t x) {
        x = (x << 16) | (x >> 16);
        x = ((x & 0x00ff00ffu) << 8) | ((x & 0xff00ff00u) >> 8);
        x = ((x & 0x0f0f0f0fu) << 4) | ((x & 0xf0f0f0f0u) >> 4);
        x = ((x & 0x33333333u) << 2) | ((x & 0xccccccccu) >> 2);
        return ((x & 0x55555555u) << 1) | ((x & 0xaaaaaaaau) >> 1);
    }
    // Flips each bit by a hash of the bits above it. Constants: Vegdahl 2021, "Owen scrambling based
    // low-discrepancy blue noise" (a better mixed Laine-Karras permutation).
    static std::uint32_t owenScrambled(std::uint32_t v, std::uint32_t key) {
        v = reversed(v);
        v ^= v * 0x3d20adeau;
        v += key;
        v *= (key >> 16) | 1u;
        v ^= v * 0x05526c56u;
        v ^= v * 0x53a22864u;
        return reversed(v);
    }
    // Sobol's second dimension: its matrix is Pascal's triangle modulo 2.
    static std::uint32_t secondDimension(std::uint32_t index) {
        std::uint32_t result = 0;
        for (std::uint32_t column = 1u << 31; index != 0; index >>= 1, column ^= column >> 1)
            if ((index & 1u) != 0) result ^= column;
        return result;
    }

    std::uint32_t key_, sample_, mask_, pair_ = 0;
};

// Of a sample that another technique could have drawn, by both densities: power heuristic, exponent 2 (Veach and Guibas
// 1995). An infinite own density is certain.
inline float misWeight(float own, float other) {
    const float ratio = other / own;
    return 1.0f / (1.0f + ratio * ratio);
}

}  // namespace conelight::reference

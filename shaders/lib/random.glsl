// SPDX-License-Identifier: MIT
// Random numbers from counters: the same for the same seed, whatever the order of threads. Hash: PCG (O'Neill
// 2014; as a hash, Jarzynski and Olano 2020, "Hash Functions for GPU Rendering"). Sequence: multiples of
// powers of the inverse of the root of x^3 = x + 1, modulo 1 (Roberts 2018, "The Unreasonable Effectiveness
// of Quasirandom Sequences"), shifted per seed (Cranley and Patterson 1976).

uint randomHash(uint x) {
    uint state = x * 747796405u + 2891336453u;
    uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (word >> 22u) ^ word;
}

// [0,1) from the upper 24 bits.
float randomFloat(uint bits) { return float(bits >> 8) * (1.0 / 16777216.0); }

// The next number of a stream.
float randomNext(inout uint state) {
    state = randomHash(state);
    return randomFloat(state);
}

// Point `index` of the sequence of `seed`, in [0,1)^2. Steps are held as integers, so that far points are as
// exact as near ones: 2^32 / 1.32471795724..., 2^32 / 1.32471795724...^2.
vec2 sequencePoint(uint seed, uint index) {
    uint a = randomHash(seed);
    return vec2(randomFloat(a + index * 3242174889u), randomFloat(randomHash(a) + index * 2447445414u));
}

// The same in [0,1)^3, with the root of x^4 = x + 1, 1.22074408460...
vec3 sequencePoint3(uint seed, uint index) {
    uint a = randomHash(seed ^ 0x68bc21ebu);
    uint b = randomHash(a);
    return vec3(randomFloat(a + index * 3518319155u), randomFloat(b + index * 2882110345u),
                randomFloat(randomHash(b) + index * 2360945575u));
}

// The same in [0,1)^4, with the root of x^5 = x + 1, 1.16730397826...
vec4 sequencePoint4(uint seed, uint index) {
    uint a = randomHash(seed ^ 0x2c1b3c6du);
    uint b = randomHash(a);
    uint c = randomHash(b);
    return vec4(randomFloat(a + index * 3679390609u), randomFloat(b + index * 3152041523u),
                randomFloat(c + index * 2700274806u), randomFloat(randomHash(c) + index * 2313257605u));
}

// SPDX-License-Identifier: MIT
// Hooks by which the gathering of one pixel writes down its steps, for the inspector. Without RECORD_STEPS
// all of them are nothing. With it a dispatch of one group stands for the pixel of the header: its first
// invocation is the pixel and writes, the others are its neighbours and do not. Pictures are not stored then.
#include "shared/inspect.h"
#ifdef RECORD_STEPS
layout(std430) buffer RecordBuffer {
    RecordHeader header;
    RecordedPart parts[RECORD_PARTS];
    RecordedPath paths[RECORD_MAX_PATHS];
    RecordedStep steps[];
}
record;

#define INVOCATION_PIXEL (ivec2(record.header.pixelX, record.header.pixelY) + ivec2(gl_GlobalInvocationID.xy))

bool recording() { return all(equal(gl_GlobalInvocationID, uvec3(0u))); }

void recordSurface(bool seen, vec3 position, vec3 normal, float depth) {
    if (!recording()) return;
    record.header.seen = seen ? 1u : 0u;
    record.header.position = position;
    record.header.normal = normal;
    record.header.depth = depth;
}

// Steps belong to the path that is recorded next.
void recordStep(uint kind, vec3 position, float distance, float size, float level, vec3 radiance,
                float opacity, float total) {
    if (!recording()) return;
    uint index = record.header.steps++;
    if (index >= RECORD_MAX_STEPS) return;
    record.steps[index] = RecordedStep(position, size, radiance, opacity, distance, level, total, kind);
}

// Returns the path's index; RECORD_MAX_PATHS when it is not kept.
uint recordPath(uint kind, vec3 origin, vec3 direction, float tanHalf, vec3 weight, vec3 radiance,
                float opacity, float distance, uint end) {
    if (!recording()) return RECORD_MAX_PATHS;
    uint first = record.header.pathSteps;
    record.header.pathSteps = record.header.steps;
    uint index = record.header.paths++;
    if (index >= RECORD_MAX_PATHS) return RECORD_MAX_PATHS;
    record.paths[index] = RecordedPath(origin, kind, direction, tanHalf, weight * record.header.share,
                                       opacity, radiance, distance, first, record.header.steps - first, end,
                                       -1, vec3(0.0), 0.0, vec3(0.0), 0u, vec3(0.0), 0.0, vec3(0.0), 0u);
    return index;
}

// Multiplies the weight of the last path.
void recordWeight(float factor) {
    if (recording() && record.header.paths - 1u < RECORD_MAX_PATHS)
        record.paths[record.header.paths - 1u].weight *= factor;
}

void recordPart(int part, vec3 value, vec3 scale) {
    if (!recording()) return;
    record.parts[part].value += value * record.header.share;
    record.parts[part].scale = scale;
    record.parts[part].used = 1u;
}

#define RECORD_SURFACE(seen, s) recordSurface(seen, (s).position, (s).normal, (s).depth)
#define RECORD_STEP(kind, position, distance, size, level, radiance, opacity, total) \
    recordStep(kind, position, distance, size, level, radiance, opacity, total)
#define RECORD_PATH(kind, origin, direction, tanHalf, weight, radiance, opacity, distance, end) \
    recordPath(kind, origin, direction, tanHalf, weight, radiance, opacity, distance, end)
#define RECORD_WEIGHT(factor) recordWeight(factor)
#define RECORD_PART(part, value, scale) recordPart(part, value, scale)
#else
#define INVOCATION_PIXEL ivec2(gl_GlobalInvocationID.xy)
#define RECORD_SURFACE(seen, s)
#define RECORD_STEP(kind, position, distance, size, level, radiance, opacity, total)
#define RECORD_PATH(kind, origin, direction, tanHalf, weight, radiance, opacity, distance, end)
#define RECORD_WEIGHT(factor)
#define RECORD_PART(part, value, scale)
#endif

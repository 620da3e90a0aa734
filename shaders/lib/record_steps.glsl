// SPDX-License-Identifier: MIT
// Hooks that record the steps of one pixel's gathering for the inspector. Without RECORD_STEPS they are
// empty. With it a dispatch of one group covers the pixel of the header: the first invocation is the pixel
// and records; the others are its neighbours and do not. No picture is stored then.
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
// Whether paths are. Not those of a pixel whose rays are sent where they meet nothing, as it has no need of them.
bool pathsCount = true;

void recordSurface(bool seen, vec3 position, vec3 normal, float depth) {
    if (!recording()) return;
    record.header.seen = seen ? 1u : 0u;
    record.header.position = position;
    record.header.normal = normal;
    record.header.depth = depth;
}

// Steps belong to the path that is recorded next.
void recordStep(RecordedStep recorded) {
    if (!recording() || !pathsCount) return;
    uint index = record.header.steps++;
    if (index >= RECORD_MAX_STEPS) return;
    record.steps[index] = recorded;
}

// A path without opacity and face, that leaves the grid.
RecordedPath newPath(uint kind, vec3 origin, vec3 direction, vec3 weight, vec3 radiance, float distance) {
    return RecordedPath(origin, kind, direction, 0.0, weight, 0.0, radiance, distance, 0u, 0u, END_OPEN, -1,
                        vec3(0.0), 0.0, vec3(0.0), 0u, vec3(0.0), 0.0, vec3(0.0), 0u);
}

// A cone's path.
RecordedPath conePath(RecordedPath path, float tanHalf, float opacity, uint end) {
    path.tanHalf = tanHalf;
    path.opacity = opacity;
    path.end = end;
    return path;
}

// Returns the path's index; RECORD_MAX_PATHS when it is not kept.
uint recordPath(RecordedPath path) {
    if (!recording() || !pathsCount) return RECORD_MAX_PATHS;
    path.firstStep = record.header.pathSteps;
    path.stepCount = record.header.steps - path.firstStep;
    path.weight *= record.header.share;
    record.header.pathSteps = record.header.steps;
    uint index = record.header.paths++;
    if (index >= RECORD_MAX_PATHS) return RECORD_MAX_PATHS;
    record.paths[index] = path;
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

#define RECORD_PATHS(count) pathsCount = (count)
#define RECORD_SURFACE(seen, s) recordSurface(seen, (s).position, (s).normal, (s).depth)
#define RECORD_STEP(kind, position, distance, size, level, radiance, opacity, total) \
    recordStep(RecordedStep(position, size, radiance, opacity, distance, level, total, kind))
#define RECORD_PATH(kind, origin, direction, tanHalf, weight, radiance, opacity, distance, end) \
    recordPath(conePath(newPath(kind, origin, direction, weight, radiance, distance), tanHalf, opacity, end))
#define RECORD_WEIGHT(factor) recordWeight(factor)
#define RECORD_PART(part, value, scale) recordPart(part, value, scale)
#else
#define INVOCATION_PIXEL ivec2(gl_GlobalInvocationID.xy)
#define RECORD_PATHS(count)
#define RECORD_SURFACE(seen, s)
#define RECORD_STEP(kind, position, distance, size, level, radiance, opacity, total)
#define RECORD_PATH(kind, origin, direction, tanHalf, weight, radiance, opacity, distance, end)
#define RECORD_WEIGHT(factor)
#define RECORD_PART(part, value, scale)
#endif

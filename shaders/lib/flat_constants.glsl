// SPDX-License-Identifier: MIT
// What a fragment shader reads of uniform blocks, as flat inputs from the vertices of its one triangle.
// Mesa's software driver reads a block lane by lane: 27 instructions for each number, again wherever it is
// used, which were a third of mode traced's picture. A flat input is one. FLAT_CONSTANTS 1 says that a shader
// has them (fragments); gather/traced_shade.vert.glsl hands them on.
#ifndef FLAT_CONSTANTS
#define FLAT_CONSTANTS 0
#endif
// So many lights have room: 7 rows each, and there are 32 rows.
#define FLAT_MOST_LIGHTS 3
#define FLAT_LIGHT_ROW 9
#if defined(LIGHTS_FIXED) && SHOW_DIRECT
#define FLAT_LIGHTS_TOTAL (LIGHTS_POINT + LIGHTS_SPOT + LIGHTS_DIRECTIONAL + LIGHTS_RECT)
#if LIGHTS_FIXED && FLAT_LIGHTS_TOTAL > 0 && FLAT_LIGHTS_TOTAL <= FLAT_MOST_LIGHTS
#define FLAT_LIGHTS 1
#endif
#endif
#ifdef FLAT_LIGHTS
#define FLAT_ROWS (FLAT_LIGHT_ROW + 7 * FLAT_LIGHTS_TOTAL)
#else
#define FLAT_LIGHTS 0
#define FLAT_ROWS FLAT_LIGHT_ROW
#endif

#if FLAT_CONSTANTS
layout(location = 0) flat in uvec4 flatRows[FLAT_ROWS];

struct FlatFrame {
    vec3 eye;
    vec3 viewForward;
    vec3 viewRight;
    vec3 viewUp;
    uint width;
    uint height;
    float parallel;
};
struct FlatLighting {
    vec3 sky;
    uvec4 lightEnds;
};
struct FlatGrid {
    vec3 origin;
    float voxelSize;
    float inverseVoxelSize;
    uint sizeX;
    uint sizeY;
    uint sizeZ;
    uint bricksX;
    uint bricksY;
    uint bricksZ;
};
struct FlatPixelRays {
    float specularLimit;
};

vec3 flatVec3(int row) { return uintBitsToFloat(flatRows[row].xyz); }
float flatFloat(int row) { return uintBitsToFloat(flatRows[row].w); }

FlatFrame frame =
    FlatFrame(flatVec3(0), flatVec3(2), flatVec3(3), flatVec3(4), flatRows[0].w, flatRows[1].w, flatFloat(4));
FlatLighting lighting = FlatLighting(flatVec3(1), flatRows[8]);
FlatPixelRays pixelRays = FlatPixelRays(flatFloat(2));
FlatGrid grid = FlatGrid(flatVec3(5), flatFloat(5), flatFloat(3), flatRows[6].x, flatRows[6].y, flatRows[6].z,
                         flatRows[7].x, flatRows[7].y, flatRows[7].z);
#endif

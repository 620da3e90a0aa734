#version 450 core
// SPDX-License-Identifier: MIT
// A triangle over the whole picture, without vertex attributes: gl::drawTriangle. For clip space z in [0,1]:
// with the G-buffer's depths and GL_GEQUAL only pixels are drawn that show a surface. Its vertices carry what
// the fragments need of uniform blocks (lib/flat_constants.glsl).
#include "lib/flat_constants.glsl"
#include "lib/frame_block.glsl"
#include "lib/lighting.glsl"
#include "shared/gbuffer.h"
#include "shared/pixel_rays.h"
// Pictures of direct light alone are drawn without voxels.
#if SHOW_DIFFUSE || SHOW_SPECULAR
#include "lib/voxel_grid.glsl"
#endif
layout(std140) uniform PixelRayBlock { PixelRayConstants pixelRays; };
#if FLAT_LIGHTS
layout(std140) uniform FixedLightRows { uvec4 lightRows[7 * FLAT_LIGHTS_TOTAL]; };
#endif
layout(location = 0) flat out uvec4 flatRows[FLAT_ROWS];

void main() {
    gl_Position = vec4(4 * (gl_VertexID & 1) - 1, 2 * (gl_VertexID & 2) - 1, GBUFFER_BEHIND, 1.0);
    flatRows[0] = uvec4(floatBitsToUint(frame.eye), frame.width);
    flatRows[1] = uvec4(floatBitsToUint(lighting.sky), frame.height);
    flatRows[2] = floatBitsToUint(vec4(frame.viewForward, pixelRays.specularLimit));
    flatRows[4] = floatBitsToUint(vec4(frame.viewUp, frame.parallel));
#if SHOW_DIFFUSE || SHOW_SPECULAR
    flatRows[3] = floatBitsToUint(vec4(frame.viewRight, grid.inverseVoxelSize));
    flatRows[5] = floatBitsToUint(vec4(grid.origin, grid.voxelSize));
    flatRows[6] = uvec4(gridSize(), 0);
    flatRows[7] = uvec4(gridBricks(), 0);
#else
    flatRows[3] = floatBitsToUint(vec4(frame.viewRight, 0.0));
    flatRows[5] = flatRows[6] = flatRows[7] = uvec4(0);
#endif
    flatRows[8] = lighting.lightEnds;
#if FLAT_LIGHTS
    for (int i = 0; i < 7 * FLAT_LIGHTS_TOTAL; ++i) flatRows[FLAT_LIGHT_ROW + i] = lightRows[i];
#endif
}

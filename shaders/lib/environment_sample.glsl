// SPDX-License-Identifier: MIT
// Rays towards the bright parts of the environment's picture. One level of it is a table of cells, each of one
// radiance: cells are drawn in proportion to their light (alias method, Walker 1977; Vose 1991), directions
// evenly within a cell. Density and radiance of a direction so are in proportion, and a small sun costs no
// noise but that of what hides it. Part of lib/voxel_light.glsl; needs ENVIRONMENT 1.

// Per cell: the share of draws that keep it, as float bits; the cell of the others.
uniform usamplerBuffer environmentCells;

// Where there are light samples on faces as well, so many of the light-sampled rays go to the surroundings.
const float kEnvironmentShare = 0.5;

vec3 environmentDirection(vec2 xi) {
    // Choose a cell by its light
    ivec2 size = textureSize(environmentPicture, int(lighting.environmentCellLevel));
    int count = size.x * size.y;
    float scaled = min(xi.x, 0.99999994) * float(count);
    int cell = int(scaled);
    uvec2 alias = texelFetch(environmentCells, cell).xy;
    float kept = uintBitsToFloat(alias.x);
    float rest = scaled - float(cell);
    bool stays = rest < kept;
    rest = stays ? rest / max(kept, 1e-12) : (rest - kept) / max(1.0 - kept, 1e-12);
    cell = stays ? cell : int(alias.y);

    // Choose a direction within it, evenly over its solid angle
    vec2 column = vec2(cell % size.x, cell / size.x);
    float turn = (column.x + clamp(rest, 0.0, 1.0)) / float(size.x) - 0.5 - lighting.environmentTurn;
    vec2 edges = cos(0.5 * kEnvironmentTurn * vec2(column.y, column.y + 1.0) / float(size.y));
    float height = mix(edges.x, edges.y, xi.y);
    float radius = sqrt(max(1.0 - height * height, 0.0));
    float azimuth = turn * kEnvironmentTurn;
    return vec3(radius * sin(azimuth), height, -radius * cos(azimuth));
}

// Radiance of a direction's cell, and its density per steradian among such rays.
vec3 environmentCell(vec3 direction, out float pdf) {
    int level = int(lighting.environmentCellLevel);
    ivec2 size = textureSize(environmentPicture, level);
    vec2 uv = environmentUv(direction);
    ivec2 cell = min(ivec2(vec2(fract(uv.x), uv.y) * vec2(size)), size - 1);
    vec3 texel = texelFetch(environmentPicture, cell, level).rgb;
    pdf = brightness(texel) * lighting.environmentInverseFlux;
    return lighting.sky + lighting.environmentScale * texel;
}

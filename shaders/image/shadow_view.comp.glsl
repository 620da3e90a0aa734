#version 450 core
// SPDX-License-Identifier: MIT
// The shadow maps of one light -> picture: distance along the map's axis in m, 0 where nothing was drawn
// (component shadow_map). The light's tiles side by side, row by row from the upper left: one for spots and
// directional lights, +x -x +y / -y +z -z for points, all sample points for area
// lights.
#include "shared/image.h"
#include "shared/scene.h"
layout(local_size_x = 8, local_size_y = 8) in;
layout(std140) uniform ShadowViewBlock { ShadowViewConstants view; };
layout(std430) readonly buffer LightTable { Light lights[]; };
uniform sampler2DArray shadowDepths;
layout(rgba32f) writeonly uniform image2D picture;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    ivec2 size = imageSize(picture);
    if (any(greaterThanEqual(pixel, size))) return;
    Light light = lights[view.light];
    // A frame of square tiles as large as fits, in the middle.
    int columns = int(view.columns), rows = int(view.rows);
    float edge = min(float(size.x) / float(columns), float(size.y) / float(rows));
    vec2 at = vec2(pixel.x, size.y - 1 - pixel.y) + 0.5 - 0.5 * (vec2(size) - edge * vec2(columns, rows));
    ivec2 cell = ivec2(floor(at / edge));
    int tile = cell.y * columns + cell.x;
    bool inside = all(greaterThanEqual(cell, ivec2(0))) && cell.x < columns && tile < int(view.tiles);
    int perEdge = int(view.tilesPerEdge);
    int tileSize = textureSize(shadowDepths, 0).x / perEdge;
    int number = light.shadow + max(tile, 0);
    int inLayer = number % (perEdge * perEdge);
    ivec2 corner = ivec2(inLayer % perEdge, inLayer / perEdge) * tileSize;
    vec2 part = at / edge - vec2(cell);
    // The map's second axis points up.
    ivec2 texel =
        corner + clamp(ivec2(vec2(part.x, 1.0 - part.y) * float(tileSize)), ivec2(0), ivec2(tileSize - 1));
    float depth = texelFetch(shadowDepths, ivec3(texel, number / (perEdge * perEdge)), 0).r;
    bool drawn = inside && depth > 0.0;
    float distance = light.type == LIGHT_DIRECTIONAL ? (1.0 - depth) / light.shadowNear
                                                     : light.shadowNear / max(depth, 1e-20);
    imageStore(picture, pixel, drawn ? vec4(vec3(distance), 1.0) : vec4(0.0));
}

// SPDX-License-Identifier: MIT
// The way of a ray through nested grids: which levels it meets, one after the other, and from where to where. Part of
// lib/ray_query.glsl. At each point it is in the finest level that holds the point. Levels are boxes in one another: a
// ray first goes inwards, then outwards. Without NESTED_GRIDS there is one, and the macros do nothing.
#if NESTED_GRIDS
// The level that rays are in: rows of bricks along z before it, its corner and its edge.
int levelBricksBefore = 0;
vec4 levelOfRay = vec4(0.0, 0.0, 0.0, 1.0);
#define STORED_BRICK(brick) ((brick) + ivec3(0, 0, levelBricksBefore))
// From the level's coordinates to those of the grid.
#define GRID_POINT(point) gridFromLevel(point, levelOfRay)
#define GRID_LENGTH(t) ((t)*levelOfRay.w)

struct LevelPath {
    int level;
    float edge;  // of its voxels, in those of level 0
    float inverse;
    float begin;  // t, as the ray counts it; begin > end: meets nothing
    float end;
    float exit;    // where the ray leaves the level, or meets the next finer one
    int next;      // level after this
    bool outward;  // finer ones lie behind
    bool goesOn;
};

// Where a ray enters and leaves the box of a level.
vec2 levelSpan(Ray ray, vec3 inverse, int level) {
    vec4 place = levelPlace(level);
    vec3 a = (place.xyz - ray.origin) * inverse;
    vec3 b = (place.xyz + place.w * levelSize() - ray.origin) * inverse;
    vec3 low = min(a, b), high = max(a, b);
    return vec2(max(max(low.x, low.y), low.z), min(min(high.x, high.y), high.z));
}

// Finds where the ray's way in path.level ends.
void endLevel(Ray ray, inout LevelPath path) {
    vec3 inverse = rayInverse(ray.direction);
    path.edge = levelPlace(path.level).w;
    path.inverse = 1.0 / path.edge;
    path.exit = levelSpan(ray, inverse, path.level).y;
    vec2 finer = levelSpan(ray, inverse, max(path.level - 1, 0));
    bool inward = !path.outward && path.level > 0 && finer.x < finer.y && finer.y > path.begin;
    path.next = inward ? path.level - 1 : path.level + 1;
    path.outward = !inward;
    // Borders of finer levels are no matter: there is nothing behind them in this one.
    path.end = min(inward ? finer.x : path.exit - kRayEnd * path.edge, ray.tMax);
    path.exit = inward ? finer.x : path.exit;
    path.goesOn = path.exit < ray.tMax && path.next <= coarsestLevel();
}

LevelPath levelPath(Ray ray) {
    LevelPath path;
    path.level = levelAt(ray.origin);
    path.outward = false;
    vec2 whole = levelSpan(ray, rayInverse(ray.direction), coarsestLevel());
    path.begin = max(whole.x, 0.0);
    endLevel(ray, path);
    bool met = whole.x < whole.y && whole.y > 0.0 && path.begin < ray.tMax;
    path.end = met ? path.end : -3e38;
    path.goesOn = met && path.goesOn;
    return path;
}

// The ray in coordinates of the level that it is in, which becomes that of STORED_BRICK.
Ray enterLevel(Ray ray, LevelPath path) {
    levelOfRay = levelPlace(path.level);
    levelBricksBefore = path.level * int(grid.bricksZ);
    return Ray(levelFromGrid(ray.origin, levelOfRay), ray.direction, ray.tMax * path.inverse,
               ray.startNormal);
}

// On to the next level, of a path that goes on.
void leaveLevel(Ray ray, inout LevelPath path) {
    path.level = path.next;
    path.begin = max(path.begin, path.exit);
    endLevel(ray, path);
}
#else
#define STORED_BRICK(brick) (brick)
#define GRID_POINT(point) (point)
#define GRID_LENGTH(t) (t)
#endif

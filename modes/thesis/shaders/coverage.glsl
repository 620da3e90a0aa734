// SPDX-License-Identifier: MIT
// How much of a pixel a triangle covers, exactly: the area of the intersection of a triangle with the unit
// square [0,1]^2. For every x the square cuts the triangle's vertical section to the difference of its two
// clamped ends, so the area is the sum over the three edges of the signed integral of clamp(y, 0, 1) dx.

// Integral of clamp(y, 0, 1) over [0, y].
float clampIntegral(float y) { return y <= 0.0 ? 0.0 : y >= 1.0 ? y - 0.5 : 0.5 * y * y; }

// Signed integral of clamp(y, 0, 1) dx along the edge, as far as x is in [0, 1].
float edgeCoverage(vec2 p, vec2 q) {
    float width = q.x - p.x;
    float slope = width != 0.0 ? (q.y - p.y) / width : 0.0;
    float x0 = clamp(p.x, 0.0, 1.0), x1 = clamp(q.x, 0.0, 1.0);
    float y0 = p.y + slope * (x0 - p.x), y1 = p.y + slope * (x1 - p.x);
    float low = min(y0, y1), high = max(y0, y1);
    // Below 1e-3 the difference of the integrals loses its digits; the middle is exact enough there.
    float mean = low >= 1.0          ? 1.0
                 : high <= 0.0       ? 0.0
                 : high - low > 1e-3 ? (clampIntegral(high) - clampIntegral(low)) / (high - low)
                                     : clamp(0.5 * (low + high), 0.0, 1.0);
    return mean * (x1 - x0);
}

float triangleCoverage(vec2 a, vec2 b, vec2 c) {
    return min(abs(edgeCoverage(a, b) + edgeCoverage(b, c) + edgeCoverage(c, a)), 1.0);
}

// Barycentric coordinates of the point of the triangle near `p`: exact inside, on the border outside.
// Triangles without area: the centre.
vec3 nearestBarycentrics(vec2 a, vec2 b, vec2 c, vec2 p) {
    float twiceArea = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    if (abs(twiceArea) < 1e-12) return vec3(1.0 / 3.0);
    vec3 w;
    w.x = ((b.x - p.x) * (c.y - p.y) - (b.y - p.y) * (c.x - p.x)) / twiceArea;
    w.y = ((c.x - p.x) * (a.y - p.y) - (c.y - p.y) * (a.x - p.x)) / twiceArea;
    w.z = 1.0 - w.x - w.y;
    w = max(w, vec3(0.0));
    return w / (w.x + w.y + w.z);
}

// SPDX-License-Identifier: MIT
// Parts of polygons -> pixels. With the box filter a pixel is the mean over its area: each part adds the area that it
// has in the pixel times its light at the middle of that area (area coverage; Catmull 1978, "A Hidden-Surface Algorithm
// with Anti-Aliasing"). With one point per pixel, a part adds its light where it holds the pixel's middle.
//
// Limits: light within a part's share of a ninth of a pixel is taken to be even; of a sixteenth where textures are on its
// way.
#pragma once

#include <vector>

#include "conelight/renderer.h"
#include "reference/beam_light.h"
#include "reference/path_tracer.h"

namespace conelight::reference {

// A part as the picture shows it.
struct BeamPiece {
    std::vector<glm::dvec2> corners;  // convex, in pixels, y down
    glm::dvec2 low{0}, high{0};
    BeamLight::Query what;
    int part = 0;         // number of the beam's part that it belongs to, over all beams
    int mirrorPart = -1;  // that of the mirror it is seen in
    int depth = 0;        // mirrors
    bool covers = true;   // hides what is behind it; else it adds to it
    bool direct = true;   // which light it is
    bool textured = false;
};

class BeamFilm {
  public:
    BeamFilm(int width, int height);

    // Adds the pieces' light to the pixels of rows [begin, end); pieces of one beam stand behind those of the beam it
    // comes from, pieces of one part together, the one that covers first. Rows may be drawn at once.
    void draw(const std::vector<BeamPiece>& pieces, const BeamLight& light, const Lens& lens,
              PixelFilter filter, int begin, int end);

    Image direct, mirrored;  // alpha: how much of the pixel shows a surface

  private:
    struct Pixel {
        int x, y;
    };
    void fill(const BeamPiece& piece, const BeamLight& light, int begin, int end);
    void add(const BeamPiece& piece, Pixel pixel, const glm::vec3& radiance, float area);
    glm::dvec2 placeOf(const glm::dvec2& inPixels) const;

    int width_, height_;
};

}  // namespace conelight::reference

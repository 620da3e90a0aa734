// SPDX-License-Identifier: MIT
// The atrium's plan: what will be built, as pieces whose triangle counts are known before they are made.
// Internal.
//
// Right-handed, y up, metres. The courtyard is kBaysX by kBaysZ bays of kBay; its middle is the origin; an
// arcade runs around it, behind that a vaulted aisle, above it a gallery.
#pragma once

#include "io/generated_scenes.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

namespace conelight::io::generated::atrium {

// Plan and elevation. Proportions after Italian courtyards of the 15th century, by eye.
constexpr int kBaysX = 5;
constexpr int kBaysZ = 3;
constexpr float kBay = 2.8f;
constexpr float kHalfX = 0.5f * kBaysX * kBay;  // to the axes of the columns
constexpr float kHalfZ = 0.5f * kBaysZ * kBay;
constexpr float kWall = 0.4f;         // outer walls
constexpr float kArcadeDepth = 0.5f;  // thickness of the wall above the columns
constexpr float kSpring = 3.0f;       // where ground-floor arches begin
constexpr float kArchRadius = 1.12f;  // clear half span
constexpr float kPanelHeight = 1.6f;  // from there to the gallery's cornice
constexpr float kGallery = 4.9f;      // floor of the gallery
constexpr float kUpperSpring = 6.75f;
constexpr float kUpperPanel = 1.1f;
constexpr float kRoof = 8.3f;
constexpr float kGlassRadius = 0.09f;  // of the lanterns
constexpr float kStep = 0.15f;         // the courtyard lies deeper than the aisles

// How finely curved things are cut: pieces = reference * scale, at least `least`. While triangles are scarce
// (not rich), small things are left out or become boxes.
class Detail {
  public:
    Detail(float scale, bool rich) : scale_(scale), rich_(rich) {}
    float scale() const { return scale_; }
    bool rich() const { return rich_; }
    int pieces(float reference, int least) const {
        return std::max(least, int(std::lround(reference * scale_)));
    }
    // Counts of small things (leaves, balusters) grow with the area's scale, up to `most`.
    int count(float reference, int least, int most) const {
        return std::clamp(int(std::lround(reference * scale_ * scale_)), least, most);
    }

  private:
    float scale_;
    bool rich_;
};

// Something that will append `triangles` triangles at most.
struct Piece {
    std::size_t triangles;
    std::function<void(Mesh&)> append;
};
Piece piece(shapes::Patch patch);
Piece piece(Mesh mesh);
void addPatches(std::vector<Piece>& pieces, std::vector<shapes::Patch> patches);

// One mesh with a material and its places.
struct Part {
    std::string name;
    int material = 0;
    std::vector<Piece> pieces;
    std::vector<glm::mat4> places{glm::mat4(1)};
    bool voxelized = true;
    bool castsShadow = true;
    std::size_t triangles() const;  // over all places
};
using Plan = std::vector<Part>;

struct Materials {
    int wall, dado, upperWall, ashlar, trim, marble, floor, galleryFloor, wood, roof;
    int red, green, blue, gold, terracotta, leaves, water, iron, lampGlass;
};
// The lanterns' glass shows the radiance of a sphere that shines with `lampIntensity`, W/sr.
Materials addMaterials(Scene& scene, float lampIntensity);

// generated_atrium_parts.cpp: what carries.
std::vector<Piece> columnShaft(const Detail& detail);
std::vector<Piece> columnTrim(const Detail& detail);  // base and capital
std::vector<Piece> colonnette(const Detail& detail);
std::vector<Piece> pier(const Detail& detail, float halfWidth, float height);  // square, with base and cap
// The wall over one arch or two: its faces, and the moulded rim with the underside.
struct ArchPanel {
    float x0, x1, centre, radius, height, depth;
};
std::vector<Piece> archFaces(const Detail& detail, const ArchPanel& panel);
std::vector<Piece> archRim(const Detail& detail, const ArchPanel& panel, float rimWidth);
std::vector<Piece> vault(const Detail& detail);
std::vector<Piece> rib(const Detail& detail);
std::vector<Piece> baluster(const Detail& detail);
std::vector<Piece> cornice(const Detail& detail, float y, float height, float projection, float inset);

// generated_atrium_decor.cpp: what hangs, stands and grows.
std::vector<Piece> curtainHalf(const Detail& detail,
                               int seed);  // gathered to -x, top edge from x = -1.1 to 0
std::vector<Piece> banner(const Detail& detail, float width, float length, int seed);
std::vector<Piece> curtainTie(const Detail& detail);
std::vector<Piece> rod(const Detail& detail, float halfLength);  // along x
std::vector<Piece> fountainStone(const Detail& detail);
std::vector<Piece> fountainWater(const Detail& detail);
std::vector<Piece> pot(const Detail& detail);
std::vector<Piece> shrub(const Detail& detail, int seed);
std::vector<Piece> lantern(const Detail& detail);
std::vector<Piece> lanternGlass(const Detail& detail);

}  // namespace conelight::io::generated::atrium

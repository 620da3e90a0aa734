// SPDX-License-Identifier: MIT
// The atrium: a courtyard of two storeys with arcade, vaulted aisles and gallery, in sun and under a blue
// sky. Triangle budget -> Scene. A plan lists every piece with its triangle count at a given detail;
// bisection finds the detail whose count is nearest to the budget; only then are vertices made. Repeated
// things are instances.
#include "io/generated_atrium.h"

#include "io/generated_figure.h"
#include "io/generated_textures.h"

#include <fmt/format.h>
#include <glm/gtc/constants.hpp>

namespace conelight::io::generated::atrium {
namespace {

constexpr glm::vec3 kLampColor{1.0f, 0.60f, 0.26f};  // about 2700 K

// Limits between which every budget of 1e4 to 1e7 triangles lies; the count is monotone up to rounding.
constexpr float kLeastDetail = 0.02f;
constexpr float kMostDetail = 32.0f;

// A local frame on the courtyard's rim: +z looks into the courtyard, the origin lies on the axis of the
// columns.
struct Bay {
    glm::mat4 worldFromBay;
    int side;   // 0: -z, 1: +z (long sides), 2: -x, 3: +x
    int index;  // along the side, toward +x or +z
};

std::vector<Bay> allBays() {
    std::vector<Bay> bays;
    for (int i = 0; i < kBaysX; ++i) {
        const float x = (float(i) + 0.5f) * kBay - kHalfX;
        bays.push_back({translation({x, 0, -kHalfZ}), 0, i});
        bays.push_back({translation({x, 0, kHalfZ}) * turnAboutY(glm::pi<float>()), 1, i});
    }
    for (int i = 0; i < kBaysZ; ++i) {
        const float z = (float(i) + 0.5f) * kBay - kHalfZ;
        bays.push_back({translation({-kHalfX, 0, z}) * turnAboutY(0.5f * glm::pi<float>()), 2, i});
        bays.push_back({translation({kHalfX, 0, z}) * turnAboutY(-0.5f * glm::pi<float>()), 3, i});
    }
    return bays;
}

// Places of the columns: corners of the courtyard are left out, they get piers.
std::vector<glm::vec3> columnPlaces() {
    std::vector<glm::vec3> places;
    for (int i = 1; i < kBaysX; ++i)
        for (float z : {-kHalfZ, kHalfZ}) places.emplace_back(float(i) * kBay - kHalfX, 0, z);
    for (int i = 1; i < kBaysZ; ++i)
        for (float x : {-kHalfX, kHalfX}) places.emplace_back(x, 0, float(i) * kBay - kHalfZ);
    return places;
}

std::vector<glm::vec3> cornerPlaces() {
    return {{-kHalfX, 0, -kHalfZ}, {kHalfX, 0, -kHalfZ}, {-kHalfX, 0, kHalfZ}, {kHalfX, 0, kHalfZ}};
}

std::vector<glm::mat4> at(const std::vector<glm::vec3>& places, float y) {
    std::vector<glm::mat4> matrices;
    for (const glm::vec3& p : places) matrices.push_back(translation(p + glm::vec3(0, y, 0)));
    return matrices;
}

// Walls, floors, gallery slab and roof, as one closed lattice solid.
void planShell(Plan& plan, const Materials& m) {
    const glm::vec2 inner(kHalfX + kBay, kHalfZ + kBay);  // face of the outer walls
    const glm::vec2 outer = inner + kWall;
    const glm::vec2 edge = glm::vec2(kHalfX, kHalfZ) - 0.5f * kArcadeDepth;  // of slab and roof
    const glm::vec2 court = glm::vec2(kHalfX, kHalfZ) - 0.42f;               // of the step
    constexpr float kSlab = kSpring + kPanelHeight;
    constexpr float kCeiling = kUpperSpring + kUpperPanel;
    constexpr float kDado = 1.15f;
    constexpr float kBottom = -0.45f;
    shapes::CellSolid shell;
    for (std::size_t a : {0u, 2u}) {
        const int k = a == 0 ? 0 : 1;
        shell.planes[a] = {-outer[k], -inner[k], -edge[k], -court[k], court[k], edge[k], inner[k], outer[k]};
    }
    shell.planes[1] = {kBottom, -kStep, 0, kDado, kSlab, kGallery, kCeiling, kRoof};
    auto within = [](glm::vec3 p, glm::vec2 half) {
        return std::abs(p.x) < half.x && std::abs(p.z) < half.y;
    };
    shell.solid = [=](glm::vec3 p) {
        if (!within(p, inner) || p.y < -kStep) return true;
        if (p.y < 0) return !within(p, court);
        const bool slab = (p.y > kSlab && p.y < kGallery) || p.y > kCeiling;
        return slab && !within(p, edge);
    };
    enum {
        kWallPart,
        kDadoPart,
        kUpperPart,
        kCourtPart,
        kAislePart,
        kGalleryPart,
        kCeilingPart,
        kEdgePart,
        kOutsidePart,
        kRoofPart,
        kParts
    };
    shell.part = [=](glm::vec3 p, glm::vec3 n) -> int {
        if (p.y > kRoof - 0.01f) return kRoofPart;
        if (!within(p, inner + 0.01f) || p.y < kBottom + 0.01f) return kOutsidePart;
        if (n.y > 0.5f) return p.y < -0.01f ? kCourtPart : p.y < 1 ? kAislePart : kGalleryPart;
        if (n.y < -0.5f) return p.y > kGallery ? kCeilingPart : kWallPart;
        if (within(p, edge + 0.01f)) return kEdgePart;
        return p.y < kDado ? kDadoPart : p.y < kGallery ? kWallPart : kUpperPart;
    };
    const std::pair<const char*, int> looks[kParts] = {{"aisle walls", m.wall},
                                                       {"dado", m.dado},
                                                       {"gallery walls", m.upperWall},
                                                       {"courtyard floor", m.floor},
                                                       {"aisle floor", m.galleryFloor},
                                                       {"gallery floor", m.galleryFloor},
                                                       {"gallery ceiling", m.wood},
                                                       {"slab edges", m.ashlar},
                                                       {"outside", m.wall},
                                                       {"roof", m.roof}};
    std::vector<Mesh> meshes = shapes::buildCells(shell, kParts);
    for (std::size_t i = 0; i < kParts; ++i)
        plan.push_back({looks[i].first, looks[i].second, {piece(std::move(meshes[i]))}});
}

void planGroundFloor(Plan& plan, const Materials& m, const Detail& detail) {
    const std::vector<glm::mat4> columns = at(columnPlaces(), 0);
    plan.push_back({"column shaft", m.marble, columnShaft(detail), columns});
    plan.push_back({"column base and capital", m.trim, columnTrim(detail), columns});
    plan.push_back({"corner pier", m.ashlar, pier(detail, 0.27f, kSpring), at(cornerPlaces(), 0)});

    const ArchPanel panel{-0.5f * kBay, 0.5f * kBay, 0, kArchRadius, kPanelHeight, kArcadeDepth};
    std::vector<glm::mat4> arches;
    for (const Bay& bay : allBays()) arches.push_back(bay.worldFromBay * translation({0, kSpring, 0}));
    plan.push_back({"arch wall", m.ashlar, archFaces(detail, panel), arches});
    plan.push_back({"arch moulding", m.trim, archRim(detail, panel, 0.22f), arches});

    // The aisle: a vault over every square, ribs between them, pilasters under the ribs at the wall.
    std::vector<glm::mat4> vaults, ribs, pilasters;
    for (int i = -1; i <= kBaysX; ++i)
        for (int j = -1; j <= kBaysZ; ++j) {
            const bool courtyard = i >= 0 && i < kBaysX && j >= 0 && j < kBaysZ;
            if (!courtyard)
                vaults.push_back(translation(
                    {(float(i) + 0.5f) * kBay - kHalfX, kSpring, (float(j) + 0.5f) * kBay - kHalfZ}));
        }
    const float middle = 0.5f * kBay, wall = kBay - 0.09f;
    for (int i = 0; i <= kBaysX; ++i)
        for (float s : {-1.0f, 1.0f}) {
            const float x = float(i) * kBay - kHalfX;
            ribs.push_back(translation({x, kSpring, s * (kHalfZ + middle)}) *
                           turnAboutY(0.5f * glm::pi<float>()));
            pilasters.push_back(translation({x, 0, s * (kHalfZ + wall)}));
        }
    for (int i = 0; i <= kBaysZ; ++i)
        for (float s : {-1.0f, 1.0f}) {
            const float z = float(i) * kBay - kHalfZ;
            ribs.push_back(translation({s * (kHalfX + middle), kSpring, z}));
            pilasters.push_back(translation({s * (kHalfX + wall), 0, z}));
        }
    plan.push_back({"vault", m.wall, vault(detail), vaults});
    plan.push_back({"rib", m.trim, rib(detail), ribs});
    plan.push_back({"pilaster", m.trim, pier(detail, 0.20f, kSpring), pilasters});

    // Doors in the middle of the end walls: two leaves in a stone frame.
    std::vector<Piece> leaves{piece(box({{-0.78f, 0, 0}, {-0.01f, 2.5f, 0.07f}})),
                              piece(box({{0.01f, 0, 0}, {0.78f, 2.5f, 0.07f}}))};
    std::vector<Piece> frame{piece(box({{-0.98f, 0, 0}, {-0.78f, 2.5f, 0.12f}})),
                             piece(box({{0.78f, 0, 0}, {0.98f, 2.5f, 0.12f}})),
                             piece(box({{-1.02f, 2.5f, 0}, {1.02f, 2.74f, 0.14f}})),
                             piece(box({{-1.12f, 2.74f, 0}, {1.12f, 2.84f, 0.24f}}))};
    const std::vector<glm::mat4> doors{
        translation({-kHalfX - kBay, 0, 0}) * turnAboutY(0.5f * glm::pi<float>()),
        translation({kHalfX + kBay, 0, 0}) * turnAboutY(-0.5f * glm::pi<float>())};
    plan.push_back({"door", m.wood, std::move(leaves), doors});
    plan.push_back({"door frame", m.trim, std::move(frame), doors});
}

void planBalustrade(Plan& plan, const Materials& m, const Detail& detail) {
    // The balustrade stands between the piers; few balusters while triangles are scarce.
    const int perSide = detail.scale() < 0.25f ? 3 : 5;
    constexpr float kRailBottom = 0.10f, kRailTop = 0.76f;
    std::vector<glm::mat4> balusters, rails;
    for (const Bay& bay : allBays()) {
        rails.push_back(bay.worldFromBay * translation({0, kGallery, 0}));
        for (float s : {-1.0f, 1.0f})
            for (int i = 0; i < perSide; ++i) {
                const float x = s * (0.13f + (float(i) + 0.5f) * (1.22f - 0.13f) / float(perSide));
                balusters.push_back(bay.worldFromBay * translation({x, kGallery + kRailBottom, 0}));
            }
    }
    // A solid parapet stands in for them while there is no budget at all.
    if (detail.rich())
        plan.push_back({"baluster", m.trim, baluster(detail), balusters});
    else
        plan.push_back({"parapet",
                        m.trim,
                        {piece(box({{-1.23f, kRailBottom, -0.05f}, {1.23f, kRailTop, 0.05f}}))},
                        rails});
    std::vector<Piece> rail{piece(box({{-1.23f, 0, -0.09f}, {1.23f, 0.10f, 0.09f}})),
                            piece(box({{-1.23f, 0.76f, -0.08f}, {1.23f, 0.80f, 0.08f}})),
                            piece(box({{-1.23f, 0.80f, -0.11f}, {1.23f, 0.88f, 0.11f}}))};
    plan.push_back({"rail", m.trim, std::move(rail), rails});
}

void planGallery(Plan& plan, const Materials& m, const Detail& detail) {
    const std::vector<Bay> bays = allBays();
    std::vector<glm::vec3> pierPlaces = columnPlaces();
    for (const glm::vec3& p : cornerPlaces()) pierPlaces.push_back(p);
    plan.push_back(
        {"gallery pier", m.ashlar, pier(detail, 0.17f, kUpperSpring - kGallery), at(pierPlaces, kGallery)});

    // Two small arches per bay on a colonnette.
    std::vector<glm::mat4> colonnettes, left, right;
    for (const Bay& bay : bays) {
        colonnettes.push_back(bay.worldFromBay * translation({0, kGallery, 0}));
        left.push_back(bay.worldFromBay * translation({0, kUpperSpring, 0}));
        right.push_back(left.back());
    }
    const ArchPanel leftPanel{-0.5f * kBay, 0, -0.65f, 0.57f, kUpperPanel, 0.4f};
    const ArchPanel rightPanel{0, 0.5f * kBay, 0.65f, 0.57f, kUpperPanel, 0.4f};
    plan.push_back({"colonnette", m.marble, colonnette(detail), colonnettes});
    plan.push_back({"left gallery arch", m.ashlar, archFaces(detail, leftPanel), left});
    plan.push_back({"right gallery arch", m.ashlar, archFaces(detail, rightPanel), right});
    plan.push_back({"left gallery moulding", m.trim, archRim(detail, leftPanel, 0.12f), left});
    plan.push_back({"right gallery moulding", m.trim, archRim(detail, rightPanel, 0.12f), right});

    plan.push_back({"gallery cornice", m.trim,
                    cornice(detail, kSpring + kPanelHeight - 0.06f, 0.40f, 0.30f, 0.5f * kArcadeDepth)});
    plan.push_back(
        {"roof cornice", m.trim, cornice(detail, kRoof - 0.50f, 0.55f, 0.50f, 0.5f * kArcadeDepth)});

    // Dentils under the roof, eight per bay; beams under the gallery's ceiling.
    std::vector<glm::mat4> dentils, beams;
    for (const Bay& bay : bays) {
        for (int i = 0; i < 8; ++i)
            dentils.push_back(bay.worldFromBay * translation({(float(i) + 0.5f) * kBay / 8 - 0.5f * kBay,
                                                              kRoof - 0.62f, 0.5f * kArcadeDepth}));
        for (float x : {-0.5f * kBay, 0.0f})
            beams.push_back(bay.worldFromBay *
                            translation({x, kUpperSpring + kUpperPanel - 0.18f, -0.5f * kBay}));
    }
    if (detail.rich())
        plan.push_back(
            {"dentil", m.trim, {piece(box({{-0.08f, 0, -0.02f}, {0.08f, 0.14f, 0.13f}}))}, dentils});
    plan.push_back({"beam",
                    m.wood,
                    {piece(box({{-0.09f, 0, -0.5f * kBay}, {0.09f, 0.19f, 0.5f * kBay - 0.15f}}))},
                    beams});
}

void planTextiles(Plan& plan, const Materials& m, const Detail& detail) {
    // Curtains in every other ground-floor arch of the long sides; colours in turn, other ones opposite.
    const int colors[3] = {m.red, m.green, m.blue};
    const char* colorNames[3] = {"red", "green", "blue"};
    std::vector<glm::mat4> rods, ties;
    std::vector<glm::mat4> halves[3], banners[2], drapes[3];
    for (const Bay& bay : allBays()) {
        if (bay.side > 1) continue;
        const bool curtained = bay.index % 2 == 0;
        const int color = (bay.index / 2 + (bay.side == 0 ? 0 : 2)) % 3;
        const glm::mat4 top = bay.worldFromBay * translation({0, kSpring - 0.10f, 0});
        if (curtained) {
            rods.push_back(top);
            for (const glm::mat4& half : {top, top * turnAboutY(glm::pi<float>())}) {
                halves[color].push_back(half);
                ties.push_back(half);
            }
        } else {
            banners[bay.index / 2 % 2].push_back(bay.worldFromBay *
                                                 translation({0, kGallery + 0.74f, 0.36f}));
        }
        // Upstairs, short cloths in some of the small arches.
        const int upper = (bay.index + 2 * bay.side) % 3;
        if (upper < 2)
            drapes[(bay.index + bay.side) % 3].push_back(
                bay.worldFromBay * translation({upper == 0 ? -0.65f : 0.65f, kUpperSpring - 0.02f, -0.12f}));
    }
    for (int c = 0; c < 3; ++c) {
        plan.push_back(
            {fmt::format("{} curtain", colorNames[c]), colors[c], curtainHalf(detail, c + 1), halves[c]});
        plan.push_back({fmt::format("{} drape", colorNames[c]), colors[c],
                        banner(detail, 1.02f, 1.25f, 11 + c), drapes[c]});
    }
    if (detail.rich()) plan.push_back({"curtain tie", m.gold, curtainTie(detail), ties});
    plan.push_back({"curtain rod", m.iron, rod(detail, 1.25f), rods});
    plan.push_back({"gold banner", m.gold, banner(detail, 1.15f, 2.3f, 21), banners[0]});
    plan.push_back({"red banner", m.red, banner(detail, 1.15f, 2.3f, 22), banners[1]});
}

// Places of the lanterns, shared with their lights.
std::vector<glm::vec3> lanternPlaces() {
    std::vector<glm::vec3> places;
    for (float x : {-kBay, kBay})
        for (float z : {-1.0f, 1.0f}) places.emplace_back(x, kSpring + 0.18f, z * (kHalfZ + 0.5f * kBay));
    return places;
}

void planGarden(Plan& plan, const Materials& m, const Detail& detail) {
    const std::vector<glm::mat4> middle{translation({0, -kStep, 0})};
    plan.push_back({"fountain", m.marble, fountainStone(detail), middle});
    plan.push_back({"water", m.water, fountainWater(detail), middle});
    std::vector<glm::mat4> pots, shrubs[2];
    for (int i = 0; i < 8; ++i) {
        const float x = (float(i % 4) - 1.5f) * kBay, z = i < 4 ? -1.0f : 1.0f;
        const glm::mat4 place = translation({x, -kStep, z * (kHalfZ - 0.85f)}) * turnAboutY(float(i));
        pots.push_back(place);
        shrubs[i % 2].push_back(place);
    }
    plan.push_back({"pot", m.terracotta, pot(detail), pots});
    for (int i = 0; i < 2; ++i)
        plan.push_back({fmt::format("shrub {}", i + 1), m.leaves, shrub(detail, i), shrubs[i]});

    // Lanterns shine as point lights; their glass only shows it, or the light would count twice.
    Part frame{"lantern", m.iron, lantern(detail), at(lanternPlaces(), 0)};
    frame.castsShadow = false;
    Part glass{"lantern glass", m.lampGlass, lanternGlass(detail), frame.places};
    glass.castsShadow = glass.voxelized = false;
    plan.push_back(std::move(frame));
    plan.push_back(std::move(glass));
}

Plan makePlan(const Materials& m, const Detail& detail) {
    Plan plan;
    planShell(plan, m);
    planGroundFloor(plan, m, detail);
    planGallery(plan, m, detail);
    planBalustrade(plan, m, detail);
    planTextiles(plan, m, detail);
    planGarden(plan, m, detail);
    return plan;
}

std::size_t triangles(const Plan& plan) {
    std::size_t sum = 0;
    for (const Part& part : plan) sum += part.triangles();
    return sum;
}

// The plan whose triangle count is nearest to the budget, rich if that comes near enough.
Plan planForBudget(const Materials& m, double budget) {
    constexpr double kNear = 0.05;
    Plan best;
    double bestError = 1e30;
    for (bool rich : {true, false}) {
        float lo = std::log(kLeastDetail), hi = std::log(kMostDetail);
        for (int i = 0; i < 20; ++i) {
            const float mid = 0.5f * (lo + hi);
            Plan plan = makePlan(m, Detail(std::exp(mid), rich));
            const double count = double(triangles(plan));
            (count < budget ? lo : hi) = mid;
            const double error = std::abs(count / budget - 1);
            if (error >= bestError) continue;
            bestError = error;
            best = std::move(plan);
        }
        if (bestError < kNear) break;
    }
    return best;
}

void build(Scene& scene, const Plan& plan) {
    for (const Part& part : plan) {
        Mesh mesh;
        mesh.name = part.name;
        for (const Piece& p : part.pieces) p.append(mesh);
        if (scene.materials[std::size_t(part.material)].normalTexture.used()) shapes::computeTangents(mesh);
        const int index = add(scene, std::move(mesh));
        for (std::size_t i = 0; i < part.places.size(); ++i) {
            std::string name = part.places.size() == 1 ? part.name : fmt::format("{} {}", part.name, i + 1);
            Instance& instance = place(scene, index, part.material, std::move(name), part.places[i]);
            instance.voxelized = part.voxelized;
            instance.castsShadow = part.castsShadow;
        }
    }
}

void addLights(Scene& scene, const Values& values) {
    // The sun stands 62 degrees high: it lights the floor's half and one long side, down into its aisle.
    scene.lights.push_back(
        sunLight("sun", {-0.34f, -1.0f, -0.42f}, float(values["sun"]) * glm::vec3(1.0f, 0.92f, 0.78f)));
    scene.sky = float(values["sky"]) * glm::vec3(0.50f, 0.72f, 1.0f);
    int number = 0;
    for (const glm::vec3& p : lanternPlaces())
        scene.lights.push_back(
            pointLight(fmt::format("lantern {}", ++number), p, float(values["lamps"]) * kLampColor));
}

void addCameras(Scene& scene) {
    scene.cameras.push_back(camera("courtyard", {6.1f, 1.75f, 2.1f}, {-4.6f, 2.45f, -1.5f}, 62));
    scene.cameras.push_back(camera("aisle", {8.0f, 1.65f, -5.9f}, {-6.0f, 2.0f, -5.3f}, 62));
    scene.cameras.push_back(camera("gallery", {-4.9f, 6.4f, 3.75f}, {3.2f, 1.2f, -2.4f}, 62));
    scene.cameras.push_back(camera("above", {13.0f, 15.0f, 13.0f}, {0, 2.0f, 0}, 50));
}

}  // namespace

Piece piece(shapes::Patch patch) {
    const std::size_t count = patch.triangleCount();
    return {count, [patch = std::move(patch)](Mesh& mesh) { shapes::appendPatch(mesh, patch); }};
}

Piece piece(Mesh flat) {
    const std::size_t count = flat.triangleCount();
    return {count, [flat = std::move(flat)](Mesh& mesh) {
                const auto first = std::uint32_t(mesh.positions.size());
                mesh.positions.insert(mesh.positions.end(), flat.positions.begin(), flat.positions.end());
                mesh.normals.insert(mesh.normals.end(), flat.normals.begin(), flat.normals.end());
                mesh.uvs.insert(mesh.uvs.end(), flat.uvs.begin(), flat.uvs.end());
                for (std::uint32_t i : flat.indices) mesh.indices.push_back(first + i);
            }};
}

void addPatches(std::vector<Piece>& pieces, std::vector<shapes::Patch> patches) {
    for (shapes::Patch& patch : patches) pieces.push_back(piece(std::move(patch)));
}

std::size_t Part::triangles() const {
    std::size_t sum = 0;
    for (const Piece& p : pieces) sum += p.triangles;
    return sum * places.size();
}

Materials addMaterials(Scene& scene, float lampIntensity) {
    textures::Surface ashlarSurface = textures::ashlar(512), tileSurface = textures::tiles(512);
    const int ashlar = add(scene, std::move(ashlarSurface.color)),
              ashlarNormal = add(scene, std::move(ashlarSurface.normal));
    const int tiles = add(scene, std::move(tileSurface.color)),
              tilesNormal = add(scene, std::move(tileSurface.normal));
    const int tilesRoughness = add(scene, std::move(tileSurface.roughness));
    const int plaster = add(scene, textures::plaster(256)), marble = add(scene, textures::marble(256));
    const int fabric = add(scene, textures::fabric(256)), wood = add(scene, textures::wood(256));

    auto textured = [&](Material material, int texture, float metres) {
        material.baseColorTexture = repeat(texture, metres);
        return material;
    };
    auto cloth = [&](const char* name, glm::vec3 color) {
        Material material = textured(matte(name, color), fabric, 0.5f);
        material.doubleSided = true;
        return add(scene, std::move(material));
    };
    Materials m;
    m.wall = add(scene, textured(matte("plaster", {0.70f, 0.62f, 0.50f}), plaster, 2.1f));
    m.dado = add(scene, textured(matte("dado", {0.40f, 0.13f, 0.08f}), plaster, 1.3f));
    m.upperWall = add(scene, textured(matte("ochre plaster", {0.68f, 0.47f, 0.22f}), plaster, 2.1f));
    Material stone = textured(glossy("limestone blocks", {0.68f, 0.60f, 0.49f}, 0.85f), ashlar, 1.4f);
    stone.normalTexture = repeat(ashlarNormal, 1.4f);
    m.ashlar = add(scene, std::move(stone));
    Material trim = textured(glossy("limestone", {0.72f, 0.65f, 0.54f}, 0.8f), plaster, 0.9f);
    trim.doubleSided = true;  // leaves of the capitals
    m.trim = add(scene, std::move(trim));
    m.marble = add(scene, textured(glossy("marble", {0.74f, 0.71f, 0.66f}, 0.35f), marble, 1.1f));
    Material floor = textured(glossy("tiles", {0.92f, 0.92f, 0.92f}, 1.0f), tiles, 1.4f);
    floor.normalTexture = repeat(tilesNormal, 1.4f);
    floor.metallicRoughnessTexture = repeat(tilesRoughness, 1.4f);
    m.floor = add(scene, std::move(floor));
    m.galleryFloor = add(scene, textured(glossy("flagstones", {0.50f, 0.44f, 0.36f}, 0.6f), ashlar, 2.0f));
    m.wood = add(scene, textured(matte("wood", {0.30f, 0.17f, 0.09f}), wood, 0.8f));
    m.roof = add(scene, matte("roof", {0.30f, 0.14f, 0.09f}));
    m.red = cloth("red fabric", {0.62f, 0.03f, 0.03f});
    m.green = cloth("green fabric", {0.04f, 0.36f, 0.08f});
    m.blue = cloth("blue fabric", {0.03f, 0.10f, 0.55f});
    m.gold = cloth("gold fabric", {0.62f, 0.35f, 0.05f});
    m.terracotta = add(scene, textured(matte("terracotta", {0.55f, 0.24f, 0.13f}), plaster, 0.7f));
    Material leaves = glossy("leaves", {0.09f, 0.22f, 0.04f}, 0.55f);
    leaves.doubleSided = true;
    m.leaves = add(scene, std::move(leaves));
    m.water = add(scene, glossy("water", {0.03f, 0.07f, 0.07f}, 0.06f));
    m.iron = add(scene, metal("iron", {0.20f, 0.19f, 0.18f}, 0.5f));
    m.lampGlass = add(
        scene,
        emitter("lamp glass", lampIntensity / (glm::pi<float>() * kGlassRadius * kGlassRadius) * kLampColor));
    return m;
}

}  // namespace conelight::io::generated::atrium

namespace conelight::io::generated {

Scene buildAtrium(const Values& values) {
    Scene scene;
    const atrium::Materials materials = atrium::addMaterials(scene, float(values["lamps"]));
    atrium::build(scene, atrium::planForBudget(materials, values["triangles"]));
    atrium::addLights(scene, values);
    atrium::addCameras(scene);
    if (values["figure"] > 0) addWalkingFigure(scene, {0.2f, -atrium::kStep, -2.35f});
    return scene;
}

}  // namespace conelight::io::generated

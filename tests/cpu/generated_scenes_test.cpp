// SPDX-License-Identifier: MIT
// Generated scenes: what their specifications accept and refuse, and what every one of them must fulfil:
// valid tables, outward winding, closed rooms, the same bits every time, a camera that stands in free space.
#include "conelight/error.h"
#include "io/generated.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <set>
#include <tuple>

namespace conelight {
namespace {

using io::generatedScenes;
using io::generateScene;

// ---- Specifications -------------------------------------------------------------------------------------

// The message of the usage error that `spec` must give.
std::string usageError(const std::string& spec) {
    try {
        generateScene(spec);
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::Usage) << spec;
        return error.what();
    }
    ADD_FAILURE() << spec << " is accepted";
    return {};
}

TEST(GeneratedScenes, ListsEveryPromisedScene) {
    std::set<std::string_view> names;
    for (const io::GeneratedSceneInfo& info : generatedScenes()) {
        EXPECT_TRUE(names.insert(info.name).second) << info.name << " is listed twice";
        EXPECT_FALSE(info.description.empty()) << info.name;
        EXPECT_EQ(info.description.find('\n'), std::string_view::npos) << info.name;
        for (const io::GeneratedParameter& p : info.parameters) {
            EXPECT_LT(p.min, p.max) << info.name << " " << p.name;
            EXPECT_GE(p.defaultValue, p.min) << info.name << " " << p.name;
            EXPECT_LE(p.defaultValue, p.max) << info.name << " " << p.name;
            EXPECT_FALSE(p.meaning.empty()) << info.name << " " << p.name;
        }
    }
    for (std::string_view promised : {"cornell", "cornell-point", "furnace", "leak", "sunroom", "corridor",
                                      "atrium", "glossy", "spheres"})
        EXPECT_TRUE(names.count(promised)) << promised;
}

TEST(GeneratedScenes, UnknownNameListsTheKnown) {
    const std::string message = usageError("kornell");
    EXPECT_NE(message.find("kornell"), std::string::npos);
    for (const io::GeneratedSceneInfo& info : generatedScenes())
        EXPECT_NE(message.find(info.name), std::string::npos) << info.name;
    EXPECT_EQ(message.find('\n'), std::string::npos);
    usageError("");
    usageError("?albedo=0.5");
    usageError("furnace ");
}

TEST(GeneratedScenes, UnknownKeyListsTheKnownWithRanges) {
    const std::string message = usageError("furnace?colour=1");
    for (const char* part : {"colour", "albedo=0..0.99", "emission=0..10000", "default 0.5"})
        EXPECT_NE(message.find(part), std::string::npos) << part << " in: " << message;
    EXPECT_EQ(message.find('\n'), std::string::npos);
}

TEST(GeneratedScenes, RefusesBadValues) {
    for (const char* spec :
         {"furnace?albedo=", "furnace?albedo", "furnace?albedo=x", "furnace?albedo=0.5x",
          "furnace?albedo=nan", "furnace?albedo=inf", "furnace?albedo=-0.1", "furnace?albedo=1",
          "furnace?albedo=0,5", "furnace?albedo= 0.5", "furnace?albedo=0.1&albedo=0.2", "furnace?&albedo=0.1",
          "furnace?albedo=0.1&&emission=1", "spheres?rows=2.5", "furnace?albedo=1e999", "furnace?Albedo=0.5",
          "furnace?albedo=0.5?emission=1"})
        EXPECT_NE(usageError(spec).find("builtin:"), std::string::npos) << spec;
}

TEST(GeneratedScenes, ReadsEveryValue) {
    const Scene scene = generateScene("furnace?emission=2.5&albedo=0.25");
    ASSERT_EQ(scene.materials.size(), 1u);
    EXPECT_EQ(scene.materials[0].baseColor, glm::vec4(0.25f, 0.25f, 0.25f, 1));
    EXPECT_EQ(scene.materials[0].emission, glm::vec3(2.5f));
    EXPECT_EQ(scene.materials[0].specular, 0.0f);  // purely Lambertian
    EXPECT_TRUE(scene.lights.empty());
    EXPECT_EQ(scene.sky, glm::vec3(0));
    EXPECT_EQ(generateScene("furnace").materials[0].baseColor.r, 0.5f);
    EXPECT_EQ(generateScene("furnace?").materials[0].emission, glm::vec3(1));
    EXPECT_EQ(generateScene("furnace?albedo=2e-1").materials[0].baseColor.r, 0.2f);
}

// ---- What all scenes fulfil -----------------------------------------------------------------------------

// Scenes of the kinds that people model, of 50,000 triangles and more.
constexpr std::string_view kModelled[] = {"street", "counter", "workshop", "bathroom", "greenhouse",
                                          "cafe",   "attic",   "cellar",   "town"};

// Every scene at its defaults and at both ends of each parameter; of large ones only what changes their shape.
std::vector<std::string> allSpecs() {
    std::vector<std::string> specs{"atrium?triangles=10000", "atrium?triangles=60000", "street?leaves=100"};
    for (const io::GeneratedSceneInfo& info : generatedScenes()) {
        specs.emplace_back(info.name);
        if (info.name == "atrium" || std::ranges::count(kModelled, info.name) > 0) continue;
        for (const io::GeneratedParameter& p : info.parameters)
            for (double value : {p.min, p.max})
                specs.push_back(std::string(info.name) + "?" + std::string(p.name) + "=" +
                                std::to_string(value));
    }
    return specs;
}

// Scenes that several tests only look at are made once.
const Scene& sharedScene(const std::string& spec) {
    static std::map<std::string, Scene> scenes;
    const auto found = scenes.find(spec);
    return found != scenes.end() ? found->second : scenes.emplace(spec, generateScene(spec)).first->second;
}

struct Triangle {
    glm::vec3 a, b, c;
};

template <class Visit>  // visit(instance, corners in world space, indices)
void forEachTriangle(const Scene& scene, Visit visit) {
    for (const Instance& instance : scene.instances) {
        const Mesh& mesh = scene.meshes[std::size_t(instance.mesh)];
        for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
            const std::uint32_t* t = &mesh.indices[i];
            auto corner = [&](int k) {
                return glm::vec3(instance.worldFromObject * glm::vec4(mesh.positions[t[k]], 1));
            };
            visit(instance, Triangle{corner(0), corner(1), corner(2)}, t);
        }
    }
}

TEST(GeneratedScenes, TablesAreValidAndNamed) {
    for (const std::string& spec : allSpecs()) {
        SCOPED_TRACE(spec);
        const Scene& scene = sharedScene(spec);
        EXPECT_NO_THROW(scene.validate());
        EXPECT_EQ(scene.name, spec);
        ASSERT_FALSE(scene.cameras.empty());
        for (const Mesh& m : scene.meshes) {
            EXPECT_FALSE(m.name.empty());
            EXPECT_FALSE(m.indices.empty()) << m.name;
            EXPECT_EQ(m.normals.size(), m.positions.size()) << m.name;
            EXPECT_EQ(m.uvs.size(), m.positions.size()) << m.name;
        }
        std::set<std::string> cameraNames;
        for (const Camera& c : scene.cameras) EXPECT_TRUE(cameraNames.insert(c.name).second) << c.name;
        for (const Instance& i : scene.instances) EXPECT_FALSE(i.name.empty());
        for (const Light& l : scene.lights) EXPECT_FALSE(l.name.empty());
        for (const Material& m : scene.materials) {
            EXPECT_FALSE(m.name.empty());
            // Nothing reflects all that it gets: the light in a closed room stays finite. What is unlit shines
            // with its color instead.
            for (int k = 0; k < 3 && !m.unlit; ++k) EXPECT_LE(m.baseColor[k], 0.99f) << m.name;
        }
        // Somebody gives light.
        bool glows = !scene.lights.empty() || scene.sky != glm::vec3(0);
        for (const Material& m : scene.materials) glows = glows || m.emission != glm::vec3(0);
        if (spec.find("=0.000000") == std::string::npos) {
            EXPECT_TRUE(glows);
        }
    }
}

TEST(GeneratedScenes, NormalsAgreeWithWinding) {
    for (const std::string& spec : allSpecs()) {
        SCOPED_TRACE(spec);
        const Scene& scene = sharedScene(spec);
        for (const Mesh& mesh : scene.meshes) {
            std::size_t wrong = 0;
            for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
                const std::uint32_t* t = &mesh.indices[i];
                const glm::vec3 n = glm::cross(mesh.positions[t[1]] - mesh.positions[t[0]],
                                               mesh.positions[t[2]] - mesh.positions[t[0]]);
                EXPECT_GT(glm::length(n), 0.0f) << mesh.name << " has a triangle without area";
                if (glm::dot(n, mesh.normals[t[0]] + mesh.normals[t[1]] + mesh.normals[t[2]]) <= 0) ++wrong;
            }
            EXPECT_EQ(wrong, 0u) << mesh.name << " of " << mesh.triangleCount();
            for (const glm::vec3& n : mesh.normals) ASSERT_NEAR(glm::length(n), 1.0f, 1e-4f) << mesh.name;
        }
        for (const Instance& i : scene.instances)
            EXPECT_GT(glm::determinant(glm::mat3(i.worldFromObject)), 0.0f) << i.name << " is mirrored";
    }
}

TEST(GeneratedScenes, TangentsComeWithNormalMaps) {
    for (const std::string& spec : allSpecs()) {
        SCOPED_TRACE(spec);
        const Scene& scene = sharedScene(spec);
        for (const Instance& i : scene.instances) {
            const Mesh& mesh = scene.meshes[std::size_t(i.mesh)];
            if (!scene.materials[std::size_t(i.material)].normalTexture.used()) continue;
            ASSERT_EQ(mesh.tangents.size(), mesh.positions.size()) << mesh.name;
            for (std::size_t v = 0; v < mesh.tangents.size(); ++v) {
                ASSERT_NEAR(glm::length(glm::vec3(mesh.tangents[v])), 1.0f, 1e-4f) << mesh.name;
                ASSERT_NEAR(glm::dot(glm::vec3(mesh.tangents[v]), mesh.normals[v]), 0.0f, 1e-3f) << mesh.name;
                ASSERT_EQ(std::abs(mesh.tangents[v].w), 1.0f) << mesh.name;
            }
        }
    }
}

// Half-edges by welded end points. Positions that should coincide come from the same sums, or differ by
// rounding: they are welded on a lattice of 10 micrometres.
using Point = std::array<long, 3>;
Point weld(glm::vec3 p) {
    return {std::lround(double(p.x) * 1e5), std::lround(double(p.y) * 1e5), std::lround(double(p.z) * 1e5)};
}

void expectWatertight(const Scene& scene) {
    std::map<std::pair<Point, Point>, int> balance;  // an edge and its opposite cancel
    std::map<std::pair<Point, Point>, int> uses;
    forEachTriangle(scene, [&](const Instance&, const Triangle& t, const std::uint32_t*) {
        const Point p[3] = {weld(t.a), weld(t.b), weld(t.c)};
        for (int k = 0; k < 3; ++k) {
            const Point& from = p[k];
            const Point& to = p[(k + 1) % 3];
            const bool forward = from < to;
            const auto edge = forward ? std::pair(from, to) : std::pair(to, from);
            balance[edge] += forward ? 1 : -1;
            uses[edge] += 1;
        }
    });
    std::size_t open = 0, shared = 0;
    for (const auto& [edge, sum] : balance) open += sum != 0;
    for (const auto& [edge, count] : uses) shared += count != 2;
    EXPECT_EQ(open, 0u) << "edges without a partner in the opposite direction";
    EXPECT_EQ(shared, 0u) << "edges not shared by exactly two triangles";
}

TEST(GeneratedScenes, MeasurementRoomsAreClosed) {
    for (const char* spec : {"furnace", "furnace?albedo=0.9", "cornell-point", "leak", "leak?angle=20",
                             "leak?angle=-40&thickness=0.2", "leak?thickness=0.0005", "corridor"}) {
        SCOPED_TRACE(spec);
        expectWatertight(generateScene(spec));
    }
}

// Does anything of the scene lie between `from` and `to`?
bool blocked(const Scene& scene, glm::vec3 from, glm::vec3 to) {
    bool hit = false;
    const glm::vec3 d = to - from;
    forEachTriangle(scene, [&](const Instance&, const Triangle& t, const std::uint32_t*) {
        const glm::vec3 e1 = t.b - t.a, e2 = t.c - t.a, p = glm::cross(d, e2);
        const float det = glm::dot(e1, p);
        if (det == 0) return;
        const glm::vec3 s = from - t.a, q = glm::cross(s, e1);
        const float u = glm::dot(s, p) / det, v = glm::dot(d, q) / det, w = glm::dot(e2, q) / det;
        hit = hit || (u >= 0 && v >= 0 && u + v <= 1 && w > 0 && w < 1);
    });
    return hit;
}

TEST(GeneratedScenes, LeakHalvesDoNotSeeEachOther) {
    // Segments between lattice points of the two halves, the corners along the partition's rim included.
    for (const char* spec : {"leak", "leak?angle=20", "leak?angle=-40", "leak?thickness=0.0005&angle=33"}) {
        SCOPED_TRACE(spec);
        const Scene scene = generateScene(spec);
        ASSERT_EQ(scene.lights.size(), 1u);
        const Camera& lit = scene.cameras[0];
        const Camera& dark = scene.cameras[1];
        EXPECT_EQ(lit.name, "lit");
        EXPECT_EQ(dark.name, "dark");
        EXPECT_EQ(scene.cameras[2].name, "both");
        EXPECT_FALSE(blocked(scene, lit.eye, scene.lights[0].position));
        EXPECT_TRUE(blocked(scene, dark.eye, scene.lights[0].position));
        int open = 0;
        for (int i = 0; i < 20; ++i)
            for (int j = 0; j < 20; ++j) {
                // Up to 1 mm from floor and ceiling, from end to end.
                const float y = 0.001f + 0.998f * float(j) / 19.0f;
                const float z = -0.499f + 0.998f * float(i) / 19.0f;
                open += !blocked(scene, scene.lights[0].position, {0.495f, y, z});
            }
        EXPECT_EQ(open, 0);
    }
}

TEST(GeneratedScenes, LeakPartitionIsAsThickAsAsked) {
    const Scene scene = generateScene("leak?angle=30&thickness=0.05");
    const glm::vec3 across(std::cos(glm::radians(30.0f)), 0, -std::sin(glm::radians(30.0f)));  // its normal
    float lo = 1e9f, hi = -1e9f;
    for (const Instance& i : scene.instances)
        if (i.name == "partition")
            for (const glm::vec3& p : scene.meshes[std::size_t(i.mesh)].positions) {
                lo = std::min(lo, glm::dot(across, p));
                hi = std::max(hi, glm::dot(across, p));
            }
    EXPECT_NEAR(hi - lo, 0.05f, 1e-5f);
}

TEST(GeneratedScenes, SunReachesTheSunroomOnlyThroughItsWindow) {
    const Scene scene = generateScene("sunroom");
    const glm::vec3 toSun = -scene.lights.at(0).direction * 20.0f;
    int lit = 0, total = 0;
    for (int i = 0; i < 24; ++i)
        for (int j = 0; j < 24; ++j, ++total)  // just above the floor, wall to wall
            lit += !blocked(
                scene, {-1.79f + 3.58f * float(i) / 23.0f, 0.03f, -2.19f + 4.38f * float(j) / 23.0f}, toSun);
    EXPECT_GT(lit, total / 50);
    EXPECT_LT(lit, total / 4);
}

TEST(GeneratedScenes, CorridorHidesItsLampFromTheFirstLeg) {
    const Scene scene = generateScene("corridor");
    glm::vec3 lamp(0);
    for (const Instance& i : scene.instances)
        if (i.name == "lamp")
            lamp = scene.meshes[std::size_t(i.mesh)].bounds().center() - glm::vec3(0, 0.01f, 0);
    std::map<std::string, bool> hidden;
    for (const Camera& c : scene.cameras) hidden[c.name] = blocked(scene, c.eye, lamp);
    EXPECT_TRUE(hidden.at("dark"));
    EXPECT_TRUE(hidden.at("middle"));
    EXPECT_FALSE(hidden.at("lit"));
}

TEST(GeneratedScenes, CamerasStandInFreeSpaceAndSeeFronts) {
    // Rays through a lattice of pixels: something is hit, and hit from its front or two-sided.
    for (const std::string& spec : allSpecs()) {
        const Scene& scene = sharedScene(spec);
        if (!scene.format.empty()) continue;  // a guest's rooms are looked into through their front wall
        std::vector<std::pair<Triangle, bool>> triangles;
        forEachTriangle(scene, [&](const Instance& i, const Triangle& t, const std::uint32_t*) {
            triangles.emplace_back(t, scene.materials[std::size_t(i.material)].doubleSided);
        });
        for (const Camera& camera : scene.cameras) {
            SCOPED_TRACE(spec + " camera " + camera.name);
            const glm::vec3 forward = glm::normalize(camera.target - camera.eye);
            const glm::vec3 right = glm::normalize(glm::cross(forward, camera.up));
            const glm::vec3 up = glm::cross(right, forward);
            int hits = 0, backs = 0;
            for (int y = -2; y <= 2; ++y)
                for (int x = -2; x <= 2; ++x) {
                    // Off the symmetry axes, so that no ray runs along an edge.
                    const float scale = 0.45f * std::tan(0.5f * camera.fovY);
                    const glm::vec3 d =
                        forward + right * (scale * (float(x) + 0.013f)) + up * (scale * (float(y) + 0.017f));
                    float nearest = 1e30f;
                    bool front = true;
                    for (const auto& [t, doubleSided] : triangles) {
                        const glm::vec3 e1 = t.b - t.a, e2 = t.c - t.a, p = glm::cross(d, e2);
                        const float det = glm::dot(e1, p);
                        if (det == 0) continue;
                        const glm::vec3 s = camera.eye - t.a, q = glm::cross(s, e1);
                        const float u = glm::dot(s, p) / det, v = glm::dot(d, q) / det,
                                    w = glm::dot(e2, q) / det;
                        if (u < 0 || v < 0 || u + v > 1 || w < camera.zNear || w >= nearest) continue;
                        nearest = w;
                        front = det > 0 || doubleSided;
                    }
                    hits += nearest < 1e30f;
                    backs += !front;
                }
            EXPECT_GE(hits, 13) << "of 25 rays";
            EXPECT_EQ(backs, 0);
        }
    }
}

// ---- The atrium's budget --------------------------------------------------------------------------------

TEST(GeneratedAtrium, MeetsItsTriangleBudget) {
    for (double wanted : {1e4, 1.3e4, 2.2e4, 1e5, 1e6}) {
        const Scene scene = generateScene("atrium?triangles=" + std::to_string(wanted));
        std::size_t count = 0;
        for (const Instance& i : scene.instances)
            count += scene.meshes[std::size_t(i.mesh)].indices.size() / 3;
        EXPECT_NEAR(double(count), wanted, 0.2 * wanted);
        EXPECT_EQ(count, scene.triangleCount());
    }
}

TEST(GeneratedAtrium, RefusesBudgetsOutOfRange) {
    for (const char* spec :
         {"atrium?triangles=9999", "atrium?triangles=10000001", "atrium?triangles=20000.5"})
        EXPECT_NE(usageError(spec).find("triangles=10000..1e+07"), std::string::npos) << spec;
}

TEST(GeneratedAtrium, MillionTrianglesShareTheirMeshes) {
    const Scene scene = generateScene("atrium?triangles=1000000");
    std::size_t bytes = 0;
    for (const Mesh& m : scene.meshes)
        bytes += m.positions.size() * (12 + 12 + 8) + m.tangents.size() * 16 + m.indices.size() * 4;
    for (const Texture& t : scene.textures) bytes += t.rgba.size();
    // Shared meshes: far below the 80 bytes and more that a million separate triangles would take each.
    EXPECT_LT(bytes, 24u << 20);
}

TEST(GeneratedAtrium, SharesMeshesAndNamesItsCameras) {
    const Scene& scene = sharedScene("atrium");
    std::map<std::string, int> uses;
    for (const Instance& i : scene.instances) ++uses[scene.meshes[std::size_t(i.mesh)].name];
    EXPECT_EQ(uses.at("column shaft"), 12);
    EXPECT_EQ(uses.at("arch wall"), 16);
    EXPECT_EQ(uses.at("vault"), 20);
    EXPECT_EQ(uses.at("baluster"), 160);
    std::vector<std::string> names;
    for (const Camera& c : scene.cameras) names.push_back(c.name);
    EXPECT_EQ(names, (std::vector<std::string>{"courtyard", "aisle", "gallery", "above"}));
    // Lanterns: the glass shows the light but neither blocks it nor lights a second time.
    int glasses = 0;
    for (const Instance& i : scene.instances)
        if (scene.meshes[std::size_t(i.mesh)].name == "lantern glass") {
            ++glasses;
            EXPECT_FALSE(i.voxelized);
            EXPECT_FALSE(i.castsShadow);
        }
    EXPECT_EQ(glasses, 4);
}

TEST(GeneratedAtrium, SunReachesCourtyardButNotTheSunnySidesAisle) {
    const Scene& scene = sharedScene("atrium?triangles=10000");
    const glm::vec3 toSun = -scene.lights.at(0).direction * 40.0f;
    int court = 0, aisle = 0;
    for (int i = 0; i < 12; ++i)
        for (int j = 0; j < 6; ++j) {
            const float x = -6.4f + 12.8f * float(i) / 11.0f;
            court += !blocked(scene, {x, -0.1f, -3.6f + 7.2f * float(j) / 5.0f}, toSun);
            aisle += !blocked(scene, {x, 0.05f, 4.7f + 2.2f * float(j) / 5.0f}, toSun);
        }
    EXPECT_GT(court, 10);
    EXPECT_LT(court, 60);
    EXPECT_EQ(aisle, 0);
}

// ---- Determinism ----------------------------------------------------------------------------------------

// FNV-1a over the bytes of all tables.
class TableHash {
  public:
    template <class T>
    void addAll(const std::vector<T>& values) {
        add(values.size());
        for (const T& v : values) add(v);
    }
    template <class T>
    void add(const T& value) {
        static_assert(std::is_trivially_copyable_v<T>);
        unsigned char bytes[sizeof(T)];
        std::memcpy(bytes, &value, sizeof(T));
        for (unsigned char b : bytes) state_ = (state_ ^ b) * 0x100000001b3u;
    }
    std::uint64_t state() const { return state_; }

  private:
    std::uint64_t state_ = 0xcbf29ce484222325u;
};

std::uint64_t hashTables(const Scene& scene) {
    TableHash hash;
    for (const Mesh& m : scene.meshes) {
        hash.addAll(m.positions);
        hash.addAll(m.normals);
        hash.addAll(m.uvs);
        hash.addAll(m.tangents);
        hash.addAll(m.colors);
        hash.addAll(m.indices);
    }
    for (const Texture& t : scene.textures) hash.addAll(t.rgba);
    for (const Material& m : scene.materials) {
        hash.add(m.baseColor);
        hash.add(m.emission);
        hash.add(m.roughness);
        hash.add(m.metallic);
    }
    for (const Instance& i : scene.instances) {
        hash.add(i.mesh);
        hash.add(i.material);
        hash.add(i.worldFromObject);
    }
    for (const Light& l : scene.lights) {
        hash.add(l.position);
        hash.add(l.direction);
        hash.add(l.intensity);
    }
    return hash.state();
}

TEST(GeneratedScenes, SameSpecSameBits) {
    std::set<std::uint64_t> seen;
    for (const io::GeneratedSceneInfo& info : generatedScenes()) {
        const std::string spec(info.name);
        const std::uint64_t first = hashTables(generateScene(spec));
        EXPECT_EQ(first, hashTables(generateScene(spec))) << spec;
        EXPECT_TRUE(seen.insert(first).second) << spec << " equals another scene";
    }
    // The hash notices a change at all.
    EXPECT_NE(hashTables(generateScene("furnace?albedo=0.3")),
              hashTables(generateScene("furnace?albedo=0.4")));
}

}  // namespace
}  // namespace conelight

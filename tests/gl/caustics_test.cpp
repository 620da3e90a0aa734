// SPDX-License-Identifier: MIT
// Light that solids of glass send on: none of it is lost, and a lens gathers it where the lens maker's formula
// says.
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "gl/gl.h"
#include "light/lights.h"
#include "math/octahedral.h"
#include "support/gl_fixture.h"
#include "support/scenes.h"

namespace conelight::test {
namespace {

Material clearGlass() {
    Material m;
    m.roughness = 0;
    m.baseColor = glm::vec4(1);
    m.transmission = m.thickness = 1;
    return m;
}

// A lens about +y: a cap of a sphere of radius `curvature` up to the height at which it is `aperture` wide, and
// its flat side, through the origin.
Mesh planoConvexLens(float curvature, float aperture) {
    constexpr int kRings = 16, kColumns = 48;
    Mesh mesh;
    const float rim = std::asin(aperture / curvature);
    const float below = curvature * std::cos(rim);
    for (int side = 0; side < 2; ++side)
        for (int ring = 0; ring <= kRings; ++ring)
            for (int column = 0; column <= kColumns; ++column) {
                const float tilt = rim * static_cast<float>(ring) / kRings;
                const float turn = 2 * std::numbers::pi_v<float> * static_cast<float>(column) / kColumns;
                const glm::vec3 n(std::sin(tilt) * std::cos(turn), std::cos(tilt),
                                  std::sin(tilt) * std::sin(turn));
                const glm::vec3 p = curvature * n - glm::vec3(0, below, 0);
                mesh.positions.push_back(side == 0 ? p : glm::vec3(p.x, 0, p.z));
                mesh.normals.push_back(side == 0 ? n : glm::vec3(0, -1, 0));
            }
    for (std::uint32_t side = 0; side < 2; ++side)
        for (std::uint32_t ring = 0; ring < kRings; ++ring)
            for (std::uint32_t column = 0; column < kColumns; ++column) {
                const std::uint32_t a = (side * (kRings + 1) + ring) * (kColumns + 1) + column;
                const std::uint32_t b = a + 1, c = a + kColumns + 1, d = c + 1;
                const std::uint32_t up[6] = {a, b, c, b, d, c}, down[6] = {a, c, b, b, c, d};
                mesh.indices.insert(mesh.indices.end(), side == 0 ? up : down, (side == 0 ? up : down) + 6);
            }
    return mesh;
}

// A texel of a map, as the light in it.
struct Beam {
    glm::vec3 direction;  // from the solid's middle
    double flux;          // W
    double distance;      // m
};

class CausticsTest : public GlTest {
  protected:
    // The light that the first solid of a scene sends on.
    std::vector<Beam> cast(const Scene& scene, int paths = LightSettings{}.caustics) {
        scene::GpuScene gpuScene(scene);
        light::Lights lights;
        voxels::Voxels voxels;
        light::LightsWanted wanted;
        wanted.caustics = true;
        wanted.settings.caustics = paths;
        lights.update(device(), gpuScene, wanted);
        voxels.update(device(), gpuScene, {.size = 32}, voxels::Rays::Yes);
        lights.castCaustics(device(), gpuScene, voxels);
        if (!lights.hasCaustics()) return {};
        const gl::Texture& map = lights.caustics().map();
        const int edge = map.width();
        std::vector<glm::vec4> texels(static_cast<std::size_t>(edge * edge * map.depth()));
        map.read(0, GL_RGBA, GL_FLOAT, texels.data(), texels.size() * sizeof(glm::vec4));
        std::vector<Beam> beams;
        for (int y = 0; y < edge; ++y)
            for (int x = 0; x < edge; ++x) {
                const glm::vec4& texel = texels[static_cast<std::size_t>(y * edge + x)];
                const float sum = texel.r + texel.g + texel.b;
                if (!(sum > 0)) continue;
                const glm::vec2 place = 2.0f * (glm::vec2(x, y) + 0.5f) / static_cast<float>(edge) - 1.0f;
                const glm::vec3 n = math::octDecode(place);  // about -y
                // A point of the octahedron is 1 away by the sum of its coordinates.
                const double away = 1 / static_cast<double>(glm::dot(glm::abs(n), glm::vec3(1)));
                const double solidAngle = 4 / (away * away * away * edge * edge);
                beams.push_back({{n.x, -n.z, n.y},
                                 static_cast<double>(texel.g) * solidAngle,
                                 static_cast<double>(texel.a / sum)});
            }
        return beams;
    }
    static double fluxOf(const std::vector<Beam>& beams) {
        double sum = 0;
        for (const Beam& beam : beams) sum += beam.flux;
        return sum;
    }
    static Scene ballInBox() {
        Scene scene = closedBox(diffuseMaterial(glm::vec3(0.5f)));
        addInstance(scene, sphereMesh(96, 48), clearGlass(), glm::scale(glm::mat4(1), glm::vec3(0.4f)));
        return scene;
    }
};

// All light that a lamp sends towards a ball in a closed box ends on the box, whatever kind of lamp it is.
TEST_F(CausticsTest, NoLightIsLost) {
    const double sine = 0.4 / 0.8, solidAngle = 2 * std::numbers::pi * (1 - std::sqrt(1 - sine * sine));
    for (const LightType type : {LightType::Point, LightType::Directional, LightType::Rect}) {
        Scene scene = ballInBox();
        Light lamp;
        lamp.type = type;
        lamp.position = {0, 0.8f, 0};
        lamp.direction = {0, -1, 0};
        lamp.halfU = {0.01f, 0, 0};
        lamp.halfV = {0, 0, 0.01f};
        lamp.intensity = glm::vec3(10);
        scene.lights = {lamp};
        const double expected = type == LightType::Point ? 10 * solidAngle
                                : type == LightType::Directional
                                    ? 10 * std::numbers::pi * 0.4 * 0.4
                                    : 10 * 0.0004 * std::numbers::pi * sine * sine;
        EXPECT_NEAR(fluxOf(cast(scene)) / expected, 1, 0.02) << static_cast<int>(type);
    }
}

// Glass that absorbs leaves of light through the middle of a slab what Beer's law and two surfaces leave.
TEST_F(CausticsTest, SlabsAbsorb) {
    Scene scene = closedBox(diffuseMaterial(glm::vec3(0.5f)));
    Material tinted = clearGlass();
    tinted.attenuationColor = {1, 0.5f, 1};
    tinted.attenuationDistance = 0.2f;
    addInstance(scene, boxMesh(), tinted, glm::scale(glm::mat4(1), glm::vec3(0.5f, 0.1f, 0.5f)));
    Light sun;
    sun.type = LightType::Directional;
    sun.direction = {0, -1, 0};
    sun.intensity = glm::vec3(1);
    scene.lights = {sun};
    double through = 0;
    for (const Beam& beam : cast(scene))
        if (beam.direction.y < 0) through += beam.flux;
    // 4 % are reflected at the front, and as much of the rest at the back, which goes up.
    EXPECT_NEAR(through, 0.96 * 0.5 * 0.96, 0.02);
}

// Of a lens of focal length f, light is as wide in the distance d as its aperture times |1 - d / f|.
TEST_F(CausticsTest, LensGathersLightInItsFocus) {
    for (const float focus : {0.6f, 1.0f, 2.0f}) {
        Scene scene = closedBox(diffuseMaterial(glm::vec3(0.5f)));
        const float aperture = 0.08f;
        addInstance(scene, planoConvexLens(focus * 0.5f, aperture), clearGlass());  // ior 1.5: f = R / 0.5
        Light sun;
        sun.type = LightType::Directional;
        sun.direction = {0, -1, 0};
        sun.intensity = glm::vec3(1);
        scene.lights = {sun};
        double flux = 0, squares = 0;
        for (const Beam& beam : cast(scene)) {
            if (beam.direction.y > -0.9f) continue;
            const double radius = std::hypot(beam.direction.x, beam.direction.z) * beam.distance;
            flux += beam.flux;
            squares += beam.flux * radius * radius;
        }
        EXPECT_NEAR(flux / (std::numbers::pi * 0.08 * 0.08), 0.92, 0.02) << focus;
        // An even disc's mean square is half that of its rim. A texel is 8 mm wide here.
        const double expected = 0.08 * std::abs(1 - 1 / static_cast<double>(focus)) / std::sqrt(2.0);
        EXPECT_NEAR(std::sqrt(squares / flux), expected, 0.006) << focus;
    }
}

// The same light, to the bit, each time; other numbers of paths make other noise, and none none.
// A driver that builds kernels for levels and filters builds none anew when the first solid comes.
TEST_F(CausticsTest, MapOfNoneIsSampledAsOneOfSome) {
    Scene scene = ballInBox();
    scene.lights = {Light{}};
    scene::GpuScene gpuScene(scene);
    light::Lights lights;
    voxels::Voxels voxels;
    voxels.update(device(), gpuScene, {.size = 16}, voxels::Rays::Yes);
    const auto mapWith = [&](int paths) {
        light::LightsWanted wanted;
        wanted.caustics = true;
        wanted.settings.caustics = paths;
        lights.update(device(), gpuScene, wanted);
        lights.castCaustics(device(), gpuScene, voxels);
        const gl::Texture& map = lights.caustics().map();
        std::vector<int> states{map.desc().levels > 1};
        for (const GLenum name :
             {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER, GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
            glGetTextureParameteriv(map.name(), name, &states.emplace_back());
        return std::pair(map.width(), states);
    };
    const auto none = mapWith(0), some = mapWith(1024);
    EXPECT_LT(none.first, some.first);
    EXPECT_EQ(none.second, some.second);
}

TEST_F(CausticsTest, SameCallsSameBits) {
    Scene scene = ballInBox();
    Light lamp;
    lamp.position = {0.1f, 0.8f, 0};
    lamp.intensity = glm::vec3(10);
    scene.lights = {lamp};
    const std::vector<Beam> once = cast(scene, 4096), again = cast(scene, 4096), more = cast(scene, 16384);
    ASSERT_EQ(once.size(), again.size());
    for (std::size_t i = 0; i < once.size(); ++i) EXPECT_EQ(once[i].flux, again[i].flux);
    EXPECT_NEAR(fluxOf(once) / fluxOf(more), 1, 0.01);
    EXPECT_TRUE(cast(scene, 0).empty());
}

}  // namespace
}  // namespace conelight::test

// SPDX-License-Identifier: MIT
// The G-buffer as its readers see it: every field of fetchSurface against the scene it came from.
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "support/gl_fixture.h"
#include "support/view_rig.h"

namespace conelight::test {
namespace {

// One pixel as written by kDumpShader; layout of std430.
struct Pixel {
    glm::vec4 position;         // w: 1 where there is a surface
    glm::vec4 normal;           // w: instance
    glm::vec4 geometricNormal;  // w: material
    glm::vec4 albedo;           // w: metallic
    glm::vec4 f0;               // w: roughness
    glm::vec4 emission;         // w: back-facing + 2 * unlit
};

const char* const kDumpShader = R"(#version 450 core
#include "lib/gbuffer.glsl"
layout(local_size_x = 8, local_size_y = 8) in;
layout(std430) writeonly buffer Out { vec4 words[]; };
void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (pixel.x >= int(frame.width) || pixel.y >= int(frame.height)) return;
    Surface s;
    bool seen = fetchSurface(pixel, s);
    int at = 6 * (pixel.y * int(frame.width) + pixel.x);
    words[at] = vec4(s.position, seen ? 1.0 : 0.0);
    words[at + 1] = vec4(s.normal, float(s.instance));
    words[at + 2] = vec4(s.geometricNormal, float(s.material));
    words[at + 3] = vec4(s.albedo, s.metallic);
    words[at + 4] = vec4(s.dielectricF0, s.roughness);
    words[at + 5] = vec4(s.emission, (s.backFacing ? 1.0 : 0.0) + (s.unlit ? 2.0 : 0.0));
}
)";

class LightGBufferTest : public GlTest {
  protected:
    static constexpr int kWidth = 72, kHeight = 40;

    void draw(const Scene& scene, const Camera& camera, bool cull = false) {
        ViewRig rig(scene, camera, kWidth, kHeight);
        rig.draw(device(), cull);
        addShader("test/dump.comp.glsl", kDumpShader);
        const gl::Buffer out(sizeof(Pixel) * kWidth * kHeight, "dump");
        programs()
            .compute("test/dump.comp.glsl")
            .dispatch(gl::Inputs().add(rig.gpuScene).add(rig.lights).add(rig.surfaces).storage("Out", out),
                      kWidth, kHeight);
        gl::barrier(gl::Access::ShaderStorage);
        pixels_ = out.read<Pixel>(kWidth * kHeight);
    }
    const Pixel& at(int x, int y) const { return pixels_[static_cast<std::size_t>(y * kWidth + x)]; }
    const Pixel& centre() const { return at(kWidth / 2, kHeight / 2); }

    static Camera camera(const glm::vec3& eye, const glm::vec3& target) {
        Camera c;
        c.eye = eye;
        c.target = target;
        return c;
    }

  private:
    std::vector<Pixel> pixels_;
};

void expectNear(const glm::vec3& a, const glm::vec3& b, float tolerance, const char* what) {
    EXPECT_LE(glm::length(a - b), tolerance) << what << ": (" << a.x << ' ' << a.y << ' ' << a.z << ") for ("
                                             << b.x << ' ' << b.y << ' ' << b.z << ')';
}

TEST_F(LightGBufferTest, PositionsAreThePixelCentresOnThePlane) {
    // Far from the origin and with a depth range of 1e5, where a float inverse projection would fail.
    const glm::vec3 offset(1000, -300, 700);
    Scene scene;
    addInstance(scene, quadMesh(offset + glm::vec3(-20, 0, 20), {40, 0, 0}, {0, 0, -40}), Material{});
    const Camera c = camera(offset + glm::vec3(0, 1.5f, 6), offset + glm::vec3(0.3f, 0.2f, 0));
    draw(scene, c);
    GLint subpixelBits = 0;
    glGetIntegerv(GL_SUBPIXEL_BITS, &subpixelBits);
    const double pixelAngle = static_cast<double>(c.fovY) / kHeight;
    const double height = static_cast<double>(c.eye.y - offset.y);
    int seen = 0;
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            if (at(x, y).position.w == 0) continue;
            ++seen;
            const glm::dvec3 want =
                pixelOnPlane(c, {kWidth, kHeight}, {x, y}, {0, 1, 0}, static_cast<double>(offset.y));
            const double distance = glm::length(want - glm::dvec3(c.eye));
            // Half a float step at 1000 in three coordinates, and the interpolation of 1/w, which is coarser on GPUs.
            // Corners of triangles lie on a grid within pixels: half a step turns the ray, which meets the plane aslant.
            const double turned = pixelAngle * std::exp2(-subpixelBits - 1) * distance * distance / height;
            EXPECT_LE(glm::length(glm::dvec3(at(x, y).position) - want), 1e-4 + 5e-5 * distance + turned);
            expectNear(at(x, y).normal, {0, 1, 0}, 1e-6f, "normal");
            expectNear(at(x, y).geometricNormal, {0, 1, 0}, 1e-4f, "geometric normal");
        }
    EXPECT_GT(seen, kWidth * kHeight / 2);
    EXPECT_LT(seen, kWidth * kHeight);
}

TEST_F(LightGBufferTest, MaterialFieldsArrive) {
    Material material;
    material.baseColor = {0.25f, 0.5f, 0.75f, 1};
    material.metallic = 0.4f;
    material.roughness = 0.3f;
    material.specularColor = {1, 0.5f, 0.25f};
    material.emission = {17, 12, 0.3f};
    Scene scene;
    addInstance(scene, quadMesh({-5, -5, -3}, {1, 0, 0}, {0, 1, 0}), Material{});
    const std::size_t instance = addInstance(scene, quadMesh({-5, -5, 0}, {10, 0, 0}, {0, 10, 0}), material);
    scene.meshes.back().colors.assign(4, {0.5f, 1, 1, 1});
    draw(scene, camera({0.2f, 0.1f, 3}, {0.2f, 0.1f, 0}));
    EXPECT_EQ(centre().position.w, 1);
    EXPECT_EQ(centre().normal.w, static_cast<float>(instance));
    EXPECT_EQ(centre().geometricNormal.w, 1);
    expectNear(centre().albedo, {0.25f * 0.5f, 0.5f, 0.75f}, 2e-5f, "albedo");
    EXPECT_NEAR(centre().albedo.w, 0.4f, 0.5 / 255);
    EXPECT_NEAR(centre().f0.w, 0.3f, 1e-5);
    // Half a step of an 8-bit square root: 2 * 0.2 / 510.
    expectNear(centre().f0, {0.04f, 0.02f, 0.01f}, 8e-4f, "F0");
    expectNear(centre().emission, material.emission, 0, "emission");
    EXPECT_EQ(centre().emission.w, 0);
}

TEST_F(LightGBufferTest, BackFacesAreSeenUnlessCulledAndDoNotEmit) {
    Material material;
    material.emission = glm::vec3(2);
    Scene scene;
    addInstance(scene, quadMesh({-5, -5, 0}, {10, 0, 0}, {0, 10, 0}), material);
    const Camera behind = camera({0, 0, -3}, {0, 0, 0});
    draw(scene, behind);
    EXPECT_EQ(centre().position.w, 1);
    EXPECT_EQ(centre().emission.w, 1);
    expectNear(centre().emission, glm::vec3(0), 0, "emission of the back");
    expectNear(centre().normal, {0, 0, -1}, 1e-6f, "normal of the back");
    expectNear(centre().geometricNormal, {0, 0, -1}, 1e-4f, "geometric normal of the back");
    draw(scene, behind, true);
    EXPECT_EQ(centre().position.w, 0);
    scene.materials[0].doubleSided = true;
    draw(scene, behind, true);
    EXPECT_EQ(centre().position.w, 1);
    expectNear(centre().emission, glm::vec3(2), 0, "emission of the back of a double-sided emitter");
}

TEST_F(LightGBufferTest, MirroredAndStretchedInstancesKeepTheirFrontAndNormal) {
    // A plane tilted by 45 degrees, stretched along x, then mirrored in x.
    Scene scene;
    Material material;
    material.emission = glm::vec3(1);
    addInstance(scene, quadMesh({-4, -4, 4}, {8, 0, -8}, {0, 8, 0}), material,
                glm::scale(glm::mat4(1), glm::vec3(-3, 1, 1)));
    const glm::vec3 want = glm::normalize(glm::vec3(-1.0f / 3, 0, 1));
    draw(scene, camera({0, 0, 20}, {0, 0, 0}), true);
    ASSERT_EQ(centre().position.w, 1) << "culled as a back face";
    EXPECT_EQ(centre().emission.w, 0);
    expectNear(centre().normal, want, 1e-4f, "normal");
    expectNear(centre().geometricNormal, want, 2e-4f, "geometric normal");
}

TEST_F(LightGBufferTest, NormalsDecideTheSideWhenTheWindingIsWrong) {
    Scene scene;
    addInstance(scene, quadMesh({-5, -5, 0}, {10, 0, 0}, {0, 10, 0}), Material{});
    for (glm::vec3& n : scene.meshes[0].normals) n = glm::normalize(glm::vec3(0.2f, 0, -1));
    draw(scene, camera({0, 0, 3}, {0, 0, 0}));
    expectNear(centre().normal, glm::normalize(glm::vec3(-0.2f, 0, 1)), 1e-4f, "normal");
}

TEST_F(LightGBufferTest, UnlitShowsItsColourAndHasNoAlbedo) {
    Material material;
    material.baseColor = {0.1f, 0.2f, 1.0f, 1};
    material.unlit = true;
    Scene scene;
    addInstance(scene, quadMesh({-5, -5, 0}, {10, 0, 0}, {0, 10, 0}), material);
    draw(scene, camera({0, 0, 3}, {0, 0, 0}));
    expectNear(centre().emission, {0.1f, 0.2f, 1.0f}, 2e-5f, "unlit colour");
    expectNear(centre().albedo, glm::vec3(0), 0, "albedo");
    EXPECT_EQ(centre().emission.w, 2);
}

Texture checker(bool srgb) {
    // Left half: opaque 255, right half: transparent 0.
    Texture texture;
    texture.width = 8;
    texture.height = 1;
    texture.srgb = srgb;
    texture.filter = TextureFilter::Nearest;
    texture.wrapU = texture.wrapV = TextureWrap::Clamp;
    for (int x = 0; x < 8; ++x) {
        const auto value = static_cast<std::uint8_t>(x < 4 ? 255 : 0);
        texture.rgba.insert(texture.rgba.end(), {188, 255, 255, value});
    }
    return texture;
}

TEST_F(LightGBufferTest, MaskedTexelsLetTheSurfaceBehindBeSeen) {
    Scene scene;
    Material masked;
    masked.alphaMode = AlphaMode::Mask;
    masked.baseColor = {1, 1, 1, 1};
    masked.baseColorTexture.texture = 0;
    scene.textures.push_back(checker(true));
    const std::size_t wall =
        addInstance(scene, quadMesh({-50, -50, -1}, {100, 0, 0}, {0, 100, 0}), Material{});
    const std::size_t leaf = addInstance(scene, quadMesh({-5, -5, 0}, {10, 0, 0}, {0, 10, 0}), masked);
    draw(scene, camera({0, 0, 3}, {0, 0, 0}));
    EXPECT_EQ(at(kWidth / 4, kHeight / 2).normal.w, static_cast<float>(leaf));
    EXPECT_EQ(at(3 * kWidth / 4, kHeight / 2).normal.w, static_cast<float>(wall));
    // sRGB 188 is 0.5 to within half a step.
    EXPECT_NEAR(at(kWidth / 4, kHeight / 2).albedo.x, 0.503f, 0.003f);
    // A texture transform that moves the opaque half to the right.
    scene.materials[1].baseColorTexture.uvFromUv[2] = glm::vec3(0.5f, 0, 1);
    scene.textures[0].wrapU = TextureWrap::Repeat;
    draw(scene, camera({0, 0, 3}, {0, 0, 0}));
    EXPECT_EQ(at(kWidth / 4, kHeight / 2).normal.w, static_cast<float>(wall));
    EXPECT_EQ(at(3 * kWidth / 4, kHeight / 2).normal.w, static_cast<float>(leaf));
    // Blended: opaque from one half on.
    scene.materials[1].alphaMode = AlphaMode::Blend;
    scene.materials[1].baseColor.a = 0.4f;
    draw(scene, camera({0, 0, 3}, {0, 0, 0}));
    EXPECT_EQ(at(3 * kWidth / 4, kHeight / 2).normal.w, static_cast<float>(wall));
}

TEST_F(LightGBufferTest, NormalMapsFollowTangentAndHandedness) {
    Texture map;
    map.width = map.height = 1;
    map.srgb = false;
    // Leans to +x and a little more to +y of tangent space: (0.6, 0.36, 0.71) in 8 bits.
    map.rgba = {204, 173, 218, 255};
    const glm::vec3 texel = glm::normalize(glm::vec3(204, 173, 218) / 127.5f - 1.0f);
    for (const float handedness : {1.0f, -1.0f}) {
        Scene scene;
        Material material;
        material.normalTexture.texture = 0;
        scene.textures.push_back(map);
        addInstance(scene, quadMesh({-5, -5, 0}, {10, 0, 0}, {0, 10, 0}), material);
        scene.meshes[0].tangents.assign(4, glm::vec4(0, 1, 0, handedness));
        draw(scene, camera({0, 0, 3}, {0, 0, 0}));
        // Tangent +y, so bitangent = handedness * cross(z, y) = -handedness * x.
        expectNear(centre().normal, {-handedness * texel.y, texel.x, texel.z}, 1e-3f, "mapped normal");
        expectNear(centre().geometricNormal, {0, 0, 1}, 1e-4f, "geometric normal");
    }
}

}  // namespace
}  // namespace conelight::test

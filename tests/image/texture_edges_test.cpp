// SPDX-License-Identifier: MIT
// Texture levels along the edges of triangles: a textured wall looks the same made of two triangles or of
// thousands of a few pixels each. (Helper invocations that read zeros from a table once put the coarsest
// level on every edge: models of small triangles were covered with dots.)
#include <algorithm>
#include <cmath>

#include "conelight/renderer.h"
#include "support/gl_fixture.h"

namespace conelight::test {
namespace {

// A wall of edge 2 in the plane z = 0, of cells x cells squares; its texture is red and green in stripes.
Scene stripedWall(int cells) {
    Scene scene;
    Texture stripes;
    stripes.width = stripes.height = 64;
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) {
            const bool red = x / 16 % 2 == 0;
            stripes.rgba.insert(stripes.rgba.end(), {static_cast<std::uint8_t>(red ? 255 : 0),
                                                     static_cast<std::uint8_t>(red ? 0 : 255), 0, 255});
        }
    scene.textures.push_back(stripes);
    Material material;
    material.baseColor = glm::vec4(1);
    material.baseColorTexture.texture = 0;
    scene.materials.push_back(material);
    Mesh mesh;
    for (int y = 0; y <= cells; ++y)
        for (int x = 0; x <= cells; ++x) {
            const glm::vec2 uv = glm::vec2(x, y) / static_cast<float>(cells);
            mesh.positions.emplace_back(2.0f * uv - 1.0f, 0.0f);
            mesh.normals.emplace_back(0, 0, 1);
            mesh.uvs.push_back(uv);
        }
    for (int y = 0; y < cells; ++y)
        for (int x = 0; x < cells; ++x) {
            const auto at = [&](int i, int j) {
                return static_cast<std::uint32_t>((y + j) * (cells + 1) + x + i);
            };
            mesh.indices.insert(mesh.indices.end(),
                                {at(0, 0), at(1, 0), at(1, 1), at(0, 0), at(1, 1), at(0, 1)});
        }
    scene.meshes.push_back(mesh);
    scene.instances.push_back({.mesh = 0, .material = 0});
    return scene;
}

class TextureEdgesTest : public GlTest {};

TEST_F(TextureEdgesTest, SmallTrianglesLookLikeLargeOnes) {
    Settings settings;
    settings.component = Component::Albedo;
    Camera camera;
    camera.eye = {0.1f, 0.2f, 2.2f};
    std::vector<Image> images;
    for (const int cells : {1, 40}) {
        Renderer renderer;
        renderer.setScene(stripedWall(cells));
        renderer.render(camera, 160, 120, settings);
        images.push_back(renderer.readImage());
    }
    int different = 0, red = 0;
    for (std::size_t i = 0; i < images[0].pixels.size(); ++i) {
        const glm::vec4 difference = glm::abs(images[0].pixels[i] - images[1].pixels[i]);
        different += std::max({difference.r, difference.g, difference.b}) > 0.05f ? 1 : 0;
        red += images[0].pixels[i].r > 0.9f ? 1 : 0;
    }
    EXPECT_GT(red, 3000);  // the wall is in view, and its stripes are sharp
    EXPECT_LT(different, 40);
}

}  // namespace
}  // namespace conelight::test

// SPDX-License-Identifier: MIT
// The octree of radiance against the dense volume: the same texels, bit for bit, in every brick of every level;
// nothing left out; no node or brick more than there must be; the same tree every time, for a scene that
// changes and for one without a voxel.
#include "gather/radiance_octree.h"

#include <algorithm>
#include <array>
#include <bit>
#include <map>
#include <optional>
#include <vector>

#include "gather/radiance_volume.h"
#include "io/generated.h"
#include "light/inject_light.h"
#include "support/gl_fixture.h"
#include "support/view_rig.h"

namespace conelight::test {
namespace {

using gather::RadianceOctree;
using gather::RadianceVolume;

using Half4 = std::array<std::uint16_t, 4>;
constexpr Half4 kNothing{};

struct Texels {
    glm::ivec3 size;
    std::vector<Half4> values;
    Half4 at(const glm::ivec3& p) const {
        if (glm::any(glm::greaterThanEqual(p, size))) return kNothing;
        return values[static_cast<std::size_t>(p.x + size.x * (p.y + size.y * p.z))];
    }
};

Texels readTexels(const gl::Texture& texture, int level) {
    Texels texels{{texture.width(level), texture.height(level), texture.depth(level)}, {}};
    texels.values.resize(static_cast<std::size_t>(texels.size.x * texels.size.y) *
                         static_cast<std::size_t>(texels.size.z));
    texture.read(level, GL_RGBA, GL_HALF_FLOAT, texels.values.data(), texels.values.size() * sizeof(Half4));
    return texels;
}

// One level of a dense volume, a direction of it.
struct DenseLevel {
    Texels texels;
    glm::ivec3 size;
    Half4 at(int block, const glm::ivec3& p) const {
        if (glm::any(glm::greaterThanEqual(p, size))) return kNothing;
        return texels.at(p + glm::ivec3(block * size.x, 0, 0));
    }
};

// What the tree holds, walked from the root as the header of shared/radiance_octree.h says.
class Walk {
  public:
    Walk(const RadianceOctree& octree, const glm::ivec3& size, int maxLevel)
        : bricks_(readTexels(octree.bricks(), 0)), maxLevel_(maxLevel) {
        int nodes = (std::max({size.x, size.y, size.z}) + 3) / 4;
        int root = 0;
        for (; nodes > 1; nodes = (nodes + 1) / 2) ++root;
        row_ = bricks_.size.x / OCTREE_BRICK_EDGE;
        words_ = octree.nodes().read<glm::uvec2>(octree.nodes().bytes() / sizeof(glm::uvec2));
        for (int level = octree.topLevel(); level > root; --level)
            visit(static_cast<std::uint32_t>(octree.topLevel() - level), level, glm::ivec3(0));
        visit(static_cast<std::uint32_t>(octree.topLevel() - root), root, glm::ivec3(0));
    }

    struct Node {
        int level;
        glm::ivec3 at;
        std::uint32_t firstBrick, directions;
        bool operator==(const Node&) const = default;
    };
    const std::map<std::uint32_t, Node>& nodes() const { return nodes_; }  // by number

    Half4 texel(const Node& node, int block, const glm::ivec3& inBrick) const {
        const std::uint32_t below = node.directions & ((1u << block) - 1);
        const int brick = static_cast<int>(node.firstBrick) + std::popcount(below);
        const glm::ivec3 corner(brick % row_, brick / row_ % row_, brick / (row_ * row_));
        return bricks_.at(OCTREE_BRICK_EDGE * corner + inBrick);
    }
    const Texels& bricks() const { return bricks_; }

  private:
    void visit(std::uint32_t number, int level, const glm::ivec3& at) {
        const glm::uvec2 word = words_.at(number);
        const std::uint32_t directions = word.y >> 26;
        EXPECT_TRUE(nodes_.emplace(number, Node{level, at, word.y & 0x3ffffffu, directions}).second);
        EXPECT_EQ(directions != 0, level <= maxLevel_);
        std::uint32_t child = word.x & 0xffffffu;
        for (int i = 0; i < 8; ++i)
            if ((word.x >> (24 + i) & 1) != 0)
                visit(child++, level - 1, 2 * at + glm::ivec3(i & 1, i >> 1 & 1, i >> 2));
    }

    Texels bricks_;
    int maxLevel_;
    int row_ = 1;
    std::vector<glm::uvec2> words_;
    std::map<std::uint32_t, Node> nodes_;
};

class RadianceOctreeTest : public GlTest {
  protected:
    struct Case {
        VolumeDirections directional = VolumeDirections::Six;
        OpacityModel opacity = OpacityModel::Area;
        float maxFootprint = 0.25f;
    };

    void voxelize(const Scene& scene, int size) {
        gpuScene_.emplace(scene);
        surface_.emplace();
        VoxelSettings settings;
        settings.size = size;
        surface_->build(device(), *gpuScene_, settings);
        lights_.emplace();
        lights_->update(device(), *gpuScene_, {.emissiveQuads = false});
        faces_.emplace();
        light::injectLight(device(), {*gpuScene_, *lights_, *surface_}, *faces_);
    }
    RadianceVolume volumeOf(const Case& wanted, VolumeStorage storage) {
        RadianceVolume volume(
            gather::radianceLayout(surface_->grid(), wanted.directional, wanted.maxFootprint, storage));
        volume.build(device(), *surface_, *faces_, wanted.opacity);
        return volume;
    }
    void compare(const Case& wanted);

    void TearDown() override {
        faces_.reset();
        lights_.reset();
        surface_.reset();
        gpuScene_.reset();
        GlTest::TearDown();
    }

    std::optional<scene::GpuScene> gpuScene_;
    std::optional<voxels::SurfaceVoxels> surface_;
    std::optional<light::Lights> lights_;
    std::optional<light::LitFaces> faces_;
};

// Every brick holds what the dense volume has there, its border included, and has something; what the dense
// volume has is in some brick; nodes and bricks are as many as were counted.
void RadianceOctreeTest::compare(const Case& wanted) {
    const RadianceVolume dense = volumeOf(wanted, VolumeStorage::Dense);
    const RadianceVolume sparse = volumeOf(wanted, VolumeStorage::Octree);
    const gather::RadianceLayout& layout = dense.layout();
    const Walk walk(sparse.octree(), layout.size, layout.maxLevel);
    std::vector<DenseLevel> levels;
    for (int l = 0; l <= layout.maxLevel; ++l)
        levels.push_back({readTexels(dense.texture(), l), layout.size >> l});

    std::vector<std::uint32_t> nodes(static_cast<std::size_t>(sparse.octree().topLevel() + 1));
    std::vector<std::uint32_t> bricks(nodes.size());
    std::vector<std::size_t> kept(nodes.size());  // texels of nodes themselves that hold something
    for (const auto& [number, node] : walk.nodes()) {
        const auto l = static_cast<std::size_t>(node.level);
        ++nodes[l];
        bricks[l] += static_cast<std::uint32_t>(std::popcount(node.directions));
        for (int block = 0; block < layout.blocks; ++block) {
            if ((node.directions >> block & 1) == 0) continue;
            bool something = false;
            for (int i = 0; i < OCTREE_BRICK_TEXELS; ++i) {
                const glm::ivec3 inBrick(i % 5, i / 5 % 5, i / 25);
                const Half4 texel = walk.texel(node, block, inBrick);
                ASSERT_EQ(texel, levels[l].at(block, 4 * node.at + inBrick))
                    << "level " << l << ", node " << number << ", direction " << block << ", texel " << i;
                something |= texel != kNothing;
                if (texel != kNothing && inBrick.x < 4 && inBrick.y < 4 && inBrick.z < 4) ++kept[l];
            }
            EXPECT_TRUE(something) << "level " << l << ", node " << number;
        }
    }
    for (std::size_t l = 0; l < levels.size(); ++l) {
        const auto isNothing = [](const Half4& texel) { return texel == kNothing; };
        const auto& values = levels[l].texels.values;
        EXPECT_EQ(kept[l],
                  values.size() - static_cast<std::size_t>(std::ranges::count_if(values, isNothing)));
        EXPECT_GT(kept[l], 0u);
        EXPECT_EQ(bricks[l], sparse.octree().brickCount(static_cast<int>(l)));
    }
    for (std::size_t l = 0; l < nodes.size(); ++l)
        EXPECT_EQ(nodes[l], sparse.octree().nodeCount(static_cast<int>(l))) << l;
}

TEST_F(RadianceOctreeTest, BricksHoldWhatTheDenseVolumeHas) {
    voxelize(io::generateScene("cornell"), 36);
    for (const VolumeDirections directional : {VolumeDirections::Isotropic, VolumeDirections::Six})
        for (const OpacityModel opacity : {OpacityModel::Fog, OpacityModel::Area})
            compare({directional, opacity});
}

// One level alone, and levels down to one texel, above the tree's root.
TEST_F(RadianceOctreeTest, AnyNumberOfLevels) {
    for (const int size : {8, 20, 64}) {
        voxelize(io::generateScene("spheres"), size);
        for (const float footprint : {0.01f, 0.5f, 1.0f})
            compare({VolumeDirections::Six, OpacityModel::Area, footprint});
    }
}

TEST_F(RadianceOctreeTest, SameBitsEveryTime) {
    voxelize(io::generateScene("lanterns"), 48);
    const RadianceVolume first = volumeOf({}, VolumeStorage::Octree);
    const RadianceVolume second = volumeOf({}, VolumeStorage::Octree);
    EXPECT_EQ(readTexels(first.octree().bricks(), 0).values, readTexels(second.octree().bricks(), 0).values);
    const auto words = [](const gl::Buffer& buffer) {
        return buffer.read<std::uint32_t>(buffer.bytes() / 4);
    };
    EXPECT_EQ(words(first.octree().nodes()), words(second.octree().nodes()));
    EXPECT_EQ(words(first.octree().brickNodes()), words(second.octree().brickNodes()));
}

// Memory is what was counted: 8 bytes a node, 1,004 a brick, and a slice of bricks at most on top.
TEST_F(RadianceOctreeTest, AllocatesWhatWasCounted) {
    voxelize(io::generateScene("cornell"), 64);
    const RadianceVolume volume = volumeOf({}, VolumeStorage::Octree);
    const RadianceOctree& octree = volume.octree();
    std::size_t nodes = 0, bricks = 0;
    for (int l = 0; l <= octree.topLevel(); ++l) nodes += octree.nodeCount(l);
    for (int l = 0; l <= volume.layout().maxLevel; ++l) bricks += octree.brickCount(l);
    EXPECT_EQ(octree.nodes().bytes(), 8 * nodes);
    EXPECT_NEAR(static_cast<double>(octree.brickNodes().bytes()), 4.0 * static_cast<double>(bricks), 12);
    const std::size_t bytes = gl::Texture::storageBytes(octree.bricks().desc());
    EXPECT_GE(bytes, 1000 * bricks);
    EXPECT_LT(static_cast<double>(bytes), 1.1 * 1000 * static_cast<double>(bricks));
    // A quarter of the dense volume, in which walls of one side are one of six blocks.
    const RadianceVolume dense = volumeOf({}, VolumeStorage::Dense);
    EXPECT_LT(4 * bytes, gl::Texture::storageBytes(dense.texture().desc()));
}

// The voxels move, the octree follows: nothing of the old place is left.
TEST_F(RadianceOctreeTest, FollowsItsVoxels) {
    const Scene scene = io::generateScene("spheres");
    voxelize(scene, 32);
    RadianceVolume volume = volumeOf({}, VolumeStorage::Octree);
    const auto shiftedBy = [&](float x) {
        Instance instance = scene.instances.back();
        instance.worldFromObject[3].x += x;
        gpuScene_->setInstance(scene.instances.size() - 1, instance);
        surface_->update(device(), *gpuScene_, VoxelSettings{.size = 32});
        light::injectLight(device(), {*gpuScene_, *lights_, *surface_}, *faces_);
        volume.build(device(), *surface_, *faces_, OpacityModel::Area);
        return readTexels(volume.octree().bricks(), 0).values;
    };
    const auto there = shiftedBy(0.1f);
    const auto back = shiftedBy(0);
    EXPECT_NE(there, back);
    EXPECT_EQ(back, readTexels(volumeOf({}, VolumeStorage::Octree).octree().bricks(), 0).values);
}

TEST_F(RadianceOctreeTest, NoVoxels) {
    voxelize(Scene{}, 8);
    const RadianceVolume volume = volumeOf({}, VolumeStorage::Octree);
    EXPECT_EQ(volume.octree().nodeCount(0), 0u);
    EXPECT_EQ(volume.octree().brickCount(0), 0u);
    for (const Half4& texel : readTexels(volume.octree().bricks(), 0).values) ASSERT_EQ(texel, kNothing);
}

}  // namespace
}  // namespace conelight::test

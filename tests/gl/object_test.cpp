// SPDX-License-Identifier: MIT
// Ownership of GL objects: construct, move, release, count.
#include "support/gl_fixture.h"

namespace conelight::test {

using ObjectTest = GlTest;

TEST_F(ObjectTest, BufferMovesAndDies) {
    gl::Buffer a(64, "a");
    EXPECT_EQ(gl::liveObjectCount(), 1u);
    const gl::Name name = a.name();
    gl::Buffer b(std::move(a));
    EXPECT_EQ(b.name(), name);
    EXPECT_FALSE(a);  // NOLINT: the moved-from state is what is tested
    EXPECT_EQ(gl::liveObjectCount(), 1u);
    b.reset();
    EXPECT_EQ(gl::liveObjectCount(), 0u);
}

TEST_F(ObjectTest, BufferKeepsWhatWasWritten) {
    const std::vector<std::uint32_t> data{1, 2, 3, 4, 5, 6, 7};
    gl::Buffer buffer(data, "numbers");
    EXPECT_EQ(buffer.read<std::uint32_t>(7), data);
    buffer.clear();
    EXPECT_EQ(buffer.read<std::uint32_t>(7), std::vector<std::uint32_t>(7, 0));
}

TEST_F(ObjectTest, LiveObjectsNameLabelAndBytes) {
    gl::Texture texture({GL_TEXTURE_3D, GL_RGBA16F, 8, 8, 8, 0}, "volume");
    const auto live = gl::liveObjects();
    ASSERT_EQ(live.size(), 1u);
    EXPECT_EQ(live[0].label, "volume");
    EXPECT_EQ(live[0].bytes, (512u + 64 + 8 + 1) * 8);
}

}  // namespace conelight::test

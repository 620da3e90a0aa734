// SPDX-License-Identifier: MIT
// Scenes of the kinds that people model: as large as models are, and two-sided.
#include "io/generated.h"

#include <gtest/gtest.h>

namespace conelight {
namespace {

TEST(GeneratedFurnished, AreTwoSidedAndLarge) {
    for (const char* name :
         {"street", "counter", "workshop", "bathroom", "greenhouse", "cafe", "attic", "cellar"}) {
        SCOPED_TRACE(name);
        const Scene scene = io::generateScene(name);
        EXPECT_GE(scene.triangleCount(), 50000u);
        EXPECT_LE(scene.triangleCount(), 320000u);
        EXPECT_GE(scene.cameras.size(), 2u);
        EXPECT_GE(scene.textures.size(), 3u);
        for (const Material& m : scene.materials) EXPECT_TRUE(m.doubleSided) << m.name;
    }
}

}  // namespace
}  // namespace conelight

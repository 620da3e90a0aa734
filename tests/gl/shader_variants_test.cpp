// SPDX-License-Identifier: MIT
// Shader variants compile and link on the driver: those that have every value of every define.
// tools/check_shaders looks at every two values.
#include "modes/shader_variants.h"

#include "conelight/error.h"
#include "support/gl_fixture.h"

namespace conelight::test {

using ShaderVariantsGlTest = GlTest;

TEST_F(ShaderVariantsGlTest, EveryVariantLinks) {
    const std::vector<gl::ProgramDesc> all = modes::coveringVariants(modes::allShaderVariants(), 1);
    EXPECT_FALSE(all.empty());
    for (const gl::ProgramDesc& desc : all) {
        try {
            const gl::Program program(gl::embeddedShaderProvider(), desc);
            EXPECT_TRUE(program);
        } catch (const Error& error) {
            ADD_FAILURE() << error.what();
        }
    }
    RecordProperty("variants", static_cast<int>(all.size()));
}

}  // namespace conelight::test

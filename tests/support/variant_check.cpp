// SPDX-License-Identifier: MIT
#include "support/variant_check.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "gl/program.h"
#include "modes/shader_variants.h"

namespace conelight::test {
namespace {

// Files and their defines: a guest whose switches are too many to list all their products lists each switch.
std::set<std::string> switchesOf(const gl::ProgramDesc& desc) {
    std::set<std::string> switches{desc.files.back()};
    for (const auto& [name, value] : desc.defines)
        switches.insert(desc.files.back() + ' ' + name + '=' + value);
    return switches;
}

bool isOfGuest(const gl::ProgramDesc& desc) {
    return desc.files.front().find("/shaders/") != std::string::npos;
}

// Shaders that tests bring along are in no list.
bool isOfTests(const gl::ProgramDesc& desc) {
    for (const gl::EmbeddedShader& shader : gl::embeddedShaders())
        if (shader.path == desc.files.front()) return false;
    return true;
}

class VariantCheck : public ::testing::Environment {
    void TearDown() override {
        const std::vector<gl::ProgramDesc> built = gl::builtPrograms();
        if (built.empty()) return;
        std::set<std::string> labels, switches;
        for (const gl::ProgramDesc& desc : modes::allShaderVariants()) {
            labels.insert(desc.label());
            if (isOfGuest(desc)) switches.merge(switchesOf(desc));
        }
        for (const gl::ProgramDesc& desc : built) {
            if (isOfTests(desc)) continue;
            if (!isOfGuest(desc)) {
                EXPECT_TRUE(labels.count(desc.label())) << desc.label() << " is in no list of variants";
                continue;
            }
            for (const std::string& one : switchesOf(desc))
                EXPECT_TRUE(switches.count(one)) << one << " is in no list of variants";
        }
    }
};

}  // namespace

void checkVariantsAtTheEnd() { ::testing::AddGlobalTestEnvironment(new VariantCheck); }

}  // namespace conelight::test

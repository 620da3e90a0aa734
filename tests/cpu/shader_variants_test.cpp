// SPDX-License-Identifier: MIT
// The list of all shader variants is complete, and each is written out as the driver gets it.
#include "modes/shader_variants.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <unordered_set>

#include "conelight/error.h"
#include "conelight/shaders.h"
#include "gl/device.h"
#include "support/gl_fixture.h"

namespace conelight::test {
namespace {

constexpr const char* kStages[] = {".comp.glsl", ".vert.glsl", ".geom.glsl", ".frag.glsl"};

bool endsWith(const std::string& text, const std::string& end) {
    return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

// There are very many; the list is made once.
const std::vector<gl::ProgramDesc>& allVariants() {
    static const std::vector<gl::ProgramDesc> all = modes::allShaderVariants();
    return all;
}

bool isEntry(const std::string& path) {
    for (const char* stage : kStages)
        if (endsWith(path, stage)) return true;
    return false;
}

}  // namespace

TEST(ShaderVariantsTest, EveryEntryIsInAVariant) {
    std::set<std::string> used;
    for (const gl::ProgramDesc& desc : allVariants()) used.insert(desc.files.begin(), desc.files.end());
    for (const gl::EmbeddedShader& shader : gl::embeddedShaders()) {
        if (!isEntry(shader.path)) continue;
        EXPECT_TRUE(used.count(shader.path))
            << "shaders/" << shader.path
            << " is in no variant; add its stage's programDescs() to src/modes/shader_variants.cpp";
    }
    for (const std::string& file : used) EXPECT_TRUE(isEntry(file)) << file;
}

TEST(ShaderVariantsTest, ExpandedFilesAreWhatTheDriverGets) {
    const std::filesystem::path dir = std::filesystem::path(scratchDir()) / "expanded";
    const std::size_t count = expandAllShaders(dir.string());
    std::unordered_set<std::string> texts;
    const gl::ShaderProvider provider = gl::embeddedShaderProvider();
    for (const gl::ProgramDesc& desc : modes::coveringVariants(allVariants(), 2))
        for (const std::string& file : desc.files)
            texts.insert(gl::expandShader(provider, file, desc.defines).text);
    const std::size_t forProcessors = texts.size();
    // What GPUs get is there where it differs.
    const gl::ShaderProvider gpu = gl::providerFor(gl::ExecutionProfile::Gpu, provider);
    for (const gl::ProgramDesc& desc : modes::coveringVariants(allVariants(), 1))
        for (const std::string& file : desc.files)
            texts.insert(gl::expandShader(gpu, file, desc.defines).text);
    EXPECT_GT(texts.size(), forProcessors);
    std::size_t files = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(dir)) {
        if (!entry.is_regular_file()) continue;
        ++files;
        EXPECT_TRUE(isEntry(entry.path().string())) << entry.path();
        std::ostringstream text;
        text << std::ifstream(entry.path(), std::ios::binary).rdbuf();
        EXPECT_TRUE(texts.count(text.str())) << entry.path();
        texts.erase(text.str());
    }
    EXPECT_EQ(files, count);
    EXPECT_GT(files, 0u);
    EXPECT_TRUE(texts.empty()) << "variants that were not written, or two files of one text";
}

// Every pair of values that any variant has is in one of those that stand for all.
TEST(ShaderVariantsTest, CoveringVariantsHaveEveryPair) {
    const std::vector<gl::ProgramDesc>& all = allVariants();
    const std::vector<gl::ProgramDesc> part = modes::coveringVariants(all, 2);
    const auto pairsOf = [](const std::vector<gl::ProgramDesc>& descs) {
        // By file: of each name its values, of each two of these whether they are together.
        std::map<std::string, std::map<std::string, std::set<std::string>>> pairs;
        for (const gl::ProgramDesc& desc : descs) {
            auto& ofFile = pairs[desc.files.back()];
            for (const auto& [a, x] : desc.defines) {
                auto& others = ofFile[a + '=' + x];
                for (const auto& [b, y] : desc.defines) others.insert(b + '=' + y);
            }
        }
        return pairs;
    };
    EXPECT_EQ(pairsOf(all), pairsOf(part));
    EXPECT_LT(4 * part.size(), all.size());
}

TEST(ShaderVariantsTest, UnwritableFolderIsAnError) {
    const std::filesystem::path file = std::filesystem::path(scratchDir()) / "file";
    std::ofstream(file) << "x";
    try {
        expandAllShaders(file.string());
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::Runtime);
        EXPECT_EQ(std::string(error.what()).rfind(file.string(), 0), 0u) << error.what();
    }
}

}  // namespace conelight::test

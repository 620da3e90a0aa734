// SPDX-License-Identifier: MIT
#include "support/variant_check.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <vector>

#include "gl/program.h"
#include "modes/shader_variants.h"
#include "support/program.h"

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

// FNV-1a.
std::uint64_t hashOf(const std::string& text) {
    std::uint64_t hash = 14695981039346656037u;
    for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211u;
    return hash;
}

// Of each program that may be asked for its label, of guests each switch, as sorted hashes.
std::vector<std::uint64_t> listAllowed() {
    std::vector<std::uint64_t> hashes;
    for (const gl::ProgramDesc& desc : modes::allShaderVariants()) {
        hashes.push_back(hashOf(desc.label()));
        if (isOfGuest(desc))
            for (const std::string& one : switchesOf(desc)) hashes.push_back(hashOf(one));
    }
    std::sort(hashes.begin(), hashes.end());
    hashes.erase(std::unique(hashes.begin(), hashes.end()), hashes.end());
    return hashes;
}

// Hundreds of thousands, the same in each run of this test program: they are kept in a file beside it, which begins with
// the time of the program that they are of.
std::vector<std::uint64_t> allowed() {
    namespace fs = std::filesystem;
    std::error_code ignored;
    const fs::path program = fs::read_symlink("/proc/self/exe", ignored);
    const auto time =
        static_cast<std::uint64_t>(fs::last_write_time(program, ignored).time_since_epoch().count());
    const std::string file = program.string() + ".variants";
    const std::string bytes = bytesOf(file);
    std::vector<std::uint64_t> kept(bytes.size() / 8);
    if (!kept.empty()) std::memcpy(kept.data(), bytes.data(), 8 * kept.size());
    if (kept.size() > 1 && kept.front() == time && bytes.size() % 8 == 0) {
        kept.erase(kept.begin());
        return kept;
    }
    const std::vector<std::uint64_t> hashes = listAllowed();
    const std::string beside = file + "." + std::to_string(getpid());
    {
        std::ofstream out(beside, std::ios::binary);
        out.write(reinterpret_cast<const char*>(&time), 8);
        out.write(reinterpret_cast<const char*>(hashes.data()),
                  static_cast<std::streamsize>(8 * hashes.size()));
    }
    fs::rename(beside, file, ignored);
    return hashes;
}

class VariantCheck : public ::testing::Environment {
    void TearDown() override {
        std::vector<gl::ProgramDesc> built = gl::builtPrograms();
        std::erase_if(built, isOfTests);
        if (built.empty()) return;
        const std::vector<std::uint64_t> known = allowed();
        const auto isKnown = [&](const std::string& text) {
            return std::binary_search(known.begin(), known.end(), hashOf(text));
        };
        for (const gl::ProgramDesc& desc : built) {
            if (!isOfGuest(desc)) {
                EXPECT_TRUE(isKnown(desc.label())) << desc.label() << " is in no list of variants";
                continue;
            }
            for (const std::string& one : switchesOf(desc))
                EXPECT_TRUE(isKnown(one)) << one << " is in no list of variants";
        }
    }
};

}  // namespace

void checkVariantsAtTheEnd() { ::testing::AddGlobalTestEnvironment(new VariantCheck); }

}  // namespace conelight::test

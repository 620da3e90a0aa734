// SPDX-License-Identifier: MIT
#include "session/thumbnail_files.h"

#include <fmt/core.h>
#include <sys/stat.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include "conelight/error.h"
#include "conelight/version.h"
#include "io/files.h"
#include "io/image_file.h"

namespace conelight::program {
namespace {

namespace fs = std::filesystem;

bool isGenerated(const std::string& scene) { return scene.rfind("builtin:", 0) == 0; }

std::string cacheFolder() {
    const fs::path folder = io::userFolder("XDG_CACHE_HOME", ".cache");
    return folder.empty() ? std::string() : (folder / "thumbnails").string();
}

fs::path wholePath(const std::string& scene) {
    std::error_code ignored;
    return fs::absolute(scene, ignored).lexically_normal();
}

// When it was changed, seconds since 1970; "" for no file.
std::string changedAt(const std::string& scene) {
    struct stat info {};
    return ::stat(scene.c_str(), &info) == 0 ? std::to_string(info.st_mtime) : std::string();
}

// Of one block of 64 bytes, added to the state.
void addBlock(const unsigned char* block, std::array<std::uint32_t, 4>& state) {
    static constexpr int kTurns[4][4] = {{7, 12, 17, 22}, {5, 9, 14, 20}, {4, 11, 16, 23}, {6, 10, 15, 21}};
    auto [a, b, c, d] = state;
    for (unsigned i = 0; i < 64; ++i) {
        const unsigned round = i / 16;
        const std::uint32_t mixed = round == 0   ? (b & c) | (~b & d)
                                    : round == 1 ? (d & b) | (~d & c)
                                    : round == 2 ? b ^ c ^ d
                                                 : c ^ (b | ~d);
        const unsigned word = (round == 0 ? i : round == 1 ? 5 * i + 1 : round == 2 ? 3 * i + 5 : 7 * i) % 16;
        std::uint32_t value = 0;
        for (unsigned byte = 0; byte < 4; ++byte)
            value |= std::uint32_t(block[4 * word + byte]) << (8 * byte);
        const auto sine =
            static_cast<std::uint32_t>(std::floor(std::fabs(std::sin(double(i + 1))) * 4294967296.0));
        const std::uint32_t sum = a + mixed + sine + value;
        a = d;
        d = c;
        c = b;
        b += std::rotl(sum, kTurns[round][i % 4]);
    }
    state[0] += a;
    state[1] += b;
    state[2] += c;
    state[3] += d;
}

}  // namespace

std::string md5Of(std::string_view bytes) {
    std::array<std::uint32_t, 4> state{0x67452301, 0xefcdab89, 0x98badcfe, 0x10325476};
    std::string padded(bytes);
    padded += '\x80';
    while (padded.size() % 64 != 56) padded += '\0';
    for (unsigned i = 0; i < 8; ++i)
        padded += static_cast<char>((std::uint64_t(bytes.size()) * 8) >> (8 * i));
    for (std::size_t at = 0; at < padded.size(); at += 64)
        addBlock(reinterpret_cast<const unsigned char*>(padded.data()) + at, state);
    std::string digits;
    for (const std::uint32_t word : state)
        for (unsigned i = 0; i < 4; ++i) digits += fmt::format("{:02x}", (word >> (8 * i)) & 0xff);
    return digits;
}

std::string uriOf(const fs::path& file) {
    constexpr std::string_view kPlain = "-_.~/!$&'()*+,;=:@";
    std::string uri = "file://";
    for (const char c : file.string()) {
        const auto byte = static_cast<unsigned char>(c);
        const bool plain =
            (byte < 128 && std::isalnum(byte) != 0) || kPlain.find(c) != std::string_view::npos;
        uri += plain ? std::string(1, c) : fmt::format("%{:02X}", byte);
    }
    return uri;
}

std::string thumbnailPath(const std::string& scene) {
    const std::string folder = cacheFolder();
    if (folder.empty()) return {};
    // Another version may generate another scene.
    if (isGenerated(scene))
        return folder + "/conelight/" + md5Of(scene + " " CONELIGHT_VERSION_STRING) + ".png";
    return folder + "/large/" + md5Of(uriOf(wholePath(scene))) + ".png";
}

std::optional<std::string> thumbnailOf(const std::string& scene) {
    const std::string own = thumbnailPath(scene);
    if (own.empty()) return std::nullopt;
    std::error_code ignored;
    if (isGenerated(scene)) return fs::exists(own, ignored) ? std::optional(own) : std::nullopt;
    const std::string time = changedAt(scene), name = fs::path(own).filename().string();
    for (const char* size : {"large", "x-large", "normal"}) {
        const std::string file = cacheFolder() + "/" + size + "/" + name;
        if (time.empty() || !fs::exists(file, ignored)) continue;
        try {
            for (const auto& [key, text] : io::readByteImage(file).attributes)
                if (key == "Thumb::MTime" && text == time) return file;
        } catch (const Error&) {  // what others left there may be anything
        }
    }
    return std::nullopt;
}

std::vector<std::pair<std::string, std::string>> thumbnailTexts(const std::string& scene) {
    if (isGenerated(scene)) return {};
    return {{"Thumb::URI", uriOf(wholePath(scene))},
            {"Thumb::MTime", changedAt(scene)},
            {"Software", "Conelight"}};
}

}  // namespace conelight::program

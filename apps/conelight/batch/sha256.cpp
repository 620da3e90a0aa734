// SPDX-License-Identifier: MIT
#include "batch/sha256.h"

#include <sys/types.h>

#include <sha2.h>

#include <array>
#include <fstream>

#include "conelight/error.h"
#include "io/files.h"

namespace conelight::program {

std::string sha256Of(std::string_view bytes) {
    std::array<char, SHA256_DIGEST_STRING_LENGTH> digits{};
    SHA256Data(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size(), digits.data());
    return digits.data();
}

std::string sha256OfFile(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    SHA2_CTX state;
    SHA256Init(&state);
    std::array<char, 65536> part;
    while (file.read(part.data(), part.size()) || file.gcount() > 0)
        SHA256Update(&state, reinterpret_cast<const std::uint8_t*>(part.data()),
                     static_cast<std::size_t>(file.gcount()));
    if (!file.eof())
        throw Error(ErrorKind::BadInput, io::oneLine(path.string()) + ": no such file, or it cannot be read");
    std::array<char, SHA256_DIGEST_STRING_LENGTH> digits{};
    SHA256End(&state, digits.data());
    return digits.data();
}

}  // namespace conelight::program

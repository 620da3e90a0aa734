// SPDX-License-Identifier: MIT
// SHA-256 (FIPS 180-4) as 64 hexadecimal digits, as `sha256sum` prints it.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace conelight::program {

std::string sha256Of(std::string_view bytes);
// Throws Error(BadInput), starting with the path, for a file that cannot be read.
std::string sha256OfFile(const std::filesystem::path& path);

}  // namespace conelight::program

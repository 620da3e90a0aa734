// SPDX-License-Identifier: MIT
// Bytes -> layers of an OpenEXR file. Pictures of more than 65,536 pixels are left alone: what they cost is not what is
// looked for.
#include <algorithm>
#include <array>
#include <cstring>
#include <string_view>

#include "conelight/error.h"
#include "folder.h"
#include "io/files.h"
#include "io/image_file.h"

namespace {

// Of the data window that the header names first; an attribute is its name, its type, its size and its value.
bool isLarge(const std::uint8_t* data, std::size_t size) {
    using namespace std::string_view_literals;
    constexpr std::string_view kName = "dataWindow\0box2i\0\x10\0\0\0"sv;
    const std::uint8_t* end = data + size;
    const std::uint8_t* found = std::search(data, end, kName.begin(), kName.end());
    std::array<std::int32_t, 4> box{};
    if (end - found < std::ptrdiff_t(kName.size() + sizeof box)) return false;
    std::memcpy(box.data(), found + kName.size(), sizeof box);
    const double width = 1.0 + box[2] - box[0], height = 1.0 + box[3] - box[1];
    return width * height > 65536;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const std::filesystem::path kFile = conelight::fuzz::folder() / "picture.exr";
    if (isLarge(data, size)) return -1;
    conelight::io::writeFile(kFile, {data, size});
    try {
        conelight::io::readExr(kFile);
    } catch (const conelight::Error&) {
    }
    return 0;
}

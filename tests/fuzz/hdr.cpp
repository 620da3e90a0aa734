// SPDX-License-Identifier: MIT
// Bytes -> pixels of a Radiance picture (.hdr), which is read here and by no library. Pictures of more than 65,536
// pixels are left alone: what they cost is not what is looked for.
#include <cstdio>
#include <string>

#include "conelight/error.h"
#include "folder.h"
#include "io/files.h"
#include "io/image_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const std::filesystem::path kFile = conelight::fuzz::folder() / "picture.hdr";
    const std::string text(reinterpret_cast<const char*>(data), size);
    long height = 0, width = 0;
    const std::size_t line = text.find("\n\n");
    if (line != std::string::npos &&
        std::sscanf(text.c_str() + line, " %*[-+YX] %ld %*[-+YX] %ld", &height, &width) == 2 &&
        double(width) * double(height) > 65536)
        return -1;
    conelight::io::writeFile(kFile, {data, size});
    try {
        conelight::io::readImage(kFile);
    } catch (const conelight::Error&) {
    }
    return 0;
}

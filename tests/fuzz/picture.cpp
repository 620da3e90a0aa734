// SPDX-License-Identifier: MIT
// Bytes -> pixels of a PNG, a JPEG, or what stb_image reads. Pictures of more than a million pixels are left
// alone: what they cost is not what is looked for.
#include "io/picture_codec.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    for (const int channels : {0, 4}) {
        conelight::io::DecodeRequest request;
        request.channels = channels;
        request.maxInFile = std::uint64_t(1) << 20;
        request.maxPixels = std::uint64_t(1) << 12;
        conelight::io::ByteImage image;
        conelight::io::decodePicture({data, size}, request, image);
    }
    return 0;
}

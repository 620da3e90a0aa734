// SPDX-License-Identifier: MIT
#include "image/image.h"

#include <algorithm>

#include "gl/gl.h"

namespace conelight::image {

void LinearImage::resize(int width, int height) {
    if (texture_ && texture_.width() == width && texture_.height() == height) return;
    texture_ = {};  // frees the old one first
    texture_ = gl::Texture({GL_TEXTURE_2D, GL_RGBA32F, width, height, 1, 1}, "output image");
}

Image LinearImage::read() const {
    Image image{width(), height(), {}};
    const auto rowLength = static_cast<std::size_t>(width());
    const auto rows = static_cast<std::size_t>(height());
    image.pixels.resize(rowLength * rows);
    texture_.read(0, GL_RGBA, GL_FLOAT, image.pixels.data(), image.pixels.size() * sizeof(glm::vec4));
    // GL's first row is the lowest.
    for (std::size_t low = 0, high = rows - 1; low < high; ++low, --high)
        std::swap_ranges(&image.pixels[low * rowLength], &image.pixels[low * rowLength] + rowLength,
                         &image.pixels[high * rowLength]);
    return image;
}

glm::vec4 LinearImage::readPixel(int x, int y) const {
    glm::vec4 pixel;
    texture_.readRegion({x, height() - 1 - y, 0}, {1, 1, 1}, GL_RGBA, GL_FLOAT, &pixel, sizeof pixel);
    return pixel;
}

}  // namespace conelight::image

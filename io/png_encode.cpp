// SPDX-License-Identifier: MIT
// PNG out through libpng, with texts (iTXt chunks) in front of the picture. libpng jumps out of its functions
// when something fails, so whatever has a destructor lives in the writer, outside of them.
#include <png.h>

#include <csetjmp>
#include <cstddef>

#include "io/picture_codec.h"

namespace conelight::io {

namespace {

class PngWriter {
  public:
    // With 16 bits a channel has two bytes, the upper one first.
    explicit PngWriter(const ByteImage& image, int bits = 8) : image_(image), bits_(bits) {}
    ~PngWriter() { png_destroy_write_struct(&png_, &info_); }
    PngWriter(const PngWriter&) = delete;
    PngWriter& operator=(const PngWriter&) = delete;

    std::vector<std::uint8_t> write();

  private:
    static void onError(png_structp png, png_const_charp) { png_longjmp(png, 1); }
    static void onWarning(png_structp, png_const_charp) {}
    static void onWrite(png_structp png, png_bytep data, std::size_t size) {
        auto* const self = static_cast<PngWriter*>(png_get_io_ptr(png));
        try {
            self->out_.insert(self->out_.end(), data, data + size);
        } catch (const std::exception&) {
            png_error(png, "out of memory");
        }
    }
    static void onFlush(png_structp) {}
    bool writeAll();  // false after a jump

    const ByteImage& image_;
    int bits_;
    std::vector<std::uint8_t> out_;
    std::vector<png_text> texts_;
    png_structp png_ = nullptr;
    png_infop info_ = nullptr;
};

bool PngWriter::writeAll() {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    png_set_write_fn(png_, this, onWrite, onFlush);
    const int type = image_.channels == 1   ? PNG_COLOR_TYPE_GRAY
                     : image_.channels == 3 ? PNG_COLOR_TYPE_RGB
                                            : PNG_COLOR_TYPE_RGBA;
    png_set_IHDR(png_, info_, png_uint_32(image_.width), png_uint_32(image_.height), bits_, type,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    if (!texts_.empty()) png_set_text(png_, info_, texts_.data(), int(texts_.size()));
    png_write_info(png_, info_);
    const std::size_t rowBytes = std::size_t(image_.width) * std::size_t(image_.channels * bits_ / 8);
    for (int y = 0; y < image_.height; ++y)
        png_write_row(png_, image_.pixels.data() + std::size_t(y) * rowBytes);
    png_write_end(png_, nullptr);
    return true;
}

std::vector<std::uint8_t> PngWriter::write() {
    for (const auto& [key, value] : image_.attributes) {
        png_text text = {};
        text.compression = PNG_ITXT_COMPRESSION_NONE;
        text.key = const_cast<char*>(key.c_str());  // libpng copies both
        text.text = const_cast<char*>(value.c_str());
        text.itxt_length = value.size();
        texts_.push_back(text);
    }
    png_ = png_create_write_struct(PNG_LIBPNG_VER_STRING, this, onError, onWarning);
    info_ = png_ == nullptr ? nullptr : png_create_info_struct(png_);
    if (info_ == nullptr || !writeAll()) return {};
    return std::move(out_);
}

}  // namespace

std::vector<std::uint8_t> encodePng(const ByteImage& image) { return PngWriter(image).write(); }

std::vector<std::uint8_t> encodePng16(const WordImage& image) {
    ByteImage bytes;
    bytes.width = image.width;
    bytes.height = image.height;
    bytes.channels = image.channels;
    bytes.attributes = image.attributes;
    bytes.pixels.reserve(2 * image.pixels.size());
    for (const std::uint16_t value : image.pixels) {
        bytes.pixels.push_back(std::uint8_t(value >> 8));
        bytes.pixels.push_back(std::uint8_t(value & 0xff));
    }
    return PngWriter(bytes, 16).write();
}

}  // namespace conelight::io

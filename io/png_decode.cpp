// SPDX-License-Identifier: MIT
// PNG through libpng: any depth, palette and transparency, as 8 bits a channel. libpng jumps out of its
// functions when a file is broken, so whatever has a destructor lives in the reader, outside of them.
#include <png.h>

#include <csetjmp>
#include <cstring>
#include <memory>

#include "io/picture_codec.h"

namespace conelight::io {

namespace {

// An interlaced picture cannot be made smaller while it is read.
constexpr std::uint64_t kMostInterlaced = std::uint64_t(1) << 26;

// Grey and RGB as RGBA, in place from the end.
void makeRgba(ByteImage& image) {
    const auto channels = std::size_t(image.channels);
    if (channels == 4) return;
    const std::size_t texels = image.pixels.size() / channels;
    image.pixels.resize(4 * texels);
    for (std::size_t i = texels; i-- > 0;) {
        const std::uint8_t* const from = &image.pixels[channels * i];
        const std::uint8_t rgba[4] = {from[0], from[channels == 3 ? 1 : 0], from[channels == 3 ? 2 : 0],
                                      0xff};
        std::memcpy(&image.pixels[4 * i], rgba, 4);
    }
    image.channels = 4;
}

class PngReader {
  public:
    PngReader(std::span<const std::uint8_t> file, const DecodeRequest& request, ByteImage& image)
        : left_(file), fileBytes_(file.size()), request_(request), image_(image) {}
    ~PngReader() { png_destroy_read_struct(&png_, &info_, nullptr); }
    PngReader(const PngReader&) = delete;
    PngReader& operator=(const PngReader&) = delete;

    DecodeResult read();

  private:
    static void onError(png_structp png, png_const_charp message) {
        auto* const self = static_cast<PngReader*>(png_get_error_ptr(png));
        std::strncpy(self->message_, message, sizeof self->message_ - 1);
        png_longjmp(png, 1);
    }
    static void onWarning(png_structp, png_const_charp) {}
    static void onRead(png_structp png, png_bytep out, std::size_t size) {
        auto* const self = static_cast<PngReader*>(png_get_io_ptr(png));
        if (size > self->left_.size()) png_error(png, "ends early");
        std::memcpy(out, self->left_.data(), size);
        self->left_ = self->left_.subspan(size);
    }
    // Each returns false after a jump.
    bool readHead();
    bool readRows();
    DecodeResult failed() const { return {std::string("cannot be decoded (") + message_ + ")", 0, 0}; }

    std::span<const std::uint8_t> left_;
    std::size_t fileBytes_;
    const DecodeRequest& request_;
    ByteImage& image_;
    png_structp png_ = nullptr;
    png_infop info_ = nullptr;
    char message_[200] = {};
    int width_ = 0, height_ = 0, channels_ = 0, passes_ = 1;
    std::size_t rowBytes_ = 0, largestRow_ = 0;  // as read here; the larger of that and as in the file
    png_textp texts_ = nullptr;                  // in front of the picture
    int textCount_ = 0;
    std::vector<std::uint8_t> rows_;  // one row, or all of an interlaced picture
    std::unique_ptr<RowShrinker> shrinker_;
};

bool PngReader::readHead() {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    png_set_read_fn(png_, this, onRead);
    png_set_user_limits(png_, 0x7fffffff, 0x7fffffff);  // sizeProblem judges
    png_set_chunk_malloc_max(png_, std::size_t(8) << 20);
    png_read_info(png_, info_);
    width_ = int(png_get_image_width(png_, info_));
    height_ = int(png_get_image_height(png_, info_));
    largestRow_ = png_get_rowbytes(png_, info_);
    png_set_expand(png_);
    png_set_strip_16(png_);
    const bool grey = (png_get_color_type(png_, info_) & PNG_COLOR_MASK_COLOR) == 0;
    const bool alpha = (png_get_color_type(png_, info_) & PNG_COLOR_MASK_ALPHA) != 0 ||
                       png_get_valid(png_, info_, PNG_INFO_tRNS) != 0;
    if (grey && alpha) png_set_gray_to_rgb(png_);
    passes_ = png_set_interlace_handling(png_);
    png_read_update_info(png_, info_);
    channels_ = png_get_channels(png_, info_);
    rowBytes_ = png_get_rowbytes(png_, info_);
    largestRow_ = std::max(largestRow_, rowBytes_);
    png_textp texts = nullptr;
    textCount_ = png_get_text(png_, info_, &texts, nullptr);
    texts_ = texts;
    return true;
}

bool PngReader::readRows() {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    for (int pass = 0; pass < passes_; ++pass)
        for (int y = 0; y < height_; ++y) {
            std::uint8_t* const row = rows_.data() + (passes_ > 1 ? std::size_t(y) * rowBytes_ : 0);
            png_read_row(png_, row, nullptr);
            if (pass == passes_ - 1) shrinker_->add(row);
        }
    png_read_end(png_, nullptr);
    return true;
}

DecodeResult PngReader::read() {
    png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, onError, onWarning);
    info_ = png_ == nullptr ? nullptr : png_create_info_struct(png_);
    if (info_ == nullptr) return {"needs more memory than there is", 0, 0};
    if (!readHead()) return failed();
    const std::string problem =
        sizeProblem(std::uint64_t(width_), std::uint64_t(height_), fileBytes_, request_.maxInFile);
    if (!problem.empty()) return {problem, width_, height_};
    const std::uint64_t pixels = std::uint64_t(width_) * std::uint64_t(height_);
    if (passes_ > 1 && pixels > kMostInterlaced)
        return {"is interlaced and larger than 8192x8192; without interlacing would be right", width_,
                height_};
    rows_.resize(rowBytes_ * (passes_ > 1 ? std::size_t(height_) : 1));
    shrinker_ = std::make_unique<RowShrinker>(width_, height_, channels_,
                                              halvings(width_, height_, request_.maxPixels), image_);
    if (!readRows()) return failed();
    // Behind the last row: a picture that is made smaller has fewer texels than its file.
    if (request_.channels == 4) makeRgba(image_);
    for (int i = 0; i < textCount_; ++i)
        if (texts_[i].key != nullptr && texts_[i].text != nullptr)
            image_.attributes.emplace_back(texts_[i].key, texts_[i].text);
    return {{}, width_, height_, std::uint64_t(height_) * largestRow_};
}

}  // namespace

DecodeResult decodePng(std::span<const std::uint8_t> file, const DecodeRequest& request, ByteImage& image) {
    return PngReader(file, request, image).read();
}

}  // namespace conelight::io

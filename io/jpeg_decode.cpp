// SPDX-License-Identifier: MIT
// JPEG through libjpeg: grey, YCbCr, RGB, CMYK and YCCK, baseline and progressive. libjpeg jumps out of its
// functions when a file is broken, so whatever has a destructor lives in the reader, outside of them. A file
// that ends early or has broken data is refused, though a part of its picture could be shown.
#include <cstddef>
#include <cstdio>  // jpeglib.h needs it

#include <jpeglib.h>

#include <jerror.h>

#include <algorithm>
#include <csetjmp>
#include <memory>

#include "io/picture_codec.h"

namespace conelight::io {

namespace {

// Each scan of a progressive file goes over the whole picture; encoders write about ten.
constexpr int kMostScans = 100;

class JpegReader {
  public:
    JpegReader(std::span<const std::uint8_t> file, const DecodeRequest& request, ByteImage& image)
        : file_(file), request_(request), image_(image) {}
    ~JpegReader() {
        if (made_) jpeg_destroy_decompress(&jpeg_);
    }
    JpegReader(const JpegReader&) = delete;
    JpegReader& operator=(const JpegReader&) = delete;

    DecodeResult read();

  private:
    static JpegReader& of(j_common_ptr jpeg) { return *static_cast<JpegReader*>(jpeg->client_data); }
    static void onError(j_common_ptr jpeg) {
        JpegReader& self = of(jpeg);
        jpeg->err->format_message(jpeg, self.message_);
        std::longjmp(self.jump_, 1);
    }
    static void onMessage(j_common_ptr jpeg, int level) {
        const int code = jpeg->err->msg_code;
        if (level < 0 && (code == JWRN_JPEG_EOF || code == JWRN_HIT_MARKER)) onError(jpeg);
    }
    static void onProgress(j_common_ptr jpeg) {
        JpegReader& self = of(jpeg);
        if (self.jpeg_.input_scan_number <= kMostScans) return;
        std::snprintf(self.message_, sizeof self.message_, "more than %d scans", kMostScans);
        std::longjmp(self.jump_, 1);
    }
    // Each returns false after a jump.
    bool readHead();
    bool start();
    bool readRows();
    void rgbFromCmyk();
    DecodeResult failed() const { return {std::string("cannot be decoded (") + message_ + ")", 0, 0}; }

    std::span<const std::uint8_t> file_;
    const DecodeRequest& request_;
    ByteImage& image_;
    jpeg_decompress_struct jpeg_ = {};
    jpeg_error_mgr errors_ = {};
    jpeg_progress_mgr progress_ = {};
    std::jmp_buf jump_;
    bool made_ = false;
    char message_[JMSG_LENGTH_MAX] = {};
    int channels_ = 3;                     // of the result
    std::vector<std::uint8_t> row_, out_;  // as decoded; in the result's channels
    std::unique_ptr<RowShrinker> shrinker_;
};

bool JpegReader::readHead() {
    if (setjmp(jump_) != 0) return false;
    jpeg_create_decompress(&jpeg_);
    made_ = true;
    jpeg_.client_data = this;
    progress_.progress_monitor = onProgress;
    jpeg_.progress = &progress_;
    jpeg_mem_src(&jpeg_, file_.data(), static_cast<unsigned long>(file_.size()));
    jpeg_read_header(&jpeg_, TRUE);
    return true;
}

// The decoder itself can leave out up to seven eighths, which costs less than means do.
bool JpegReader::start() {
    if (setjmp(jump_) != 0) return false;
    const bool fourInks = jpeg_.jpeg_color_space == JCS_CMYK || jpeg_.jpeg_color_space == JCS_YCCK;
    const bool grey = jpeg_.jpeg_color_space == JCS_GRAYSCALE && request_.channels == 0;
    jpeg_.out_color_space = fourInks ? JCS_CMYK : grey ? JCS_GRAYSCALE : JCS_RGB;
    const int count = halvings(int(jpeg_.image_width), int(jpeg_.image_height), request_.maxPixels);
    jpeg_.scale_num = 1;
    jpeg_.scale_denom = 1u << std::min(count, 3);
    jpeg_start_decompress(&jpeg_);
    return true;
}

// Adobe's programs store inks inverted, and only they store inks.
void JpegReader::rgbFromCmyk() {
    const bool inverted = jpeg_.saw_Adobe_marker != FALSE;
    for (std::size_t x = 0; x < jpeg_.output_width; ++x)
        for (std::size_t c = 0; c < 3; ++c) {
            const int ink = inverted ? row_[4 * x + c] : 255 - row_[4 * x + c];
            const int black = inverted ? row_[4 * x + 3] : 255 - row_[4 * x + 3];
            out_[x * std::size_t(channels_) + c] = std::uint8_t((ink * black + 127) / 255);
        }
}

bool JpegReader::readRows() {
    if (setjmp(jump_) != 0) return false;
    while (jpeg_.output_scanline < jpeg_.output_height) {
        JSAMPROW row = row_.data();
        if (jpeg_read_scanlines(&jpeg_, &row, 1) != 1) continue;
        if (jpeg_.out_color_space == JCS_CMYK) {
            rgbFromCmyk();
        } else {
            const auto from = std::size_t(jpeg_.output_components), to = std::size_t(channels_);
            for (std::size_t x = 0; x < jpeg_.output_width; ++x)
                std::copy_n(&row_[x * from], from, &out_[x * to]);
        }
        shrinker_->add(out_.data());
    }
    jpeg_finish_decompress(&jpeg_);
    return true;
}

DecodeResult JpegReader::read() {
    jpeg_.err = jpeg_std_error(&errors_);
    errors_.error_exit = onError;
    errors_.emit_message = onMessage;
    jpeg_.client_data = this;
    if (!readHead()) return failed();
    const int width = int(jpeg_.image_width), height = int(jpeg_.image_height);
    const std::string problem =
        sizeProblem(jpeg_.image_width, jpeg_.image_height, file_.size(), request_.maxInFile);
    if (!problem.empty()) return {problem, width, height};
    if (!start()) return failed();
    channels_ = request_.channels == 4 ? 4 : std::min(jpeg_.output_components, 3);
    row_.resize(std::size_t(jpeg_.output_width) * std::size_t(jpeg_.output_components));
    out_.assign(std::size_t(jpeg_.output_width) * std::size_t(channels_), 255);  // opaque
    const int outWidth = int(jpeg_.output_width), outHeight = int(jpeg_.output_height);
    shrinker_ = std::make_unique<RowShrinker>(outWidth, outHeight, channels_,
                                              halvings(outWidth, outHeight, request_.maxPixels), image_);
    if (!readRows()) return failed();
    const auto pixels = std::uint64_t(width) * std::uint64_t(height);
    return {{}, width, height, pixels * std::uint64_t(jpeg_.num_components)};
}

}  // namespace

DecodeResult decodeJpeg(std::span<const std::uint8_t> file, const DecodeRequest& request, ByteImage& image) {
    return JpegReader(file, request, image).read();
}

}  // namespace conelight::io

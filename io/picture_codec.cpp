// SPDX-License-Identifier: MIT
#include "io/picture_codec.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>

#include "io/stb_impl.h"

namespace conelight::io {

bool isPng(std::span<const std::uint8_t> file) {
    return file.size() > 4 && file[0] == 0x89 && file[1] == 'P' && file[2] == 'N' && file[3] == 'G';
}

bool isJpeg(std::span<const std::uint8_t> file) {
    return file.size() > 4 && file[0] == 0xFF && file[1] == 0xD8;
}

std::string sizeProblem(std::uint64_t width, std::uint64_t height, std::size_t fileBytes,
                        std::uint64_t maxInFile) {
    constexpr std::uint64_t kMostSide = 32768;  // twice the texture limit of today's GPUs
    if (width == 0 || height == 0 || width > kMostSide || height > kMostSide || width * height > kMostPixels)
        return "has an unusable size";
    // No format packs more than about 1000 pixels into a byte (deflate's limit is 1032 to 1); beyond 4 million
    // pixels a picture must be that plausible.
    const std::uint64_t pixels = width * height;
    if (pixels > (std::uint64_t(1) << 22) && pixels / 1100 > fileBytes) return "has an unusable size";
    if (pixels > maxInFile)
        return fmt::format("has {}x{} pixels; at most {} would be right", width, height, maxInFile);
    return {};
}

int halvings(int width, int height, std::uint64_t maxPixels) {
    int count = 0;
    const auto pixels = [&] {
        const auto side = [&](int full) { return (std::uint64_t(full) + (1u << count) - 1) >> count; };
        return side(width) * side(height);
    };
    while (count < 12 && pixels() > maxPixels) ++count;
    return count;
}

RowShrinker::RowShrinker(int width, int height, int channels, int halvings, ByteImage& image)
    : image_(image), width_(width), height_(height), halvings_(halvings) {
    const int step = 1 << halvings;
    image_.width = (width + step - 1) / step;
    image_.height = (height + step - 1) / step;
    image_.channels = channels;
    image_.pixels.clear();
    image_.pixels.reserve(std::size_t(image_.width) * std::size_t(image_.height) * std::size_t(channels));
    if (halvings > 0) sums_.assign(std::size_t(image_.width) * std::size_t(channels), 0);
}

namespace {

// Adds the texels of a row to the sums of the squares they lie in. The number of channels is known to the
// compiler: a picture may have 2^28 texels.
template <std::size_t kChannels>
void addRow(const std::uint8_t* row, std::size_t width, int halvings, std::uint32_t* sums) {
    const std::size_t step = std::size_t(1) << halvings;
    for (std::size_t first = 0; first < width; first += step, sums += kChannels) {
        std::array<std::uint32_t, kChannels> sum{};
        for (std::size_t x = first; x < std::min(first + step, width); ++x, row += kChannels)
            for (std::size_t c = 0; c < kChannels; ++c) sum[c] += row[c];
        for (std::size_t c = 0; c < kChannels; ++c) sums[c] += sum[c];
    }
}

}  // namespace

void RowShrinker::add(const std::uint8_t* row) {
    const auto channels = std::size_t(image_.channels), width = std::size_t(width_);
    if (halvings_ == 0) {
        image_.pixels.insert(image_.pixels.end(), row, row + width * channels);
        return;
    }
    const auto addThis = channels == 4 ? addRow<4> : channels == 3 ? addRow<3> : addRow<1>;
    addThis(row, width, halvings_, sums_.data());
    ++row_;
    if (++summed_ == 1 << halvings_ || row_ == height_) finishRow();
}

void RowShrinker::finishRow() {
    const auto channels = std::size_t(image_.channels), width = std::size_t(image_.width);
    const std::size_t step = std::size_t(1) << halvings_, at = image_.pixels.size();
    image_.pixels.resize(at + width * channels);
    std::uint8_t* const out = &image_.pixels[at];
    // Squares that the picture ends in have fewer texels.
    const std::size_t whole = std::size_t(summed_) == step ? std::size_t(width_) / step : 0;
    const std::uint32_t half = 1u << (2 * halvings_ - 1);
    for (std::size_t i = 0; i < whole * channels; ++i)
        out[i] = std::uint8_t((sums_[i] + half) >> (2 * halvings_));
    for (std::size_t x = whole; x < width; ++x) {
        const std::size_t columns = std::min(step, std::size_t(width_) - x * step);
        const auto count = std::uint32_t(columns * std::size_t(summed_));
        for (std::size_t c = 0; c < channels; ++c)
            out[x * channels + c] = std::uint8_t((sums_[x * channels + c] + count / 2) / count);
    }
    std::fill(sums_.begin(), sums_.end(), 0u);
    summed_ = 0;
}

DecodeResult decodePicture(std::span<const std::uint8_t> file, const DecodeRequest& request,
                           ByteImage& image) {
    if (isPng(file)) return decodePng(file, request, image);
    if (isJpeg(file)) return decodeJpeg(file, request, image);
    if (isWebp(file)) return decodeWebp(file, request, image);
    ByteImage whole;
    std::string failure = stb::decodeBytes(file, request.channels, whole);
    if (failure.empty())
        failure = sizeProblem(std::uint64_t(whole.width), std::uint64_t(whole.height), file.size(),
                              request.maxInFile);
    if (!failure.empty()) return {std::move(failure), 0, 0};
    RowShrinker shrinker(whole.width, whole.height, whole.channels,
                         halvings(whole.width, whole.height, request.maxPixels), image);
    const std::size_t row = std::size_t(whole.width) * std::size_t(whole.channels);
    for (std::size_t y = 0; y < std::size_t(whole.height); ++y) shrinker.add(&whole.pixels[y * row]);
    return {{}, whole.width, whole.height, whole.pixels.size()};
}

}  // namespace conelight::io

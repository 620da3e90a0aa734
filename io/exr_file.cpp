// SPDX-License-Identifier: MIT
// OpenEXR in and out, through memory so that files appear whole: scanline, ZIP (16 rows a block), 32-bit
// float, increasing y. Layers follow the file format's "LAYER.CHANNEL" names. Reading takes the first part of
// any flat file (tiled too); deep data and subsampled (luminance-chroma) channels are refused.
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>
#include <fmt/core.h>

#include <algorithm>
#include <cassert>
#include <cstring>
#include <map>

#include "conelight/error.h"
#include "io/files.h"
#include "io/image_file.h"

namespace conelight::io {

namespace fs = std::filesystem;

namespace {

// OpenEXR's stream interfaces over a byte vector.
class MemoryOut final : public Imf::OStream {
  public:
    MemoryOut() : Imf::OStream("memory") {}
    void write(const char bytes[], int count) override {
        const std::size_t end = at_ + std::size_t(count);
        if (end > bytes_.size()) bytes_.resize(end);
        std::memcpy(bytes_.data() + at_, bytes, std::size_t(count));
        at_ = end;
    }
    std::uint64_t tellp() override { return at_; }
    void seekp(std::uint64_t position) override { at_ = std::size_t(position); }
    const Bytes& bytes() const { return bytes_; }

  private:
    Bytes bytes_;
    std::size_t at_ = 0;
};

class MemoryIn final : public Imf::IStream {
  public:
    explicit MemoryIn(const Bytes& bytes) : Imf::IStream("memory"), bytes_(bytes) {}
    bool read(char out[], int count) override {
        if (at_ > bytes_.size() || bytes_.size() - at_ < std::size_t(count))
            throw std::runtime_error("file ends early");
        std::memcpy(out, bytes_.data() + at_, std::size_t(count));
        at_ += std::size_t(count);
        return at_ < bytes_.size();
    }
    std::uint64_t tellg() override { return at_; }
    void seekg(std::uint64_t position) override { at_ = std::size_t(position); }

  private:
    const Bytes& bytes_;
    std::size_t at_ = 0;
};

// Channel suffixes of a layer with the given number of channels, in memory order.
std::vector<std::string> suffixesOf(int channels) {
    switch (channels) {
        case 2:
            return {"X", "Y"};
        case 3:
            return {"R", "G", "B"};
        case 4:
            return {"R", "G", "B", "A"};
        default:
            return {""};
    }
}

// Adds one interleaved layer to header and frame buffer. OpenEXR takes non-const pointers but only reads.
void addLayer(Imf::Header& header, Imf::FrameBuffer& buffer, const std::string& name, int channels, int width,
              const std::vector<float>& pixels) {
    const std::vector<std::string> suffixes = suffixesOf(channels);
    char* base = reinterpret_cast<char*>(const_cast<float*>(pixels.data()));
    for (std::size_t c = 0; c < suffixes.size(); ++c) {
        std::string channel = name;
        if (!suffixes[c].empty()) channel += (channel.empty() ? "" : ".") + suffixes[c];
        if (channel.empty()) channel = "Y";
        header.channels().insert(channel, Imf::Channel(Imf::FLOAT));
        buffer.insert(channel,
                      Imf::Slice(Imf::FLOAT, base + c * sizeof(float), std::size_t(channels) * sizeof(float),
                                 std::size_t(channels) * std::size_t(width) * sizeof(float)));
    }
}

// Channels of a file grouped by layer; "" is the picture itself.
using Layers = std::map<std::string, std::vector<std::string>>;

// Sorts suffixes the way they are stored in memory: R G B A, X Y Z, anything else by name.
int suffixRank(const std::string& suffix) {
    static const std::string kOrder = "RGBAXYZ";
    const std::size_t at = suffix.size() == 1 ? kOrder.find(suffix[0]) : std::string::npos;
    return at == std::string::npos ? 100 : int(at);
}

Layers layersOf(const Imf::ChannelList& channels, const std::string& file) {
    Layers layers;
    for (auto it = channels.begin(); it != channels.end(); ++it) {
        if (it.channel().xSampling != 1 || it.channel().ySampling != 1)
            throw Error(ErrorKind::BadInput,
                        fmt::format("{}: channel {}: is subsampled; only full-resolution channels are read",
                                    file, oneLine(it.name())));
        const std::string name = it.name();
        const std::size_t dot = name.rfind('.');
        const bool single = dot == std::string::npos && suffixRank(name) == 100;
        // "Z" or "depth" without a dot is a layer of one channel.
        const bool colour = name == "R" || name == "G" || name == "B" || name == "A" || name == "Y";
        if (dot != std::string::npos)
            layers[name.substr(0, dot)].push_back(name.substr(dot + 1));
        else if (!single && colour)
            layers[""].push_back(name);
        else
            layers[name].push_back("");
    }
    for (auto& [name, suffixes] : layers)
        std::stable_sort(suffixes.begin(), suffixes.end(), [](const std::string& a, const std::string& b) {
            return suffixRank(a) < suffixRank(b);
        });
    return layers;
}

std::string channelName(const std::string& layer, const std::string& suffix) {
    if (layer.empty()) return suffix;
    return suffix.empty() ? layer : layer + "." + suffix;
}

// OpenEXR asks for the memory that an attribute says it has, up to 2 GB, before it reads any of it. A header is a list
// of name, type, size and value; an empty name ends it, and in files of several parts an empty header the list of
// headers ("OpenEXR File Layout").
void requireAttributesInFile(const Bytes& bytes, const std::string& file) {
    constexpr std::size_t kBegin = 8, kSizeBytes = 4;  // magic number and version
    std::size_t at = kBegin;
    const auto word = [&] {
        const auto end = std::find(bytes.begin() + std::ptrdiff_t(at), bytes.end(), 0);
        const std::string text(bytes.begin() + std::ptrdiff_t(at), end);
        at = std::size_t(end - bytes.begin()) + 1;
        return text;
    };
    bool first = true;  // of its header
    while (at < bytes.size()) {
        const std::string name = word();
        const bool ends = name.empty();
        if (ends && first) return;
        first = ends;
        if (ends) {
            constexpr std::size_t kFlags = 5;
            constexpr int kMultiPart = 0x10;
            if ((bytes[kFlags] & kMultiPart) == 0) return;
            continue;
        }
        word();
        if (at + kSizeBytes > bytes.size()) return;  // it ends early, which is said later
        std::uint32_t size = 0;                      // little-endian
        for (std::size_t i = 0; i < kSizeBytes; ++i) size |= std::uint32_t(bytes[at + i]) << (8 * i);
        at += kSizeBytes;
        if (size > bytes.size() - at)
            throw Error(ErrorKind::BadInput,
                        fmt::format("{}: header: attribute '{}' of {} bytes is larger than the file", file,
                                    oneLine(name), size));
        at += size;
    }
}

FloatImage readFrom(const Bytes& bytes, const std::string& file) {
    requireAttributesInFile(bytes, file);
    MemoryIn stream(bytes);
    Imf::InputFile input(stream);
    const Imath::Box2i window = input.header().dataWindow();
    const long long width = 1LL + window.max.x - window.min.x;
    const long long height = 1LL + window.max.y - window.min.y;
    if (width <= 0 || height <= 0 || width > (1 << 16) || height > (1 << 16) || width * height > (1LL << 28))
        throw Error(ErrorKind::BadInput, fmt::format("{}: data window: has an unusable size", file));

    FloatImage image;
    image.width = int(width);
    image.height = int(height);
    const Layers layers = layersOf(input.header().channels(), file);
    if (layers.empty()) throw Error(ErrorKind::BadInput, fmt::format("{}: has no channels", file));
    std::size_t channelCount = 0;
    for (const auto& [name, suffixes] : layers) channelCount += suffixes.size();
    // 2^31 floats are 8 GiB: more is a broken header. So is, above 16 million floats, more than 65536 of them
    // per byte (an empty PIZ picture has 6000).
    const std::size_t values = channelCount * std::size_t(width * height);
    if (values > (std::size_t(1) << 31) || (values > (std::size_t(1) << 24) && values / 65536 > bytes.size()))
        throw Error(ErrorKind::BadInput, fmt::format("{}: header: its size does not fit the file", file));

    Imf::FrameBuffer buffer;
    image.layers.reserve(layers.size());
    for (const auto& [name, suffixes] : layers) {
        ImageLayer layer{name, int(suffixes.size()), {}};
        layer.pixels.assign(suffixes.size() * std::size_t(width * height), 0.0f);
        const std::size_t stride = suffixes.size() * sizeof(float);
        // Slices address pixel (0,0); the data window may start elsewhere.
        char* base = reinterpret_cast<char*>(layer.pixels.data()) -
                     std::ptrdiff_t(stride) * (window.min.x + std::ptrdiff_t(window.min.y) * width);
        for (std::size_t c = 0; c < suffixes.size(); ++c)
            buffer.insert(channelName(name, suffixes[c]), Imf::Slice(Imf::FLOAT, base + c * sizeof(float),
                                                                     stride, stride * std::size_t(width)));
        image.layers.push_back(std::move(layer));
    }
    input.setFrameBuffer(buffer);
    input.readPixels(window.min.y, window.max.y);

    // The unnamed layer is the picture; without one the first layer serves as it and stays a layer.
    ImageLayer& first = image.layers.front();
    image.channels = first.channels;
    if (first.name.empty()) {
        image.pixels = std::move(first.pixels);
        image.layers.erase(image.layers.begin());
    } else {
        image.pixels = first.pixels;
    }
    for (auto it = input.header().begin(); it != input.header().end(); ++it)
        if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&it.attribute()))
            image.attributes.emplace_back(it.name(), text->value());
    return image;
}

}  // namespace

void writeExr(const fs::path& path, const FloatImage& image) {
    assert(image.pixels.size() ==
           std::size_t(image.width) * std::size_t(image.height) * std::size_t(image.channels));
    MemoryOut stream;
    try {
        Imf::Header header(image.width, image.height);
        header.compression() = Imf::ZIP_COMPRESSION;
        header.lineOrder() = Imf::INCREASING_Y;
        Imf::addChromaticities(header, Imf::Chromaticities());  // default: Rec.709 primaries, D65
        for (const auto& [name, text] : image.attributes) header.insert(name, Imf::StringAttribute(text));
        Imf::FrameBuffer buffer;
        addLayer(header, buffer, "", image.channels, image.width, image.pixels);
        for (const ImageLayer& layer : image.layers) {
            assert(!layer.name.empty() && layer.pixels.size() == std::size_t(image.width) *
                                                                     std::size_t(image.height) *
                                                                     std::size_t(layer.channels));
            addLayer(header, buffer, layer.name, layer.channels, image.width, layer.pixels);
        }
        Imf::OutputFile output(stream, header);
        output.setFrameBuffer(buffer);
        output.writePixels(image.height);
    } catch (const std::exception& error) {
        throw Error(ErrorKind::Runtime, fmt::format("{}: cannot be encoded as EXR: {}",
                                                    oneLine(path.string()), oneLine(error.what())));
    }
    writeFile(path, stream.bytes());
}

FloatImage readExr(const fs::path& path) {
    const Bytes bytes = readFile(path);
    const std::string file = oneLine(path.string());
    try {
        return readFrom(bytes, file);
    } catch (const Error&) {
        throw;
    } catch (const std::exception& error) {
        throw Error(ErrorKind::BadInput,
                    fmt::format("{}: is not a usable EXR picture: {}", file, oneLine(error.what())));
    }
}

}  // namespace conelight::io

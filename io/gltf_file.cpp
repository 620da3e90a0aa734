// SPDX-License-Identifier: MIT
// glTF container: see gltf_file.h. Layout rules: glTF 2.0 specification, sections 3.6 (buffers, accessors)
// and 4 (GLB). Written on nlohmann::json instead of a glTF library so that each error can name its place and
// no check depends on somebody else's.
#include "io/gltf_file.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "conelight/error.h"
#include "io/gltf.h"
#include "io/gltf_meshopt.h"

namespace conelight::io {

namespace fs = std::filesystem;
using AnyJson = nlohmann::json;

namespace {

constexpr std::size_t kMaxDepth = 200;                         // of the JSON; real files stay below 20
constexpr std::uint64_t kMaxNumbers = std::uint64_t(1) << 29;  // read in total: 100 million triangles' worth
constexpr std::uint64_t kMaxUnpackedBytes = std::uint64_t(1) << 31;
constexpr std::uint64_t kMaxEmptyCount = std::uint64_t(1) << 22;  // elements of an accessor without data

[[noreturn]] void failFile(const std::string& file, const std::string& why) {
    throw Error(ErrorKind::BadInput, fmt::format("{}: {}", file, why));
}

std::uint32_t littleEndian32(const std::uint8_t* at) {
    return std::uint32_t(at[0]) | std::uint32_t(at[1]) << 8 | std::uint32_t(at[2]) << 16 |
           std::uint32_t(at[3]) << 24;
}

// Depth of nested brackets outside strings; keeps later recursive walks safe.
std::size_t nestingOf(std::string_view text) {
    std::size_t depth = 0, deepest = 0;
    bool inString = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (inString) {
            if (c == '\\')
                ++i;
            else if (c == '"')
                inString = false;
        } else if (c == '"') {
            inString = true;
        } else if (c == '{' || c == '[') {
            deepest = std::max(deepest, ++depth);
        } else if ((c == '}' || c == ']') && depth > 0) {
            --depth;
        }
    }
    return deepest;
}

std::size_t componentSize(std::uint64_t type) {
    switch (type) {
        case 5120:
        case 5121:
            return 1;
        case 5122:
        case 5123:
            return 2;
        case 5125:
        case 5126:
            return 4;
        default:
            return 0;
    }
}

template <typename T>
T load(const std::uint8_t* at) {
    T value;
    std::memcpy(&value, at, sizeof value);  // glTF is little-endian, as is every machine with OpenGL 4.5
    return value;
}

double component(const std::uint8_t* at, std::uint64_t type, bool normalized) {
    switch (type) {
        case 5120:
            return normalized ? std::max(load<std::int8_t>(at) / 127.0, -1.0) : load<std::int8_t>(at);
        case 5121:
            return normalized ? *at / 255.0 : *at;
        case 5122:
            return normalized ? std::max(load<std::int16_t>(at) / 32767.0, -1.0) : load<std::int16_t>(at);
        case 5123:
            return normalized ? load<std::uint16_t>(at) / 65535.0 : load<std::uint16_t>(at);
        case 5125:
            return normalized ? load<std::uint32_t>(at) / 4294967295.0 : load<std::uint32_t>(at);
        default:
            return load<float>(at);
    }
}

}  // namespace

void GltfValue::fail(const std::string& why) const {
    failFile(*file_, path_.empty() ? why : fmt::format("{}: {}", oneLine(path_), why));
}

GltfValue GltfValue::operator[](const char* key) const {
    std::string path = path_.empty() ? std::string(key) : path_ + "." + key;
    if (!exists()) return {*file_, nullptr, std::move(path)};
    if (!value_->is_object()) fail("an object expected");
    const auto found = value_->find(key);
    return {*file_, found == value_->end() ? nullptr : &*found, std::move(path)};
}

GltfValue GltfValue::operator[](std::size_t index) const {
    std::string path = fmt::format("{}[{}]", path_, index);
    if (!exists()) return {*file_, nullptr, std::move(path)};
    if (!value_->is_array()) fail("an array expected");
    return {*file_, index < value_->size() ? &(*value_)[index] : nullptr, std::move(path)};
}

std::size_t GltfValue::size() const {
    if (!exists()) return 0;
    if (!value_->is_array()) fail("an array expected");
    return value_->size();
}

GltfValue GltfValue::extension(const char* name) const { return (*this)["extensions"][name]; }

float GltfValue::number(float otherwise) const {
    if (!exists()) return otherwise;
    if (!value_->is_number()) fail("a number expected");
    const float value = value_->get<float>();
    if (!std::isfinite(value)) fail("a finite number expected");
    return value;
}

bool GltfValue::boolean(bool otherwise) const {
    if (!exists()) return otherwise;
    if (!value_->is_boolean()) fail("true or false expected");
    return value_->get<bool>();
}

std::string GltfValue::text(const std::string& otherwise) const {
    if (!exists()) return otherwise;
    if (!value_->is_string()) fail("a string expected");
    return value_->get<std::string>();
}

void GltfValue::numbers(float* out, std::size_t count) const {
    if (size() != count) fail(fmt::format("{} numbers expected", count));
    for (std::size_t i = 0; i < count; ++i) out[i] = (*this)[i].number(0.0f);
}

std::uint64_t GltfValue::whole(std::uint64_t otherwise) const {
    if (!exists()) return otherwise;
    if (value_->is_number_unsigned()) return value_->get<std::uint64_t>();
    if (value_->is_number_float()) {  // some writers print 3.0
        const double value = value_->get<double>();
        if (value >= 0.0 && value <= 9.0e15 && value == std::floor(value)) return std::uint64_t(value);
    }
    fail("a whole number of 0 or more expected");
}

std::optional<std::size_t> GltfValue::index(std::size_t limit) const {
    if (!exists()) return std::nullopt;
    const std::uint64_t value = whole(0);
    if (value >= limit) fail(fmt::format("index {} is out of range; there are {}", value, limit));
    return std::size_t(value);
}

GltfFile::GltfFile(const fs::path& path, bool allowOutside)
    : folder_(path, allowOutside), file_(oneLine(path.string())) {
    Bytes bytes = readFile(path);
    if (bytes.size() >= 4 && std::memcmp(bytes.data(), "glTF", 4) == 0) {
        // GLB: 12 bytes head, then chunks of length, type, data: JSON first, then optionally BIN.
        if (bytes.size() < 20) failFile(file_, "GLB: ends within its header");
        const std::uint32_t version = littleEndian32(&bytes[4]);
        if (version == 1) throw GltfVersion1();
        if (version != 2) failFile(file_, fmt::format("GLB: version {} is unknown; 2 is read", version));
        const std::uint64_t total = littleEndian32(&bytes[8]);
        if (total > bytes.size())
            failFile(file_, fmt::format("GLB: ends early: {} of {} bytes", bytes.size(), total));
        const std::uint64_t jsonLength = littleEndian32(&bytes[12]);
        if (littleEndian32(&bytes[16]) != 0x4E4F534Au) failFile(file_, "GLB: its first chunk is not JSON");
        if (jsonLength > total - std::min<std::uint64_t>(total, 20))
            failFile(file_, "GLB: its JSON chunk is longer than the file");
        readJson({reinterpret_cast<const char*>(bytes.data()) + 20, std::size_t(jsonLength)});
        const std::uint64_t next = 20 + jsonLength;
        if (next + 8 <= total && littleEndian32(&bytes[next + 4]) == 0x004E4942u) {
            const std::uint64_t length = littleEndian32(&bytes[next]);
            if (length > total - next - 8) failFile(file_, "GLB: its binary chunk is longer than the file");
            binaryChunk_.emplace(bytes.begin() + std::ptrdiff_t(next + 8),
                                 bytes.begin() + std::ptrdiff_t(next + 8 + length));
        }
    } else {
        readJson({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    }
    const GltfValue versionValue = root()["asset"]["version"];
    if (versionValue.isNumber() && versionValue.number(0.0f) < 2.0f) throw GltfVersion1();
    const std::string version = versionValue.text("");
    if (version.rfind("1.", 0) == 0 || version == "1") throw GltfVersion1();
    if (version.empty()) failFile(file_, "asset.version: is missing; not a glTF file");
    if (version.rfind("2.", 0) != 0 && version != "2")
        failFile(file_, fmt::format("asset.version: '{}' is unknown; 2.0 is read", oneLine(version)));
}

void GltfFile::readJson(std::string_view text) {
    if (text.substr(0, 3) == "\xEF\xBB\xBF") text.remove_prefix(3);
    if (nestingOf(text) > kMaxDepth) failFile(file_, "JSON: is nested too deeply");
    // GLB pads with blanks; some writers pad with zeros.
    while (!text.empty() && (text.back() == '\0' || text.back() == ' ')) text.remove_suffix(1);
    try {
        json_ = AnyJson::parse(text);
    } catch (const AnyJson::exception& error) {
        failFile(file_, "JSON: " + oneLine(error.what()));
    }
    if (!json_.is_object()) failFile(file_, "JSON: an object expected at the top");
}

Bytes GltfFile::uriBytes(const GltfValue& uri) const {
    const std::string text = uri.text("");
    if (text.rfind("data:", 0) == 0) {
        const std::size_t comma = text.find(',');
        if (comma == std::string::npos) uri.fail("data URI without a comma");
        if (text.substr(0, comma).find(";base64") == std::string::npos) {
            const std::string decoded = percentDecoded(text.substr(comma + 1));
            return {decoded.begin(), decoded.end()};
        }
        std::optional<Bytes> bytes = base64Decoded(std::string_view(text).substr(comma + 1));
        if (!bytes) uri.fail("data URI is not base64");
        return std::move(*bytes);
    }
    if (text.find("://") != std::string::npos) uri.fail("only files beside the scene and data URIs are read");
    // Names with percent signs exist: the spelling of the file wins, then the decoded one.
    const std::string decoded = percentDecoded(text);
    const SceneFolder::Choice found = folder_.firstOf({folder_.path() / text, folder_.path() / decoded});
    if (found.file.empty()) uri.fail(fmt::format("{}: {}", oneLine(decoded), found.refusal));
    try {
        return folder_.read(found.file);
    } catch (const Error& error) {
        uri.fail(error.what());
    }
}

Bytes GltfFile::imageBytes(const GltfValue& image) {
    if (image["bufferView"].exists()) {
        const std::span<const std::uint8_t> bytes = bufferView(image["bufferView"]);
        return {bytes.begin(), bytes.end()};
    }
    if (!image["uri"].exists()) image.fail("has neither uri nor bufferView");
    return uriBytes(image["uri"]);
}

const Bytes& GltfFile::buffer(std::size_t index) {
    const auto known = buffers_.find(index);
    if (known != buffers_.end()) return known->second;
    const GltfValue value = array("buffers")[index];
    const std::uint64_t length = value["byteLength"].whole(0);
    Bytes bytes;
    if (value["uri"].exists())
        bytes = uriBytes(value["uri"]);
    else if (index == 0 && binaryChunk_)
        bytes = std::move(*binaryChunk_);
    else
        value.fail("has neither a uri nor a binary chunk");
    if (bytes.size() < length)
        value.fail(fmt::format("has {} bytes; byteLength says {}", bytes.size(), length));
    bytes.resize(std::size_t(length));
    return buffers_.emplace(index, std::move(bytes)).first->second;
}

std::span<const std::uint8_t> GltfFile::bytesOf(const GltfValue& value) {
    const std::optional<std::size_t> bufferAt = value["buffer"].index(array("buffers").size());
    if (!bufferAt) value["buffer"].fail("is missing");
    const Bytes& bytes = buffer(*bufferAt);
    const std::uint64_t offset = value["byteOffset"].whole(0);
    const std::uint64_t length = value["byteLength"].whole(0);
    if (offset > bytes.size() || length > bytes.size() - offset)
        value.fail(
            fmt::format("bytes {} to {} are beyond the buffer's {}", offset, offset + length, bytes.size()));
    return std::span(bytes).subspan(std::size_t(offset), std::size_t(length));
}

std::span<const std::uint8_t> GltfFile::bufferView(const GltfValue& viewIndex) {
    const std::optional<std::size_t> at = viewIndex.index(array("bufferViews").size());
    if (!at) viewIndex.fail("is missing");
    const GltfValue view = array("bufferViews")[*at];
    const GltfValue packed = view.extension("EXT_meshopt_compression");
    if (!packed.exists()) return bytesOf(view);
    const auto known = unpackedViews_.find(*at);
    if (known != unpackedViews_.end()) return known->second;
    Bytes bytes = unpackMeshopt(packed, bytesOf(packed));
    unpackedBytes_ += bytes.size();
    if (unpackedBytes_ > kMaxUnpackedBytes) packed.fail("the file has more than 2 GiB of compressed data");
    return unpackedViews_.emplace(*at, std::move(bytes)).first->second;
}

// The numbers of an accessor's JSON, checked for kind but not yet against the buffer.
struct GltfFile::Layout {
    GltfValue value;
    std::size_t index;  // of the accessor
    std::uint64_t count;
    std::uint64_t type;
    std::size_t components;
    bool normalized;
    std::size_t elementSize() const { return components * componentSize(type); }
};

GltfFile::Layout GltfFile::layoutOf(const GltfValue& accessorIndex) const {
    const std::optional<std::size_t> at = accessorIndex.index(array("accessors").size());
    if (!at) accessorIndex.fail("is missing");
    const GltfValue value = array("accessors")[*at];
    static const std::map<std::string, std::size_t> kComponents = {
        {"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT2", 4}, {"MAT3", 9}, {"MAT4", 16}};
    const std::string kind = value["type"].text("");
    const auto found = kComponents.find(kind);
    if (found == kComponents.end()) value["type"].fail(fmt::format("'{}' is unknown", oneLine(kind)));
    Layout layout{value,
                  *at,
                  value["count"].whole(0),
                  value["componentType"].whole(0),
                  found->second,
                  value["normalized"].boolean(false)};
    if (componentSize(layout.type) == 0)
        value["componentType"].fail(fmt::format("{} is unknown", layout.type));
    // Columns of small matrices are padded to 4 bytes; only float matrices are used by what we read.
    if (kind.rfind("MAT", 0) == 0 && layout.type != 5126)
        value.fail("matrices of whole numbers are not supported");
    return layout;
}

std::size_t GltfFile::accessorCount(const GltfValue& accessorIndex) const {
    return std::size_t(layoutOf(accessorIndex).count);
}

GltfFile::AccessorShape GltfFile::shapeOf(const GltfValue& accessorIndex) const {
    const Layout layout = layoutOf(accessorIndex);
    return {layout.index, layout.type, layout.components, layout.count};
}

struct GltfFile::Elements {
    std::span<const std::uint8_t> data;
    std::uint64_t stride, offset;
};

std::optional<GltfFile::Elements> GltfFile::elementsOf(const Layout& layout) {
    const std::size_t elementSize = layout.elementSize();
    if (const auto given = givenElements_.find(layout.index); given != givenElements_.end()) {
        if (given->second.size() / elementSize != layout.count)
            layout.value.fail(
                fmt::format("has {} decoded bytes for {} elements", given->second.size(), layout.count));
        return Elements{given->second, elementSize, 0};
    }
    if (!layout.value["bufferView"].exists()) {
        if (layout.count > kMaxEmptyCount)
            layout.value["count"].fail("is too large for an accessor without data");
        return {};
    }
    const std::span<const std::uint8_t> data = bufferView(layout.value["bufferView"]);
    const GltfValue view = array("bufferViews")[layout.value["bufferView"].whole(0)];
    const std::uint64_t stride = view["byteStride"].whole(elementSize);
    const std::uint64_t offset = layout.value["byteOffset"].whole(0);
    if (stride < elementSize)
        view["byteStride"].fail(fmt::format("{} is less than an element's {} bytes", stride, elementSize));
    if (layout.count > 0 && (offset > data.size() || elementSize > data.size() - offset ||
                             (layout.count - 1) > (data.size() - offset - elementSize) / stride))
        layout.value.fail(
            fmt::format("{} elements reach beyond their buffer view of {} bytes", layout.count, data.size()));
    return Elements{data, stride, offset};
}

template <typename Put>
void GltfFile::putSparse(const Layout& layout, const Put& put) {
    const GltfValue sparse = layout.value["sparse"];
    if (!sparse.exists()) return;
    const std::size_t elementSize = layout.elementSize();
    const std::uint64_t count = sparse["count"].whole(0);
    const GltfValue indices = sparse["indices"], values = sparse["values"];
    const std::uint64_t indexType = indices["componentType"].whole(0);
    const std::size_t indexSize =
        indexType == 5121 || indexType == 5123 || indexType == 5125 ? componentSize(indexType) : 0;
    if (indexSize == 0) indices["componentType"].fail(fmt::format("{} is not an index type", indexType));
    const std::span<const std::uint8_t> indexData = bufferView(indices["bufferView"]),
                                        valueData = bufferView(values["bufferView"]);
    const std::uint64_t indexOffset = indices["byteOffset"].whole(0),
                        valueOffset = values["byteOffset"].whole(0);
    if (indexOffset > indexData.size() || count > (indexData.size() - indexOffset) / indexSize ||
        valueOffset > valueData.size() || count > (valueData.size() - valueOffset) / elementSize)
        sparse.fail(fmt::format("{} elements reach beyond their buffer views", count));
    for (std::uint64_t i = 0; i < count; ++i) {
        const auto element =
            std::uint64_t(component(indexData.data() + indexOffset + i * indexSize, indexType, false));
        if (element >= layout.count)
            sparse.fail(fmt::format("index {} is out of range; there are {}", element, layout.count));
        put(element, valueData.data() + valueOffset + i * elementSize);
    }
}

template <typename Number>
std::vector<Number> GltfFile::read(const GltfValue& accessorIndex, std::size_t components, bool allowFewer,
                                   Number padding) {
    const Layout layout = layoutOf(accessorIndex);
    if (layout.components != components && !(allowFewer && layout.components < components))
        layout.value["type"].fail(
            fmt::format("{} components expected, found {}", components, layout.components));
    const std::optional<Elements> elements = elementsOf(layout);
    numbersRead_ += layout.count * components;
    if (numbersRead_ > kMaxNumbers) layout.value.fail("the file has more than 500 million numbers");

    std::vector<Number> out(std::size_t(layout.count) * components, padding);
    const auto put = [&](std::uint64_t element, const std::uint8_t* from) {
        for (std::size_t c = 0; c < layout.components; ++c) {
            const double number =
                component(from + c * componentSize(layout.type), layout.type, layout.normalized);
            if (!std::isfinite(number))
                layout.value.fail(fmt::format("element {} is not a finite number", element));
            out[std::size_t(element) * components + c] = Number(number);
        }
    };
    if (elements)
        for (std::uint64_t i = 0; i < layout.count; ++i)
            put(i, elements->data.data() + elements->offset + i * elements->stride);
    else
        std::fill(out.begin(), out.end(), Number(0));
    putSparse(layout, put);
    return out;
}

std::vector<float> GltfFile::floats(const GltfValue& accessorIndex, std::size_t components, bool allowFewer,
                                    float padding) {
    return read<float>(accessorIndex, components, allowFewer, padding);
}

std::vector<std::uint32_t> GltfFile::wholes(const GltfValue& accessorIndex, std::size_t components) {
    const std::uint64_t type = layoutOf(accessorIndex).type;
    if (type != 5121 && type != 5123 && type != 5125)
        accessorIndex.fail("whole numbers of 0 or more expected");
    return read<std::uint32_t>(accessorIndex, components, false, 0);
}

}  // namespace conelight::io

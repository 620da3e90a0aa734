// SPDX-License-Identifier: MIT
// KHR_draco_mesh_compression through Google's Draco. A few bytes may say a billion vertices, so it runs in a
// child process with a limit, as Assimp does.
#include "io/gltf_draco.h"

#include <fmt/core.h>

#include <cstring>
#include <functional>
#include <set>

#include "conelight/error.h"
#include "io/child_process.h"

#ifdef CONELIGHT_HAS_DRACO
#include <draco/compression/decode.h>
#endif

namespace conelight::io {

namespace {

constexpr const char* kExtension = "KHR_draco_mesh_compression";

void forEachCompressed(GltfFile& file, const std::function<void(const GltfValue& primitive)>& visit) {
    const GltfValue meshes = file.array("meshes");
    for (std::size_t m = 0; m < meshes.size(); ++m) {
        const GltfValue primitives = meshes[m]["primitives"];
        for (std::size_t p = 0; p < primitives.size(); ++p)
            if (primitives[p].extension(kExtension).exists()) visit(primitives[p]);
    }
}

}  // namespace

#ifdef CONELIGHT_HAS_DRACO

namespace {

// Elements of one accessor, as the child hands them on.
struct Block {
    std::uint64_t accessor, bytes;
};

void append(Bytes& all, std::uint64_t accessor, const Bytes& elements) {
    const Block block{accessor, elements.size()};
    const std::size_t at = all.size();
    all.resize(at + sizeof block + elements.size());
    std::memcpy(&all[at], &block, sizeof block);
    if (!elements.empty()) std::memcpy(&all[at + sizeof block], elements.data(), elements.size());
}

template <typename T>
void appendIndices(const draco::Mesh& mesh, Bytes& elements) {
    elements.resize(3 * std::size_t(mesh.num_faces()) * sizeof(T));
    std::size_t at = 0;
    for (std::uint32_t f = 0; f < mesh.num_faces(); ++f)
        for (const draco::PointIndex& corner : mesh.face(draco::FaceIndex(f))) {
            const auto index = static_cast<T>(corner.value());
            std::memcpy(&elements[at], &index, sizeof index);
            at += sizeof index;
        }
}

template <typename T>
bool appendAttribute(const draco::PointAttribute& attribute, std::uint32_t points, std::size_t components,
                     Bytes& elements) {
    elements.resize(points * components * sizeof(T));
    std::vector<T> values(components);
    for (std::uint32_t p = 0; p < points; ++p) {
        if (!attribute.ConvertValue<T>(attribute.mapped_index(draco::PointIndex(p)),
                                       static_cast<std::int8_t>(components), values.data()))
            return false;
        std::memcpy(&elements[p * components * sizeof(T)], values.data(), components * sizeof(T));
    }
    return true;
}

void appendAttribute(const GltfValue& at, const GltfFile::AccessorShape& shape, const draco::Mesh& mesh,
                     std::int64_t id, Bytes& elements) {
    const draco::PointAttribute* const attribute = mesh.GetAttributeByUniqueId(std::uint32_t(id));
    if (attribute == nullptr) at.fail(fmt::format("attribute {} is not in the compressed data", id));
    const std::uint32_t points = mesh.num_points();
    if (points != shape.count)
        at.fail(
            fmt::format("the compressed data has {} vertices; the accessor says {}", points, shape.count));
    bool converted = false;
    switch (shape.type) {
        case 5120:
            converted = appendAttribute<std::int8_t>(*attribute, points, shape.components, elements);
            break;
        case 5121:
            converted = appendAttribute<std::uint8_t>(*attribute, points, shape.components, elements);
            break;
        case 5122:
            converted = appendAttribute<std::int16_t>(*attribute, points, shape.components, elements);
            break;
        case 5123:
            converted = appendAttribute<std::uint16_t>(*attribute, points, shape.components, elements);
            break;
        case 5125:
            converted = appendAttribute<std::uint32_t>(*attribute, points, shape.components, elements);
            break;
        default:
            converted = appendAttribute<float>(*attribute, points, shape.components, elements);
    }
    if (!converted) at.fail("the compressed data does not have the numbers that the accessor names");
}

// Appends the elements of all accessors of a primitive that `done` does not have.
void decode(GltfFile& file, const GltfValue& primitive, std::set<std::uint64_t>& done, Bytes& all) {
    const GltfValue extension = primitive.extension(kExtension);
    const std::span<const std::uint8_t> packed = file.bufferView(extension["bufferView"]);
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(packed.data()), packed.size());
    draco::Decoder decoder;
    auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
    if (!decoded.ok()) extension.fail("cannot be decoded: " + oneLine(decoded.status().error_msg_string()));
    const draco::Mesh& mesh = *decoded.value();

    if (primitive["indices"].exists()) {
        const GltfFile::AccessorShape shape = file.shapeOf(primitive["indices"]);
        if (done.insert(shape.index).second) {
            if (shape.count != 3 * std::uint64_t(mesh.num_faces()))
                primitive["indices"].fail(
                    fmt::format("the compressed data has {} indices; the accessor says {}",
                                3 * std::uint64_t(mesh.num_faces()), shape.count));
            Bytes elements;
            if (shape.type == 5121)
                appendIndices<std::uint8_t>(mesh, elements);
            else if (shape.type == 5123)
                appendIndices<std::uint16_t>(mesh, elements);
            else
                appendIndices<std::uint32_t>(mesh, elements);
            append(all, shape.index, elements);
        }
    }
    const GltfValue ids = extension["attributes"];
    if (!ids.isObject()) ids.fail("is missing");
    for (const auto& entry : ids.json().items()) {
        const GltfValue accessor = primitive["attributes"][entry.key().c_str()];
        const GltfValue id = ids[entry.key().c_str()];
        if (!accessor.exists()) id.fail("the primitive has no such attribute");
        const GltfFile::AccessorShape shape = file.shapeOf(accessor);
        if (!done.insert(shape.index).second) continue;
        Bytes elements;
        appendAttribute(accessor, shape, mesh, std::int64_t(id.whole(0) & 0xffffffffu), elements);
        append(all, shape.index, elements);
    }
}

}  // namespace

void unpackDraco(GltfFile& file) {
    std::uint64_t packedBytes = 0;
    bool any = false;
    forEachCompressed(file, [&](const GltfValue& primitive) {
        any = true;
        // Here, so that a buffer that cannot be read is told by its own line, and is read once.
        packedBytes += file.bufferView(primitive.extension(kExtension)["bufferView"]).size();
    });
    if (!any) return;
    // Draco decodes 10 MB of its bytes a second and more; a byte is 20 of what is decoded, with copies 100.
    const ChildLimits limits{10.0 + double(packedBytes) / 1e6, (std::uint64_t(2) << 30) + 200 * packedBytes};
    const ChildResult result = runInChild(
        [&] {
            Bytes all;
            std::set<std::uint64_t> done;
            forEachCompressed(file, [&](const GltfValue& primitive) { decode(file, primitive, done, all); });
            return all;
        },
        limits);
    if (!result.failure.empty()) {
        // A line of ours starts with the file; how a child ended does not.
        const std::string line = oneLine(result.failure);
        if (line.starts_with(file.name())) throw Error(ErrorKind::BadInput, line);
        file.root().fail(fmt::format("{}: {}", kExtension, line));
    }
    std::size_t at = 0;
    const Bytes& all = result.bytes;
    while (at < all.size()) {
        Block block{};
        if (all.size() - at < sizeof block) file.root().fail("the decoded data ends early");
        std::memcpy(&block, &all[at], sizeof block);
        at += sizeof block;
        if (block.bytes > all.size() - at) file.root().fail("the decoded data ends early");
        file.giveElements(std::size_t(block.accessor),
                          {all.begin() + std::ptrdiff_t(at), all.begin() + std::ptrdiff_t(at + block.bytes)});
        at += std::size_t(block.bytes);
    }
}

#else

void unpackDraco(GltfFile& file) {
    forEachCompressed(file, [&](const GltfValue& primitive) {
        // Files may keep the plain data beside it.
        const std::size_t accessor = file.shapeOf(primitive["attributes"]["POSITION"]).index;
        if (!file.array("accessors")[accessor]["bufferView"].exists())
            primitive.extension(kExtension)
                .fail("this build has no Draco, which decodes it; build with libdraco-dev installed");
    });
}

#endif

}  // namespace conelight::io

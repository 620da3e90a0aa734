// SPDX-License-Identifier: MIT
// EXT_meshopt_compression through meshoptimizer. It trusts the sizes that it is given, so all are checked here.
#include "io/gltf_meshopt.h"

#include <fmt/core.h>

#ifdef CONELIGHT_HAS_MESHOPT
#include <meshoptimizer.h>
#endif

namespace conelight::io {

#ifdef CONELIGHT_HAS_MESHOPT

namespace {

// No mode packs more bytes into one: 16 values of a column in two bits are 64.
constexpr std::uint64_t kMostPerByte = 256;

void unpackAttributes(const GltfValue& extension, std::size_t count, std::size_t stride,
                      std::span<const std::uint8_t> packed, Bytes& bytes) {
    if (stride % 4 != 0 || stride > 256)
        extension["byteStride"].fail(
            fmt::format("{} is not a multiple of 4 from 4 to 256, as attributes need", stride));
    if (meshopt_decodeVertexBuffer(bytes.data(), count, stride, packed.data(), packed.size()) != 0)
        extension.fail("its attributes cannot be decoded");
    const std::string filter = extension["filter"].text("NONE");
    if (filter == "NONE") return;
    // As the extension says, by filter: OCTAHEDRAL 4 or 8 bytes, QUATERNION 8, EXPONENTIAL any.
    if (filter == "OCTAHEDRAL" && (stride == 4 || stride == 8))
        meshopt_decodeFilterOct(bytes.data(), count, stride);
    else if (filter == "QUATERNION" && stride == 8)
        meshopt_decodeFilterQuat(bytes.data(), count, stride);
    else if (filter == "EXPONENTIAL")
        meshopt_decodeFilterExp(bytes.data(), count, stride);
    else
        extension["filter"].fail(
            fmt::format("'{}' with {} bytes an element is unknown; known: NONE, OCTAHEDRAL (4 or 8), "
                        "QUATERNION (8), EXPONENTIAL",
                        oneLine(filter), stride));
}

}  // namespace

Bytes unpackMeshopt(const GltfValue& extension, std::span<const std::uint8_t> packed) {
    const std::uint64_t count = extension["count"].whole(0), stride = extension["byteStride"].whole(0);
    if (stride == 0 || stride > 256) extension["byteStride"].fail("must be from 1 to 256");
    if (count > kMostPerByte * packed.size() / stride)
        extension["count"].fail(
            fmt::format("{} elements of {} bytes cannot be in {} bytes", count, stride, packed.size()));
    Bytes bytes(std::size_t(count * stride));
    const std::string mode = extension["mode"].text("");
    if (mode == "ATTRIBUTES") {
        unpackAttributes(extension, std::size_t(count), std::size_t(stride), packed, bytes);
        return bytes;
    }
    const bool triangles = mode == "TRIANGLES";
    if (!triangles && mode != "INDICES")
        extension["mode"].fail(
            fmt::format("'{}' is unknown; known: ATTRIBUTES, TRIANGLES, INDICES", oneLine(mode)));
    if (stride != 2 && stride != 4) extension["byteStride"].fail("indices have 2 or 4 bytes");
    if (triangles && count % 3 != 0) extension["count"].fail("triangles have 3 indices each");
    const auto size = std::size_t(count), bytesEach = std::size_t(stride);
    const int failed =
        triangles ? meshopt_decodeIndexBuffer(bytes.data(), size, bytesEach, packed.data(), packed.size())
                  : meshopt_decodeIndexSequence(bytes.data(), size, bytesEach, packed.data(), packed.size());
    if (failed != 0) extension.fail("its indices cannot be decoded");
    return bytes;
}

#else

Bytes unpackMeshopt(const GltfValue& extension, std::span<const std::uint8_t>) {
    extension.fail(
        "this build has no meshoptimizer, which decodes it; build with libmeshoptimizer-dev installed");
}

#endif

}  // namespace conelight::io

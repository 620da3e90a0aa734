// SPDX-License-Identifier: MIT
#include "light/face_order.h"

#include <algorithm>
#include <array>

#include "gl/gl.h"
#include "gl/pace.h"
#include "shared/irradiance.h"
#include "shared/prefix_sum.h"

namespace conelight::light {
namespace {

// Blocks of 16^3 voxels that are sorted at once (256^3 has half of that), so that bins take 38 MB at most.
constexpr std::uint32_t kMostBlocks = 8192;

struct OrderKey {
    int step;
    gl::ProgramDesc desc() const {
        return {{"light/cache_order.comp.glsl"}, {{"STEP", std::to_string(step)}}};
    }
    static std::vector<OrderKey> all() { return {{0}, {1}, {2}, {3}, {4}}; }
};

}  // namespace

void FaceOrder::takeCounts(bool late) {
    if (late) return late_.take(chunks_, 0, 2);
    const auto counts = chunks_.read<std::uint32_t>(2);
    counts_ = {counts[0], counts[1]};
}

const FaceOrder::Counts& FaceOrder::known() const {
    if (!late_.pending()) return counts_;
    std::array<std::uint32_t, 2> words{};
    late_.read(words);
    return counts_ = {words[0], words[1]};
}

void FaceOrder::reserveOrder(std::size_t faces) {
    if (order_.bytes() >= 4 * faces && order_) return;
    orderTexels_ = {};
    const bool grows = static_cast<bool>(order_);
    order_ = {};
    order_ = gl::Buffer(4 * (grows ? faces + faces / 4 : faces), "order of faces");
    orderTexels_ = gl::Texture(order_, GL_R32UI, "order of faces");
}

void FaceOrder::reserveBins(std::uint32_t count) {
    if (const std::size_t bytes = 4 * (3 + std::size_t{gpu::mostChunks(count)}); chunks_.bytes() < bytes)
        chunks_ = gl::Buffer(bytes, "chunks of bins");
    if (!block_) block_ = gl::Buffer(sizeof(gpu::CacheOrder), "order of faces constants");
    if (bins_.bytes() == std::size_t{8} * count) return;
    releaseBins();
    bins_ = gl::Buffer(std::size_t{8} * count, "bins of faces");
    binStarts_ = gl::Buffer(std::size_t{4} * count, "starts of bins of faces");
    binTexels_ = gl::Texture(bins_, GL_RG32UI, "bins of faces");
    binStartTexels_ = gl::Texture(binStarts_, GL_R32UI, "starts of bins of faces");
}

void FaceOrder::releaseBins() {
    binTexels_ = {};
    binStartTexels_ = {};
    bins_ = {};
    binStarts_ = {};
}

base::Steps FaceOrder::sortInSteps(const gl::Device& device, const voxels::SurfaceVoxels& surface,
                                   const gl::Buffer& states, const gl::Texture& stateTexels, Wanted wanted) {
    const bool late = wanted.late && device.readsLate();
    const std::uint32_t faces = surface.mostFaces();
    late_.drop();
    counts_ = {faces, 0};
    if (faces == 0) co_return;
    reserveOrder(faces);
    const glm::ivec3 blocks = (surface.grid().storedBricks() + 3) / 4;
    const auto blockCount = static_cast<std::uint32_t>(blocks.x * blocks.y * blocks.z);
    reserveBins(std::min(blockCount, kMostBlocks) * CACHE_BINS_PER_BLOCK);
    gl::Inputs inputs;
    inputs.add(surface)
        .storage("OrderTable", order_)
        .uniform("OrderBlock", block_)
        .storage("BinTable", bins_)
        .storage("StartTable", binStarts_)
        .storage("ChunkTable", chunks_)
        .storage("StateTable", states)
        .texture("binTexels", binTexels_)
        .texture("startTexels", binStartTexels_)
        .texture("stateTexels", stateTexels);
    gpu::CacheOrder block{};
    block.number = sorts_++;
    block.searches = wanted.searches ? 1 : 0;
    for (std::uint32_t first = 0; first < blockCount; first += kMostBlocks) {
        const std::uint32_t sorted = std::min(blockCount - first, kMostBlocks);
        block.firstBlock = first;
        block.lastSweep = first + sorted == blockCount ? 1 : 0;
        block.binCount = sorted * CACHE_BINS_PER_BLOCK;
        block.binsPerChunk = gpu::perChunk(block.binCount);
        block.chunkCount = gpu::chunksOf(block.binCount);
        block_.update(block);
        bins_.clear();
        const std::size_t invocations[] = {faces, block.chunkCount, 1, block.chunkCount, faces};
        for (int step = 0; step < 5; ++step) {
            device.get(OrderKey{step}.desc()).dispatchLinear(inputs, invocations[step]);
            gl::barrier(gl::Access::ShaderStorage | gl::Access::TextureFetch | gl::Access::Update);
            co_await gl::rest(device);
        }
    }
    takeCounts(late);
    // They are as large as what they sort.
    if (!wanted.keepsMemory) releaseBins();
}

std::vector<gl::ProgramDesc> FaceOrder::programDescs() {
    std::vector<gl::ProgramDesc> descs;
    for (const OrderKey& key : OrderKey::all()) descs.push_back(key.desc());
    return descs;
}

}  // namespace conelight::light

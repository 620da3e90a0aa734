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

// Grids with more blocks of 16^3 voxels (256^3 has half of that) keep faces as they are stored: bins would
// take too much memory.
constexpr std::size_t kMaxBlocks = 8192;

struct OrderKey {
    int step;
    gl::ProgramDesc desc() const {
        return {{"light/cache_order.comp.glsl"}, {{"STEP", std::to_string(step)}}};
    }
    static std::vector<OrderKey> all() { return {{0}, {1}, {2}, {3}, {4}, {5}}; }
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

void FaceOrder::reserveBins(std::size_t count) {
    if (bins_.bytes() == 8 * count) return;
    releaseBins();
    bins_ = gl::Buffer(8 * count, "bins of faces");
    binStarts_ = gl::Buffer(4 * count, "starts of bins of faces");
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
    const auto blockCount = static_cast<std::size_t>(blocks.x) * static_cast<std::size_t>(blocks.y) *
                            static_cast<std::size_t>(blocks.z);
    const auto bins = static_cast<std::uint32_t>(std::min(blockCount, kMaxBlocks) * CACHE_BINS_PER_BLOCK);
    if (const std::size_t bytes = 4 * (2 + std::size_t{gpu::mostChunks(bins)}); chunks_.bytes() < bytes)
        chunks_ = gl::Buffer(bytes, "chunks of bins");
    if (!block_) block_ = gl::Buffer(sizeof(gpu::CacheOrder), "order of faces constants");
    gl::Inputs inputs;
    inputs.add(surface).storage("OrderTable", order_);
    if (blockCount > kMaxBlocks) {
        // The block and the lists are declared in every step; nothing is read of them here.
        inputs.uniform("OrderBlock", block_)
            .storage("BinTable", chunks_)
            .storage("StartTable", chunks_)
            .storage("ChunkTable", chunks_);
        device.get(OrderKey{5}.desc()).dispatchLinear(inputs, faces);
        gl::barrier(gl::Access::ShaderStorage | gl::Access::TextureFetch);
        chunks_.clear();
        surface.putFaceCount(chunks_, 0);
        takeCounts(late);
        co_return;
    }
    reserveBins(bins);
    bins_.clear();
    gpu::CacheOrder block{};
    block.number = sorts_++;
    block.searches = wanted.searches ? 1 : 0;
    block.binsPerChunk = gpu::perChunk(bins);
    block.chunkCount = gpu::chunksOf(bins);
    block_.update(block);
    inputs.uniform("OrderBlock", block_)
        .storage("BinTable", bins_)
        .storage("StartTable", binStarts_)
        .storage("ChunkTable", chunks_)
        .storage("StateTable", states)
        .texture("binTexels", binTexels_)
        .texture("startTexels", binStartTexels_)
        .texture("stateTexels", stateTexels);
    const std::size_t invocations[] = {faces, block.chunkCount, 1, block.chunkCount, faces};
    for (int step = 0; step < 5; ++step) {
        device.get(OrderKey{step}.desc()).dispatchLinear(inputs, invocations[step]);
        gl::barrier(gl::Access::ShaderStorage | gl::Access::TextureFetch);
        co_await gl::rest(device);
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

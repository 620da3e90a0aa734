// SPDX-License-Identifier: MIT
#include "view/motion_picture.h"

#include <algorithm>

#include "gl/gl.h"

namespace conelight::view {
namespace {

gl::ProgramDesc motionDesc() { return {{"view/motion.vert.glsl", "view/motion.frag.glsl"}, {}}; }

}  // namespace

bool MotionPicture::follow(const scene::GpuScene& scene) {
    drawn_ = false;
    if (scene_ != scene.identity()) placed_.clear();
    scene_ = scene.identity();
    from_ = placed_.empty() ? base::Revision{} : now_;
    now_ = scene.geometryRevision();
    if (from_ == now_) return false;
    bool reshaped = false;
    for (std::size_t i = 0; i < std::min(placed_.size(), scene.instances().size()); ++i)
        reshaped = reshaped ||
                   (placed_[i].entry == scene.entryRevision(i) && placed_[i].shape != scene.shapeRevision(i));
    motions_.clear();
    if (reshaped) look(scene);
    placed_.clear();
    for (std::size_t i = 0; i < scene.instances().size(); ++i)
        placed_.push_back(
            {scene.instances()[i].worldFromObject, scene.shapeRevision(i), scene.entryRevision(i)});
    return reshaped;
}

void MotionPicture::look(const scene::GpuScene& scene) {
    moves_.clear();
    for (std::size_t i = 0; i < scene.instances().size(); ++i) {
        motions_.push_back(motionOf(scene, i));
        moves_.push_back(motions_.back().firstVertex != MOTION_SAME_SHAPE ||
                         motions_.back().worldFromObject != scene.instances()[i].worldFromObject);
    }
}

// One that has come since stands still.
gpu::InstanceMotion MotionPicture::motionOf(const scene::GpuScene& scene, std::size_t i) const {
    gpu::InstanceMotion motion{};
    motion.worldFromObject = scene.instances()[i].worldFromObject;
    motion.firstVertex = MOTION_SAME_SHAPE;
    if (i >= placed_.size() || placed_[i].entry != scene.entryRevision(i)) return motion;
    motion.worldFromObject = placed_[i].worldFromObject;
    // Of several changes since then the last one's vertices are kept.
    if (placed_[i].shape != scene.shapeRevision(i))
        motion.firstVertex =
            placed_[i].shape == scene.shapeBefore(i) ? scene.firstVertexBefore(i) : MOTION_UNKNOWN;
    return motion;
}

void MotionPicture::draw(const gl::Device& device, const scene::GpuScene& scene, const gl::Buffer& frameBlock,
                         const GBuffer& gbuffer) {
    const gl::PassScope pass(device.profiler, "motion");
    if (!picture_ || picture_.width() != gbuffer.width() || picture_.height() != gbuffer.height()) {
        framebuffer_.reset();
        picture_ = {};  // freed first
        picture_ = gl::Texture({GL_TEXTURE_2D, GL_RGBA32F, gbuffer.width(), gbuffer.height()}, "motion");
        picture_.parameter(GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        picture_.parameter(GL_TEXTURE_MAG_FILTER, GL_NEAREST);
        framebuffer_.emplace(std::vector<const gl::Texture*>{&picture_}, nullptr, "motion");
    }
    table_ = gl::Buffer(motions_, "instance motion");
    gl::Inputs inputs;
    inputs.uniform("FrameBlock", frameBlock).add(scene).add(gbuffer).storage("MotionTable", table_);
    // Fragments say by themselves whether the G-buffer shows them.
    gl::RasterState state;
    state.framebuffer = &*framebuffer_;
    state.depthTest = state.depthWrite = false;
    const gl::Program& program = device.get(motionDesc());
    gl::apply(state);
    framebuffer_->clearColor(0, 0, 0, 0, 0);
    program.use(inputs);
    const gpu::Instance* const first = scene.instances().data();
    scene.draw({.filter =
                    [&](const gpu::Instance& instance) {
                        return moves_[static_cast<std::size_t>(&instance - first)] != 0 &&
                               !scene::isGlass(instance);
                    },
                .together = device.profile == gl::ExecutionProfile::Gpu});
    drawn_ = true;
}

std::vector<gl::ProgramDesc> MotionPicture::programDescs() { return {motionDesc()}; }

}  // namespace conelight::view

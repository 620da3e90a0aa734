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
    if (scene_ != scene.identity()) instances_.forget();
    scene_ = scene.identity();
    from_ = instances_.at();
    const std::vector<scene::InstanceChange>& changes = instances_.look(scene);
    if (std::none_of(changes.begin(), changes.end(),
                     [](const scene::InstanceChange& one) { return one.reshaped; }))
        return false;
    motions_.clear();
    for (const gpu::Instance& instance : scene.instances()) {
        gpu::InstanceMotion& still = motions_.emplace_back();
        still.worldFromObject = instance.worldFromObject;
        still.firstVertex = MOTION_SAME_SHAPE;
    }
    moves_.assign(motions_.size(), 0);
    for (const scene::InstanceChange& change : changes) {
        if (change.came) continue;  // it stands still
        gpu::InstanceMotion& motion = motions_[change.index];
        motion.worldFromObject = change.worldFromObject;
        // Of several changes since then the last one's vertices are kept.
        if (change.reshaped)
            motion.firstVertex =
                change.keepsVertices ? scene.firstVertexBefore(change.index) : MOTION_UNKNOWN;
        moves_[change.index] = 1;
    }
    return true;
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

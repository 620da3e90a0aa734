// SPDX-License-Identifier: MIT
#include "gl/pass.h"

#include <cstring>

#include "base/assert.h"
#include "base/clock.h"
#include "gl/buffer.h"
#include "gl/dispatch_counter.h"
#include "gl/gl.h"
#include "gl/late_words.h"
#include "gl/work.h"

namespace conelight::gl {

std::string rendererName() {
    const GLubyte* text = glGetString(GL_RENDERER);
    return text != nullptr ? reinterpret_cast<const char*>(text) : "";
}

void finish() {
    countWait();
    glFinish();
}

bool isSoftwareDriver() {
    const char* renderer = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    return renderer != nullptr &&
           (std::strstr(renderer, "llvmpipe") != nullptr || std::strstr(renderer, "softpipe") != nullptr);
}

Query::Query(const std::string& label) {
    Name query = 0;
    glCreateQueries(GL_TIMESTAMP, 1, &query);
    adopt(query, label, 0);
}
void Query::record() const { glQueryCounter(name(), GL_TIMESTAMP); }
double Query::resultMs() const {
    GLuint64 nanoseconds = 0;
    glGetQueryObjectui64v(name(), GL_QUERY_RESULT, &nanoseconds);
    return 1e-6 * static_cast<double>(nanoseconds);
}

void Profiler::beginFrame() {
    CONELIGHT_ASSERT(open_.empty(), "Profiler::beginFrame inside a pass scope");
    passes_.clear();
    gl::beginFrame();
}

std::vector<PassTime> Profiler::endFrame() {
    CONELIGHT_ASSERT(open_.empty(), "Profiler::endFrame inside a pass scope");
    std::vector<PassTime> times = this->times();
    passes_.clear();
    return times;
}

std::vector<PassTime> Profiler::times() const {
    std::vector<PassTime> times;
    times.reserve(passes_.size());
    for (const Open& pass : passes_) {
        PassTime& time = times.emplace_back(pass.time);
        if (pass.start) time.gpuMs = pass.stop.resultMs() - pass.start.resultMs();
    }
    return times;
}

PassScope::PassScope(Profiler& profiler, const char* name)
    : profiler_(profiler), timed_(profiler.enabled_), counted_(DispatchCounter::current() != nullptr) {
    if (counted_) DispatchCounter::current()->enter(name);
    if (Work* const work = Work::current()) work->tell(name);
    glPushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 0, -1, name);
    if (!timed_) return;
    // The list may grow and move while this scope is open, hence an index.
    index_ = profiler_.passes_.size();
    const std::string outer =
        profiler_.open_.empty() ? "" : profiler_.passes_[profiler_.open_.back()].time.name + "/";
    Profiler::Open& pass = profiler_.passes_.emplace_back();
    profiler_.open_.push_back(index_);
    pass.time.name = outer + name;
    // Earlier work must not be counted here: wait for it, or mark its end in the GPU's own order.
    const bool byCpu =
        profiler_.timer_ == PassTimer::Auto ? isSoftwareDriver() : profiler_.timer_ == PassTimer::Cpu;
    if (byCpu) {
        glFinish();
    } else {
        pass.start = Query(pass.time.name + " start");
        pass.stop = Query(pass.time.name + " stop");
        pass.start.record();
    }
    pass.cpuStart = base::processCpuMs();
    pass.wallStart = base::wallMs();
}

PassScope::~PassScope() {
    if (timed_) {
        CONELIGHT_ASSERT(!profiler_.open_.empty() && profiler_.open_.back() == index_,
                         "pass scopes close in reverse order");
        profiler_.open_.pop_back();
        Profiler::Open& pass = profiler_.passes_[index_];
        if (pass.start)
            pass.stop.record();
        else
            glFinish();
        pass.time.cpuMs = base::processCpuMs() - pass.cpuStart;
        pass.time.wallMs = base::wallMs() - pass.wallStart;
    }
    if (counted_) DispatchCounter::current()->leave();
    glPopDebugGroup();
}

void barrier(Access consumers) {
    const auto has = [&](Access one) {
        return (static_cast<unsigned>(consumers) & static_cast<unsigned>(one)) != 0;
    };
    GLbitfield bits = 0;
    if (has(Access::ShaderStorage)) bits |= GL_SHADER_STORAGE_BARRIER_BIT;
    if (has(Access::ImageAccess)) bits |= GL_SHADER_IMAGE_ACCESS_BARRIER_BIT;
    if (has(Access::TextureFetch)) bits |= GL_TEXTURE_FETCH_BARRIER_BIT;
    if (has(Access::Indirect)) bits |= GL_COMMAND_BARRIER_BIT;
    if (has(Access::Uniform)) bits |= GL_UNIFORM_BARRIER_BIT;
    if (has(Access::Framebuffer)) bits |= GL_FRAMEBUFFER_BARRIER_BIT;
    if (has(Access::VertexFetch)) bits |= GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT | GL_ELEMENT_ARRAY_BARRIER_BIT;
    if (has(Access::Update))
        bits |= GL_BUFFER_UPDATE_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT | GL_PIXEL_BUFFER_BARRIER_BIT;
    glMemoryBarrier(bits);
}

}  // namespace conelight::gl

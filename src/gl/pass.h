// SPDX-License-Identifier: MIT
// Pass scopes: a debug group with the pass's name, and its time. On a software driver (llvmpipe) a pass is
// closed by glFinish and measured as process CPU time and wall time, because timer queries lie there; on a
// GPU it is measured by timestamp queries, which do not stop the GPU and are read when the frame ends.
// Process CPU time is that of all threads, the host's own included: what those compute meanwhile is counted.
// Use on the thread of the context only.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "gl/object.h"

namespace conelight::gl {

struct PassTime {
    std::string name;  // "outer", and "outer/inner" for a scope inside it; the outer time contains the inner
    double cpuMs = 0;  // process CPU time between begin and end; on a GPU: of issuing the commands
    double wallMs = 0;
    double gpuMs = -1;  // < 0: not measured (software driver)
};

std::string rendererName();  // GL_RENDERER
void finish();               // waits until the driver has done everything
bool isSoftwareDriver();     // GL_RENDERER is llvmpipe or softpipe

class Query : public Object<ObjectType::Query> {
  public:
    Query() = default;
    explicit Query(const std::string& label);  // timestamp
    void record() const;
    double resultMs() const;  // waits
};

// How passes are timed. Auto: by the driver; the others are for tests of both ways.
enum class PassTimer { Auto, Cpu, Gpu };

// Collects the passes of a frame. Disabled (default): only debug groups, no finish, no queries, no memory.
class Profiler {
  public:
    void setEnabled(bool enabled) { enabled_ = enabled; }  // holds for scopes opened from now on
    bool enabled() const { return enabled_; }
    void setTimer(PassTimer timer) { timer_ = timer; }
    // Both outside all scopes. endFrame waits for the GPU when passes were timed there.
    void beginFrame();
    // Times of the passes since beginFrame, in the order they began; passes of equal names are separate
    // entries.
    std::vector<PassTime> endFrame();
    // The same, of a frame that goes on.
    std::vector<PassTime> times() const;

  private:
    friend class PassScope;
    struct Open {
        PassTime time;
        Query start, stop;
        double cpuStart = 0, wallStart = 0;
    };
    bool enabled_ = false;
    PassTimer timer_ = PassTimer::Auto;
    std::vector<Open> passes_;
    std::vector<std::size_t> open_;  // scopes not yet closed, outermost first; indices into passes_
};

// One pass, from construction to destruction; scopes nest. Costs a debug group when the profiler is off.
class PassScope {
  public:
    PassScope(Profiler& profiler, const char* name);
    ~PassScope();
    PassScope(const PassScope&) = delete;
    PassScope& operator=(const PassScope&) = delete;

  private:
    Profiler& profiler_;
    std::size_t index_ = 0;
    bool timed_;
    bool counted_;
};

// What later commands must see of earlier shader writes. One call between producer and consumer.
// Update: uploads and copies to and from buffers and textures.
enum class Access : unsigned {
    ShaderStorage = 1,
    ImageAccess = 2,
    TextureFetch = 4,
    Indirect = 8,
    Uniform = 16,
    Framebuffer = 32,
    VertexFetch = 64,
    Update = 128,
};
constexpr Access operator|(Access a, Access b) {
    return static_cast<Access>(static_cast<unsigned>(a) | static_cast<unsigned>(b));
}
void barrier(Access consumers);

}  // namespace conelight::gl

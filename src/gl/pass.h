// SPDX-License-Identifier: MIT
// Pass scopes: a debug group with the pass's name, and its time. On a software driver (llvmpipe) a pass is
// closed by glFinish and measured as process CPU time and wall time, because timer queries lie there; on a
// GPU it is measured by timestamp queries, which cost nothing and are read when the frame ends.
#pragma once

#include <string>
#include <vector>

#include "gl/object.h"

namespace conelight::gl {

struct PassTime {
    std::string name;
    double cpuMs = 0;   // process CPU time between begin and end; on a GPU: of issuing the commands
    double wallMs = 0;
    double gpuMs = -1;  // < 0: not measured (software driver)
};

bool isSoftwareDriver();  // GL_RENDERER is llvmpipe or softpipe

class Query : public Object<ObjectType::Query> {
  public:
    Query() = default;
    explicit Query(const std::string& label);  // timestamp
    void record() const;
    double resultMs() const;  // waits
};

// Collects the passes of a frame. Disabled (default): only debug groups, no finish, no queries.
class Profiler {
  public:
    void setEnabled(bool enabled) { enabled_ = enabled; }
    bool enabled() const { return enabled_; }
    void beginFrame();
    // Times of the passes since beginFrame, in order; passes of equal names are separate entries.
    std::vector<PassTime> endFrame();

  private:
    friend class PassScope;
    struct Open {
        PassTime time;
        Query start, stop;
        double cpuStart = 0, wallStart = 0;
    };
    bool enabled_ = false;
    std::vector<Open> passes_;
};

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
};

// What later commands must see of earlier shader writes. One call between producer and consumer.
enum class Access : unsigned { ShaderStorage = 1, ImageAccess = 2, TextureFetch = 4, Indirect = 8, Uniform = 16, Framebuffer = 32, VertexFetch = 64 };
constexpr Access operator|(Access a, Access b) { return static_cast<Access>(static_cast<unsigned>(a) | static_cast<unsigned>(b)); }
void barrier(Access consumers);

}  // namespace conelight::gl

// SPDX-License-Identifier: MIT
// The OpenGL state of a host: all that a call of the library may touch, as the driver tells it, and set to odd values.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "gl/gl.h"

namespace conelight::test {

using Snapshot = std::map<std::string, std::vector<double>>;
Snapshot snapshot();

// The objects of a host program, by raw names; `set` gives every state another value than it has at first.
class HostState {
  public:
    HostState();
    ~HostState();
    HostState(const HostState&) = delete;
    HostState& operator=(const HostState&) = delete;
    void set() const;

  private:
    void setBindings() const;
    static void setIndexed();

    GLuint buffer_ = 0, sampler_ = 0, vertexArray_ = 0, program_ = 0;
    GLuint textures_[6] = {}, framebuffers_[2] = {};
};

}  // namespace conelight::test

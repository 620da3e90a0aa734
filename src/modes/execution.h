// SPDX-License-Identifier: MIT
// RendererOptions::execution -> the profile that passes are run by.
#pragma once

#include "conelight/renderer.h"
#include "gl/device.h"

namespace conelight::modes {

// The context is current.
inline gl::ExecutionProfile profileOf(Execution execution) {
    if (execution == Execution::Auto)
        return gl::isSoftwareDriver() ? gl::ExecutionProfile::Processor : gl::ExecutionProfile::Gpu;
    return execution == Execution::Gpu ? gl::ExecutionProfile::Gpu : gl::ExecutionProfile::Processor;
}

}  // namespace conelight::modes

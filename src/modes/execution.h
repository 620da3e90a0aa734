// SPDX-License-Identifier: MIT
// RendererOptions -> the profile that passes are run by, their shaders and who keeps their programs.
#pragma once

#include <memory>

#include "conelight/renderer.h"
#include "gl/device.h"

namespace conelight::modes {

// The context is current.
inline gl::ExecutionProfile profileOf(Execution execution) {
    if (execution == Execution::Auto)
        return gl::isSoftwareDriver() ? gl::ExecutionProfile::Processor : gl::ExecutionProfile::Gpu;
    return execution == Execution::Gpu ? gl::ExecutionProfile::Gpu : gl::ExecutionProfile::Processor;
}

inline std::shared_ptr<ProgramCache> programsOf(const RendererOptions& options) {
    return options.programs && options.programs->suits(gl::isSoftwareDriver()) ? options.programs : nullptr;
}

inline gl::ShaderProvider shadersOf(const RendererOptions& options, gl::ExecutionProfile profile) {
    return gl::providerFor(profile, options.shaderDirectory.empty()
                                        ? gl::embeddedShaderProvider()
                                        : gl::directoryShaderProvider(options.shaderDirectory));
}

}  // namespace conelight::modes

// SPDX-License-Identifier: MIT
#include "gl/device.h"

#include <utility>

namespace conelight::gl {

ShaderProvider providerFor(ExecutionProfile profile, ShaderProvider provider) {
    if (profile == ExecutionProfile::Processor) return provider;
    return [provider = std::move(provider)](const std::string& path) -> std::optional<std::string> {
        if (path == "lib/execution.glsl") return "#define EXECUTION_GPU 1\n";
        return provider(path);
    };
}

}  // namespace conelight::gl

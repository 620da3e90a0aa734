// SPDX-License-Identifier: MIT
#include "platform/context_health.h"

#include <epoxy/gl.h>

#include "conelight/error.h"

namespace conelight::platform {

void requireHealthyContext() {
    if (glGetGraphicsResetStatus() != GL_NO_ERROR)
        throw Error(ErrorKind::Runtime,
                    "OpenGL: the context is lost: the driver was reset; starting again would be right");
    // One flag per kind of error; a lost context reports one for ever, hence the bound.
    bool full = false;
    for (int i = 0; i < 8; ++i) {
        const GLenum error = glGetError();
        if (error == GL_NO_ERROR) break;
        full = full || error == GL_OUT_OF_MEMORY;
    }
    if (full)
        throw Error(ErrorKind::Runtime,
                    "OpenGL: the driver is out of memory; a smaller picture, scene or voxels.size, or "
                    "--memory, would "
                    "be right");
}

}  // namespace conelight::platform

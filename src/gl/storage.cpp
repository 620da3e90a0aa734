// SPDX-License-Identifier: MIT
#include "gl/storage.h"

#include "base/log.h"
#include "gl/gl.h"

namespace conelight::gl {

void requireStorage(ObjectType type, Name name, const std::string& label, std::size_t bytes) {
    // Asking the object costs no synchronisation, unlike asking for the error of every allocation.
    bool given = false;
    if (type == ObjectType::Buffer) {
        GLint64 size = 0;
        glGetNamedBufferParameteri64v(name, GL_BUFFER_SIZE, &size);
        given = size >= 0 && static_cast<std::size_t>(size) >= bytes;
    } else {
        GLint immutable = GL_FALSE;
        glGetTextureParameteriv(name, GL_TEXTURE_IMMUTABLE_FORMAT, &immutable);
        given = immutable == GL_TRUE;
    }
    if (given) return;
    // The flag is per kind of error; a lost context reports one for ever, hence the bound.
    for (int i = 0; i < 8 && glGetError() != GL_NO_ERROR; ++i) continue;
    base::fail(ErrorKind::Runtime,
               "OpenGL: no memory for '%s' (%.1f MiB); a smaller grid, picture or texture would be right",
               label.c_str(), static_cast<double>(bytes) / (1 << 20));
}

}  // namespace conelight::gl

#version 450 core
// SPDX-License-Identifier: MIT
// A triangle over the whole picture, without vertex attributes: gl::drawTriangle. For clip space z in [0,1]:
// with the G-buffer's depths and GL_GEQUAL only pixels are drawn that show a surface.
#include "shared/gbuffer.h"

void main() { gl_Position = vec4(4 * (gl_VertexID & 1) - 1, 2 * (gl_VertexID & 2) - 1, GBUFFER_BEHIND, 1.0); }

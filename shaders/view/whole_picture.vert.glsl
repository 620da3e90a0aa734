#version 450 core
// SPDX-License-Identifier: MIT
// A triangle over the whole picture, without vertex attributes: gl::drawTriangle.
void main() { gl_Position = vec4(4 * (gl_VertexID & 1) - 1, 2 * (gl_VertexID & 2) - 1, 0.0, 1.0); }

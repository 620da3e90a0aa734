// SPDX-License-Identifier: MIT
// The OpenGL functions. Only files below src/gl (and tests) include this or call gl*.
#pragma once
#include <epoxy/gl.h>

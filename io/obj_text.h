// SPDX-License-Identifier: MIT
// The text of an OBJ or MTL file in the spelling that Assimp's reader takes: it stumbles over a byte order mark,
// indents, comments behind values and numbers that begin with a point, all of which the format allows. Private
// to this room.
#pragma once

#include "io/files.h"

namespace conelight::io {

// The same statements, one to a line as before, without marks, indents, tabs and trailing comments.
Bytes plainObjText(const Bytes& text);

}  // namespace conelight::io

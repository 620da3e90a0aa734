// SPDX-License-Identifier: MIT
// What tests of the program share: running it, reading what it wrote.
#pragma once

#include <string>
#include <vector>

#include "support/gl_fixture.h"

namespace conelight::test {

std::string scratchPath(const std::string& name);
CommandResult conelight(const std::string& arguments, const std::string& environment = "");
std::string bytesOf(const std::string& file);  // "" when there is none
// Values of all channels and layers, without what the file says of how it was made; fails for none.
std::vector<float> pixelsOf(const std::string& picture);
// One line, from the program, that contains `part`.
void expectOneLine(const CommandResult& result, int status, const std::string& part);

}  // namespace conelight::test

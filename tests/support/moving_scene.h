// SPDX-License-Identifier: MIT
// Scenes with a clip `rise`, one second long, made of the Cornell box: .gltf files in the scratch folder.
#pragma once

#include <string>
#include <vector>

namespace conelight::test {

// Object `what` rises by half a metre; it is not moved at all, but placed there, if `placed` is given. Returns the
// file's path.
std::string risingBlock(const std::string& name, const std::vector<float>& placed = {},
                        const std::string& what = "short block");
// The short block rises by a morph target's weight instead of its node.
std::string growingBlock(const std::string& name);

}  // namespace conelight::test

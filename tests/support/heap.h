// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

namespace conelight::test {

std::size_t heapBytes();  // that the process has asked for and not given back; 0: unknown

}  // namespace conelight::test

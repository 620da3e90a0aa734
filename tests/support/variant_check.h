// SPDX-License-Identifier: MIT
// After all tests of a process: every program of the library's that they asked for is in the list of variants
// (modes/shader_variants.h), so that what checks the list checks what runs.
#pragma once

namespace conelight::test {

// Adds the check to GoogleTest's environments; call it before RUN_ALL_TESTS.
void checkVariantsAtTheEnd();

}  // namespace conelight::test

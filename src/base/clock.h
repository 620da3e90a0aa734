// SPDX-License-Identifier: MIT
// Wall time and process CPU time in milliseconds. On a software driver the CPU time of all threads is the
// honest cost of a pass: it does not change when other programs share the cores.
#pragma once

namespace conelight::base {

double wallMs();        // monotonic, arbitrary origin
double processCpuMs();  // user + system time of all threads of this process

}  // namespace conelight::base

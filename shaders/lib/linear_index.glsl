// SPDX-License-Identifier: MIT
// The number of a compute invocation in a dispatch of gl::Program::dispatchLinear, which folds groups beyond
// 65,535 into y. Numbers run from 0, each exactly once, past the asked-for count: compare with it.
// 32 bits: at most 4,294,967,295 invocations.

uint linearIndex() {
    uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    return group * (gl_WorkGroupSize.x * gl_WorkGroupSize.y * gl_WorkGroupSize.z) + gl_LocalInvocationIndex;
}

// SPDX-License-Identifier: MIT
// Numbers that the passes over VisibilityList (lib/visibility_list.glsl) share with C++.
#pragma once

#define VISIBILITY_GROUPS_X 32u  // in x of the dispatch over the list; y may be 65,535
#define VISIBILITY_GROUP 64u     // invocations of a group

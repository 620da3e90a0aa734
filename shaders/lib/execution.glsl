// SPDX-License-Identifier: MIT
// Which execution profile a program is made for (gl/device.h). A GPU gets 1 here, by its provider of shaders.
//
// A software driver runs both sides of every branch for all lanes, so kernels do without: what is not wanted is looked up
// at place 0. On a GPU a wave whose lanes all want nothing goes on: functions are left early. What they return is the same.
#define EXECUTION_GPU 0

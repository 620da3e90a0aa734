// SPDX-License-Identifier: MIT
// NVIDIA's compiler unrolls loops unless told otherwise. Diffuse rays of pixels get no faster by that, and the largest kernel
// takes three times as long to compile: docs/notes/2026-11-28-nvidia-compiles.md. To be included before any loop.
#pragma optionNV(unroll none)

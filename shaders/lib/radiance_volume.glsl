// SPDX-License-Identifier: MIT
// The block of the radiance volume, and its texels.
#include "shared/radiance_volume.h"
layout(std140) uniform RadianceVolumeBlock { RadianceVolume volume; };

// Texel of level 0 that holds direction `block` of a voxel.
ivec3 radianceTexel(ivec3 voxel, int block) { return voxel + ivec3(block * int(volume.sizeX), 0, 0); }

// Texels of level 0 per block.
ivec3 radianceSize() { return ivec3(volume.sizeX, volume.sizeY, volume.sizeZ); }

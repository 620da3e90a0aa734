// SPDX-License-Identifier: MIT
// What is drawn, beside the settings of the picture: the switches of the thesis's program that belong to its
// window.
#pragma once

namespace conelight::program {

struct ViewFlags {
    bool drawObjects = true;
    bool drawVoxels = false;
    bool wireframeObjects = false;
    bool wireframeVoxels = false;
    bool wireframeOverlay = false;  // edges on top of the shaded picture
    bool localizedLod = false;      // surfaces in the colours of the volume at thesis.voxel_level
    bool singleFrame = false;       // draw only when asked (RequestKind::SingleFrame)
    bool dynamic = false;           // build the voxels anew every `period` seconds
    float period = 0.5f;            // s
    bool drawBlock = false;         // wait for the device after each frame
    bool operator==(const ViewFlags&) const = default;
};

}  // namespace conelight::program

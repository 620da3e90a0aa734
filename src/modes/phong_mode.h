// SPDX-License-Identifier: MIT
// Mode `phong`: local illumination only, the thesis's model. Scenes of the thesis's format look as its
// program drew them: back faces culled, no shadows; others have shadow maps (setting phong.shadows).
#pragma once

#include "modes/frame_context.h"

namespace conelight::modes {

class PhongMode : public ModeRenderer {
  public:
    void render(const FrameContext& frame) override;
    bool needsShadows(const Settings& settings) const override;
    bool needsShadowsIn(const Scene& scene, const Settings& settings) const override;
    // The rooms of the thesis are looked into through their front walls.
    bool cullsBackFaces() const override { return true; }
};

}  // namespace conelight::modes

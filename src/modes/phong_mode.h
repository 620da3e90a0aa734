// SPDX-License-Identifier: MIT
// Mode `phong`: local illumination only, by Phong's model. Back faces are culled. Shadow maps are drawn, but
// not in scenes with a format of their own (Scene::format), unless phong.shadows asks for them.
#pragma once

#include "modes/frame_context.h"

namespace conelight::modes {

class PhongMode : public ModeRenderer {
  public:
    void render(const FrameContext& frame) override;
    bool needsShadows(const Settings& settings) const override;
    bool needsShadowsIn(const Scene& scene, const Settings& settings) const override;
    // Rooms are looked into through their front walls.
    bool cullsBackFaces() const override { return true; }
};

}  // namespace conelight::modes

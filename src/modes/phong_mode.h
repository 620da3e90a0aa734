// SPDX-License-Identifier: MIT
// Mode `phong`: local illumination only, by Phong's model. Shadow maps are drawn, but not in scenes with a
// format of their own (Scene::format), unless phong.shadows asks for them.
#pragma once

#include "modes/mode.h"

namespace conelight::modes {

class PhongMode : public ModeRenderer {
  public:
    base::Steps drawInSteps(const Frame& frame) override;
    bool needsShadows(const Scene& scene, const Settings& settings) const override;
    bool readsCascades() const override { return true; }
    bool lightsFromSmallLamps() const override { return true; }
};

}  // namespace conelight::modes

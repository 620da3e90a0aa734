// SPDX-License-Identifier: MIT
// The picture that a host draws with baked light, beside the path tracer's.
#pragma once

#include <functional>

#include "conelight/renderer.h"
#include "conelight/scene.h"
#include "reference/path_tracer.h"
#include "reference/surface.h"

namespace conelight::reference {

// A camera's picture with its diffuse indirect light from irradiance that was baked, all else from the path tracer.
struct BakedPicture {
    Image diffuse, full;
};
// `irradiance`: at what a pixel's middle sees, W/m^2.
BakedPicture drawWithIrradiance(const Scene& scene, const Camera& camera, const PathTracedPicture& truth,
                                const std::function<glm::vec3(const Surface&, const RayHit&)>& irradiance);

}  // namespace conelight::reference

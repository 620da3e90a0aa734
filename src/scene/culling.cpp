// SPDX-License-Identifier: MIT
#include "scene/culling.h"

#include <algorithm>
#include <cmath>

namespace conelight::scene {
namespace {

// Shaders round the same products otherwise.
constexpr float kSlack = 1e-5f;  // of w

}  // namespace

bool isOutside(const glm::mat4& clipFromBox, const Aabb& box) {
    int outside[5] = {0, 0, 0, 0, 0};
    for (const glm::vec3& corner : box.corners()) {
        const glm::vec4 p = clipFromBox * glm::vec4(corner, 1);
        const float slack = std::abs(p.w) * kSlack;
        outside[0] += p.x < -p.w - slack;
        outside[1] += p.x > p.w + slack;
        outside[2] += p.y < -p.w - slack;
        outside[3] += p.y > p.w + slack;
        outside[4] += p.z > p.w + slack;
    }
    return std::any_of(std::begin(outside), std::end(outside), [](int count) { return count == 8; });
}

GpuScene::PartFilter partsWithin(const glm::mat4& clipFromWorld) {
    // Parts come instance by instance.
    return [clipFromWorld, last = static_cast<const gpu::Instance*>(nullptr), clipFromObject = glm::mat4(1)](
               const gpu::Instance& instance, const Aabb& objectBox) mutable {
        if (last != &instance) clipFromObject = clipFromWorld * instance.worldFromObject;
        last = &instance;
        return !isOutside(clipFromObject, objectBox);
    };
}

}  // namespace conelight::scene

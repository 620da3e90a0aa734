// SPDX-License-Identifier: MIT
#include "reference/picture_layers.h"

#include <utility>

namespace conelight::reference {

int bounceLayer(const std::string& name) {
    constexpr int kMost = 64;  // more have no light left: 0.8^64 = 6e-7
    if (name.rfind("bounce", 0) != 0 || name.size() > 8) return 0;
    int value = 0;
    for (const char c : name.substr(6)) {
        if (c < '0' || c > '9') return 0;
        value = 10 * value + (c - '0');
    }
    return value <= kMost ? value : 0;
}

bool isTracedLayer(const std::string& name) {
    return bounceLayer(name) > 0 || name == "half_a" || name == "half_b" || name == "indirect_half_a" ||
           name == "indirect_half_b";
}

std::string tracedLayerNames() {
    return "half_a, half_b, indirect_half_a, indirect_half_b or bounce1 to bounce64";
}

const Image* layerOf(const PathTracedPicture& picture, const std::string& name) {
    const std::pair<const char*, const Image*> named[] = {{"full", &picture.full},
                                                          {"direct", &picture.direct},
                                                          {"indirect", &picture.indirect},
                                                          {"diffuse", &picture.diffuse},
                                                          {"specular", &picture.specular},
                                                          {"half_a", &picture.halfA},
                                                          {"half_b", &picture.halfB},
                                                          {"indirect_half_a", &picture.indirectA},
                                                          {"indirect_half_b", &picture.indirectB}};
    for (const auto& [one, image] : named)
        if (name == one) return image;
    const int bounce = bounceLayer(name);
    if (bounce >= 1 && bounce <= static_cast<int>(picture.bounces.size()))
        return &picture.bounces[static_cast<std::size_t>(bounce - 1)];
    return nullptr;
}

Image* layerOf(PathTracedPicture& picture, const std::string& name) {
    return const_cast<Image*>(layerOf(std::as_const(picture), name));
}

}  // namespace conelight::reference

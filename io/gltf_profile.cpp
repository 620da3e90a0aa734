// SPDX-License-Identifier: MIT
#include "io/gltf_profile.h"

#include <algorithm>

#include "conelight/error.h"
#include "io/light_profile_file.h"

namespace conelight::io {
namespace {

std::shared_ptr<const LightProfile> readProfile(GltfFile& file, const GltfValue& from) {
    const GltfValue uri = from["uri"];
    Bytes bytes;
    if (uri.exists()) {
        bytes = file.uriBytes(uri);
    } else {
        const auto view = file.bufferView(from["bufferView"]);
        bytes.assign(view.begin(), view.end());
    }
    const std::string given = uri.exists() ? uri.text("") : from["name"].text("");
    const std::string name = given.empty() || given.starts_with("data:") ? from.path() : oneLine(given);
    try {
        return parseLightProfile(name, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    } catch (const Error& error) {
        from.fail(error.what());
    }
}

}  // namespace

std::optional<Light> GltfProfiles::lightOf(GltfFile& file, const GltfValue& node, const GltfValue& own) {
    const GltfValue light = node.extension("EXT_lights_ies");
    const GltfValue all = file.root().extension("EXT_lights_ies")["lights"];
    const std::optional<std::size_t> at = light["light"].index(all.size());
    if (!at) return std::nullopt;
    std::shared_ptr<const LightProfile>& profile = read_[*at];
    if (profile == nullptr) profile = readProfile(file, all[*at]);
    Light to;
    setLightProfile(to, profile);
    const float multiplier = light["multiplier"].number(1.0f);
    if (!(multiplier >= 0)) light["multiplier"].fail("a negative multiplier");
    to.intensity *= multiplier * glm::clamp(light["color"].vector<3>(glm::vec3(1)), 0.0f, 1.0f);
    to.enabled = own["enabled"].boolean(true);
    to.castsShadow = own["castsShadow"].boolean(true);
    to.range = std::max(own["range"].number(0.0f), 0.0f);
    to.customFalloff = own["falloff"].exists();
    to.falloff = own["falloff"].vector<3>(to.falloff);
    if (const GltfValue cone = own["cone"]; cone.exists()) {
        const glm::vec2 angles = cone.vector<2>({0, 0});
        to.type = LightType::Spot;
        to.outerAngle = std::clamp(angles.y, 1e-3f, 1.57079632679f);
        to.innerAngle = std::clamp(angles.x, 0.0f, 0.999f * to.outerAngle);
    }
    return to;
}

}  // namespace conelight::io

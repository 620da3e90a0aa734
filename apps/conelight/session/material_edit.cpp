// SPDX-License-Identifier: MIT
#include "session/material_edit.h"

#include <fmt/core.h>

#include <map>

#include "conelight/scene_fields.h"
#include "session/rename.h"

namespace conelight::program {

void setPhong(Material& material, const PhongMaterial& phong) {
    if (!material.phong) {
        // The metallic-roughness model was given and stays, but for what is the same property by another
        // name.
        const PhongMaterial before = phongFromPbr(material);
        Material probe;
        setPbrFromPhong(probe, phong);
        if (phong.shininess != before.shininess) material.roughness = probe.roughness;
        material.phong = phong;
        return;
    }
    Material old = material, now = material;
    setPbrFromPhong(old, *material.phong);
    setPbrFromPhong(now, phong);
    visitFields(
        [](const char*, auto& value, const auto& derived, const auto& derivedNow) {
            if (value == derived) value = derivedNow;
        },
        material, old, now);
    material.phong = phong;
}

void setColor(Material& material, const glm::vec3& color) {
    if (material.phong && material.phong->color != color) {
        PhongMaterial phong = *material.phong;
        phong.color = color;
        const glm::vec4 before = material.baseColor;
        setPhong(material, phong);
        // A base colour of its own: it becomes the new one as it is.
        if (material.baseColor == before && !material.unlit) material.baseColor = glm::vec4(color, before.a);
    }
    if (!material.phong || material.unlit) material.baseColor = glm::vec4(color, material.baseColor.a);
}

std::string othersWith(const Session& session, const std::set<std::size_t>& materials,
                       const std::string& name) {
    std::string names;
    int count = 0;
    for (const Instance& instance : session.scene().instances) {
        if (instance.material < 0 || instance.name == name) continue;
        if (materials.count(static_cast<std::size_t>(instance.material)) == 0) continue;
        if (++count <= 3) names += (count == 1 ? "" : ", ") + instance.name;
    }
    return count > 3 ? fmt::format("{} and {} more", names, count - 3) : names;
}

std::vector<std::size_t> usesOfMaterials(const Scene& scene) {
    std::vector<std::size_t> uses(scene.materials.size(), 0);
    for (const Instance& instance : scene.instances)
        if (instance.material >= 0) ++uses[static_cast<std::size_t>(instance.material)];
    return uses;
}

int makeMaterialsSingle(Session& session, const std::vector<std::size_t>& objects) {
    const Scene& scene = session.scene();
    std::map<int, std::vector<std::size_t>> byMaterial;
    for (const std::size_t i : objects) byMaterial[scene.instances.at(i).material].push_back(i);
    const std::vector<std::size_t> uses = usesOfMaterials(scene);
    std::vector<std::string> names;
    for (const Material& material : scene.materials) names.push_back(material.name);
    FreeNames free(names);
    SceneEdits edits;
    std::vector<Material> materials = scene.materials;
    for (const auto& [material, users] : byMaterial) {
        const bool isDefault = material < 0;
        if (!isDefault && users.size() == uses[static_cast<std::size_t>(material)]) continue;
        Material copy = isDefault ? Material{} : scene.materials[static_cast<std::size_t>(material)];
        copy.name = isDefault ? free.takeOwn(scene.instances[users.front()].name) : free.take(copy.name);
        for (const std::size_t i : users) {
            edits.instances.emplace_back(i, scene.instances[i]);
            edits.instances.back().second.material = static_cast<int>(materials.size());
        }
        materials.push_back(std::move(copy));
    }
    const auto copies = static_cast<int>(materials.size() - scene.materials.size());
    edits.materialList = std::move(materials);
    if (copies > 0) session.edit(edits, "make material single");
    return copies;
}

}  // namespace conelight::program

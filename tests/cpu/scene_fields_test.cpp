// SPDX-License-Identifier: MIT
// The lists of fields (conelight/scene_fields.h), and what is derived from them: a field that is changed
// makes another object, another hash of the scene and another stream, and a number that is not finite is
// refused by its name.
#include "conelight/scene_fields.h"

#include <gtest/gtest.h>

#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "conelight/error.h"
#include "io/scene_stream.h"
#include "scene_hash.h"

namespace conelight {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

template <class T>
void change(T& value) {
    if constexpr (std::is_same_v<T, bool>)
        value = !value;
    else if constexpr (std::is_enum_v<T>)
        value = static_cast<T>(static_cast<int>(value) == 0 ? 1 : 0);
    else
        value += T(1);
}
void change(std::string& value) { value += " x"; }
void change(glm::mat4& value) { value[3][0] += 1; }
void change(TextureRef& value) { value.uvFromUv[2][1] += 0.5f; }
void change(std::shared_ptr<const LightProfile>& value) {
    LightProfile profile;
    profile.factors.assign(std::size_t{LightProfile::kRows} * LightProfile::kColumns, 0.5f);
    value = std::make_shared<LightProfile>(std::move(profile));
}
void change(std::optional<PhongMaterial>& value) { value = PhongMaterial{glm::vec3(0.5f)}; }

struct Changed {
    std::string field;
    bool isName = false;
    Scene scene;
};

// A scene with one object more, once as it is and then once with each of its fields changed.
template <class T>
std::vector<Changed> changes(std::vector<T> Scene::*table) {
    std::vector<Changed> all(1);
    (all[0].scene.*table).resize(1);
    std::size_t count = 0;
    visitFields([&](const char*, const auto&) { ++count; }, (all[0].scene.*table)[0]);
    for (std::size_t k = 0; k < count; ++k) {
        Changed one{"", false, all[0].scene};
        std::size_t index = 0;
        visitFields(
            [&](const char* name, auto& value) {
                if (index++ != k) return;
                change(value);
                one.field = name;
                one.isName = std::is_same_v<std::remove_cvref_t<decltype(value)>, std::string>;
            },
            (one.scene.*table)[0]);
        all.push_back(one);
    }
    return all;
}

std::string hashOf(const Scene& scene) {
    program::Hash hash;
    program::addScene(hash, scene);
    for (const Camera& camera : scene.cameras) addCamera(hash, camera);
    return hash.hex();
}

template <class T>
void expectEveryFieldCounts(std::vector<T> Scene::*table, std::size_t fields) {
    const std::vector<Changed> all = changes(table);
    ASSERT_EQ(all.size(), 1 + fields);
    for (std::size_t i = 1; i < all.size(); ++i) {
        SCOPED_TRACE(all[i].field);
        const T& before = (all[0].scene.*table)[0];
        const T& after = (all[i].scene.*table)[0];
        EXPECT_NE(before, after);
        const Scene back = io::sceneFromBytes(io::bytesFromScene(all[i].scene));
        T kept = (back.*table)[0];
        if constexpr (std::is_same_v<T, Light>) {  // a copy of the profile stands for it
            EXPECT_EQ(kept.profile == nullptr, after.profile == nullptr);
            if (kept.profile && after.profile) {
                EXPECT_EQ(kept.profile->factors, after.profile->factors);
            }
            kept.profile = after.profile;
        }
        EXPECT_EQ(kept, after);
        const bool shows = !all[i].isName && all[i].field != "dynamic" && all[i].field != "group";
        EXPECT_EQ(hashOf(all[0].scene) != hashOf(all[i].scene), shows);
        for (std::size_t j = 1; shows && j < i; ++j)
            EXPECT_NE(hashOf(all[j].scene), hashOf(all[i].scene)) << all[j].field;
    }
}

TEST(SceneFields, EveryOneOfALightCounts) { expectEveryFieldCounts(&Scene::lights, 16); }
TEST(SceneFields, EveryOneOfAMaterialCounts) { expectEveryFieldCounts(&Scene::materials, 35); }
TEST(SceneFields, EveryOneOfAnInstanceCounts) { expectEveryFieldCounts(&Scene::instances, 9); }
TEST(SceneFields, EveryOneOfACameraCounts) { expectEveryFieldCounts(&Scene::cameras, 10); }

TEST(SceneFields, PhongValuesOfAMaterialCount) {
    Scene plain;
    plain.materials.resize(1);
    plain.materials[0].phong.emplace();
    Scene changed = plain;
    visitFields(
        [&](const char* name, auto& value, const auto& kept) {
            change(value);
            EXPECT_NE(hashOf(changed), hashOf(plain)) << name;
            EXPECT_EQ(io::sceneFromBytes(io::bytesFromScene(changed)).materials, changed.materials) << name;
            value = kept;
        },
        *changed.materials[0].phong, std::as_const(*plain.materials[0].phong));
    EXPECT_EQ(changed.materials, plain.materials);
}

// Of each number, its first part.
template <class T>
float* numberOf(T& value) {
    if constexpr (std::is_same_v<T, float>)
        return &value;
    else if constexpr (std::is_same_v<T, glm::vec3> || std::is_same_v<T, glm::vec4>)
        return &value.x;
    else
        return nullptr;
}

template <class T>
void expectNumbersRefused(Scene& scene, T& object) {
    visitFields(
        [&](const char* name, auto& value) {
            float* number = numberOf(value);
            if (number == nullptr) return;
            const float kept = std::exchange(*number, kNan);
            try {
                scene.validate();
                ADD_FAILURE() << name << " may be any";
            } catch (const Error& error) {
                EXPECT_NE(std::string(error.what()).find(std::string(name) + " is not finite"),
                          std::string::npos)
                    << error.what();
            }
            *number = kept;
        },
        object);
    EXPECT_NO_THROW(scene.validate());
}

TEST(SceneFields, NumbersThatAreNotFiniteAreRefusedByName) {
    Scene scene;
    scene.lights.resize(1);
    scene.materials.resize(1);
    scene.materials[0].phong.emplace();
    expectNumbersRefused(scene, scene.lights[0]);
    expectNumbersRefused(scene, scene.materials[0]);
    expectNumbersRefused(scene, *scene.materials[0].phong);
}

template <class T>
const void* placeOf(const T& object, const std::string& name) {
    const void* place = nullptr;
    visitFields(
        [&](const char* field, const auto& value) {
            if (field == name) place = &value;
        },
        object);
    return place;
}

// Fields of one type cannot stand in for each other.
TEST(SceneFields, NamesBelongToTheirFields) {
    const Material material;
    EXPECT_EQ(placeOf(material, "roughness"), &material.roughness);
    EXPECT_EQ(placeOf(material, "ior"), &material.ior);
    EXPECT_EQ(placeOf(material, "alpha cutoff"), &material.alphaCutoff);
    EXPECT_EQ(placeOf(material, "normal"), &material.normalTexture);
    const Light light;
    EXPECT_EQ(placeOf(light, "position"), &light.position);
    EXPECT_EQ(placeOf(light, "outer angle"), &light.outerAngle);
    EXPECT_EQ(placeOf(light, "enabled"), &light.enabled);
}

}  // namespace
}  // namespace conelight

// SPDX-License-Identifier: MIT
// LightField: views of all kinds. Parallel rays, off-centre lenses, and hosts that say how their pixels moved.
#include <glm/gtc/matrix_transform.hpp>
#include <optional>

#include "support/light_field_rig.h"
#include "support/scenes.h"
#include "view/camera.h"

namespace conelight::test {
namespace {

class LightFieldViews : public LightFieldRig {
  protected:
    void TearDown() override {
        field_.reset();
        LightFieldRig::TearDown();
    }
    // Of the room seen from before its open front; the wall there is turned away.
    glm::mat4 parallel(float nearest = 2.5f, float farthest = 5.5f) const {
        return glm::ortho(-1.2f, 1.2f, -0.9f, 0.9f, nearest, farthest);
    }
    void lookFrom(const glm::vec3& eye) {
        scene_.cameras.front() = {.eye = eye, .target = {0, 0, 0}, .fovY = 0.9f};
    }
    void settledField(const Settings& settings) {
        field_.emplace();
        field_->setScene(scene_);
        field_->setSettings(settings);
        field_->update();
    }
    GatheredLight gathered(HostPicture& host) {
        drawn(host);
        return field_->gather(field_->addView(), host.surfaces());
    }
    std::vector<glm::vec4> diffuse(HostPicture& host) { return pixelsOf(gathered(host).diffuse); }

  private:
    std::optional<LightField> field_;
};

// In a closed room of albedo 0.6 whose walls all send out 0.4 every ray brings 0.4 / (1 - 0.6) = 1. Pixels keep some
// noise of what the cache has not settled, 10 %; their mean 1 %.
TEST_F(LightFieldViews, ParallelRaysSeeAFurnace) {
    scene_ = closedBox(diffuseMaterial(glm::vec3(0.6f), glm::vec3(0.4f)));
    lookFrom({0.6f, 0.5f, 4});
    Settings settings = hostSettings();
    settings.traced.cacheUpdates = 64;
    settledField(settings);
    HostPicture host(scene_, parallel());
    const std::vector<glm::vec4> image = diffuse(host);
    int seen = 0;
    float sum = 0;
    for (const glm::vec4& pixel : image) {
        if (pixel.a == 0) continue;
        ++seen;
        sum += pixel.r;
        EXPECT_NEAR(pixel.r, 1, 0.1);
    }
    EXPECT_GT(seen, kHostWidth * kHostHeight / 2);
    EXPECT_NEAR(sum / static_cast<float>(seen), 1, 0.01);
}

// A floor that mirrors parallel rays, seen at 45 degrees, shows the wall before it at the height that geometry says:
// glowing above y = 0, dark below.
TEST_F(LightFieldViews, ParallelRaysAreMirrored) {
    scene_ = {};
    Material mirror;
    mirror.baseColor = glm::vec4(1);
    mirror.metallic = 1;
    mirror.roughness = 0;
    addInstance(scene_, quadMesh({-1, -1, 1}, {2, 0, 0}, {0, 0, -2}), mirror);
    addInstance(scene_, quadMesh({-1, 0, -1}, {2, 0, 0}, {0, 1, 0}),
                diffuseMaterial(glm::vec3(0), glm::vec3(1)));
    addInstance(scene_, quadMesh({-1, -1, -1}, {2, 0, 0}, {0, 1, 0}), diffuseMaterial(glm::vec3(0)));
    scene_.cameras.push_back({.eye = {0, 3, 4}, .target = {0, -1, 0}});
    settledField(hostSettings());
    HostPicture host(scene_, glm::ortho(-0.6f, 0.6f, -0.45f, 0.45f, 1.0f, 10.0f));
    const std::vector<glm::vec4> image = pixelsOf(gathered(host).specular);
    // Up the picture by y the floor lies at z = -y sqrt 2, and its ray meets the wall at height z: 0 in the middle
    int wrong = 0, pixels = 0;
    for (int y = 0; y < kHostHeight; ++y) {
        const float up = 0.9f * (static_cast<float>(y) + 0.5f) / static_cast<float>(kHostHeight) - 0.45f;
        const float height = -up * std::sqrt(2.0f);
        if (std::abs(height) < 0.07f) continue;  // a voxel
        for (int x = 0; x < kHostWidth; ++x, ++pixels) {
            const float shown = image[static_cast<std::size_t>(y * kHostWidth + x)].r;
            wrong += std::abs(shown - (height > 0 ? 1.0f : 0.0f)) > 0.05f ? 1 : 0;
        }
    }
    EXPECT_LT(wrong, pixels / 100);
}

// Rays that meet two kilometres away are parallel to a thousandth of a voxel.
TEST_F(LightFieldViews, ParallelRaysAreThoseOfADistantEye) {
    lookFrom(glm::normalize(glm::vec3(0.6f, 0.5f, 4)) * 4.0f);
    Settings settings = hostSettings();
    settings.traced.pixelRays = 0;
    settledField(settings);
    HostPicture near(scene_, parallel());
    const GatheredLight light = gathered(near);
    const std::vector<glm::vec4> image = pixelsOf(light.diffuse), mirrored = pixelsOf(light.specular);
    // What two kinds of depth and of normals say is the same
    glm::mat4 reversed = parallel();
    reversed[2][2] = -0.5f * reversed[2][2];
    reversed[3][2] = 0.5f - 0.5f * reversed[3][2];
    HostPicture back(scene_, reversed, true);
    EXPECT_LT(hostDifference(diffuse(back), image), 2e-3);
    near.surfaces().geometricNormal = 0;
    EXPECT_LT(hostDifference(diffuse(near), image), 2e-2);

    constexpr float kFar = 2000;
    lookFrom(glm::normalize(glm::vec3(0.6f, 0.5f, 4)) * kFar);
    const float part = (kFar - 1.5f) / kFar;
    HostPicture far(
        scene_, glm::frustum(-1.2f * part, 1.2f * part, -0.9f * part, 0.9f * part, kFar - 1.5f, kFar + 1.5f));
    const GatheredLight distant = gathered(far);
    EXPECT_LT(hostDifference(pixelsOf(distant.diffuse), image), 0.01);
    const auto metal = [&](std::size_t i) { return mirrored[i] != image[i]; };
    EXPECT_LT(hostDifference(pixelsOf(distant.specular), mirrored, metal), 0.03);
}

// An eye that looks past its picture's middle: a lens shifted by ten pixels sees what the straight one sees ten
// pixels beside. From the cache, which has no noise of pixels.
TEST_F(LightFieldViews, LensesMayBeOffCentre) {
    Settings settings = hostSettings();
    settings.traced.pixelRays = 0;
    settledField(settings);
    HostPicture straight(scene_, lens());
    const std::vector<glm::vec4> image = diffuse(straight);
    constexpr int kShift = 10;
    HostPicture shifted(scene_, glm::translate(glm::mat4(1), {2.0f * kShift / kHostWidth, 0, 0}) * lens());
    const std::vector<glm::vec4> beside = diffuse(shifted);
    std::vector<glm::vec4> expected, found;
    for (int y = 0; y < kHostHeight; ++y)
        for (int x = kShift; x < kHostWidth; ++x) {
            found.push_back(beside[static_cast<std::size_t>(y * kHostWidth + x)]);
            expected.push_back(image[static_cast<std::size_t>(y * kHostWidth + x - kShift)]);
        }
    EXPECT_LT(hostDifference(found, expected), 1e-3);
}

// Where a host's pixels were in the picture before, worked out on the CPU from what it has drawn.
class LightFieldMotion : public LightFieldRig {
  protected:
    static constexpr int kFrames = 10;

    // A box slides and the eye moves; the last picture.
    // Vertices: it slides by those, and its instance stays.
    enum class Says { Nothing, Instances, Vertices, Vectors, Wrong };
    std::vector<glm::vec4> moving(Says says, int reduction = 1, std::optional<int> bounces = {});

  private:
    void slide(const glm::vec3& step, bool byVertices);
    std::vector<glm::vec4> vectors(HostPicture& host, const glm::mat4& clipBefore, const Scene& before);
};

std::vector<glm::vec4> LightFieldMotion::vectors(HostPicture& host, const glm::mat4& clipBefore,
                                                 const Scene& before) {
    const std::size_t count = static_cast<std::size_t>(kHostWidth * kHostHeight);
    std::vector<float> depth(count);
    std::vector<std::uint32_t> ids(count);
    const auto bytes = static_cast<GLsizei>(4 * count);
    glGetTextureImage(host.surfaces().depth, 0, GL_DEPTH_COMPONENT, GL_FLOAT, bytes, depth.data());
    glGetTextureImage(host.surfaces().instances, 0, GL_RED_INTEGER, GL_UNSIGNED_INT, bytes, ids.data());
    const glm::mat4 worldFromClip =
        glm::inverse(host.surfaces().clipFromView * host.surfaces().viewFromWorld);
    std::vector<glm::vec4> all(count);
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec2 here((static_cast<float>(i % kHostWidth) + 0.5f) / kHostWidth,
                             (static_cast<float>(i / kHostWidth) + 0.5f) / kHostHeight);
        const glm::vec4 clip(2.0f * here - 1.0f, 2 * depth[i] - 1, 1);
        glm::vec4 world = worldFromClip * clip;
        world /= world.w;
        const glm::mat4& now = scene_.instances[ids[i]].worldFromObject;
        const glm::vec4 then =
            clipBefore * before.instances[ids[i]].worldFromObject * glm::inverse(now) * world;
        const glm::vec2 place = 0.5f * glm::vec2(then) / then.w + 0.5f;
        all[i] = glm::vec4(place - here, then.w - (clipBefore * world).w, 0);
    }
    return all;
}

void LightFieldMotion::slide(const glm::vec3& step, bool byVertices) {
    glm::mat4& place = scene_.instances.back().worldFromObject;
    if (!byVertices)
        place[3] += glm::vec4(step, 0);
    else
        for (glm::vec3& position : scene_.meshes.back().positions)
            position += glm::inverse(glm::mat3(place)) * step;
}

std::vector<glm::vec4> LightFieldMotion::moving(Says says, int reduction, std::optional<int> bounces) {
    scene_ = hostRoom();
    Settings settings = hostSettings();
    settings.traced.bounces = bounces;
    LightField field;
    field.setScene(scene_);
    field.setSettings(settings);
    field.update();
    settings.traced.budgeted = true;
    field.setSettings(settings);
    const int view = field.addView();
    gl::Texture motion({GL_TEXTURE_2D, GL_RGBA32F, kHostWidth, kHostHeight}, "host motion");
    Scene before = scene_;
    glm::mat4 clipBefore(1);
    GatheredLight light;
    for (int frame = 0; frame < kFrames; ++frame) {
        if (frame > 0) {
            slide({-0.04f, 0, 0.03f}, says == Says::Vertices);
            scene_.cameras.front().eye.x -= 0.05f;
            scene_.cameras.front().target.x -= 0.05f;
        }
        field.setInstance(scene_.instances.size() - 1, scene_.instances.back());
        if (frame > 0 && says == Says::Vertices)
            field.setMesh(scene_.meshes.size() - 1, scene_.meshes.back());
        field.update({.updates = 4});
        HostPicture host(scene_, lens());
        drawn(host);
        const glm::mat4 clip = host.surfaces().clipFromView * host.surfaces().viewFromWorld;
        if (says == Says::Vectors || says == Says::Wrong) {
            std::vector<glm::vec4> texels(static_cast<std::size_t>(kHostWidth * kHostHeight), glm::vec4(0));
            if (frame > 0 && says == Says::Vectors) texels = vectors(host, clipBefore, before);
            // In pixels, which the scale takes back.
            for (glm::vec4& texel : texels) texel *= glm::vec4(kHostWidth, kHostHeight, 1, 1);
            motion.upload(0, GL_RGBA, GL_FLOAT, texels.data());
            host.surfaces().motion = motion.name();
            host.surfaces().motionScale = {1.0f / kHostWidth, 1.0f / kHostHeight};
        }
        if (says == Says::Nothing) host.surfaces().instances = 0;
        light = field.gather(view, host.surfaces(), {.reduction = reduction});
        clipBefore = clip;
        before = scene_;
    }
    return pixelsOf(light.diffuse);
}

// What moves keeps its means by vectors as it does by the instances' own matrices.
TEST_F(LightFieldMotion, VectorsSayWhatMatricesSay) {
    const std::vector<glm::vec4> byInstances = moving(Says::Instances);
    EXPECT_LT(hostDifference(moving(Says::Vectors), byInstances), 0.003);
    EXPECT_GT(hostDifference(moving(Says::Wrong), byInstances), 0.02);
    EXPECT_LT(hostDifference(moving(Says::Vectors, 2), moving(Says::Instances, 2)), 0.01);
}

// Vertices that move are the field's to follow, where the host says whose pixels are. By one bounce: what faces keep goes
// by how far things have moved, which voxels do not know of vertices.
TEST_F(LightFieldMotion, VerticesAreFollowedAsInstancesAre) {
    const double apart = hostDifference(moving(Says::Vertices, 2, 1), moving(Says::Instances, 2, 1));
    RecordProperty("apart", std::to_string(apart));
    EXPECT_LT(apart, 0.005);
}

}  // namespace
}  // namespace conelight::test

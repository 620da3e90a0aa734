// SPDX-License-Identifier: MIT
// Everything that shines, as one table that the path tracer samples: lights of the scene, flat emissive quads
// (rectangular lights, as in the GL modes) and other emissive triangles. Intensity, falloff,
// cone and range follow shaders/lib/lights.glsl to the letter.
//
// Each light of the scene, quad and emissive instance is a group. A group is chosen by what it gives at the
// surface without shadows, a triangle within its group by power; the first surface of a path asks all groups
// if they are few. Very many groups are one, of which a tree chooses (reference/light_tree.h); directional lights stay
// groups. The power of a textured emitter is that of its mean over each triangle, only to choose it often enough; what
// it gives is the exact value at the sampled point. The sky is not in the table: it is found by the directions that
// surfaces reflect to.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "conelight/scene.h"
#include "reference/light_tree.h"
#include "reference/ray_scene.h"

namespace conelight::reference {

struct LightSample {
    glm::vec3 toLight{0};   // unit
    float distance = 0;     // to the sampled point; infinite for directional lights
    glm::vec3 target{0};    // the sampled point, moved off the emitter's surface; not for directional lights
    glm::vec3 radiance{0};  // of the emitter, or the irradiance on a facing plane of a light without extent
    float density = 0;      // of this sample, 1/sr; without extent: the probability of having chosen it
    bool extended = false;  // has a solid angle: other techniques can find it as well
    bool direct = false;    // counts as direct light: seen by shadow rays, else by bounce rays
    bool castsShadow = true;
};

// What a light without extent gives at `from` when nothing is in the way: direction, distance, radiance. False when
// nothing arrives.
bool sampleLight(const Light& light, const glm::vec3& from, LightSample& result);

// Which emissive instances count as direct light (PathTracerSettings).
struct DirectEmitters {
    bool quads, smallLamps;
};

class LightTable {
  public:
    // Emitters of the kinds of `direct` are direct light. Without `extended`, only lights that no ray can hit
    // are sampled. `scene` must outlive it.
    LightTable(const Scene& scene, DirectEmitters direct, bool extended);

    // How often each group is asked from one surface; all zero when no group can give light.
    static constexpr std::size_t kMostGroups = 32;
    struct Choice {
        std::array<float, kMostGroups> probability;
        bool each = false;  // all groups are asked: the probabilities are 1
        LightTree::Place place;
    };
    // `first`: of a path.
    void choose(const glm::vec3& from, const glm::vec3& normal, bool first, Choice& choice) const;
    // For surfaces that scatter light through: the mean of the choices at both of their sides.
    void chooseBothSides(const glm::vec3& from, const glm::vec3& normal, Choice& choice) const;
    std::size_t groupCount() const { return groups_.size(); }

    // A point of one group. False when nothing arrives (behind the emitter, out of range ...).
    bool sample(const Choice& choice, std::size_t group, const glm::vec3& from, float within,
                const glm::vec2& u, LightSample& result) const;
    // The group that a number in [0,1) stands for, and what is left of the number; groupCount() if none.
    std::size_t groupOf(const Choice& choice, float& number) const;

    // A ray from `from` hit a triangle: whether it belongs to the table, and the density with which sample()
    // would have found this point.
    struct Found {
        bool emitter = false;    // in the table
        bool direct = false;     // its light is direct
        bool elsewhere = false;  // forRectsAlong finds it
        float density = 0;
    };
    Found found(const Choice& choice, const RayHit& hit, const glm::vec3& direction) const;

    // Area lights that no bounce ray finds: the scene's own, and flat emissive ones that are direct, when bounce
    // rays see other instances than shadow rays. Calls visit(const LightSample&) for each that the ray meets.
    template <class Visit>
    void forRectsAlong(const Choice& choice, const glm::vec3& from, const glm::vec3& direction,
                       Visit visit) const {
        for (const std::uint32_t i : rectsToTest_) {
            LightSample hit;
            if (lampAlong(choice, emitters_[i], from, direction, hit)) visit(hit);
        }
    }
    bool hasRectsToTest() const { return !rectsToTest_.empty(); }
    bool hasExtendedLamps() const { return hasExtendedLamps_; }

  private:
    enum class Kind : std::uint8_t { Point, Directional, Rect, Sphere, Triangle };
    struct Emitter {
        Kind kind = Kind::Point;
        bool round = false;  // rect: the ellipse in it
        bool direct = true, castsShadow = true, twoSided = false, constant = true;
        glm::vec3 radiance{0};  // or intensity
        glm::vec3 position{0};  // rect: a corner; triangle: vertex 0
        glm::vec3 edgeU{0}, edgeV{0};
        glm::vec3 normal{0};  // unit; shining side, or where light travels to
        float area = 0;       // of a sphere that of its disc
        float radius = 0;
        float within = 0;  // probability within its group; 0: never sampled
        std::uint32_t group = 0;
        std::uint32_t instance = 0, triangle = 0;
        const Light* light = nullptr;  // point, spot
        float cosInner = -2, cosOuter = -3;
    };

    void addLight(const Light& light);
    void addSphere(const Light& light);
    void addRect(const Light& light, std::uint32_t instance, bool isQuad);
    void addTriangles(const Scene& scene, std::size_t instance);
    void setGroups(bool extended);
    void joinGroups(const std::vector<double>& powers);
    void shareGroup(std::size_t group, const std::vector<double>& powers);
    float chanceOf(const Choice& choice, const Emitter& e) const;
    float weightOf(std::size_t group, const glm::vec3& from, const glm::vec3& normal) const;
    double powerOf(const Emitter& e) const;
    static Aabb boxOf(const Emitter& e);
    bool lampAlong(const Choice& choice, const Emitter& e, const glm::vec3& from, const glm::vec3& direction,
                   LightSample& hit) const;
    bool rectAlong(const Choice& choice, const Emitter& e, const glm::vec3& from, const glm::vec3& direction,
                   LightSample& hit) const;
    bool sampleEmitter(const Emitter& e, const glm::vec3& from, const glm::vec2& u,
                       LightSample& result) const;
    bool samplePart(const Emitter& e, const glm::vec3& from, const glm::vec2& u, LightSample& result) const;
    bool samplePoint(const Emitter& e, const glm::vec3& from, LightSample& result) const;
    bool sampleArea(const Emitter& e, const glm::vec3& from, const glm::vec2& u, LightSample& result) const;

    const Scene& scene_;
    std::vector<Emitter> emitters_;
    struct Group {
        std::size_t first = 0, count = 0;  // emitters
        glm::vec3 center{0};
        float radius2 = 0;  // of a sphere around it, squared
        float power = 0;    // 0: never sampled
    };
    std::vector<Group> groups_;
    LightTree tree_;                 // of the first group, when there are very many emitters
    std::vector<float> cumulative_;  // within groups, by emitter
    std::vector<std::uint32_t> rectsToTest_;
    static constexpr std::uint32_t kNone = ~0u;
    struct OfInstance {
        std::uint32_t first = kNone;  // first triangle's emitter, or the quad's front
        bool quad = false;
        bool direct = false;    // its light is direct
        bool twoSided = false;  // the quad's back follows its front
    };
    std::vector<OfInstance> ofInstance_;
    float sceneRadius_ = 1;
    bool sameBlockers_ = true;
    bool hasExtendedLamps_ = false;
};

}  // namespace conelight::reference

// SPDX-License-Identifier: MIT
// Groups of the path tracer's emitters, and how often each is asked from a surface. Part of LightTable.
#include <algorithm>
#include <cmath>

#include "reference/lights.h"

namespace conelight::reference {
namespace {

// The first surface of a path asks every group when there are no more than these: its noise is the picture's.
constexpr std::size_t kGroupsAtFirst = 8;
// Share of choices that do not look at the light a group would give: the brightest may be hidden, as the sun
// from most of scene atrium. Chosen by eye, not tuned.
constexpr float kEvenShare = 0.25f;

}  // namespace

void LightTable::setGroups(bool extended) {
    std::vector<double> powers;
    for (std::size_t i = 0; i < emitters_.size(); ++i) {
        Emitter& e = emitters_[i];
        const bool sampled = extended || e.kind == Kind::Point || e.kind == Kind::Directional;
        const double power = sampled ? powerOf(e) : 0.0;
        powers.push_back(std::isfinite(power) ? std::max(power, 0.0) : 0.0);
        const bool joins = e.kind == Kind::Triangle && i > 0 && emitters_[i - 1].kind == Kind::Triangle &&
                           emitters_[i - 1].instance == e.instance;
        if (!joins) groups_.push_back({i, 0, {}, 0, 0});
        ++groups_.back().count;
    }
    cumulative_.resize(emitters_.size());
    if (groups_.size() > kMostGroups) joinGroups(powers);
    for (std::size_t g = tree_.empty() ? 0 : 1; g < groups_.size(); ++g) shareGroup(g, powers);
}

// One group for the tree of all that is somewhere, one for each directional light; all in one if those are many.
void LightTable::joinGroups(const std::vector<double>& powers) {
    std::vector<LightTree::Lamp> lamps;
    std::vector<Group> others;
    Group whole{0, emitters_.size(), {}, 0, 0};
    Aabb bounds;
    for (std::size_t i = 0; i < emitters_.size(); ++i) {
        Emitter& e = emitters_[i];
        if (e.kind == Kind::Directional) {
            others.push_back({i, 1, {}, 0, 0});
            continue;
        }
        e.group = 0;
        e.within = powers[i] > 0 ? 1.0f : 0.0f;
        if (!(powers[i] > 0)) continue;
        const Aabb box = boxOf(e);
        bounds.grow(box.min);
        bounds.grow(box.max);
        whole.power += static_cast<float>(powers[i]);
        lamps.push_back({box, static_cast<float>(powers[i]), static_cast<std::uint32_t>(i)});
    }
    groups_.assign(1, whole);
    if (others.size() >= kMostGroups || lamps.empty()) return;
    groups_.front().center = bounds.center();
    groups_.front().radius2 = 0.25f * glm::dot(bounds.extent(), bounds.extent());
    groups_.insert(groups_.end(), others.begin(), others.end());
    tree_ = LightTree(std::move(lamps));
}

Aabb LightTable::boxOf(const Emitter& e) {
    Aabb box;
    for (const glm::vec3& corner : {glm::vec3(0), e.edgeU, e.edgeV}) box.grow(e.position + corner);
    if (e.kind == Kind::Rect) box.grow(e.position + e.edgeU + e.edgeV);
    for (const float side : {-e.radius, e.radius}) box.grow(e.position + side);
    return box;
}

// A group's bounds and power, and the probabilities of its emitters.
void LightTable::shareGroup(std::size_t g, const std::vector<double>& powers) {
    Group& group = groups_[g];
    double total = 0, sum = 0;
    Aabb bounds;
    for (std::size_t i = group.first; i < group.first + group.count; ++i) {
        total += powers[i];
        const Aabb box = boxOf(emitters_[i]);
        bounds.grow(box.min);
        bounds.grow(box.max);
    }
    group.power = static_cast<float>(total);
    group.center = bounds.center();
    group.radius2 = 0.25f * glm::dot(bounds.extent(), bounds.extent());
    float before = 0;
    for (std::size_t i = group.first; i < group.first + group.count; ++i) {
        sum += powers[i];
        emitters_[i].group = static_cast<std::uint32_t>(g);
        if (!(group.power > 0)) continue;
        cumulative_[i] = static_cast<float>(sum / total);
        // As the search sees it.
        emitters_[i].within = cumulative_[i] - before;
        before = cumulative_[i];
    }
}

// How often sample() takes an emitter from where the choice was made.
float LightTable::chanceOf(const Choice& choice, const Emitter& e) const {
    const float chance = choice.probability[e.group] * e.within;
    if (tree_.empty() || e.group != 0 || !(chance > 0)) return chance;
    return chance * tree_.probability(choice.place, static_cast<std::uint32_t>(&e - emitters_.data()));
}

void LightTable::choose(const glm::vec3& from, const glm::vec3& normal, bool first, Choice& choice) const {
    const std::size_t count = groups_.size();
    choice.place = {from, normal};
    choice.each = first && count <= kGroupsAtFirst;
    if (choice.each || count == 1) {
        for (std::size_t g = 0; g < count; ++g) choice.probability[g] = groups_[g].power > 0 ? 1.0f : 0.0f;
        return;
    }
    float sum = 0;
    int giving = 0;
    for (std::size_t g = 0; g < count; ++g) {
        const float weight = weightOf(g, from, normal);
        choice.probability[g] = weight;
        sum += weight;
        giving += weight > 0 ? 1 : 0;
    }
    // The brightest light may be hidden: others keep a share.
    for (std::size_t g = 0; g < count; ++g)
        if (choice.probability[g] > 0)
            choice.probability[g] =
                (1 - kEvenShare) * choice.probability[g] / sum + kEvenShare / static_cast<float>(giving);
}

void LightTable::chooseBothSides(const glm::vec3& from, const glm::vec3& normal, Choice& choice) const {
    choice.place.normal = glm::vec3(0);
    if (choice.each || groups_.size() == 1) return;
    Choice back;
    choose(from, -normal, false, back);
    float sum = 0;
    for (std::size_t g = 0; g < groups_.size(); ++g) sum += choice.probability[g] += back.probability[g];
    for (std::size_t g = 0; g < groups_.size() && sum > 0; ++g) choice.probability[g] /= sum;
}

std::size_t LightTable::groupOf(const Choice& choice, float& number) const {
    std::size_t last = groups_.size();
    float rest = number;
    for (std::size_t g = 0; g < groups_.size(); ++g) {
        const float probability = choice.probability[g];
        if (!(probability > 0)) continue;
        last = g;
        if (rest < probability) break;
        rest -= probability;
    }
    if (last < groups_.size()) number = std::clamp(rest / choice.probability[last], 0.0f, 1.0f - 0x1p-24f);
    return last;
}

}  // namespace conelight::reference

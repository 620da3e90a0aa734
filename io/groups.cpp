// SPDX-License-Identifier: MIT
#include "io/groups.h"

#include <algorithm>

namespace conelight::io {
namespace {

class Grouping {
  public:
    Grouping(Scene& scene, const NodeTree& tree, const std::vector<int>& ofInstances,
             const std::vector<int>& ofLights)
        : scene_(scene), tree_(tree), own_(tree.parents.size(), 0), groups_(tree.parents.size(), -1) {
        for (const std::vector<int>* nodes : {&ofInstances, &ofLights})
            for (const int node : *nodes)
                if (node >= 0) ++own_[static_cast<std::size_t>(node)];
        all_ = own_;
        for (std::size_t i = tree.parentsFirst.size(); i-- > 0;) {
            const std::size_t node = tree.parentsFirst[i];
            if (tree.parents[node] >= 0) all_[static_cast<std::size_t>(tree.parents[node])] += all_[node];
        }
    }
    // The group that a thing of this node is in, made with those above it.
    int of(int node) {
        std::vector<std::size_t> missing;
        int above = -1;
        for (int at = node; at >= 0; at = tree_.parents[static_cast<std::size_t>(at)]) {
            const auto n = static_cast<std::size_t>(at);
            above = groups_[n];
            if (above >= 0) break;
            if (all_[n] > own_[n] || own_[n] > 1) missing.push_back(n);
        }
        while (!missing.empty()) {
            groups_[missing.back()] = static_cast<int>(scene_.groups.size());
            scene_.groups.push_back({tree_.nameOf(missing.back()), above});
            above = groups_[missing.back()];
            missing.pop_back();
        }
        return above;
    }

  private:
    Scene& scene_;
    const NodeTree& tree_;
    std::vector<std::size_t> own_, all_;  // things of each node, and with those below
    std::vector<int> groups_;             // of each node, as far as made
};

}  // namespace

void makeGroups(Scene& scene, const NodeTree& tree, const std::vector<int>& ofInstances,
                const std::vector<int>& ofLights) {
    Grouping grouping(scene, tree, ofInstances, ofLights);
    for (std::size_t i = 0; i < ofInstances.size(); ++i)
        scene.instances[i].group = grouping.of(ofInstances[i]);
    for (std::size_t i = 0; i < ofLights.size(); ++i) scene.lights[i].group = grouping.of(ofLights[i]);
}

}  // namespace conelight::io

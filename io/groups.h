// SPDX-License-Identifier: MIT
// A file's tree of nodes -> Scene::groups: nodes that hold several things, or nodes with things below.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "conelight/scene.h"

namespace conelight::io {

struct NodeTree {
    std::vector<int> parents;               // of each node; -1: none
    std::vector<std::size_t> parentsFirst;  // all nodes
    std::function<std::string(std::size_t)> nameOf;
};

// `ofInstances`, `ofLights`: the node of each of the scene's, -1: none. A node that holds one thing is no group of its own.
void makeGroups(Scene& scene, const NodeTree& tree, const std::vector<int>& ofInstances,
                const std::vector<int>& ofLights);

}  // namespace conelight::io

// SPDX-License-Identifier: MIT
// The lines of the list of objects: the scene's groups, folded or not, and what is in them. Scene and filter -> lines.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "conelight/scene.h"
#include "session/selection.h"

namespace conelight::program {

// What an object without a name is called.
std::string objectLabel(const Scene& scene, std::size_t instance);

class ObjectTree {
  public:
    struct Line {
        bool isGroup = false;
        std::size_t index = 0;  // of the group or instance
        int depth = 0;
    };
    // Objects and groups with `filter` in their names; all below such groups. Another `revision`: instances, lights or
    // groups have changed.
    void update(const Scene& scene, std::uint64_t revision, const std::string& filter);
    const std::vector<Line>& lines() const { return lines_; }
    // Those of the lines, from above.
    const std::vector<std::size_t>& shownInstances() const { return shownInstances_; }
    bool hasGroups() const { return hasGroups_; }

    bool isOpen(std::size_t group) const { return !filter_.empty() || open_[group] != 0; }
    void fold(std::size_t group, bool open);
    // Unfolds what it is in; nothing for one that the filter leaves out.
    void reveal(const Scene& scene, std::size_t instance);
    // The line of an instance; lines().size(): it is not among them.
    std::size_t lineOf(std::size_t instance) const;

    // What is in a group and in those below, lights first.
    std::vector<Selection> partsOf(const Scene& scene, std::size_t group) const;
    struct Count {
        std::size_t all = 0, selected = 0;     // objects and lights
        std::size_t objects = 0, visible = 0;  // objects alone
    };
    const Count& countOf(std::size_t group) const { return counts_[group]; }
    void countSelected(const Scene& scene, const std::vector<Selection>& selected);

  private:
    struct Item {
        bool isGroup;
        std::size_t index;
    };
    void takeItems(const Scene& scene);
    void openAtFirst(const Scene& scene);
    void findLines();
    void markMatches(const Scene& scene);
    template <class Visit>
    void forGroupsOf(int group, const Visit& visit) const;

    std::vector<Group> groups_;  // as they are now
    std::vector<Item> roots_;
    std::vector<std::vector<Item>> items_;  // of each group
    std::vector<std::uint8_t> open_;
    std::vector<std::uint8_t> groupMatches_, matches_;  // groups with something to show; instances
    std::vector<Count> counts_;
    std::vector<Line> lines_;
    std::vector<std::size_t> shownInstances_;
    std::string filter_;
    std::uint64_t revision_ = 0;
    bool hasGroups_ = false;
};

}  // namespace conelight::program

// SPDX-License-Identifier: MIT
#include "viewer/object_tree.h"

#include <fmt/core.h>

#include <algorithm>

namespace conelight::program {
namespace {

constexpr std::size_t kUnfolded = 40;  // objects: scenes with more begin folded

bool has(const std::string& name, const std::string& filter) {
    return name.find(filter) != std::string::npos;
}

}  // namespace

std::string objectLabel(const Scene& scene, std::size_t instance) {
    const std::string& name = scene.instances[instance].name;
    return name.empty() ? fmt::format("object {}", instance) : name;
}

// From the group upwards.
template <class Visit>
void ObjectTree::forGroupsOf(int group, const Visit& visit) const {
    for (; group >= 0; group = groups_[static_cast<std::size_t>(group)].parent)
        visit(static_cast<std::size_t>(group));
}

void ObjectTree::update(const Scene& scene, std::uint64_t revision, const std::string& filter) {
    if (revision == revision_ && filter == filter_) return;
    const bool changed = revision != revision_;
    revision_ = revision;
    filter_ = filter;
    if (changed) {
        const bool others = groups_ != scene.groups;
        groups_ = scene.groups;
        takeItems(scene);
        if (others) openAtFirst(scene);
    }
    markMatches(scene);
    findLines();
}

// Groups stand where their first object does.
void ObjectTree::takeItems(const Scene& scene) {
    roots_.clear();
    items_.assign(groups_.size(), {});
    counts_.assign(groups_.size(), {});
    std::vector<std::uint8_t> placed(groups_.size(), 0);
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        const Instance& instance = scene.instances[i];
        Item item{false, i};
        bool done = false;
        forGroupsOf(instance.group, [&](std::size_t group) {
            ++counts_[group].all;
            ++counts_[group].objects;
            counts_[group].visible += instance.visible ? 1 : 0;
            if (!done) items_[group].push_back(item);
            done = done || placed[group] != 0;
            placed[group] = 1;
            item = {true, group};
        });
        if (!done) roots_.push_back(item);
    }
    for (const Light& light : scene.lights)
        forGroupsOf(light.group, [&](std::size_t group) { ++counts_[group].all; });
    hasGroups_ = std::any_of(roots_.begin(), roots_.end(), [](const Item& item) { return item.isGroup; });
}

// Small scenes wholly; of others what everything is in.
void ObjectTree::openAtFirst(const Scene& scene) {
    open_.assign(groups_.size(), scene.instances.size() <= kUnfolded ? 1 : 0);
    const std::vector<Item>* items = &roots_;
    while (items->size() == 1 && items->front().isGroup) {
        open_[items->front().index] = 1;
        items = &items_[items->front().index];
    }
}

void ObjectTree::markMatches(const Scene& scene) {
    matches_.assign(scene.instances.size(), filter_.empty() ? 1 : 0);
    groupMatches_.assign(groups_.size(), filter_.empty() ? 1 : 0);
    if (filter_.empty()) return;
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        bool found = has(objectLabel(scene, i), filter_);
        forGroupsOf(scene.instances[i].group,
                    [&](std::size_t group) { found = found || has(groups_[group].name, filter_); });
        matches_[i] = found ? 1 : 0;
        if (found)
            forGroupsOf(scene.instances[i].group, [&](std::size_t group) { groupMatches_[group] = 1; });
    }
}

void ObjectTree::findLines() {
    lines_.clear();
    shownInstances_.clear();
    struct Level {
        const std::vector<Item>* items;
        std::size_t next;
    };
    std::vector<Level> stack{{&roots_, 0}};
    while (!stack.empty()) {
        Level& level = stack.back();
        if (level.next == level.items->size()) {
            stack.pop_back();
            continue;
        }
        const Item item = (*level.items)[level.next++];
        if ((item.isGroup ? groupMatches_ : matches_)[item.index] == 0) continue;
        lines_.push_back({item.isGroup, item.index, static_cast<int>(stack.size()) - 1});
        if (!item.isGroup)
            shownInstances_.push_back(item.index);
        else if (isOpen(item.index))
            stack.push_back({&items_[item.index], 0});
    }
}

void ObjectTree::fold(std::size_t group, bool open) {
    open_[group] = open ? 1 : 0;
    findLines();
}

void ObjectTree::reveal(const Scene& scene, std::size_t instance) {
    bool folded = false;
    forGroupsOf(scene.instances[instance].group, [&](std::size_t group) {
        folded = folded || open_[group] == 0;
        open_[group] = 1;
    });
    if (folded) findLines();
}

std::size_t ObjectTree::lineOf(std::size_t instance) const {
    const auto found = std::find_if(lines_.begin(), lines_.end(), [&](const Line& line) {
        return !line.isGroup && line.index == instance;
    });
    return static_cast<std::size_t>(found - lines_.begin());
}

std::vector<Selection> ObjectTree::partsOf(const Scene& scene, std::size_t group) const {
    std::vector<Selection> parts;
    const auto isIn = [&](int of) {
        bool found = false;
        forGroupsOf(of, [&](std::size_t one) { found = found || one == group; });
        return found;
    };
    for (std::size_t i = 0; i < scene.lights.size(); ++i)
        if (isIn(scene.lights[i].group)) parts.push_back({SelectionKind::Light, i});
    for (std::size_t i = 0; i < scene.instances.size(); ++i)
        if (isIn(scene.instances[i].group)) parts.push_back({SelectionKind::Instance, i});
    return parts;
}

void ObjectTree::countSelected(const Scene& scene, const std::vector<Selection>& selected) {
    for (Count& count : counts_) count.selected = 0;
    for (const Selection& one : selected) {
        int group = -1;
        if (one.kind == SelectionKind::Instance) group = scene.instances[one.index].group;
        if (one.kind == SelectionKind::Light) group = scene.lights[one.index].group;
        forGroupsOf(group, [&](std::size_t above) { ++counts_[above].selected; });
    }
}

}  // namespace conelight::program

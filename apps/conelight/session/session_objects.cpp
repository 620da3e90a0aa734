// SPDX-License-Identifier: MIT
// What is selected in a session, and objects that come and go.
#include <algorithm>
#include <utility>

#include "session/session.h"

namespace conelight::program {
namespace {

bool maybeOneOfSeveral(const Selection& what) {
    return what.kind == SelectionKind::Instance || what.kind == SelectionKind::Light;
}

template <class T>
void append(std::vector<T>& to, const std::vector<T>& more) {
    to.insert(to.end(), more.begin(), more.end());
}

SceneCounts countsOf(const Scene& scene) {
    return {scene.meshes.size(),    scene.materials.size(), scene.textures.size(),
            scene.instances.size(), scene.lights.size(),    scene.groups.size()};
}

}  // namespace

// ---- Selection ------------------------------------------------------------------------------------------

void Session::select(const Selection& selection) {
    if (selection.kind == SelectionKind::None) return takeSelection({}, {});
    takeSelection({selection}, selection);
}

void Session::selectAll(std::vector<Selection> selection) {
    std::erase_if(selection, [](const Selection& one) { return !maybeOneOfSeveral(one); });
    const Selection last = selection.empty() ? Selection{} : selection.back();
    std::sort(selection.begin(), selection.end());
    selection.erase(std::unique(selection.begin(), selection.end()), selection.end());
    takeSelection(std::move(selection), last);
}

void Session::toggleSelected(const Selection& what) {
    if (!maybeOneOfSeveral(what)) return;
    std::vector<Selection> all = selected_;
    std::erase_if(all, [](const Selection& one) { return !maybeOneOfSeveral(one); });
    if (std::erase(all, what) > 0)
        takeSelection(all, std::find(all.begin(), all.end(), selection_) != all.end() ? selection_
                           : all.empty()                                              ? Selection{}
                                                                                      : all.back());
    else {
        all.insert(std::upper_bound(all.begin(), all.end(), what), what);
        takeSelection(std::move(all), what);
    }
}

bool Session::isSelected(const Selection& what) const {
    return std::binary_search(selected_.begin(), selected_.end(), what);
}

std::vector<std::size_t> Session::selectedOf(SelectionKind kind) const {
    std::vector<std::size_t> indices;
    for (const Selection& one : selected_)
        if (one.kind == kind) indices.push_back(one.index);
    return indices;
}

// Sorted, with the last one chosen among them.
void Session::takeSelection(std::vector<Selection> all, const Selection& last) {
    if (all == selected_ && last == selection_) return;
    selected_ = std::move(all);
    selection_ = last;
    ++revisions_.selection;
}

// Those of a kind from a number on: what they stood for is gone.
void Session::deselectFrom(SelectionKind kind, std::size_t first) {
    std::vector<Selection> rest = selected_;
    const auto gone = [&](const Selection& one) { return one.kind == kind && one.index >= first; };
    if (std::erase_if(rest, gone) == 0) return;
    const Selection last = !gone(selection_) ? selection_ : rest.empty() ? Selection{} : rest.back();
    takeSelection(std::move(rest), last);
}

// ---- Changes of several parts ---------------------------------------------------------------------------

void Session::edit(const SceneEdits& edits, const std::string& label, const std::string& mergeKey) {
    Step step{label, mergeKey, {}};
    const auto change = [&]<class E>(E made, const auto& before, const auto& after) {
        made.before = before;
        made.after = after;
        step.edits.push_back(std::move(made));
    };
    if (edits.added) step.edits.push_back(AddEdit{edits.added, countsOf(scene_)});
    if (edits.instanceList) change(InstancesEdit{}, scene_.instances, *edits.instanceList);
    if (edits.materialList) change(MaterialsEdit{}, scene_.materials, *edits.materialList);
    for (const auto& [index, instance] : edits.instances) {
        change(InstanceEdit{}, scene_.instances.at(index), instance);
        std::get<InstanceEdit>(step.edits.back()).index = index;
    }
    if (edits.lights && *edits.lights != scene_.lights) change(LightsEdit{}, scene_.lights, *edits.lights);
    if (!step.edits.empty()) commit(std::move(step));
}

void Session::setInstances(const std::vector<std::pair<std::size_t, Instance>>& changed,
                           const std::string& label, const std::string& mergeKey) {
    SceneEdits edits;
    edits.instances = changed;
    edit(edits, label, mergeKey);
}

void Session::setInstanceList(const std::vector<Instance>& instances, const std::string& label) {
    SceneEdits edits;
    edits.instanceList = instances;
    edit(edits, label);
}

// ---- Objects that come and go ---------------------------------------------------------------------------

void Session::takeInstances(const std::vector<Instance>& instances) {
    scene_.instances = instances;
    instanceRevisions_.resize(instances.size());
    for (std::uint64_t& revision : instanceRevisions_) ++revision;
    ++revisions_.instances;
    ++revisions_.instanceList;
    deselectFrom(SelectionKind::Instance, 0);
}

// Behind what is there, which keeps its numbers: clips go on. What is added gets revisions that nothing had before.
void Session::takeAddition(const AddEdit& edit, bool forward) {
    const bool fits = clipsFit();
    const Scene& added = *edit.added;
    if (forward) {
        append(scene_.meshes, added.meshes);
        append(scene_.materials, added.materials);
        append(scene_.textures, added.textures);
        append(scene_.instances, added.instances);
        append(scene_.lights, added.lights);
        append(scene_.groups, added.groups);
    } else {
        scene_.meshes.resize(edit.before.meshes);
        scene_.materials.resize(edit.before.materials);
        scene_.textures.resize(edit.before.textures);
        scene_.instances.resize(edit.before.instances);
        scene_.lights.resize(edit.before.lights);
        scene_.groups.resize(edit.before.groups);
        deselectFrom(SelectionKind::Instance, edit.before.instances);
        deselectFrom(SelectionKind::Light, edit.before.lights);
        deselectFrom(SelectionKind::Material, edit.before.materials);
    }
    const std::uint64_t fresh = ++additions_ << 32;
    instanceRevisions_.resize(scene_.instances.size(), fresh);
    materialRevisions_.resize(scene_.materials.size(), fresh);
    meshRevisions_.resize(scene_.meshes.size(), fresh);
    textureRevisions_.resize(scene_.textures.size(), fresh);
    if (!added.instances.empty()) {
        ++revisions_.instances;
        ++revisions_.instanceList;
        if (fits) clipList_ = revisions_.instanceList;
    }
    if (!added.meshes.empty()) ++revisions_.meshes;
    if (!added.materials.empty() || !added.textures.empty()) ++revisions_.materials;
    if (!added.lights.empty()) ++revisions_.lights;
}

void Session::takeChanges(const Scene& before, const Scene& now) {
    for (std::size_t i = 0; i < std::min(now.instances.size(), scene_.instances.size()); ++i) {
        if (now.instances[i] == before.instances[i]) continue;
        scene_.instances[i] = now.instances[i];
        ++instanceRevisions_[i];
        ++revisions_.instances;
    }
    for (std::size_t i = 0; i < std::min(now.materials.size(), scene_.materials.size()); ++i) {
        if (now.materials[i] == before.materials[i]) continue;
        scene_.materials[i] = now.materials[i];
        ++materialRevisions_[i];
        ++revisions_.materials;
    }
    if (now.lights != before.lights) {
        scene_.lights = now.lights;
        ++revisions_.lights;
    }
    if (now.environment == before.environment) return;
    scene_.environment = now.environment;
    ++revisions_.sky;
}

}  // namespace conelight::program

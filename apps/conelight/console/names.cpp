// SPDX-License-Identifier: MIT
#include "console/names.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <set>

#include "conelight/error.h"
#include "console/statements.h"

namespace conelight::program {
namespace {

template <class T>
std::vector<std::string> namesOf(const std::vector<T>& things) {
    std::vector<std::string> names;
    std::set<std::string> known;
    for (std::size_t i = 0; i < things.size(); ++i) {
        const std::string name = things[i].name.empty() ? std::to_string(i) : things[i].name;
        if (known.insert(name).second) names.push_back(name);
    }
    return names;
}

bool asIndex(const std::string& word, std::size_t count, std::size_t& index) {
    const auto [end, fault] = std::from_chars(word.data(), word.data() + word.size(), index);
    return fault == std::errc{} && end == word.data() + word.size() && index < count;
}

template <class T>
std::vector<std::size_t> named(const std::vector<T>& things, const std::string& word) {
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < things.size(); ++i)
        if (things[i].name == word && !word.empty()) found.push_back(i);
    std::size_t index = 0;
    if (found.empty() && asIndex(word, things.size(), index)) found.push_back(index);
    return found;
}

// What is in groups of that name, or in groups in them.
template <class T>
std::vector<std::size_t> inGroups(const Scene& scene, const std::vector<T>& things, const std::string& word) {
    const std::string name = word.substr(0, word.size() - 1);
    std::vector<bool> meant;  // parents come first
    for (const Group& group : scene.groups)
        meant.push_back(group.name == name ||
                        (group.parent >= 0 && meant[static_cast<std::size_t>(group.parent)]));
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < things.size(); ++i)
        if (things[i].group >= 0 && meant[static_cast<std::size_t>(things[i].group)]) found.push_back(i);
    return found;
}

}  // namespace

bool isGroupName(const std::string& word) { return word.size() > 1 && word.back() == '/'; }

std::string textOf(const glm::vec3& v) { return fmt::format("{:.6g} {:.6g} {:.6g}", v.x, v.y, v.z); }

// With a group as "NAME/".
std::vector<std::string> objectNames(const Session& s) {
    std::vector<std::string> names = namesOf(s.scene().instances);
    std::set<std::string> known;
    for (const Group& group : s.scene().groups)
        if (known.insert(group.name).second) names.push_back(group.name + "/");
    return names;
}
std::vector<std::string> materialNames(const Session& s) { return namesOf(s.scene().materials); }
std::vector<std::string> lightNames(const Session& s) { return namesOf(s.scene().lights); }
std::vector<std::string> cameraNames(const Session& s) { return namesOf(s.scene().cameras); }

std::vector<std::size_t> objectsNamed(const Session& s, const std::string& word) {
    if (isGroupName(word)) return inGroups(s.scene(), s.scene().instances, word);
    return named(s.scene().instances, word);
}
std::vector<std::size_t> materialsNamed(const Session& s, const std::string& word) {
    return named(s.scene().materials, word);
}
std::vector<std::size_t> lightsNamed(const Session& s, const std::string& word) {
    if (isGroupName(word)) return inGroups(s.scene(), s.scene().lights, word);
    return named(s.scene().lights, word);
}
std::vector<std::size_t> camerasNamed(const Session& s, const std::string& word) {
    return named(s.scene().cameras, word);
}

void requireName(const std::string& command, const std::string& thing, const std::vector<std::string>& names,
                 const std::string& word) {
    std::size_t index = 0;
    const auto groups = std::count_if(names.begin(), names.end(), isGroupName);
    if (std::find(names.begin(), names.end(), word) != names.end() ||
        asIndex(word, names.size() - static_cast<std::size_t>(groups), index))
        return;
    std::string right = nearest(word, names);
    if (right.empty() && !names.empty()) {
        // A few of them; `list` shows all.
        for (std::size_t i = 0; i < std::min<std::size_t>(names.size(), 5); ++i)
            right += (i == 0 ? "" : ", ") + names[i];
        if (names.size() > 5) right += fmt::format(" or one of {} more", names.size() - 5);
    }
    throw Error(ErrorKind::Usage,
                fmt::format("{}: there is no {} '{}'{}", command, thing, word,
                            right.empty() ? "; the scene has none" : "; " + right + " would be right"));
}

}  // namespace conelight::program

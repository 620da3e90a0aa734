// SPDX-License-Identifier: MIT
// Settings of guests: each guest keeps a struct of its own in Settings::groups, found by its type. A group
// that was never written is as it is by default. Copies are deep.
#pragma once

#include <any>
#include <map>
#include <typeindex>

namespace conelight {

class SettingsGroups {
  public:
    // T: default-constructible, copyable, with ==.
    template <class T>
    const T& of() const {
        static const T defaults{};
        const auto found = groups_.find(std::type_index(typeid(T)));
        return found == groups_.end() ? defaults : *std::any_cast<T>(&found->second.value);
    }
    template <class T>
    T& of() {
        Group& group = groups_[std::type_index(typeid(T))];
        if (!group.value.has_value()) group = {T{}, &sameGroup<T>};
        return *std::any_cast<T>(&group.value);
    }

    bool operator==(const SettingsGroups& other) const { return agrees(other) && other.agrees(*this); }

  private:
    struct Group {
        std::any value;
        bool (*same)(const SettingsGroups& a, const SettingsGroups& b) = nullptr;
    };

    template <class T>
    static bool sameGroup(const SettingsGroups& a, const SettingsGroups& b) {
        return a.of<T>() == b.of<T>();
    }
    // Whether the groups written here are the same there.
    bool agrees(const SettingsGroups& other) const {
        for (const auto& [type, group] : groups_)
            if (!group.same(*this, other)) return false;
        return true;
    }

    std::map<std::type_index, Group> groups_;
};

}  // namespace conelight

// SPDX-License-Identifier: MIT
// One row of the table of settings: where the value lives in its struct, which values it takes, unit and
// help. A group of settings is a struct and a vector of rows; the registry (settings/registry.h) joins the
// groups.
//
//     {"size", &VoxelSettings::size, Numbers{8, 512, 4}, "voxels", "voxels along the longest axis"}
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "conelight/settings.h"

namespace conelight::settings {

// The numbers that a setting takes (SettingInfo has the same fields).
struct Numbers {
    double low = 0, high = 0;
    int step = 1;
    bool zeroToo = false;
    bool squares = false;
    std::optional<int> word = {};  // of std::optional<int>: this number is read as the word `all`
};

template <class E>
struct Choice {
    const char* name;
    E value;
};

// Where a value lives in a struct.
template <class Owner, class T>
struct Place {
    std::function<const T&(const Owner&)> get;
    std::function<T&(Owner&)> edit;
};

// One of several words.
template <class Owner>
struct Chosen {
    std::function<std::string(const Owner&)> name;          // of a value that is no choice: "value 7"
    std::function<void(Owner&, std::size_t index)> choose;  // one of SettingInfo::choices
};

template <class Owner>
using Field = std::variant<Place<Owner, bool>, Place<Owner, int>, Place<Owner, std::optional<int>>,
                           Place<Owner, float>, Place<Owner, AutoFloat>, Chosen<Owner>>;

// `where`: a pointer to a member, or a function from the struct to a reference into it.
template <class Owner, class Where>
auto placeOf(Where where) {
    using T = std::remove_cvref_t<std::invoke_result_t<Where, Owner&>>;
    return Place<Owner, T>{
        [where](const Owner& owner) -> const T& { return std::invoke(where, owner); },
        [where](Owner& owner) -> T& { return std::invoke(where, owner); },
    };
}

// A member of a member.
template <class A, class B, class T>
auto within(B A::*outer, T B::*inner) {
    return [ outer, inner ](auto& owner) -> auto& { return owner.*outer.*inner; };
}

template <class Owner>
struct Setting {
    SettingInfo info;  // without the default; the key without the group's prefix
    Field<Owner> field;
    std::optional<int> wordNumber;

    template <class Where>
    Setting(const char* key, Where where, const char* help) : field(placeOf<Owner>(where)) {
        info.key = key;
        info.choices = {"true", "false"};
        info.help = help;
    }

    template <class Where>
    Setting(const char* key, Where where, const Numbers& numbers, const char* unit, const char* help)
        : field(placeOf<Owner>(where)), wordNumber(numbers.word) {
        using T = std::remove_cvref_t<std::invoke_result_t<Where, Owner&>>;
        constexpr bool isFloat = std::is_same_v<T, float> || std::is_same_v<T, AutoFloat>;
        info.key = key;
        info.kind = isFloat ? SettingKind::Float : SettingKind::Int;
        info.low = numbers.low;
        info.high = numbers.high;
        info.step = numbers.step;
        info.zeroToo = numbers.zeroToo;
        info.squares = numbers.squares;
        if (std::is_same_v<T, AutoFloat>) info.word = "auto";
        if (std::is_same_v<T, std::optional<int>>) info.word = "all";
        info.unit = unit;
        info.help = help;
    }

    template <class Where, class E, std::size_t N>
    Setting(const char* key, Where where, const Choice<E> (&choices)[N], const char* help) {
        const std::vector<Choice<E>> all(choices, choices + N);
        const Place<Owner, E> place = placeOf<Owner>(where);
        field = Chosen<Owner>{
            [all, place](const Owner& owner) {
                for (const Choice<E>& one : all)
                    if (one.value == place.get(owner)) return std::string(one.name);
                return "value " + std::to_string(static_cast<int>(place.get(owner)));
            },
            [all, place](Owner& owner, std::size_t index) { place.edit(owner) = all[index].value; },
        };
        info.key = key;
        info.kind = SettingKind::Choice;
        for (const Choice<E>& one : all) info.choices.emplace_back(one.name);
        info.help = help;
    }

    Setting(SettingInfo what, Field<Owner> at, std::optional<int> word)
        : info(std::move(what)), field(std::move(at)), wordNumber(word) {}
};

// A row of a group as a row of what holds the group.
template <class Outer, class Group>
Setting<Outer> within(const std::string& prefix, const Place<Outer, Group>& group,
                      const Setting<Group>& row) {
    SettingInfo info = row.info;
    info.key = prefix + info.key;
    Field<Outer> field = std::visit(
        [&group](const auto& inner) -> Field<Outer> {
            using Inner = std::decay_t<decltype(inner)>;
            if constexpr (std::is_same_v<Inner, Chosen<Group>>) {
                return Chosen<Outer>{
                    [group, inner](const Outer& outer) { return inner.name(group.get(outer)); },
                    [group, inner](Outer& outer, std::size_t i) { inner.choose(group.edit(outer), i); }};
            } else {
                return placeOf<Outer>([ group, inner ](auto& outer) -> auto& {
                    if constexpr (std::is_const_v<std::remove_reference_t<decltype(outer)>>)
                        return inner.get(group.get(outer));
                    else
                        return inner.edit(group.edit(outer));
                });
            }
        },
        row.field);
    return {std::move(info), std::move(field), row.wordNumber};
}

// Text of a value, and back. Setting throws Error(Usage) that says what would be right.
std::string textOf(const Setting<Settings>& setting, const Settings& settings);
void setFromText(const Setting<Settings>& setting, Settings& settings, const std::string& text);
// Throws Error(Usage) for a value out of range.
void check(const Setting<Settings>& setting, const Settings& settings);

}  // namespace conelight::settings

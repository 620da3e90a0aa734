// SPDX-License-Identifier: MIT
// What all calls of conelight.h share: exceptions become results and a message of the thread, pointers and structs of
// the caller are checked before they are read.
#pragma once

#include <algorithm>
#include <cstring>
#include <glm/glm.hpp>
#include <string>

#include "conelight.h"
#include "conelight/error.h"

namespace conelight::c {

// Result of the exception that is being handled; keeps its message for conelight_message().
conelight_result resultOfException() noexcept;

// Runs a call's work; nothing that it throws leaves.
template <class Work>
conelight_result guarded(Work&& work) noexcept {
    try {
        work();
        return CONELIGHT_OK;
    } catch (...) {
        return resultOfException();
    }
}

[[noreturn]] void failUsage(const std::string& message);

// What the pointer points to; `what` is the argument's name.
template <class T>
T& need(T* pointer, const char* what) {
    if (pointer == nullptr) failUsage(std::string(what) + ": is NULL; a valid pointer would be right");
    return *pointer;
}

// A struct of the caller; one of a later version has more fields, which are not looked at. Whoever adds a field here starts
// from the INIT values and takes the first `size` bytes, so that the structs of this version are still taken.
template <class Struct>
const Struct& readStruct(const Struct* given, const char* what) {
    const std::size_t size = need(given, what).size;
    if (size < sizeof(Struct))
        failUsage(std::string(what) + ": size " + std::to_string(size) + "; " +
                  std::to_string(sizeof(Struct)) + ", what the INIT macro sets, would be right");
    return *given;
}

// Writes what the caller's version of the struct has room for.
template <class Struct>
void writeStruct(Struct* given, Struct values, const char* what) {
    values.size = readStruct(given, what).size;
    std::memcpy(static_cast<void*>(given), &values, sizeof values);
}

// An element of a list; `what` is the list's name for messages.
template <class List>
const typename List::value_type& elementOf(const List& list, std::size_t index, const char* what) {
    if (index >= list.size())
        failUsage(std::string(what) + ": " + std::to_string(index) + " of " + std::to_string(list.size()) +
                  "; an index below that would be right");
    return list[index];
}

inline std::string textOf(const char* text) { return text != nullptr ? text : ""; }
inline glm::vec3 vec3Of(const float* v) { return {v[0], v[1], v[2]}; }
inline void put(float* to, const glm::vec3& v) { std::copy_n(&v.x, 3, to); }

}  // namespace conelight::c

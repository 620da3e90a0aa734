// SPDX-License-Identifier: MIT
// Things of the scene by name. Names may repeat: then all that have it are meant, as in the thesis's program.
// Where nothing has a name, a number counts from 0. "NAME/" means all that is in a group.
#pragma once

#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "session/session.h"

namespace conelight::program {

std::vector<std::string> objectNames(const Session& session);  // each once, in the scene's order; then groups
bool isGroupName(const std::string& word);
std::vector<std::string> materialNames(const Session& session);
std::vector<std::string> lightNames(const Session& session);
std::vector<std::string> cameraNames(const Session& session);

// Indices; empty when there is none.
std::vector<std::size_t> objectsNamed(const Session& session, const std::string& word);
std::vector<std::size_t> materialsNamed(const Session& session, const std::string& word);
std::vector<std::size_t> lightsNamed(const Session& session, const std::string& word);
std::vector<std::size_t> camerasNamed(const Session& session, const std::string& word);

// What stands on disk and begins so: names behind what is given of their folder, folders with a slash.
std::vector<std::string> filesFor(const std::string& partial);

// Throws Error(Usage): "COMMAND: there is no THING 'WORD'; NEAREST would be right" unless it is a name or a
// number below the count.
void requireName(const std::string& command, const std::string& thing, const std::vector<std::string>& names,
                 const std::string& word);

std::string textOf(const glm::vec3& v);  // three numbers, six digits

}  // namespace conelight::program

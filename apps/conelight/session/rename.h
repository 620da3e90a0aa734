// SPDX-License-Identifier: MIT
// Names of objects, lights and materials: given anew, and found where a copy needs one.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "session/session.h"

namespace conelight::program {

const std::string& nameOf(const Session& session, const Selection& what);  // may be empty
// One step of undo.
void renameAll(Session& session, const std::vector<Selection>& things, const std::string& name);

// Names that are free among others: "chair" -> "chair 2", or the first number that is free.
class FreeNames {
  public:
    explicit FreeNames(const std::vector<std::string>& taken) : taken_(taken.begin(), taken.end()) {}
    std::string take(const std::string& name);     // with a number
    std::string takeOwn(const std::string& name);  // without one if it is free

  private:
    std::set<std::string> taken_;
};

}  // namespace conelight::program

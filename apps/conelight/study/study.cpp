// SPDX-License-Identifier: MIT
#include "study/study.h"

#include "command.h"

namespace conelight::program {

void addStudy(CLI::App& app) {
    CLI::App* study = app.add_subcommand("study", "searches that answer a question by measurement");
    study->require_subcommand(1);
    addStudyCones(*study);
}

}  // namespace conelight::program

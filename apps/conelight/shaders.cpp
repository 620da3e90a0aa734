// SPDX-License-Identifier: MIT
// `conelight shaders --expand DIR`: every shader entry x variant as one text each, for glslangValidator.
#include <fmt/core.h>

#include "command.h"
#include "conelight/shaders.h"

namespace conelight::program {

void addShaders(CLI::App& app) {
    auto directory = std::make_shared<std::string>();
    CLI::App* command =
        app.add_subcommand("shaders", "write every shader variant as expanded text (for checks)");
    command->add_option("--expand", *directory, "folder to write to")->required()->type_name("DIR");
    command->callback([directory] { fmt::print("{} files\n", expandAllShaders(*directory)); });
}

}  // namespace conelight::program

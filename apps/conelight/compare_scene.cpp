// SPDX-License-Identifier: MIT
#include "compare_scene.h"

#include "conelight/error.h"

namespace conelight::program {

void CompareSceneOptions::addTo(CLI::App& command) {
    const std::size_t before = command.get_options().size();
    command.add_option("--modes", modes, "the modes to measure, comma-separated")
        ->capture_default_str()
        ->type_name("A,B");
    command.add_option("--against", against, "the mode that counts as the truth")
        ->capture_default_str()
        ->type_name("MODE");
    view.addTo(command);
    const std::vector<CLI::Option*> all = command.get_options();
    for (std::size_t i = before; i < all.size(); ++i) all[i]->group("One scene");
}

void compareScene(const CompareSceneOptions& options) {
    throw Error(ErrorKind::Usage,
                options.scene + ": the modes of a scene cannot be compared yet; two pictures would be right");
}

}  // namespace conelight::program

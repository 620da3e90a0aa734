// SPDX-License-Identifier: MIT
// `conelight convert IN OUT`: a scene of any format that is read, in one that is written.
#include <fmt/core.h>

#include "command.h"
#include "io/scene_file.h"
#include "io/scene_write.h"

namespace conelight::program {

void addConvert(CLI::App& app) {
    struct Options {
        std::string in, out;
        bool force = false;
        io::LoadOptions load;
    };
    auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand("convert", "write a scene in another format");
    command->add_option("in", options->in, "a scene file, or builtin:NAME")->required();
    std::string known;
    for (const std::string& extension : io::writtenSceneExtensions()) known += " " + extension;
    command->add_option("out", options->out, "what to write:" + known)->required();
    command->add_flag("--overwrite,--force", options->force, "write over files that are there");
    addAllowOutside(*command, options->load.allowOutside);
    addUpAxis(*command, options->load.up);
    command->callback([options] {
        Progress progress;
        progress.show("loading " + options->in);
        const Scene scene = io::loadScene(options->in, options->load);
        for (const std::string& note : scene.notes)
            std::fprintf(stderr, "conelight: %s: %s\n", options->in.c_str(), note.c_str());
        progress.show("writing " + options->out);
        const std::vector<std::string> notes = io::writeScene(options->out, scene, options->force);
        progress.finish();
        for (const std::string& note : notes)
            std::fprintf(stderr, "conelight: %s: %s\n", options->out.c_str(), note.c_str());
    });
}

}  // namespace conelight::program

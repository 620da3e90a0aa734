// SPDX-License-Identifier: MIT
// `conelight figures`: the figures and tables of the thesis, drawn by this project.
#include <fmt/core.h>

#include <algorithm>
#include <cctype>

#include "command.h"
#include "conelight/error.h"
#include "figures/gallery.h"
#include "figures/studio.h"
#include "memory_limit.h"

namespace conelight::program {
namespace {

using figures::Figure;
using figures::Kind;

struct FigureOptions {
    std::string only;
    std::string directory;
    std::string size = "512x512";
    bool small = false, list = false, markdown = false;
    int device = -1;
};

// "F2", "f02", "F02" are one figure.
std::string normalised(std::string word) {
    for (char& c : word) c = char(std::toupper(static_cast<unsigned char>(c)));
    if (word.size() == 2 && (word[0] == 'F' || word[0] == 'B')) word.insert(1, "0");
    return word;
}

std::vector<const Figure*> chosen(const std::string& only) {
    std::vector<const Figure*> all;
    if (only.empty()) {
        for (const Figure& figure : figures::allFigures()) all.push_back(&figure);
        return all;
    }
    const std::vector<std::string> words = splitList(only);
    const auto fits = [](const Figure& figure, const std::string& word) {
        return figure.id == normalised(word) || nameOf(figure.kind) == word;
    };
    const std::span<const Figure> every = figures::allFigures();
    for (const std::string& word : words)
        if (std::none_of(every.begin(), every.end(), [&](const Figure& f) { return fits(f, word); }))
            usage(fmt::format(
                "--only: there is no figure '{}'; F01 to F50, T1, T2, B01, B02, or drawing, plot, render, "
                "series, table would be right",
                word));
    for (const Figure& figure : every)
        if (std::any_of(words.begin(), words.end(), [&](const std::string& w) { return fits(figure, w); }))
            all.push_back(&figure);
    return all;
}

void printList(const std::vector<const Figure*>& figures) {
    for (const Figure* figure : figures)
        fmt::print("{:<4} {:<8} {}\n", figure->id, nameOf(figure->kind), figure->title);
}

void run(const FigureOptions& options) {
    const std::vector<const Figure*> wanted = chosen(options.only);
    if (options.markdown) return fmt::print("{}", figures::galleryMarkdown());
    if (options.list) return printList(wanted);
    if (options.directory.empty()) usage("--output is required; -o figures, for example, would be right");
    const Size size = options.small ? Size{96, 72} : parseSize(options.size);
    ViewOptions view;
    view.device = options.device;
    Progress progress;
    figures::Gallery gallery(options.directory);
    figures::Studio studio(size, options.small, view, progress);
    for (const Figure* figure : wanted) {
        progress.show(fmt::format("{} {}", figure->id, figure->title));
        try {
            gallery.add(*figure, figure->draw(studio));
        } catch (const Error& error) {
            throw Error(error.kind(), fmt::format("figure {}: {}", figure->id, error.what()));
        }
        progress.finish();
        for (const std::string& file : gallery.lastFiles()) fmt::print("{:<10} {}\n", file, figure->title);
    }
}

}  // namespace

void addFigures(CLI::App& app) {
    auto options = std::make_shared<FigureOptions>();
    CLI::App* command = app.add_subcommand("figures", "redraw the figures and tables of the thesis");
    command
        ->add_option("--only", options->only,
                     "figures by name, or kinds: drawing, plot, render, series, table")
        ->type_name("F38,T1");
    command
        ->add_option("-o,--output", options->directory,
                     "folder for the figures, a page of them (index.html) and a list (figures.json)")
        ->type_name("DIR");
    CLI::Option* size = command->add_option("--size", options->size, "size of rendered pictures")
                            ->capture_default_str()
                            ->type_name("WxH");
    command
        ->add_flag("--small", options->small,
                   "rendered pictures of 96x72 with few voxels and samples, tables of few frames: a trial")
        ->excludes(size);
    command->add_flag("--list", options->list, "name the figures");
    command->add_flag("--markdown", options->markdown, "the gallery as a page of the documentation");
    command->add_option("--device", options->device, "EGL device (`conelight info` lists them)")
        ->type_name("N")
        ->check(CLI::NonNegativeNumber);
    addMemory(*command);
    command->callback([options] { run(*options); });
}

}  // namespace conelight::program

// SPDX-License-Identifier: MIT
// The program `conelight`: names the sub-commands (one file each) and turns failures into one line and an
// exit status: 0 done, 1 failed while running, 2 wrong usage, 3 bad input, 4 no usable OpenGL, 130
// interrupted.
#include <CLI/CLI.hpp>

#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>
#include <string>
#include <vector>

#include "command.h"
#include "command_line.h"
#include "conelight/error.h"
#include "conelight/memory.h"
#include "conelight/version.h"
#include "guests.h"
#include "platform/headless_context.h"
#include "script_run.h"
#include "shell_words.h"
#include "usage_text.h"

namespace {

int exitStatus(conelight::ErrorKind kind) {
    switch (kind) {
        case conelight::ErrorKind::Runtime:
            return 1;
        case conelight::ErrorKind::Usage:
            return 2;
        case conelight::ErrorKind::BadInput:
            return 3;
        case conelight::ErrorKind::NoGl:
            return 4;
    }
    return 1;
}

void printMessage(conelight::LogLevel level, std::string_view message) {
    if (level == conelight::LogLevel::Warning || level == conelight::LogLevel::Error)
        std::fprintf(stderr, "conelight: %.*s\n", static_cast<int>(message.size()), message.data());
}

constexpr char kOutOfMemory[] =
    "conelight: out of memory; a smaller scene, picture or voxel size would be right\n";

void sayOutOfMemory() {
    if (const std::size_t limit = conelight::memoryLimit(); limit > 0)
        std::fprintf(
            stderr,
            "conelight: out of memory: --memory is %zu MB; more, or a smaller scene or picture, would be "
            "right\n",
            limit >> 20);
    else
        std::fputs(kOutOfMemory, stderr);
}

// An exception that nobody caught: of a thread, of a destructor. Memory can end anywhere, so that is said
// without asking for more of it; anything else is a fault of ours and leaves its trace.
[[noreturn]] void onTerminate() {
    try {
        if (const std::exception_ptr last = std::current_exception()) std::rethrow_exception(last);
    } catch (const std::bad_alloc&) {
        [[maybe_unused]] const ssize_t ignored =
            ::write(STDERR_FILENO, kOutOfMemory, sizeof kOutOfMemory - 1);
        std::_Exit(1);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "conelight: internal error: %s\n", error.what());
    } catch (...) {
    }
    std::abort();
}

}  // namespace

int main(int argc, char** argv) {
    std::set_terminate(onTerminate);
    // A file that grows beyond the system's limit (ulimit -f) is then a failed write, which is said.
    std::signal(SIGXFSZ, SIG_IGN);
    conelight::platform::tuneAllocator();
    conelight::setLogCallback(printMessage);
    conelight::program::installInterruptHandler();
    conelight::program::keepCommandLine(argc, argv);
    conelight::program::registerGuests();

    CLI::App app("Conelight: real-time global illumination by tracing voxels, measured against ground truth.",
                 "conelight");
    app.set_version_flag("--version", std::string("conelight ") + CONELIGHT_VERSION_STRING);
    app.require_subcommand(1);
    app.get_formatter()->column_width(36);
    conelight::program::addView(app);
    conelight::program::addRender(app);
    conelight::program::addCompare(app);
    conelight::program::addBench(app);
    conelight::program::addScore(app);
    conelight::program::addBake(app);
    conelight::program::addBatch(app);
    conelight::program::addStudy(app);
    conelight::program::addFigures(app);
    conelight::program::addInfo(app);
    conelight::program::addInspect(app);
    conelight::program::addThumbnail(app);
    conelight::program::addSettings(app);
    conelight::program::addCommands(app);
    conelight::program::addConvert(app);
    conelight::program::addShaders(app);
    conelight::program::addCompletion(app);
    conelight::program::addManual(app);

    const std::vector<std::string> words =
        conelight::program::withCommand(app, std::vector<std::string>(argv + 1, argv + argc));
    try {
        app.parse(std::vector<std::string>(words.rbegin(), words.rend()));  // CLI11 takes them from the end
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success))
            return app.exit(error);  // --help, --version
        const std::string text = conelight::program::usageText(app, error, words);
        std::fprintf(stderr, "conelight: %s\n", text.c_str());
        return 2;
    } catch (const conelight::program::QuitRequest& quit) {
        return quit.status;
    } catch (const conelight::program::InterruptedError&) {
        return 130;
    } catch (const conelight::Error& error) {
        std::fprintf(stderr, "conelight: %s\n", error.what());
        return exitStatus(error.kind());
    } catch (const std::bad_alloc&) {
        sayOutOfMemory();
        return 1;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "conelight: %s\n", error.what());
        return 1;
    }
    return 0;
}

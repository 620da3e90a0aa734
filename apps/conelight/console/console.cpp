// SPDX-License-Identifier: MIT
#include "console/console.h"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "io/files.h"

namespace conelight::program {
namespace {

constexpr int kDeepestScript = 16;

std::string countText(const Command& command) {
    const std::size_t few = command.fewestWords();
    const std::size_t many = command.arguments.size();
    const bool open = many > 0 && command.arguments.back().repeated;
    if (many == 0) return "no arguments";
    if (open)
        return fmt::format("at least {} argument{}", std::max<std::size_t>(few, 1), few == 1 ? "" : "s");
    if (few == many) return fmt::format("{} argument{}", few, few == 1 ? "" : "s");
    return fmt::format("{} to {} arguments", few, many);
}

// The command that the words mean; throws what is wrong with them.
const Command& resolve(const std::vector<std::string>& words) {
    const std::vector<const Command*> named = commandsNamed(words.front());
    if (named.empty()) {
        const std::string near = nearest(words.front(), commandWords());
        throw Error(ErrorKind::Usage,
                    fmt::format("unknown command '{}'; {}", words.front(),
                                near.empty() ? "`help` lists all" : near + " would be right"));
    }
    for (const Command* command : named)
        if (command->takes(words.size() - 1)) return *command;
    std::string usages;
    for (const Command* command : named) usages += (usages.empty() ? "" : ", or ") + command->usage();
    throw Error(ErrorKind::Usage, fmt::format("{}: takes {}, got {}; {} would be right", words.front(),
                                              countText(*named.front()), words.size() - 1, usages));
}

}  // namespace

Console::Console(Session& session, ConsoleOutput output) : session_(session), output_(std::move(output)) {}

void Console::submit(const std::string& text, const std::string& origin) {
    if (origin.empty()) history_.add(text);
    for (Statement& statement : parseStatements(text)) queue_.push_back({std::move(statement), origin, 0});
}

void Console::submitWidget(const std::string& text) {
    history_.add(text);
    for (Statement& statement : parseStatements(text)) ofWidgets_.push_back({std::move(statement), {}, 0});
}

void Console::runWidgets() {
    for (const Queued& queued : std::exchange(ofWidgets_, {})) run(queued);
}

void Console::source(const std::string& file) {
    const int depth = current_.depth + 1;
    if (depth > kDeepestScript)
        throw Error(ErrorKind::Usage, fmt::format("source {}: scripts call each other more than {} deep",
                                                  file, kDeepestScript));
    const io::Bytes bytes = io::readFile(file, std::uint64_t(16) << 20);  // 16 MB: no script is longer
    std::vector<Statement> statements =
        parseStatements({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    for (auto statement = statements.rbegin(); statement != statements.rend(); ++statement)
        queue_.push_front({std::move(*statement), file, depth});
}

bool Console::runQueued() {
    bool any = false;
    while (!queue_.empty() && waitFrames_ == 0 && !session_.hasRequests() && !session_.playing()) {
        current_ = std::move(queue_.front());
        queue_.pop_front();
        run(current_);
        any = true;
    }
    return any;
}

void Console::run(const Queued& queued) {
    const bool sealed = session_.sealed();
    const std::uint64_t steps = session_.stepsTaken();
    try {
        if (!queued.statement.error.empty()) throw Error(ErrorKind::Usage, queued.statement.error);
        const Command& command = resolve(queued.statement.words);
        const std::vector<std::string> words(queued.statement.words.begin() + 1,
                                             queued.statement.words.end());
        for (std::size_t i = 0; i < words.size(); ++i)
            checkArgument(session_, command, command.arguments[std::min(i, command.arguments.size() - 1)],
                          words[i]);
        session_.seal();
        keepLitMode();
        command.run({session_, *this, words});
    } catch (const Error& error) {
        report(error, queued);
    }
    // What only asks, and what fails, ends no step of undo: a hand may be dragging.
    if (session_.stepsTaken() == steps) session_.seal(sealed);
}

void Console::report(const Error& error, const Queued& queued) {
    std::string text = error.what();
    if (!queued.origin.empty()) text = fmt::format("{}:{}: {}", queued.origin, queued.statement.line, text);
    if (!firstError_) firstError_ = Error(error.kind(), text);
    if (stopOnError_) queue_.clear();
    output_({true, text});
}

void Console::keepLitMode() {
    if (session_.mode() != "phong") litMode_ = session_.mode();
}

void Console::fail(const Error& error) { report(error, current_); }

void Console::frameDone() {
    if (waitFrames_ > 0) --waitFrames_;
}

void Console::print(const std::string& line) { output_({false, line}); }

}  // namespace conelight::program

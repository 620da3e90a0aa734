// SPDX-License-Identifier: MIT
// What may stand at the cursor: commands, then what the command's next argument can be.
#include <algorithm>
#include <filesystem>

#include "console/console.h"
#include "console/names.h"
#include "io/generated.h"

namespace conelight::program {
namespace {

// The words before the cursor of the command it stands in, and where the word under the cursor begins.
struct Place {
    std::vector<std::string> before;
    std::string partial;
    std::size_t begin = 0;
};

Place placeAt(const std::string& text, std::size_t cursor) {
    Place place;
    std::size_t start = 0;
    char mark = 0;
    bool inWord = false;
    std::string word;
    for (std::size_t i = 0; i < cursor; ++i) {
        const char c = text[i];
        if (mark != 0) {
            if (c == mark)
                mark = 0;
            else
                word += c;
        } else if (c == '"' || c == '\'') {
            if (!inWord) start = i;
            inWord = true;
            mark = c;
        } else if (c == ' ' || c == '\t' || c == ';' || c == '\n') {
            if (inWord) place.before.push_back(word);
            if (c == ';' || c == '\n') place.before.clear();
            inWord = false;
            word.clear();
        } else {
            if (!inWord) start = i;
            inWord = true;
            word += c;
        }
    }
    place.partial = word;
    place.begin = inWord ? start : cursor;
    return place;
}

std::vector<std::string> valuesOfSetting(const std::string& key) {
    const SettingInfo* info = findSetting(key);
    if (info == nullptr) return {};
    if (!info->isNumber()) return info->choices;
    return {info->word.empty() ? info->defaultValue : info->word};
}

std::vector<std::string> candidatesFor(const Session& session, const Place& place) {
    if (place.before.empty()) return commandWords();
    std::vector<std::string> all;
    const std::size_t index = place.before.size() - 1;
    for (const Command* command : commandsNamed(place.before.front())) {
        if (command->arguments.empty()) continue;
        if (index >= command->arguments.size() && !command->arguments.back().repeated) continue;
        const Argument& argument = command->arguments[std::min(index, command->arguments.size() - 1)];
        std::vector<std::string> words = wordsOf(session, argument);
        if (argument.kind == ArgumentKind::SettingValue && index >= 1)
            words = place.before[index] == "mode" ? sessionModes() : valuesOfSetting(place.before[index]);
        if (argument.kind == ArgumentKind::Text) words = argument.choices;
        if (argument.kind == ArgumentKind::Camera) {
            for (const char* word : {"list", "eye", "target", "up", "fov", "lens", "focus", "orthographic",
                                     "orbit", "frame", "add"})
                words.push_back(word);
        }
        if (argument.kind == ArgumentKind::Light) words.push_back("add");
        if (argument.kind == ArgumentKind::Material) {
            const std::vector<std::string> objects = objectNames(session);
            words.insert(words.end(), objects.begin(), objects.end());
        }
        if (argument.kind == ArgumentKind::File || argument.kind == ArgumentKind::SceneFile)
            words = filesFor(place.partial);
        if (argument.kind == ArgumentKind::SceneFile)
            for (const io::GeneratedSceneInfo& scene : io::generatedScenes())
                words.push_back("builtin:" + std::string(scene.name));
        all.insert(all.end(), words.begin(), words.end());
    }
    return all;
}

std::string commonStart(const std::vector<std::string>& words) {
    if (words.empty()) return {};
    std::string common = words.front();
    for (const std::string& word : words) {
        std::size_t same = 0;
        while (same < common.size() && same < word.size() && common[same] == word[same]) ++same;
        common.resize(same);
    }
    return common;
}

}  // namespace

std::vector<std::string> filesFor(const std::string& partial) {
    namespace fs = std::filesystem;
    const std::size_t slash = partial.rfind('/');
    const std::string folder = slash == std::string::npos ? "" : partial.substr(0, slash + 1);
    std::vector<std::string> names;
    std::error_code code;
    for (fs::directory_iterator entry(folder.empty() ? "." : folder, code), end; !code && entry != end;
         entry.increment(code)) {
        const std::string name = entry->path().filename().string();
        // Hidden ones only when asked for by their dot.
        if (name.front() == '.' && partial.compare(folder.size(), 1, ".") != 0) continue;
        std::error_code ignored;
        names.push_back(folder + name + (entry->is_directory(ignored) ? "/" : ""));
    }
    std::sort(names.begin(), names.end());
    return names;
}

Completion Console::complete(const std::string& text, std::size_t cursor) const {
    cursor = std::min(cursor, text.size());
    const Place place = placeAt(text, cursor);
    Completion completion{place.begin, cursor, {}, {}};
    for (const std::string& word : candidatesFor(session_, place)) {
        if (word.compare(0, place.partial.size(), place.partial) != 0) continue;
        const std::string shown = quoted(word);
        const auto& known = completion.candidates;
        if (std::find(known.begin(), known.end(), shown) == known.end())
            completion.candidates.push_back(shown);
    }
    completion.common = commonStart(completion.candidates);
    return completion;
}

}  // namespace conelight::program

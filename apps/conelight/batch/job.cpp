// SPDX-License-Identifier: MIT
#include "batch/job.h"

#include <fmt/core.h>
#include <glob.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "conelight/error.h"
#include "io/files.h"
#include "io/image_file.h"
#include "io/json_file.h"

namespace conelight::program {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr std::size_t kMostTasks = 1000000;

// A value of a task: an option of `render`, "set.KEY", or "scene.NAME", a parameter of generated scenes.
struct Choice {
    std::string key, value;
};

struct Axis {
    std::string key;
    std::vector<std::string> values;
};

struct Frames {
    std::vector<std::string> words;  // --path FILE, --turntable, or --animate CLIP
    int first = 0, count = 0, chunk = 1;
    bool isClip = false;
};

bool isGenerated(const std::string& scene) { return scene.rfind("builtin:", 0) == 0; }

// What of a value can stand in a file's name.
std::string nameOf(std::string text) {
    for (char& c : text) {
        const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
        if (!plain && c != '.' && c != '-' && c != '_' && c != '+') c = '_';
    }
    while (!text.empty() && text.front() == '.') text.erase(0, 1);
    return text;
}

class Reader {
  public:
    Reader(const std::string& file, const std::vector<BatchOption>& options)
        : file_(file), path_(file), folder_(fs::path(file).parent_path()), options_(options) {}

    BatchJob read();

  private:
    [[noreturn]] void fail(const std::string& pointer, const std::string& message) const {
        file_.fail(pointer, message);
    }
    void checkFields(const Json& object, const std::string& pointer,
                     const std::vector<std::string>& known) const;
    std::string text(const Json& value, const std::string& pointer) const;
    int whole(const Json& object, const std::string& pointer, const std::string& key, int least,
              int otherwise) const;
    const BatchOption& option(const std::string& name, const std::string& pointer) const;
    void checkKey(const std::string& key, const std::string& pointer) const;
    std::string resolved(const std::string& name) const;

    std::vector<std::string> scenes() const;
    void addGlob(const std::string& pattern, const std::string& pointer,
                 std::vector<std::string>& found) const;
    std::vector<Choice> fixedOptions() const;
    std::vector<Axis> sweep() const;
    std::vector<std::string> rangeOf(const Json& range, const std::string& pointer) const;
    Frames frames() const;
    std::string outputPattern(const std::vector<Axis>& axes, const Frames& frames, bool severalScenes) const;
    std::string filled(const std::string& pattern, const std::string& scene,
                       const std::vector<Choice>& choices) const;
    void addTask(const std::string& scene, const std::vector<Choice>& choices, const std::string& output,
                 const Frames& frames, int frame, BatchJob& job) const;

    io::JsonFile file_;
    std::string path_;
    fs::path folder_;
    const std::vector<BatchOption>& options_;
};

void Reader::checkFields(const Json& object, const std::string& pointer,
                         const std::vector<std::string>& known) const {
    for (const auto& [field, value] : object.items())
        if (std::find(known.begin(), known.end(), field) == known.end()) {
            std::string all;
            for (const std::string& name : known) all += (all.empty() ? "" : ", ") + name;
            fail(pointer + "/" + field, fmt::format("there is no field '{}'; one of {} would be right",
                                                    io::oneLine(field, 40), all));
        }
}

std::string Reader::text(const Json& value, const std::string& pointer) const {
    std::string text;
    if (value.is_string())
        text = value.get<std::string>();
    else if (value.is_number() || value.is_boolean())
        text = value.dump();
    else
        fail(pointer, "is no value; a number, a text, true or false would be right");
    if (text.find_first_of(std::string("\0\n\r", 3)) != std::string::npos)
        fail(pointer, "holds a line end or a zero; a text of one line would be right");
    return text;
}

int Reader::whole(const Json& object, const std::string& pointer, const std::string& key, int least,
                  int otherwise) const {
    if (!object.contains(key)) return otherwise;
    const Json& value = object[key];
    if (!value.is_number_integer() || value < least || value > 100000)
        fail(pointer + "/" + key,
             fmt::format("{}: a whole number from {} to 100000 would be right", key, least));
    return value.get<int>();
}

const BatchOption& Reader::option(const std::string& name, const std::string& pointer) const {
    for (const BatchOption& one : options_)
        if (one.name == name) return one;
    fail(pointer, fmt::format("there is no option '{}' here; one of `conelight render --help` that neither "
                              "names outputs nor films, without its dashes, would be right",
                              io::oneLine(name, 40)));
}

void Reader::checkKey(const std::string& key, const std::string& pointer) const {
    for (const char* prefix : {"set.", "scene."})
        if (key.rfind(prefix, 0) == 0 && key.size() > std::string(prefix).size()) return;
    option(key, pointer);
}

// A file's name as seen from here.
std::string Reader::resolved(const std::string& name) const {
    if (isGenerated(name) || name == "none" || fs::path(name).is_absolute()) return name;
    return (folder_ / name).lexically_normal().string();
}

void Reader::addGlob(const std::string& pattern, const std::string& pointer,
                     std::vector<std::string>& found) const {
    glob_t matches = {};
    const int status = ::glob(resolved(pattern).c_str(), 0, nullptr, &matches);  // sorted
    for (std::size_t i = 0; status == 0 && i < matches.gl_pathc; ++i) found.emplace_back(matches.gl_pathv[i]);
    ::globfree(&matches);
    if (status != 0) fail(pointer, fmt::format("no file is named like '{}'", io::oneLine(pattern)));
}

std::vector<std::string> Reader::scenes() const {
    const Json& list = file_.root().contains("scenes") ? file_.root()["scenes"] : Json();
    if (!list.is_array() || list.empty())
        fail("/scenes", "scenes: a list of scene files, or builtin:NAME, would be right");
    std::vector<std::string> found;
    for (std::size_t i = 0; i < list.size(); ++i) {
        const std::string pointer = fmt::format("/scenes/{}", i);
        if (!list[i].is_string()) fail(pointer, "a scene is named by a text");
        const std::string name = text(list[i], pointer);
        const bool generated = isGenerated(name);
        if (!generated && name.find_first_of("*?[") != std::string::npos)
            addGlob(name, pointer, found);
        else
            found.push_back(resolved(name));
        if (!generated && !fs::exists(found.back()))
            fail(pointer, io::oneLine(found.back()) + ": no such file");
    }
    return found;
}

std::vector<Choice> Reader::fixedOptions() const {
    std::vector<Choice> choices;
    if (!file_.root().contains("options")) return choices;
    const Json& object = file_.root()["options"];
    if (!object.is_object()) fail("/options", "options: {\"NAME\": VALUE, ...} would be right");
    for (const auto& [key, value] : object.items()) {
        const std::string pointer = "/options/" + key;
        if (key == "set" && value.is_object()) {
            for (const auto& [setting, one] : value.items())
                choices.push_back({"set." + setting, text(one, pointer + "/" + setting)});
            continue;
        }
        checkKey(key, pointer);
        choices.push_back({key, text(value, pointer)});
    }
    return choices;
}

std::vector<std::string> Reader::rangeOf(const Json& range, const std::string& pointer) const {
    checkFields(range, pointer, {"from", "to", "step"});
    const auto number = [&](const char* key, long long otherwise, bool needed) -> long long {
        if (!range.contains(key) && !needed) return otherwise;
        if (!range.contains(key) || !range[key].is_number_integer())
            fail(pointer, fmt::format("{}: a whole number would be right", key));
        return range[key].get<long long>();
    };
    const long long from = number("from", 0, true), to = number("to", 0, true),
                    step = number("step", 1, false);
    constexpr long long kFar = 1000000000;
    if (step < 1 || from < -kFar || to > kFar || to < from || (to - from) / step >= (long long)kMostTasks)
        fail(pointer, "from below to, and a step of at least 1, would be right");
    std::vector<std::string> values;
    for (long long value = from; value <= to; value += step) values.push_back(std::to_string(value));
    return values;
}

std::vector<Axis> Reader::sweep() const {
    std::vector<Axis> axes;
    if (!file_.root().contains("sweep")) return axes;
    const Json& object = file_.root()["sweep"];
    if (!object.is_object()) fail("/sweep", "sweep: {\"NAME\": [VALUE, ...], ...} would be right");
    for (const auto& [key, list] : object.items()) {
        const std::string pointer = "/sweep/" + key;
        checkKey(key, pointer);
        Axis axis{key, {}};
        if (list.is_object()) axis.values = rangeOf(list, pointer);
        for (std::size_t i = 0; list.is_array() && i < list.size(); ++i)
            axis.values.push_back(text(list[i], fmt::format("{}/{}", pointer, i)));
        if (axis.values.empty())
            fail(pointer, "a list of values, or {\"from\": 1, \"to\": 9}, would be right");
        axes.push_back(std::move(axis));
    }
    return axes;
}

Frames Reader::frames() const {
    Frames frames;
    if (!file_.root().contains("frames")) return frames;
    const Json& object = file_.root()["frames"];
    const std::string pointer = "/frames";
    if (!object.is_object())
        fail(pointer, "frames: {\"path\": FILE, \"count\": N}, for example, would be right");
    checkFields(object, pointer, {"path", "turntable", "clip", "count", "first", "chunk", "fps"});
    frames.isClip = object.contains("clip");
    const bool turns = object.value("turntable", Json(false)) == true;
    if (int(object.contains("path")) + int(turns) + int(frames.isClip) != 1)
        fail(pointer, "one of \"path\": FILE, \"turntable\": true and \"clip\": NAME would be right");
    if (object.contains("path"))
        frames.words = {"--path", resolved(text(object["path"], pointer + "/path"))};
    else if (turns)
        frames.words = {"--turntable"};
    else
        frames.words = {"--animate", text(object["clip"], pointer + "/clip")};
    if (object.contains("fps")) {
        if (!frames.isClip) fail(pointer + "/fps", "fps: belongs to \"clip\"");
        frames.words.insert(frames.words.end(), {"--fps", text(object["fps"], pointer + "/fps")});
    }
    frames.count = whole(object, pointer, "count", 1, 0);
    if (frames.count == 0) fail(pointer, "count: how many frames there are would be right");
    frames.first = whole(object, pointer, "first", 0, 0);
    if (frames.first > 0 && !frames.isClip) fail(pointer + "/first", "first: belongs to \"clip\"");
    frames.chunk = whole(object, pointer, "chunk", 1, 1);
    return frames;
}

// The one given, or one that names what differs.
std::string Reader::outputPattern(const std::vector<Axis>& axes, const Frames& frames,
                                  bool severalScenes) const {
    if (!file_.root().contains("output")) {
        std::string pattern = severalScenes ? "{scene}" : "";
        for (const Axis& axis : axes) pattern += (pattern.empty() ? "{" : "-{") + axis.key + "}";
        if (pattern.empty()) pattern = "{scene}";
        return pattern + (frames.count > 0 ? "-{frame}.exr" : ".exr");
    }
    const std::string pattern = text(file_.root()["output"], "/output");
    try {
        io::imageFormatOf(pattern);
    } catch (const Error& error) {
        fail("/output", error.what());
    }
    const fs::path path(pattern);
    bool leaves = path.is_absolute();
    for (const fs::path& part : path) leaves = leaves || part == ".." || part == ".";
    if (leaves || *path.begin() == "batch")
        fail("/output", "a name below the folder of results, outside of its folder batch, would be right");
    if (pattern.find('%') != std::string::npos) fail("/output", "{frame} instead of % would be right");
    if ((pattern.find("{frame}") != std::string::npos) != (frames.count > 0))
        fail("/output", frames.count > 0 ? "there are frames; {frame} in the name would be right"
                                         : "{frame}: there are no frames");
    const std::size_t frame = pattern.find("{frame}");
    if (frame != std::string::npos && pattern.find("{frame}", frame + 1) != std::string::npos)
        fail("/output", "{frame} once would be right");
    return pattern;
}

std::string Reader::filled(const std::string& pattern, const std::string& scene,
                           const std::vector<Choice>& choices) const {
    std::string out;
    for (std::size_t at = 0; at < pattern.size();) {
        const std::size_t open = pattern.find('{', at);
        out += pattern.substr(at, open == std::string::npos ? open : open - at);
        if (open == std::string::npos) break;
        const std::size_t close = pattern.find('}', open);
        if (close == std::string::npos) fail("/output", "'{' without '}'");
        const std::string key = pattern.substr(open + 1, close - open - 1);
        at = close + 1;
        if (key == "frame") {
            out += "%04d";
            continue;
        }
        const bool generated = isGenerated(scene);
        std::string value =
            key == "scene" ? generated ? scene.substr(8) : fs::path(scene).stem().string() : "";
        bool known = key == "scene";
        for (const Choice& choice : choices)
            if (choice.key == key) {
                value = choice.value;
                known = true;
            }
        if (!known)
            fail("/output", fmt::format("{{{}}}: neither scene, frame, an option nor a name of the sweep",
                                        io::oneLine(key, 40)));
        out += nameOf(value);
    }
    return out;
}

void Reader::addTask(const std::string& scene, const std::vector<Choice>& choices, const std::string& output,
                     const Frames& frames, int frame, BatchJob& job) const {
    BatchTask task;
    std::string shown = scene;
    for (const Choice& choice : choices)
        if (choice.key.rfind("scene.", 0) == 0)
            shown += (shown.find('?') == std::string::npos ? "?" : "&") + choice.key.substr(6) + "=" +
                     choice.value;
    if (shown != scene && !isGenerated(scene))
        fail("/sweep",
             "scene.NAME: " + io::oneLine(scene) + " takes no parameters; a generated scene would be right");
    task.words = {"render", shown};
    if (!isGenerated(scene)) task.inputs.push_back(scene);
    for (const Choice& choice : choices) {
        if (choice.key.rfind("scene.", 0) == 0) continue;
        if (choice.key.rfind("set.", 0) == 0) {
            task.words.insert(task.words.end(), {"--set", choice.key.substr(4) + "=" + choice.value});
            continue;
        }
        const BatchOption& known = option(choice.key, "/options");
        if (known.isFlag) {
            if (choice.value == "true") task.words.push_back("--" + choice.key);
            continue;
        }
        const std::string value = known.isFile ? resolved(choice.value) : choice.value;
        if (known.isFile && !isGenerated(value) && value != "none") task.inputs.push_back(value);
        // In one word, for a value may start with a dash.
        task.words.push_back("--" + choice.key + "=" + value);
    }
    task.output = output;
    if (frames.count == 0) {
        task.files = {output};
    } else {
        const int last = std::min(frame + frames.chunk, frames.first + frames.count) - 1;
        task.words.insert(task.words.end(), frames.words.begin(), frames.words.end());
        if (frames.words.front() == "--path") task.inputs.push_back(frames.words.back());
        task.words.insert(task.words.end(),
                          {"--frames", frames.isClip ? fmt::format("{}-{}", frame, last)
                                                     : fmt::format("{}-{}/{}", frame, last, frames.count)});
        const std::size_t number = output.find("%04d");
        for (int i = frame; i <= last; ++i)
            task.files.push_back(output.substr(0, number) + fmt::format("{:04}", i) +
                                 output.substr(number + 4));
    }
    job.tasks.push_back(std::move(task));
}

BatchJob Reader::read() {
    if (!file_.root().is_object() || file_.root().value("conelight", Json()) != "batch job")
        fail("/conelight", "is no batch job, which says \"conelight\": \"batch job\"");
    checkFields(file_.root(), "", {"conelight", "scenes", "options", "sweep", "frames", "output"});
    const std::vector<std::string> scenes = this->scenes();
    const std::vector<Choice> fixed = fixedOptions();
    const std::vector<Axis> axes = sweep();
    for (const Axis& axis : axes)
        for (const Choice& choice : fixed)
            if (choice.key == axis.key)
                fail("/sweep/" + axis.key, axis.key + ": stands in options, too; once would be right");
    const Frames frames = this->frames();
    const std::string pattern = outputPattern(axes, frames, scenes.size() > 1);
    const std::size_t chunks =
        frames.count == 0 ? 1 : std::size_t((frames.count + frames.chunk - 1) / frames.chunk);
    std::size_t combinations = 1;
    for (const Axis& axis : axes) {
        combinations *= axis.values.size();
        if (combinations > kMostTasks) break;
    }
    if (scenes.size() * combinations > kMostTasks / chunks)
        fail("/sweep", fmt::format("more than {} tasks; a shorter sweep would be right", kMostTasks));
    BatchJob job{path_, {}};
    std::map<std::string, std::size_t> taken;
    for (const std::string& scene : scenes)
        for (std::size_t combination = 0; combination < combinations; ++combination) {
            std::vector<Choice> choices = fixed;
            std::size_t rest = combination;
            for (std::size_t a = axes.size(); a-- > 0; rest /= axes[a].values.size())
                choices.push_back({axes[a].key, axes[a].values[rest % axes[a].values.size()]});
            std::reverse(choices.begin() + std::ptrdiff_t(fixed.size()), choices.end());
            const std::string output = filled(pattern, scene, choices);
            if (!taken.emplace(output, job.tasks.size()).second)
                fail("/output",
                     fmt::format("several pictures would be named {}; what differs between them, as "
                                 "in {{scene}} or {{{}}}, belongs into the name",
                                 output, axes.empty() ? "mode" : axes.back().key));
            for (std::size_t c = 0; c < chunks; ++c)
                addTask(scene, choices, output, frames, frames.first + int(c) * frames.chunk, job);
        }
    return job;
}

}  // namespace

BatchJob readBatchJob(const std::string& file, const std::vector<BatchOption>& options) {
    return Reader(file, options).read();
}

}  // namespace conelight::program

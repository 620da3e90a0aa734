// SPDX-License-Identifier: MIT
#include "gl/shader_source.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>

#include "base/log.h"

namespace conelight::gl {

ShaderProvider embeddedShaderProvider() {
    return [](const std::string& path) -> std::optional<std::string> {
        for (const EmbeddedShader& shader : embeddedShaders())
            if (path == shader.path) return shader.text;
        return std::nullopt;
    };
}

ShaderProvider directoryShaderProvider(const std::string& directory) {
    return [directory,
            embedded = embeddedShaderProvider()](const std::string& path) -> std::optional<std::string> {
        for (const char* root : {"/", "/../modes/"}) {
            const std::string name = directory + root + path;
            std::error_code ignored;
            if (!std::filesystem::is_regular_file(name, ignored)) continue;
            std::ifstream file(name, std::ios::binary);
            if (!file) continue;
            std::ostringstream text;
            text << file.rdbuf();
            return text.str();
        }
        return embedded(path);
    };
}

namespace {

using base::fail;

// Trims blanks at both ends.
std::string trimmed(const std::string& text) {
    const std::size_t first = text.find_first_not_of(" \t\r");
    if (first == std::string::npos) return "";
    return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

// A preprocessor line: "#ifdef X" -> {"ifdef", "X"}.
struct Directive {
    std::string name, rest;
};

std::optional<Directive> directiveOf(const std::string& line) {
    const std::string text = trimmed(line);
    if (text.empty() || text[0] != '#') return std::nullopt;
    const std::string body = trimmed(text.substr(1));
    const std::size_t end = std::min(body.find_first_not_of("abcdefghijklmnopqrstuvwxyz"), body.size());
    return Directive{body.substr(0, end), trimmed(body.substr(end))};
}

// Whether the text after `line` is inside a block comment, given whether `line` begins inside one.
bool endsInComment(const std::string& line, bool inside) {
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        const std::string two = line.substr(i, 2);
        if (!inside && two == "//") return false;
        if (two != (inside ? "*/" : "/*")) continue;
        inside = !inside;
        ++i;
    }
    return inside;
}

// The path of an #include directive: relative to the root, and nothing but a comment after it.
std::string includePath(const std::string& rest, const std::string& where) {
    const std::size_t close = rest.empty() || rest[0] != '"' ? std::string::npos : rest.find('"', 1);
    const std::string path = close == std::string::npos ? "" : rest.substr(1, close - 1);
    const std::string tail = close == std::string::npos ? "" : trimmed(rest.substr(close + 1));
    const bool leavesRoot =
        path.rfind("/", 0) == 0 || path.rfind("../", 0) == 0 || path.find("/../") != std::string::npos;
    if (path.empty() || leavesRoot || (!tail.empty() && tail.rfind("//", 0) != 0 && tail.rfind("/*", 0) != 0))
        fail(ErrorKind::Runtime, "%s: malformed include; #include \"folder/file.glsl\" would be right",
             where.c_str());
    return path;
}

// Copies files line by line into one text. Three kinds of lines do not arrive: #include (replaced by the
// file), #pragma once, and what shared headers hold between #ifdef __cplusplus and its #else or #endif.
class Expander {
  public:
    Expander(const ShaderProvider& provider, const Defines& defines)
        : provider_(provider), defines_(defines) {}

    ExpandedShader run(const std::string& path) {
        result_.path = path;
        copyFile(path, "");
        if (!sawVersion_)
            fail(ErrorKind::Runtime, "%s: the first line must be #version 450 core", path.c_str());
        return std::move(result_);
    }

  private:
    // An open #if. `language`: it asks for __cplusplus, so that we take the branch here.
    struct Condition {
        bool language;
        bool skipped;
    };
    struct File {
        int index;  // into result_.files
        std::string path;
        std::vector<Condition> conditions;
    };

    void copyFile(const std::string& path, const std::string& from) {
        const std::optional<std::string> text = provider_(path);
        if (!text)
            fail(ErrorKind::Runtime,
                 "%s%sthere is no shader file '%s'; paths are relative to the shader root", from.c_str(),
                 from.empty() ? "" : ": ", path.c_str());
        File file{static_cast<int>(result_.files.size()), path, {}};
        result_.files.push_back(path);
        chain_.push_back(path);
        std::istringstream lines(*text);
        std::string line;
        bool comment = false;
        for (int number = 1; std::getline(lines, line); ++number) {
            const std::optional<Directive> directive = comment ? std::nullopt : directiveOf(line);
            comment = endsInComment(line, comment);
            if (directive && takesBranch(file, *directive, number)) continue;
            if (skipping(file)) continue;
            if (directive && directive->name == "include") {
                include(includePath(directive->rest, place(file, number)), place(file, number));
                continue;
            }
            if (directive && directive->name == "pragma" && directive->rest == "once") continue;
            append(line, file.index, number);
            if (directive && directive->name == "version") insertDefines(file, number);
        }
        for (const Condition& condition : file.conditions)
            if (condition.language)
                fail(ErrorKind::Runtime, "%s: #ifdef __cplusplus without #endif", path.c_str());
        chain_.pop_back();
    }

    void include(const std::string& path, const std::string& where) {
        if (!sawVersion_)
            fail(ErrorKind::Runtime,
                 "%s: #include before #version; #version 450 core on the first line would be right",
                 where.c_str());
        if (std::find(chain_.begin(), chain_.end(), path) != chain_.end())
            fail(ErrorKind::Runtime, "%s: include cycle %s -> %s", where.c_str(), joinedChain().c_str(),
                 path.c_str());
        if (std::find(result_.files.begin(), result_.files.end(), path) == result_.files.end())
            copyFile(path, where);
    }

    static bool skipping(const File& file) {
        return std::any_of(file.conditions.begin(), file.conditions.end(),
                           [](const Condition& c) { return c.skipped; });
    }

    // Follows #if ... #endif. True when the line is one of ours and does not arrive in the text.
    bool takesBranch(File& file, const Directive& directive, int number) const {
        const bool opens = directive.name == "if" || directive.name == "ifdef" || directive.name == "ifndef";
        if (opens) {
            const std::string what = directive.rest.substr(0, directive.rest.find_first_of(" \t/"));
            const bool language = directive.name != "if" && what == "__cplusplus";
            file.conditions.push_back({language, language && directive.name == "ifdef"});
            return language;
        }
        if (file.conditions.empty()) return false;
        Condition& innermost = file.conditions.back();
        const bool ours = innermost.language;
        if (directive.name == "elif" && ours)
            fail(ErrorKind::Runtime, "%s: #elif of #ifdef __cplusplus; #else would be right",
                 place(file, number).c_str());
        if (directive.name == "else" && ours) innermost.skipped = !innermost.skipped;
        if (directive.name == "endif") {
            // The line belongs to the branch that it ends: it must not arrive when that one is skipped.
            const bool gone = ours || skipping(file);
            file.conditions.pop_back();
            return gone;
        }
        return ours && directive.name == "else";
    }

    // Variants go right behind #version, before any code that asks for them.
    void insertDefines(const File& file, int number) {
        if (sawVersion_)
            fail(ErrorKind::Runtime, "%s: a second #version; only the entry file has one",
                 place(file, number).c_str());
        sawVersion_ = true;
        for (const auto& [name, value] : defines_) append("#define " + name + " " + value, -1, 0);
    }

    void append(const std::string& line, int file, int number) {
        result_.text += line;
        result_.text += '\n';
        result_.lines.push_back({file, number});
    }

    static std::string place(const File& file, int number) {
        return file.path + ":" + std::to_string(number);
    }

    std::string joinedChain() const {
        std::string text;
        for (const std::string& path : chain_) text += (text.empty() ? "" : " -> ") + path;
        return text;
    }

    const ShaderProvider& provider_;
    const Defines& defines_;
    ExpandedShader result_;
    std::vector<std::string> chain_;
    bool sawVersion_ = false;
};

}  // namespace

ExpandedShader expandShader(const ShaderProvider& provider, const std::string& path, const Defines& defines) {
    return Expander(provider, defines).run(path);
}

std::string ExpandedShader::mapLog(const std::string& log) const {
    // Mesa "0:12(3): error", glslang "ERROR: 0:12: ", NVIDIA "0(12) : error".
    static const std::regex pattern(R"((^|[^0-9])0(?::([0-9]{1,9})(?:\([0-9]+\))?|\(([0-9]{1,9})\)) ?:)");
    std::vector<std::string> sourceLines;
    std::istringstream source(text);
    for (std::string line; std::getline(source, line);) sourceLines.push_back(line);
    std::string result;
    std::istringstream messages(log);
    for (std::string message; std::getline(messages, message);) {
        std::smatch match;
        if (!std::regex_search(message, match, pattern)) {
            result += message + "\n";
            continue;
        }
        const std::size_t number = std::stoul(match[2].matched ? match[2].str() : match[3].str());
        if (number == 0 || number > lines.size()) {
            result += message + "\n";
            continue;
        }
        const Line& at = lines[number - 1];
        const std::string place =
            at.file < 0 ? path + ": inserted define"
                        : files[static_cast<std::size_t>(at.file)] + ":" + std::to_string(at.line);
        result += place + ":" + match.suffix().str() + "\n    " + sourceLines[number - 1] + "\n";
    }
    return result;
}

}  // namespace conelight::gl

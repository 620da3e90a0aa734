// SPDX-License-Identifier: MIT
#include "gl/shader_source.h"

#include <algorithm>
#include <fstream>
#include <map>
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
    return [directory, embedded = embeddedShaderProvider()](const std::string& path) -> std::optional<std::string> {
        std::ifstream file(directory + "/" + path, std::ios::binary);
        if (!file) return embedded(path);
        std::ostringstream text;
        text << file.rdbuf();
        return text.str();
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

// The quoted path of an #include line, nothing when the line is none.
std::optional<std::string> includePath(const std::string& line, const std::string& where) {
    const std::string text = trimmed(line);
    if (text.empty() || text[0] != '#') return std::nullopt;
    const std::string directive = trimmed(text.substr(1));
    if (directive.rfind("include", 0) != 0) return std::nullopt;
    const std::size_t open = directive.find('"');
    const std::size_t close = open == std::string::npos ? open : directive.find('"', open + 1);
    if (close == std::string::npos)
        fail(ErrorKind::Runtime, "%s: malformed include; #include \"folder/file.glsl\" would be right", where.c_str());
    return directive.substr(open + 1, close - open - 1);
}

class Expander {
  public:
    Expander(const ShaderProvider& provider, const Defines& defines) : provider_(provider), defines_(defines) {}

    ExpandedShader run(const std::string& path) {
        result_.path = path;
        include(path, "");
        if (!sawVersion_) fail(ErrorKind::Runtime, "%s: the first line must be #version 450 core", path.c_str());
        return std::move(result_);
    }

  private:
    void include(const std::string& path, const std::string& from) {
        const std::optional<std::string> text = provider_(path);
        if (!text)
            fail(ErrorKind::Runtime, "%s%sthere is no shader file '%s'; paths are relative to the shader root",
                 from.c_str(), from.empty() ? "" : ": ", path.c_str());
        const int file = static_cast<int>(result_.files.size());
        result_.files.push_back(path);
        chain_.push_back(path);
        std::istringstream lines(*text);
        std::string line;
        for (int number = 1; std::getline(lines, line); ++number) {
            const std::string where = path + ":" + std::to_string(number);
            const std::optional<std::string> target = includePath(line, where);
            if (!target)
                emit(line, file, number);
            else if (std::find(chain_.begin(), chain_.end(), *target) != chain_.end())
                fail(ErrorKind::Runtime, "%s: include cycle %s -> %s", where.c_str(), joinedChain().c_str(), target->c_str());
            else if (std::find(result_.files.begin(), result_.files.end(), *target) == result_.files.end())
                include(*target, where);
        }
        chain_.pop_back();
    }

    void emit(const std::string& line, int file, int number) {
        // Shared headers say #pragma once for C++; includes are once anyway.
        if (trimmed(line) == "#pragma once") return;
        append(line, file, number);
        if (!sawVersion_ && trimmed(line).rfind("#version", 0) == 0) {
            sawVersion_ = true;
            for (const auto& [name, value] : defines_) append("#define " + name + " " + value, -1, 0);
        }
    }

    void append(const std::string& line, int file, int number) {
        result_.text += line;
        result_.text += '\n';
        result_.lines.push_back({file, number});
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
    static const std::regex pattern(R"((^|[^0-9])0(?::([0-9]+)(?:\([0-9]+\))?|\(([0-9]+)\)) ?:)");
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
        const std::string place = at.file < 0 ? path + ": inserted define"
                                              : files[static_cast<std::size_t>(at.file)] + ":" + std::to_string(at.line);
        result += place + ":" + match.suffix().str() + "\n    " + sourceLines[number - 1] + "\n";
    }
    return result;
}

}  // namespace conelight::gl

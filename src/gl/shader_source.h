// SPDX-License-Identifier: MIT
// GLSL files -> one text per shader: resolves #include "path", inserts defines after #version, and keeps a
// table from lines of the expanded text to file:line, with which driver logs are rewritten. No GL calls.
//
// Rules: paths are relative to the shader root (never to the including file), a file is read once, a cycle is
// an error that names the chain. An include below an #if is resolved whether that is taken or not; only
// #ifdef __cplusplus is decided here, and its C++ branch left out. No #line is emitted: Mesa prints source 0
// whatever it says.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace conelight::gl {

struct EmbeddedShader {
    const char* path;
    const char* text;
};
// The library's own files, generated at build time, and those that were added. Add before any shader is asked
// for, from one thread; a table that is there already is passed over. Tables live as long as the program.
const std::vector<EmbeddedShader>& embeddedShaders();
void addEmbeddedShaders(std::span<const EmbeddedShader> files);

// Where shader files come from: path relative to the root -> text, nothing when there is no such file.
using ShaderProvider = std::function<std::optional<std::string>(const std::string& path)>;
ShaderProvider embeddedShaderProvider();
// Files of modes with a folder of their own lie in modes/ beside `directory`. Falls back to the embedded
// files.
ShaderProvider directoryShaderProvider(const std::string& directory);

using Defines = std::vector<std::pair<std::string, std::string>>;

struct ExpandedShader {
    std::string path;  // the entry file
    std::string text;
    struct Line {
        int file;  // index into files
        int line;  // 1-based
    };
    std::vector<Line> lines;         // one per line of text; file -1: inserted by us
    std::vector<std::string> files;  // the resolved include set, entry first

    // Rewrites the line references of a driver's log ("0:12(3):", "0(12) :", "ERROR: 0:12:") to
    // file:line, and appends the source line of each message.
    std::string mapLog(const std::string& log) const;
};

// Throws Error(Runtime): missing file, include cycle, malformed include, an include before #version, an entry
// without #version. Thread-safe if the provider is.
ExpandedShader expandShader(const ShaderProvider& provider, const std::string& path,
                            const Defines& defines = {});

}  // namespace conelight::gl

// SPDX-License-Identifier: MIT
#include "gl/program.h"

#include <algorithm>
#include <set>

#include "base/assert.h"
#include "base/log.h"
#include "gl/gl.h"

namespace conelight::gl {
namespace {

constexpr int kMaxGroups = 65535;  // GL minimum of GL_MAX_COMPUTE_WORK_GROUP_COUNT

GLenum stageOf(const std::string& file) {
    const auto has = [&](const char* part) { return file.find(part) != std::string::npos; };
    if (has(".vert.")) return GL_VERTEX_SHADER;
    if (has(".geom.")) return GL_GEOMETRY_SHADER;
    if (has(".frag.")) return GL_FRAGMENT_SHADER;
    if (has(".comp.")) return GL_COMPUTE_SHADER;
    base::fail(ErrorKind::Runtime, "%s: no stage in the name; .vert .geom .frag or .comp would be right",
               file.c_str());
}

template <class Get, class GetLog>
std::string infoLog(GLuint name, Get get, GetLog getLog) {
    GLint length = 0;
    get(name, GL_INFO_LOG_LENGTH, &length);
    std::string log(static_cast<std::size_t>(std::max(length, 1)), '\0');
    getLog(name, length, nullptr, log.data());
    while (!log.empty() && (log.back() == '\0' || log.back() == '\n')) log.pop_back();
    return log;
}

// Compiles one stage and attaches it to `program`.
void attachStage(GLuint program, const ExpandedShader& source) {
    const GLuint shader = glCreateShader(stageOf(source.path));
    const char* text = source.text.c_str();
    glShaderSource(shader, 1, &text, nullptr);
    glCompileShader(shader);
    GLint ok = 0;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &ok);
    const std::string log = infoLog(shader, glGetShaderiv, glGetShaderInfoLog);
    if (ok == GL_FALSE) {
        glDeleteShader(shader);
        base::fail(ErrorKind::Runtime, "%s: does not compile:\n%s", source.path.c_str(),
                   source.mapLog(log).c_str());
    }
    glAttachShader(program, shader);
    glDeleteShader(shader);
}

}  // namespace

std::string ProgramDesc::label() const {
    std::string text;
    for (const std::string& file : files) text += (text.empty() ? "" : " ") + file;
    if (defines.empty()) return text;
    text += "[";
    for (std::size_t i = 0; i < defines.size(); ++i)
        text += (i != 0 ? " " : "") + defines[i].first + "=" + defines[i].second;
    return text + "]";
}

Program::Program(const ShaderProvider& provider, const ProgramDesc& desc) {
    // Owned from the start, so that a failure below frees it.
    const GLuint program = glCreateProgram();
    adopt(program, desc.label(), 0);
    for (const std::string& file : desc.files) {
        const ExpandedShader source = expandShader(provider, file, desc.defines);
        attachStage(program, source);
        sourceFiles_.insert(sourceFiles_.end(), source.files.begin(), source.files.end());
    }
    glLinkProgram(program);
    GLint ok = 0;
    glGetProgramiv(program, GL_LINK_STATUS, &ok);
    if (ok == GL_FALSE)
        base::fail(ErrorKind::Runtime, "%s: does not link: %s", desc.label().c_str(),
                   infoLog(program, glGetProgramiv, glGetProgramInfoLog).c_str());
    if (stageOf(desc.files.front()) == GL_COMPUTE_SHADER)
        glGetProgramiv(program, GL_COMPUTE_WORK_GROUP_SIZE, &groupSize_.x);
}

void Program::use() const { glUseProgram(name()); }

void Program::dispatch(int x, int y, int z) const {
    CONELIGHT_ASSERT(groupSize_.x > 0, "Program::dispatch: not a compute program");
    if (x <= 0 || y <= 0 || z <= 0) return;
    const glm::ivec3 groups = (glm::ivec3(x, y, z) + groupSize_ - 1) / groupSize_;
    CONELIGHT_ASSERT(groups.x <= kMaxGroups && groups.y <= kMaxGroups && groups.z <= kMaxGroups,
                     "Program::dispatch: too many groups; dispatchLinear folds them");
    use();
    glDispatchCompute(static_cast<GLuint>(groups.x), static_cast<GLuint>(groups.y),
                      static_cast<GLuint>(groups.z));
}

void Program::dispatchLinear(std::size_t invocations) const {
    CONELIGHT_ASSERT(groupSize_.x > 0, "Program::dispatchLinear: not a compute program");
    if (invocations == 0) return;
    const std::size_t perGroup = static_cast<std::size_t>(groupSize_.x) *
                                 static_cast<std::size_t>(groupSize_.y) *
                                 static_cast<std::size_t>(groupSize_.z);
    const std::size_t groups = (invocations + perGroup - 1) / perGroup;
    // Rows of equal length waste less than one group per row; rows of full length up to 65,534 in the last.
    const std::size_t rows = (groups + kMaxGroups - 1) / kMaxGroups;
    const std::size_t columns = (groups + rows - 1) / rows;
    CONELIGHT_ASSERT(rows <= static_cast<std::size_t>(kMaxGroups),
                     "Program::dispatchLinear: too many invocations");
    use();
    glDispatchCompute(static_cast<GLuint>(columns), static_cast<GLuint>(rows), 1);
}

void Program::dispatchIndirect(const Buffer& buffer, std::size_t offset) const {
    CONELIGHT_ASSERT(groupSize_.x > 0, "Program::dispatchIndirect: not a compute program");
    CONELIGHT_ASSERT(offset % 4 == 0 && buffer.bytes() >= 12 && offset <= buffer.bytes() - 12,
                     "Program::dispatchIndirect reaches past the end of the buffer");
    use();
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, buffer.name());
    glDispatchComputeIndirect(static_cast<GLintptr>(offset));
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, 0);
}

const Program& ProgramLibrary::get(const ProgramDesc& desc) {
    std::unique_ptr<Entry>& entry = programs_[desc.label()];
    if (!entry) {
        try {
            entry = std::make_unique<Entry>(Entry{desc, Program(provider_, desc), false});
        } catch (...) {
            programs_.erase(desc.label());
            throw;
        }
    }
    return entry->program;
}

std::vector<std::string> ProgramLibrary::reload(const std::vector<std::string>& files) {
    std::vector<std::string> failures;
    for (auto& [label, entry] : programs_) {
        const std::vector<std::string>& used = entry->program.sourceFiles();
        const bool affected = std::any_of(files.begin(), files.end(), [&](const std::string& file) {
            return std::find(used.begin(), used.end(), file) != used.end();
        });
        if (!affected && !entry->reloadFailed) continue;
        try {
            entry->program = Program(provider_, entry->desc);
            entry->reloadFailed = false;
        } catch (const Error& error) {
            entry->reloadFailed = true;
            failures.emplace_back(error.what());
        }
    }
    return failures;
}

std::vector<std::string> ProgramLibrary::sourceFiles() const {
    std::set<std::string> files;
    for (const auto& [label, entry] : programs_)
        files.insert(entry->program.sourceFiles().begin(), entry->program.sourceFiles().end());
    return {files.begin(), files.end()};
}

}  // namespace conelight::gl

// SPDX-License-Identifier: MIT
#include "gl/program.h"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <set>
#include <utility>

#include "base/assert.h"
#include "base/log.h"
#include "gl/dispatch_counter.h"
#include "gl/gl.h"
#include "gl/pass.h"
#include "gl/program_binary.h"
#include "gl/sampler_slots.h"
#include "gl/work.h"

namespace conelight::gl {
namespace {

constexpr int kMaxGroups = 65535;  // GL minimum of GL_MAX_COMPUTE_WORK_GROUP_COUNT

std::atomic<std::uint64_t> builtCount{0}, usedCount{0}, loadedCount{0};

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

// Compiles one stage and attaches it to `program`; the shader lives until it is detached.
GLuint attachStage(GLuint program, const ExpandedShader& source) {
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
    return shader;
}

GLuint resourceCount(GLuint program, GLenum interface) {
    GLint count = 0;
    glGetProgramInterfaceiv(program, interface, GL_ACTIVE_RESOURCES, &count);
    return static_cast<GLuint>(count);
}

std::string resourceName(GLuint program, GLenum interface, GLuint index) {
    const GLenum wanted = GL_NAME_LENGTH;
    GLint length = 0;  // with the terminator
    glGetProgramResourceiv(program, interface, index, 1, &wanted, 1, nullptr, &length);
    std::string name(static_cast<std::size_t>(length), '\0');
    glGetProgramResourceName(program, interface, index, length, nullptr, name.data());
    name.resize(static_cast<std::size_t>(std::max(length - 1, 0)));
    return name;
}

// Whether a uniform of this type is an image, of the dimensions that shaders of this library use.
bool isImage(GLenum type) {
    switch (type) {
        case GL_IMAGE_2D:
        case GL_IMAGE_3D:
        case GL_IMAGE_2D_ARRAY:
        case GL_UNSIGNED_INT_IMAGE_2D:
        case GL_UNSIGNED_INT_IMAGE_3D:
        case GL_UNSIGNED_INT_IMAGE_2D_ARRAY:
        case GL_IMAGE_BUFFER:
        case GL_UNSIGNED_INT_IMAGE_BUFFER:
            return true;
        default:
            return false;
    }
}

bool isBufferTexture(GLenum type) {
    return type == GL_SAMPLER_BUFFER || type == GL_INT_SAMPLER_BUFFER ||
           type == GL_UNSIGNED_INT_SAMPLER_BUFFER;
}

const char* kindName(ResourceKind kind) {
    constexpr const char* kNames[] = {"uniform block", "storage block", "texture", "image"};
    return kNames[static_cast<std::size_t>(kind)];
}

GLenum accessOf(ImageUse use) {
    return use == ImageUse::Read ? GL_READ_ONLY : (use == ImageUse::Write ? GL_WRITE_ONLY : GL_READ_WRITE);
}

void bindItem(const Inputs::Item& item, unsigned slot) {
    switch (item.kind) {
        case ResourceKind::Uniform:
            glBindBufferBase(GL_UNIFORM_BUFFER, slot, item.object);
            break;
        case ResourceKind::Storage:
            glBindBufferBase(GL_SHADER_STORAGE_BUFFER, slot, item.object);
            break;
        case ResourceKind::Texture:
            glBindTextureUnit(slot, item.object);
            glBindSampler(slot, item.sampler);
            break;
        case ResourceKind::Image:
            glBindImageTexture(slot, item.object, item.level, GL_TRUE, 0, accessOf(item.use), item.format);
            break;
    }
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

Program::Program(const ShaderProvider& provider, const ProgramDesc& desc, ProgramCache* cache)
    : label_(desc.label()) {
    std::vector<ExpandedShader> stages;
    for (const std::string& file : desc.files) {
        const ExpandedShader& source = stages.emplace_back(expandShader(provider, file, desc.defines));
        sourceFiles_.insert(sourceFiles_.end(), source.files.begin(), source.files.end());
    }
    // Owned from the start, so that a failure below frees it.
    adopt(glCreateProgram(), label_, 0);
    const std::string key = cache != nullptr ? programKey(stages) : std::string();
    if (cache != nullptr && linkBinary(name(), key, label_, *cache)) {
        ++loadedCount;
    } else {
        ++builtCount;
        if (cache != nullptr) wantBinary(name());
        build(stages);
        if (cache != nullptr) keepBinary(name(), key, *cache);
    }
    if (stageOf(desc.files.front()) == GL_COMPUTE_SHADER)
        glGetProgramiv(name(), GL_COMPUTE_WORK_GROUP_SIZE, &groupSize_.x);
    assignSlots();
}

void Program::build(const std::vector<ExpandedShader>& sources) {
    const GLuint program = name();
    std::vector<GLuint> stages;
    for (const ExpandedShader& source : sources) stages.push_back(attachStage(program, source));
    glLinkProgram(program);
    // The program needs them no longer; their text and what was parsed of it is most of what a driver keeps.
    for (const GLuint stage : stages) glDetachShader(program, stage);
    GLint ok = 0;
    glGetProgramiv(program, GL_LINK_STATUS, &ok);
    if (ok == GL_FALSE)
        base::fail(ErrorKind::Runtime, "%s: does not link: %s", label_.c_str(),
                   infoLog(program, glGetProgramiv, glGetProgramInfoLog).c_str());
}

// Gives every buffer block, texture and image that the linked program reads a slot of its own.
void Program::assignSlots() {
    // HostStateGuard saves so many of each kind.
    constexpr unsigned kMost[4] = {8, 16, 32, 8};
    unsigned next[4] = {0, 0, 0, 0};
    const auto add = [&](const std::string& resource, ResourceKind kind) {
        CONELIGHT_ASSERT(next[static_cast<std::size_t>(kind)] < kMost[static_cast<std::size_t>(kind)],
                         "a program reads more resources of a kind than HostStateGuard saves");
        slots_.push_back(
            {resource, ResourceName::hashOf(resource), kind, next[static_cast<std::size_t>(kind)]++});
        return slots_.back().slot;
    };
    for (GLuint i = 0; i < resourceCount(name(), GL_UNIFORM_BLOCK); ++i)
        glUniformBlockBinding(name(), i,
                              add(resourceName(name(), GL_UNIFORM_BLOCK, i), ResourceKind::Uniform));
    for (GLuint i = 0; i < resourceCount(name(), GL_SHADER_STORAGE_BLOCK); ++i)
        glShaderStorageBlockBinding(
            name(), i, add(resourceName(name(), GL_SHADER_STORAGE_BLOCK, i), ResourceKind::Storage));
    for (GLuint i = 0; i < resourceCount(name(), GL_UNIFORM); ++i) {
        const GLenum wanted[3] = {GL_TYPE, GL_LOCATION, GL_BLOCK_INDEX};
        GLint values[3];
        glGetProgramResourceiv(name(), GL_UNIFORM, i, 3, wanted, 3, nullptr, values);
        if (values[2] != -1) continue;  // a member of a block
        if (isBufferTexture(static_cast<GLenum>(values[0]))) readsBufferTextures_ = true;
        const ResourceKind kind =
            isImage(static_cast<GLenum>(values[0])) ? ResourceKind::Image : ResourceKind::Texture;
        const unsigned slot = add(resourceName(name(), GL_UNIFORM, i), kind);
        glProgramUniform1i(name(), values[1], static_cast<GLint>(slot));
    }
}

void Program::use(const Inputs& inputs) const {
    glUseProgram(name());
    ++usedCount;
    for (const ProgramSlot& slot : slots_) {
        const auto given = std::find_if(inputs.items().begin(), inputs.items().end(), [&](const auto& item) {
            return item.name.hash() == slot.hash && item.kind == slot.kind;
        });
        if (given == inputs.items().end())
            base::fail(ErrorKind::Runtime, "%s: reads %s %s, which the pass does not give it", label_.c_str(),
                       kindName(slot.kind), slot.name.c_str());
        if (given->object != 0) bindItem(*given, slot.slot);
    }
}

int Program::unitOf(ResourceName texture) const {
    for (const ProgramSlot& slot : slots_)
        if (slot.kind == ResourceKind::Texture && slot.hash == texture.hash())
            return static_cast<int>(slot.slot);
    return -1;
}

void Program::useForDispatch(const Inputs& inputs) const {
    if (samplers_ != nullptr) samplers_->run();
    use(inputs);
}

void Program::count(const glm::uvec3& groups) const {
    DispatchCounter* const counter = DispatchCounter::current();
    if (counter == nullptr) return;
    const auto size = [](const glm::uvec3& v) { return std::uint64_t{v.x} * v.y * v.z; };
    counter->add(label_, size(groups) * size(glm::uvec3(groupSize_)));
}

void Program::dispatch(const Inputs& inputs, int x, int y, int z) const {
    CONELIGHT_ASSERT(groupSize_.x > 0, "Program::dispatch: not a compute program");
    if (x <= 0 || y <= 0 || z <= 0) return;
    const glm::ivec3 groups = (glm::ivec3(x, y, z) + groupSize_ - 1) / groupSize_;
    CONELIGHT_ASSERT(groups.x <= kMaxGroups && groups.y <= kMaxGroups && groups.z <= kMaxGroups,
                     "Program::dispatch: too many groups; dispatchLinear folds them");
    useForDispatch(inputs);
    count(glm::uvec3(groups));
    glDispatchCompute(static_cast<GLuint>(groups.x), static_cast<GLuint>(groups.y),
                      static_cast<GLuint>(groups.z));
}

void Program::dispatchLinear(const Inputs& inputs, std::size_t invocations) const {
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
    useForDispatch(inputs);
    count({columns, rows, 1});
    glDispatchCompute(static_cast<GLuint>(columns), static_cast<GLuint>(rows), 1);
}

void Program::dispatchIndirect(const Inputs& inputs, const Buffer& buffer, std::size_t offset) const {
    CONELIGHT_ASSERT(groupSize_.x > 0, "Program::dispatchIndirect: not a compute program");
    CONELIGHT_ASSERT(offset % 4 == 0 && buffer.bytes() >= 12 && offset <= buffer.bytes() - 12,
                     "Program::dispatchIndirect reaches past the end of the buffer");
    useForDispatch(inputs);
    if (DispatchCounter::current() != nullptr) count(buffer.read<glm::uvec3>(1, offset)[0]);
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, buffer.name());
    glDispatchComputeIndirect(static_cast<GLintptr>(offset));
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, 0);
}

namespace {

std::atomic<std::size_t> most{kMostPrograms};

struct BuiltPrograms {
    std::mutex mutex;
    std::map<std::string, ProgramDesc> byLabel;
};

BuiltPrograms& built() {
    static BuiltPrograms* const instance = new BuiltPrograms;  // outlives every library
    return *instance;
}

}  // namespace

void setMostPrograms(std::size_t count) { most = count; }
std::size_t mostPrograms() { return most; }
ProgramCounts programCounts() { return {builtCount, usedCount, loadedCount}; }

std::vector<ProgramDesc> builtPrograms() {
    BuiltPrograms& all = built();
    const std::lock_guard lock(all.mutex);
    std::vector<ProgramDesc> descs;
    for (const auto& [label, desc] : all.byLabel) descs.push_back(desc);
    return descs;
}

ProgramLibrary::ProgramLibrary(ShaderProvider provider, std::shared_ptr<ProgramCache> cache)
    : provider_(std::move(provider)), cache_(std::move(cache)) {}
ProgramLibrary::~ProgramLibrary() = default;

Program ProgramLibrary::build(const ProgramDesc& desc) {
    const ProgramWork told;
    Program program(provider_, desc, cache_.get());
    if (program.groupSize().x > 0 && program.readsBufferTextures() && isSoftwareDriver()) {
        if (!samplers_) samplers_ = std::make_unique<SamplerSlots>(cache_.get());
        program.runAfter(*samplers_);
    }
    return program;
}

const Program& ProgramLibrary::get(const ProgramDesc& desc) {
    std::unique_ptr<Entry>& entry = programs_[desc.label()];
    if (!entry) {
        try {
            entry = std::make_unique<Entry>(Entry{desc, build(desc)});
            const std::lock_guard lock(built().mutex);
            built().byLabel.emplace(desc.label(), desc);
        } catch (...) {
            programs_.erase(desc.label());
            throw;
        }
    }
    entry->asked = ++asked_;
    return entry->program;
}

Buffer& ProgramLibrary::firstRow() {
    constexpr std::size_t kBytes = 16;
    if (!firstRow_) firstRow_ = Buffer(kBytes, "first row");
    return firstRow_;
}

void ProgramLibrary::trim() {
    const std::uint64_t before = std::exchange(trimmed_, asked_);
    const std::size_t most = mostPrograms();
    if (programs_.size() <= most) return;
    std::vector<std::pair<std::uint64_t, std::string>> old;
    for (const auto& [label, entry] : programs_)
        if (entry->asked <= before) old.emplace_back(entry->asked, label);
    std::sort(old.begin(), old.end());
    for (const auto& [asked, label] : old) {
        if (programs_.size() <= most) break;
        programs_.erase(label);
    }
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
            entry->program = build(entry->desc);
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

namespace conelight {

ProgramStats programStats() {
    const gl::ProgramCounts counts = gl::programCounts();
    return {counts.built, counts.loaded};
}

}  // namespace conelight

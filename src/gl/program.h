// SPDX-License-Identifier: MIT
// Linked programs, and the library that builds variants when they are asked for, keeps those that were asked for last,
// and rebuilds changed ones (hot reload).
// Use both on the thread of the context only.
#pragma once

#include <glm/glm.hpp>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "conelight/program_cache.h"
#include "gl/buffer.h"
#include "gl/inputs.h"
#include "gl/object.h"
#include "gl/shader_source.h"

namespace conelight::gl {

class SamplerSlots;

// What a program is made of. Stage by file suffix: .vert.glsl .geom.glsl .frag.glsl .comp.glsl.
struct ProgramDesc {
    std::vector<std::string> files;
    Defines defines;
    std::string label() const;  // "voxels/mark.comp.glsl[A=1 B=2]"
};

// What a linked program reads, and the slot it reads it from: a binding point of uniform or storage buffers,
// a texture unit, an image unit. Slots are given out in the order of the driver's list, from 0 for each kind.
struct ProgramSlot {
    std::string name;
    std::uint64_t hash;  // ResourceName::hashOf(name)
    ResourceKind kind;
    unsigned slot;
};

class Program : public Object<ObjectType::Program> {
  public:
    Program() = default;
    // Throws Error(Runtime) with the driver's log mapped to file:line. That message has several lines, unlike
    // other errors: who writes shaders needs all of them. With a cache: by what is kept there, else kept there.
    Program(const ShaderProvider& provider, const ProgramDesc& desc, ProgramCache* cache = nullptr);

    const std::vector<std::string>& sourceFiles() const { return sourceFiles_; }
    glm::ivec3 groupSize() const { return groupSize_; }  // compute only
    const std::vector<ProgramSlot>& slots() const { return slots_; }
    bool readsBufferTextures() const { return readsBufferTextures_; }
    // Compute: run before each dispatch, lives longer than the program.
    void runAfter(const SamplerSlots& samplers) { samplers_ = &samplers; }

    // Binds what the program reads and makes it current, for draw calls. Throws Error(Runtime) that names
    // what it reads and `inputs` lacks. GL state changed, here and below: program, the slots of slots().
    void use(const Inputs& inputs = {}) const;
    // The unit of a texture that draw calls bind themselves (Inputs::perDraw); -1 if the program reads none
    // of that name.
    int unitOf(ResourceName texture) const;
    // Compute: use() and run at least this many invocations (rounded up to whole groups). Counts of zero run
    // nothing. dispatchLinear folds groups beyond 65,535 into y: the shader asks linearIndex() of
    // lib/linear_index.glsl, which is below `invocations` for each exactly once (and above for some more).
    void dispatch(const Inputs& inputs, int x, int y = 1, int z = 1) const;
    void dispatchLinear(const Inputs& inputs, std::size_t invocations) const;
    // Group counts read from `buffer` at `offset` (three uints); each at most 65,535. GL state changed: the
    // indirect dispatch buffer binding, too.
    void dispatchIndirect(const Inputs& inputs, const Buffer& buffer, std::size_t offset = 0) const;

  private:
    void build(const std::vector<ExpandedShader>& stages);
    void assignSlots();
    void useForDispatch(const Inputs& inputs) const;
    void count(const glm::uvec3& groups) const;

    std::string label_;
    std::vector<std::string> sourceFiles_;
    std::vector<ProgramSlot> slots_;
    glm::ivec3 groupSize_{0};
    bool readsBufferTextures_ = false;
    const SamplerSlots* samplers_ = nullptr;
};

// How many programs a library keeps for pictures that may need them again. All five modes need 65 together in one
// scene, and twice as many leave room for another (counted on built-in scenes). A software driver keeps some megabytes
// for each program. Tests lower the number, for all libraries of the process. Thread-safe.
constexpr std::size_t kMostPrograms = 128;
void setMostPrograms(std::size_t count);
std::size_t mostPrograms();

// Programs by description; a reference stays valid until trim().
class ProgramLibrary {
  public:
    explicit ProgramLibrary(ShaderProvider provider, std::shared_ptr<ProgramCache> cache = {});
    ~ProgramLibrary();

    const Program& get(const ProgramDesc& desc);
    // Deletes what is more than mostPrograms(), the programs first that were asked for the longest ago. Those that were
    // asked for since the last call stay, however many: a picture after another like it builds none.
    void trim();
    const Program& compute(const std::string& file, const Defines& defines = {}) {
        return get({{file}, defines});
    }

    // FirstRowBlock of passes over pictures (gl/picture_pass.h), which one pass after the other fills.
    Buffer& firstRow();

    // Rebuilds programs that use one of `files`, and those whose last rebuild failed (the fault may be in a
    // file they did not use before). A program that fails keeps its old version. Returns one message per
    // failure.
    std::vector<std::string> reload(const std::vector<std::string>& files);

    // Files that programs built so far use, sorted: what to watch for changes.
    std::vector<std::string> sourceFiles() const;

  private:
    struct Entry {
        ProgramDesc desc;
        Program program;
        bool reloadFailed = false;
        std::uint64_t asked = 0;  // which call of get() was the last for it
    };
    Program build(const ProgramDesc& desc);

    ShaderProvider provider_;
    std::shared_ptr<ProgramCache> cache_;
    Buffer firstRow_;
    std::unique_ptr<SamplerSlots> samplers_;
    std::map<std::string, std::unique_ptr<Entry>> programs_;
    std::uint64_t asked_ = 0, trimmed_ = 0;  // calls of get(), and of these before the last trim()
};

// How many programs this process has made so far, and how often it made one current: tests count the work in a part of
// a picture. Built: from sources; loaded: from a cache.
struct ProgramCounts {
    std::uint64_t built = 0, used = 0, loaded = 0;
};
ProgramCounts programCounts();

// What libraries of this process have built so far, by label: tests compare it with the lists of
// variants.
std::vector<ProgramDesc> builtPrograms();

}  // namespace conelight::gl

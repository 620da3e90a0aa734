// SPDX-License-Identifier: MIT
#include "modes/shader_variants.h"

#include <cctype>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "base/log.h"
#include "conelight/shaders.h"
#include "image/background.h"
#include "image/debug_view.h"
#include "image/display.h"
#include "image/headlight.h"
#include "image/shadow_view.h"
#include "image/temporal_picture.h"
#include "image/view_mean.h"
#include "image/wireframe.h"
#include "light/shadow_maps.h"
#include "modes/modes.h"
#include "scene/host_mesh.h"
#include "view/gbuffer.h"
#include "view/layer_picture.h"
#include "view/motion_picture.h"
#include "voxels/octant_words.h"
#include "voxels/surface_voxels.h"

namespace conelight {
namespace {

// "view/gbuffer.frag.glsl" + {A=1, B=2} -> "view/gbuffer-A=1,B=2.frag.glsl".
std::string variantFile(const std::string& path, const gl::Defines& defines) {
    const std::size_t name = path.find_last_of('/') + 1;
    const std::size_t dot = path.find('.', name);
    std::string variant;
    for (const auto& [key, value] : defines) variant += (variant.empty() ? "-" : ",") + key + "=" + value;
    for (char& c : variant)
        if (std::isalnum(static_cast<unsigned char>(c)) == 0 &&
            std::string("-_=,.").find(c) == std::string::npos)
            c = '_';
    // File systems allow 255 bytes. Long lists keep their first defines and get a hash of all (FNV-1a); the
    // text of the file has them anyway.
    constexpr std::size_t kMaxVariant = 120;
    if (variant.size() > kMaxVariant) {
        std::uint32_t hash = 2166136261u;
        for (const char c : variant) hash = (hash ^ static_cast<unsigned char>(c)) * 16777619u;
        variant = variant.substr(0, kMaxVariant) + base::format("-%08x", hash);
    }
    return path.substr(0, dot) + variant + path.substr(dot);
}

}  // namespace

namespace modes {

std::string variantNameOf(const std::string& label) {
    const std::size_t open = std::min(label.find('['), label.size());
    gl::Defines defines;
    for (std::size_t from = open + 1; from < label.size();) {
        const std::size_t end = std::min(label.find_first_of(" ]", from), label.size());
        const std::string one = label.substr(from, end - from);
        const std::size_t equals = std::min(one.find('='), one.size());
        defines.emplace_back(one.substr(0, equals), one.substr(std::min(equals + 1, one.size())));
        from = end + 1;
    }
    const std::string file = variantFile(label.substr(0, open), defines);
    const std::string ending = ".comp.glsl";
    return file.size() > ending.size() && file.ends_with(ending) ? file.substr(0, file.size() - ending.size())
                                                                 : file;
}

std::vector<gl::ProgramDesc> allShaderVariants() {
    std::vector<gl::ProgramDesc> all;
    std::unordered_set<std::string> labels;
    const auto add = [&](std::vector<gl::ProgramDesc> descs) {
        for (gl::ProgramDesc& desc : descs)
            if (labels.insert(desc.label()).second) all.push_back(std::move(desc));
    };
    add(scene::HostMeshImport::programDescs());
    add(scene::HostTextureImport::programDescs());
    add(voxels::SurfaceVoxels::programDescs());
    add(voxels::OctantWords::programDescs());
    add(light::ShadowMaps::programDescs());
    add(view::GBuffer::programDescs());
    add(view::LayerPicture::programDescs());
    add(view::MotionPicture::programDescs());
    add(image::debugViewProgramDescs());
    add(image::backgroundProgramDescs());
    add(image::Headlight::programDescs());
    add(image::ShadowView::programDescs());
    add(image::WireframeView::programDescs());
    add(image::Display::programDescs());
    add(image::ViewMean::programDescs());
    add(image::TemporalPicture::programDescs());
    add(lightFieldProgramDescs());
    for (const ModeEntry& mode : registeredModes()) add(mode.programDescs());
    return all;
}

// Files, and each of their values of a define, get numbers: there are very many pairs.
std::vector<gl::ProgramDesc> coveringVariants(const std::vector<gl::ProgramDesc>& all, int together) {
    std::vector<gl::ProgramDesc> kept;
    std::unordered_map<std::string, std::uint64_t> numbers;
    const auto numberOf = [&](const std::string& text) {
        return numbers.emplace(text, numbers.size()).first->second;
    };
    std::unordered_set<std::uint64_t> met;
    std::vector<std::uint64_t> values;
    std::string text;
    for (const gl::ProgramDesc& desc : all) {
        text.clear();
        for (const std::string& file : desc.files) text.append(file).append(1, ' ');
        const std::uint64_t files = numberOf(text);
        const std::size_t length = text.size();
        bool isNew = met.insert(files << 32).second;
        values.clear();
        for (const auto& [name, value] : desc.defines) {
            text.resize(length);
            values.push_back(numberOf(text.append(name).append(1, '=').append(value)));
        }
        for (std::size_t i = 0; i < values.size(); ++i)
            for (std::size_t k = i; k < (together == 1 ? i + 1 : values.size()); ++k)
                isNew |= met.insert(values[i] << 32 | values[k]).second;
        if (isNew) kept.push_back(desc);
    }
    return kept;
}

}  // namespace modes

namespace {

// `unlike`: leaves out what is the same with that one.
std::size_t expand(const std::vector<gl::ProgramDesc>& descs, const gl::ShaderProvider& provider,
                   const std::string& directory, const gl::ShaderProvider* unlike = nullptr) {
    std::unordered_set<std::string> written;
    for (const gl::ProgramDesc& desc : descs)
        for (const std::string& file : desc.files) {
            // Programs may share a stage.
            const std::string name = variantFile(file, desc.defines);
            if (!written.insert(name).second) continue;
            const std::string text = gl::expandShader(provider, file, desc.defines).text;
            if (unlike != nullptr && text == gl::expandShader(*unlike, file, desc.defines).text) {
                written.erase(name);
                continue;
            }
            const std::filesystem::path path = std::filesystem::path(directory) / name;
            std::error_code ignored;
            std::filesystem::create_directories(path.parent_path(), ignored);
            std::ofstream out(path, std::ios::binary);
            out << text;
            if (!out.flush())
                base::fail(ErrorKind::Runtime,
                           "%s: cannot be written; a folder with room and permission would be right",
                           path.string().c_str());
        }
    return written.size();
}

}  // namespace

std::size_t expandAllShaders(const std::string& directory, const std::string& shaderDirectory) {
    const gl::ShaderProvider provider =
        shaderDirectory.empty() ? gl::embeddedShaderProvider() : gl::directoryShaderProvider(shaderDirectory);
    std::error_code failure;
    std::filesystem::create_directories(directory, failure);
    if (!std::filesystem::is_directory(directory, failure))
        base::fail(ErrorKind::Runtime, "%s: cannot be written; a folder would be right", directory.c_str());
    const std::vector<gl::ProgramDesc> all = modes::allShaderVariants();
    // Of what is different on GPUs every value of a define, once more.
    return expand(modes::coveringVariants(all, 2), provider, directory) +
           expand(modes::coveringVariants(all, 1), gl::providerFor(gl::ExecutionProfile::Gpu, provider),
                  directory + "/gpu", &provider);
}

std::size_t expandBuiltShaders(const std::string& directory, Execution execution) {
    const gl::ExecutionProfile profile =
        execution == Execution::Gpu ? gl::ExecutionProfile::Gpu : gl::ExecutionProfile::Processor;
    return expand(gl::builtPrograms(), gl::providerFor(profile, gl::embeddedShaderProvider()), directory);
}

}  // namespace conelight

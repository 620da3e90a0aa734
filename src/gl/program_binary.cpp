// SPDX-License-Identifier: MIT
#include "gl/program_binary.h"

#include <algorithm>
#include <cstring>
#include <string_view>
#include <vector>

#include "base/log.h"
#include "gl/gl.h"
#include "gl/inputs.h"

namespace conelight::gl {
namespace {

// What stands before the driver's bytes.
struct BinaryHead {
    char magic[8];         // kBinaryMagic
    std::uint64_t check;   // of the bytes after the head
    std::uint64_t length;  // of these
    std::uint32_t format;
    std::uint32_t unused;
};
constexpr char kBinaryMagic[9] = "CNLPROG1";

std::uint64_t checkOf(std::span<const std::uint8_t> bytes) {
    return ResourceName::hashOf({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

std::vector<GLint> binaryFormats() {
    GLint count = 0;
    glGetIntegerv(GL_NUM_PROGRAM_BINARY_FORMATS, &count);
    std::vector<GLint> formats(static_cast<std::size_t>(std::max(count, 0)));
    if (count > 0) glGetIntegerv(GL_PROGRAM_BINARY_FORMATS, formats.data());
    return formats;
}

// The driver's bytes in what was kept, and their head; empty where a byte is not as it was written.
std::span<const std::uint8_t> wholeBytes(std::span<const std::uint8_t> kept, BinaryHead& head) {
    if (kept.size() <= sizeof head) return {};
    std::memcpy(&head, kept.data(), sizeof head);
    const auto bytes = kept.subspan(sizeof head);
    const bool whole = std::memcmp(head.magic, kBinaryMagic, sizeof head.magic) == 0 &&
                       head.length == bytes.size() && head.check == checkOf(bytes);
    return whole ? bytes : std::span<const std::uint8_t>{};
}

}  // namespace

std::string programKey(std::span<const ExpandedShader> stages) {
    // Two hashes of 64 bits that begin differently: texts are no attacker's.
    std::uint64_t low = ResourceName::hashOf("low"), high = ResourceName::hashOf("high");
    const auto add = [&](std::string_view text) {
        const std::string length =
            std::to_string(text.size()) + " ";  // where one text ends and another begins
        low = ResourceName::hashOf(text, ResourceName::hashOf(length, low));
        high = ResourceName::hashOf(text, ResourceName::hashOf(length, high));
    };
    for (const GLenum name : {GL_VENDOR, GL_RENDERER, GL_VERSION, GL_SHADING_LANGUAGE_VERSION}) {
        const GLubyte* text = glGetString(name);
        add(text != nullptr ? reinterpret_cast<const char*>(text) : "");
    }
    for (const ExpandedShader& stage : stages) {
        add(stage.path);
        add(stage.text);
    }
    return base::format("%016llx%016llx", static_cast<unsigned long long>(high),
                        static_cast<unsigned long long>(low));
}

void wantBinary(Name program) { glProgramParameteri(program, GL_PROGRAM_BINARY_RETRIEVABLE_HINT, GL_TRUE); }

void keepBinary(Name program, const std::string& key, ProgramCache& cache) {
    GLint length = 0;
    if (binaryFormats().empty()) return;
    glGetProgramiv(program, GL_PROGRAM_BINARY_LENGTH, &length);
    if (length <= 0) return;
    std::vector<std::uint8_t> kept(sizeof(BinaryHead) + static_cast<std::size_t>(length));
    GLsizei written = 0;
    GLenum format = 0;
    glGetProgramBinary(program, length, &written, &format, kept.data() + sizeof(BinaryHead));
    if (written <= 0) return;
    kept.resize(sizeof(BinaryHead) + static_cast<std::size_t>(written));
    BinaryHead head{};
    std::memcpy(head.magic, kBinaryMagic, sizeof head.magic);
    const auto bytes = std::span(kept).subspan(sizeof head);
    head.check = checkOf(bytes);
    head.length = bytes.size();
    head.format = format;
    std::memcpy(kept.data(), &head, sizeof head);
    cache.keep(key, kept);
}

bool linkBinary(Name program, const std::string& key, const std::string& label, ProgramCache& cache) {
    const std::vector<GLint> formats = binaryFormats();
    if (formats.empty()) return false;
    const std::vector<std::uint8_t> kept = cache.load(key);
    if (kept.empty()) return false;
    BinaryHead head{};
    const auto bytes = wholeBytes(kept, head);
    const char* why = "is damaged";
    if (!bytes.empty()) {
        why = "is of no use to this driver";
        // A format that the driver does not list would be an error.
        if (std::count(formats.begin(), formats.end(), static_cast<GLint>(head.format)) > 0) {
            glProgramBinary(program, head.format, bytes.data(), static_cast<GLsizei>(bytes.size()));
            GLint linked = 0;
            glGetProgramiv(program, GL_LINK_STATUS, &linked);
            if (linked != GL_FALSE) return true;
        }
    }
    base::log(LogLevel::Warning, base::format("program cache: %s: what was kept %s; built from its sources",
                                              label.c_str(), why));
    return false;
}

}  // namespace conelight::gl

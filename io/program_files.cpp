// SPDX-License-Identifier: MIT
#include "io/program_files.h"

#include <algorithm>
#include <utility>

#include "conelight/error.h"
#include "io/files.h"

namespace conelight::io {
namespace {

namespace fs = std::filesystem;

constexpr const char* kProgramEnding = ".program";
constexpr std::uint64_t kMostProgramBytes = std::uint64_t(64) << 20;  // of one; what is larger is no program

struct KeptFile {
    fs::path path;
    fs::file_time_type used;
    std::uint64_t bytes;
};

// Other processes may remove files meanwhile.
std::vector<KeptFile> keptIn(const fs::path& folder) {
    std::vector<KeptFile> files;
    std::error_code code;
    for (fs::directory_iterator at(folder, code), end; !code && at != end; at.increment(code)) {
        std::error_code gone;
        if (at->path().extension() != kProgramEnding || !at->is_regular_file(gone)) continue;
        const std::uint64_t bytes = at->file_size(gone);
        const fs::file_time_type used = at->last_write_time(gone);
        if (!gone) files.push_back({at->path(), used, bytes});
    }
    return files;
}

}  // namespace

ProgramFiles::ProgramFiles(fs::path folder, bool always, std::uint64_t mostBytes)
    : folder_(std::move(folder)), always_(always), mostBytes_(mostBytes) {}

fs::path ProgramFiles::fileOf(const std::string& key) const { return folder_ / (key + kProgramEnding); }

std::vector<std::uint8_t> ProgramFiles::load(const std::string& key) {
    const fs::path file = fileOf(key);
    std::error_code ignored;
    if (!fs::is_regular_file(file, ignored)) return {};
    try {
        Bytes bytes = readFile(file, kMostProgramBytes);
        fs::last_write_time(file, fs::file_time_type::clock::now(), ignored);
        return bytes;
    } catch (const Error&) {
        return {};
    }
}

void ProgramFiles::keep(const std::string& key, std::span<const std::uint8_t> bytes) {
    if (!writable_) return;
    std::error_code code;
    fs::create_directories(folder_, code);
    try {
        writeFile(fileOf(key), bytes);
    } catch (const Error&) {
        writable_ = false;
        return;
    }
    bytes_ += bytes.size();
    if (!counted_ || bytes_ > mostBytes_) trim();
}

void ProgramFiles::trim() {
    std::vector<KeptFile> files = keptIn(folder_);
    counted_ = true;
    bytes_ = 0;
    for (const KeptFile& file : files) bytes_ += file.bytes;
    if (bytes_ <= mostBytes_) return;
    std::sort(files.begin(), files.end(), [](const KeptFile& a, const KeptFile& b) {
        return a.used != b.used ? a.used < b.used : a.path < b.path;
    });
    // A quarter more, so that not each file that follows looks through the folder.
    for (const KeptFile& file : files) {
        if (bytes_ <= mostBytes_ - mostBytes_ / 4) break;
        std::error_code ignored;
        fs::remove(file.path, ignored);
        bytes_ -= file.bytes;
    }
}

fs::path programFolder() {
    const fs::path cache = userFolder("XDG_CACHE_HOME", ".cache");
    return cache.empty() ? cache : cache / "conelight" / "programs";
}

}  // namespace conelight::io

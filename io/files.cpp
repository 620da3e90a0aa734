// SPDX-License-Identifier: MIT
// Files as bytes: see files.h. Rename within a folder is atomic on every POSIX file system.
#include "io/files.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <utility>

#include "conelight/error.h"

namespace conelight::io {

namespace fs = std::filesystem;

namespace {

struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

[[noreturn]] void failRead(const fs::path& path, const std::string& why) {
    throw Error(ErrorKind::BadInput, fmt::format("{}: {}", oneLine(path.string()), why));
}

[[noreturn]] void failWrite(const fs::path& path, const std::string& why) {
    throw Error(ErrorKind::Runtime, fmt::format("{}: cannot be written: {}", oneLine(path.string()), why));
}

std::string lowerErrno(int code) {
    std::string text = std::strerror(code);
    if (!text.empty() && text[0] >= 'A' && text[0] <= 'Z') text[0] = char(text[0] - 'A' + 'a');
    return text;
}

int hexDigit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
}

// Writes all bytes through stdio; the errno of the first failure, 0 when all arrived.
int writeAll(const fs::path& path, std::span<const std::uint8_t> bytes) {
    File file(std::fopen(path.c_str(), "wb"));
    if (!file) return errno;
    if (!bytes.empty() && std::fwrite(bytes.data(), 1, bytes.size(), file.get()) != bytes.size())
        return errno != 0 ? errno : EIO;
    std::FILE* raw = file.release();
    return std::fclose(raw) == 0 ? 0 : errno;
}

// A file's new content beside its place, until it is renamed; else it goes with this.
struct Staged {
    fs::path target, part;

    Staged(fs::path place, fs::path beside) : target(std::move(place)), part(std::move(beside)) {}
    Staged(Staged&& other) noexcept
        : target(std::move(other.target)), part(std::exchange(other.part, fs::path())) {}
    Staged& operator=(Staged&&) = delete;
    ~Staged() {
        std::error_code ignored;
        if (!part.empty()) fs::remove(part, ignored);
    }
    std::error_code moveIntoPlace() {
        std::error_code code;
        fs::rename(part, target, code);
        if (!code) part.clear();
        return code;
    }
};

// A link is kept: what it leads to is replaced.
fs::path withoutLink(const fs::path& path) {
    std::error_code code;
    if (!fs::is_symlink(fs::symlink_status(path, code))) return path;
    const fs::path resolved = fs::weakly_canonical(path, code);
    return code ? path : resolved;
}

// Throws for what no file can be written to; whether it is a special file, which is written at once.
bool isSpecial(const fs::path& path) {
    if (path.empty()) throw Error(ErrorKind::Usage, "output: empty file name; give a path");
    std::error_code code;
    const fs::file_status status = fs::status(path, code);
    if (fs::is_directory(status)) failWrite(path, "it is a folder; give a file name");
    return fs::exists(status) && !fs::is_regular_file(status);
}

// Nothing for special files.
std::optional<Staged> stage(const fs::path& path, std::span<const std::uint8_t> bytes) {
    if (isSpecial(path)) {
        if (const int failure = writeAll(path, bytes)) failWrite(path, lowerErrno(failure));
        return std::nullopt;
    }
    Staged staged(withoutLink(path), newFileBeside(path, ".part"));
    if (const int failure = writeAll(staged.part, bytes)) failWrite(path, lowerErrno(failure));
    return staged;
}

}  // namespace

std::string whyNotRegular(const fs::file_status& status) {
    if (fs::is_regular_file(status)) return {};
    if (fs::is_directory(status)) return "is a folder; a file is needed";
    return "is a pipe, device or socket; only regular files are read";
}

Bytes readFile(const fs::path& path, std::uint64_t maxBytes) {
    std::error_code code;
    const fs::file_status status = fs::status(path, code);
    if (!fs::exists(status)) failRead(path, "no such file");
    const std::string unusual = whyNotRegular(status);
    if (!unusual.empty()) failRead(path, unusual);
    // Should the file become a pipe in between, opening does not wait for a writer.
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    if (descriptor < 0) failRead(path, "cannot be opened: " + lowerErrno(errno));
    const File file(::fdopen(descriptor, "rb"));
    if (!file) failRead(path, "cannot be opened: " + lowerErrno(errno));
    struct stat state {};
    if (::fstat(descriptor, &state) != 0 || !S_ISREG(state.st_mode))
        failRead(path, "is no regular file any more");
    if (std::uint64_t(state.st_size) > maxBytes)
        failRead(path, fmt::format("has {} bytes; at most {} are read", state.st_size, maxBytes));

    // The size may be wrong (/proc, a file that grows): pieces follow until the end.
    constexpr std::size_t kPiece = std::size_t(1) << 16;  // chosen: large enough that calls do not count
    Bytes bytes(std::size_t(state.st_size) + 1);
    for (std::size_t used = 0;;) {
        const std::size_t wanted = bytes.size() - used;
        const std::size_t got = std::fread(bytes.data() + used, 1, wanted, file.get());
        used += got;
        if (used > maxBytes) failRead(path, fmt::format("is larger than {} bytes", maxBytes));
        if (got < wanted) {
            bytes.resize(used);
            break;
        }
        bytes.resize(used + kPiece);
    }
    if (std::ferror(file.get()) != 0) failRead(path, "cannot be read: " + lowerErrno(errno));
    return bytes;
}

void refuseOverwriting(const std::string& path, bool overwrite) {
    std::error_code code;
    if (!overwrite && fs::exists(fs::symlink_status(path, code)))
        throw Error(
            ErrorKind::Usage,
            fmt::format("{}: is there already; another name, or overwrite, would be right", oneLine(path)));
}

fs::path newFileBeside(const fs::path& path, const std::string& ending) {
    constexpr std::size_t kNameBytes = 100;  // of the target's: file systems take 255 in all
    const fs::path target = withoutLink(path);
    const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
    std::error_code code;
    if (!fs::exists(folder, code))
        failWrite(path, fmt::format("folder {} does not exist", oneLine(folder.string())));
    const std::string name = target.filename().string().substr(0, kNameBytes);
    static std::atomic<unsigned> counter{0};
    for (;;) {
        fs::path made = folder / fmt::format(".{}.{}-{}{}", name, ::getpid(), counter++, ending);
        const int descriptor = ::open(made.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (descriptor >= 0) {
            ::close(descriptor);
            return made;
        }
        if (errno != EEXIST) failWrite(path, lowerErrno(errno));
    }
}

void checkWritable(const fs::path& path) {
    if (isSpecial(path)) return;
    std::error_code ignored;
    fs::remove(newFileBeside(path, ".probe"), ignored);
}

void writeFile(const fs::path& path, std::span<const std::uint8_t> bytes) {
    if (std::optional<Staged> staged = stage(path, bytes))
        if (const std::error_code code = staged->moveIntoPlace()) failWrite(path, code.message());
}

void writeFiles(const std::vector<std::pair<fs::path, Bytes>>& files) {
    std::vector<Staged> staged;
    for (const auto& [path, bytes] : files)
        if (std::optional<Staged> one = stage(path, bytes)) staged.push_back(std::move(*one));
    // The old files live on under other names until all new ones are in place.
    std::error_code ignored;
    std::vector<fs::path> backups(staged.size());
    for (std::size_t i = 0; i < staged.size(); ++i) {
        std::error_code code;
        if (fs::exists(staged[i].target, code)) {
            backups[i] = newFileBeside(staged[i].target, ".old");
            fs::remove(backups[i], code);
            fs::create_hard_link(staged[i].target, backups[i], code);
            if (code) fs::rename(staged[i].target, backups[i], code);  // a file system without links
        }
        if (!code) code = staged[i].moveIntoPlace();
        if (!code) continue;
        for (std::size_t k = 0; k <= i; ++k) {
            if (k < i && backups[k].empty()) fs::remove(staged[k].target, ignored);
            if (!backups[k].empty()) fs::rename(backups[k], staged[k].target, ignored);
        }
        for (const fs::path& backup : backups) fs::remove(backup, ignored);
        failWrite(staged[i].target, code.message());
    }
    for (const fs::path& backup : backups)
        if (!backup.empty()) fs::remove(backup, ignored);
}

std::string percentDecoded(std::string_view text) {
    std::string out;
    out.reserve(text.size());
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '%' && i + 2 < text.size() && hexDigit(text[i + 1]) >= 0 &&
            hexDigit(text[i + 2]) >= 0) {
            out.push_back(char(hexDigit(text[i + 1]) * 16 + hexDigit(text[i + 2])));
            i += 2;
        } else {
            out.push_back(text[i]);
        }
    }
    return out;
}

std::string base64Encoded(std::span<const std::uint8_t> bytes) {
    static const char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t left = bytes.size() - i;
        const std::uint32_t three = std::uint32_t(bytes[i]) << 16 |
                                    (left > 1 ? std::uint32_t(bytes[i + 1]) << 8 : 0) |
                                    (left > 2 ? bytes[i + 2] : 0u);
        text += kDigits[three >> 18];
        text += kDigits[three >> 12 & 63];
        text += left > 1 ? kDigits[three >> 6 & 63] : '=';
        text += left > 2 ? kDigits[three & 63] : '=';
    }
    return text;
}

std::optional<Bytes> base64Decoded(std::string_view text) {
    Bytes out;
    out.reserve(text.size() / 4 * 3);
    std::uint32_t bits = 0;
    int bitCount = 0;
    for (const char c : text) {
        int value = -1;
        if (c >= 'A' && c <= 'Z')
            value = c - 'A';
        else if (c >= 'a' && c <= 'z')
            value = c - 'a' + 26;
        else if (c >= '0' && c <= '9')
            value = c - '0' + 52;
        else if (c == '+' || c == '-')
            value = 62;  // '-' and '_': the URL-safe alphabet
        else if (c == '/' || c == '_')
            value = 63;
        else if (c == '=')
            break;
        else if (c == ' ' || c == '\n' || c == '\r' || c == '\t')
            continue;
        else
            return std::nullopt;
        bits = (bits << 6) | std::uint32_t(value);
        bitCount += 6;
        if (bitCount >= 8) {
            bitCount -= 8;
            out.push_back(std::uint8_t(bits >> bitCount));
        }
    }
    return out;
}

fs::path userFolder(const char* variable, const char* belowHome) {
    const char* named = std::getenv(variable);
    if (named != nullptr && named[0] == '/') return named;
    const char* home = std::getenv("HOME");
    if (home != nullptr && home[0] == '/') return fs::path(home) / belowHome;
    return {};
}

std::string lowerExtension(const fs::path& path) {
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; });
    return extension;
}

std::string oneLine(std::string_view text, std::size_t maxLength) {
    std::string out;
    for (const char c : text.substr(0, maxLength)) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte < 0x20 || byte == 0x7f) {
            if (!out.empty() && out.back() != ' ') out.push_back(' ');
        } else {
            out.push_back(c);
        }
    }
    while (!out.empty() && out.back() == ' ') out.pop_back();
    if (text.size() > maxLength) out += "...";
    return out;
}

void checkFolder(const std::filesystem::path& folder, const std::vector<std::string>& names, bool overwrite) {
    std::error_code failed;
    std::filesystem::create_directories(folder, failed);
    if (failed || !std::filesystem::is_directory(folder))
        throw Error(ErrorKind::Runtime, folder.string() + ": is no folder and cannot be made one");
    for (const std::string& name : names) {
        refuseOverwriting((folder / name).string(), overwrite);
        checkWritable(folder / name);
    }
}

}  // namespace conelight::io

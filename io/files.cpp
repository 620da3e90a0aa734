// SPDX-License-Identifier: MIT
// Files as bytes: see files.h. Rename within a folder is atomic on every POSIX file system.
#include "io/files.h"

#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

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

// A file's new content beside its place.
struct Staged {
    fs::path target, part;
};

// Nothing for special files, which are written at once.
std::optional<Staged> stage(const fs::path& path, std::span<const std::uint8_t> bytes) {
    if (path.empty()) throw Error(ErrorKind::Usage, "output: empty file name; give a path");
    std::error_code code;
    const fs::file_status status = fs::status(path, code);
    if (fs::is_directory(status)) failWrite(path, "it is a folder; give a file name");
    if (fs::exists(status) && !fs::is_regular_file(status)) {
        if (const int failure = writeAll(path, bytes)) failWrite(path, lowerErrno(failure));
        return std::nullopt;
    }
    // A link is kept: its target is replaced.
    fs::path target = path;
    if (fs::is_symlink(fs::symlink_status(path, code))) {
        const fs::path resolved = fs::weakly_canonical(path, code);
        if (!code) target = resolved;
    }
    const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
    if (!fs::exists(folder, code))
        failWrite(path, fmt::format("folder {} does not exist", oneLine(folder.string())));

    // The process and a counter make the name unique among writers of the same folder.
    static std::atomic<unsigned> counter{0};
    const fs::path part =
        folder / fmt::format(".{}.{}-{}.part", target.filename().string(), ::getpid(), counter++);
    if (const int failure = writeAll(part, bytes)) {
        fs::remove(part, code);
        failWrite(path, lowerErrno(failure));
    }
    return Staged{target, part};
}

}  // namespace

Bytes readFile(const fs::path& path, std::uint64_t maxBytes) {
    std::error_code code;
    const fs::file_status status = fs::status(path, code);
    if (!fs::exists(status)) failRead(path, "no such file");
    if (fs::is_directory(status)) failRead(path, "is a folder; a file is needed");
    File file(std::fopen(path.c_str(), "rb"));
    if (!file) failRead(path, "cannot be opened: " + lowerErrno(errno));

    // Read in growing pieces, which also serves pipes; the size of a regular file only reserves.
    Bytes bytes;
    if (fs::is_regular_file(status)) {
        const std::uintmax_t size = fs::file_size(path, code);
        if (!code && size > maxBytes)
            failRead(path, fmt::format("has {} bytes; at most {} are read", size, maxBytes));
        if (!code) bytes.reserve(std::size_t(size) + 1);
    }
    constexpr std::size_t kPiece = std::size_t(1) << 20;  // chosen: large enough that calls do not count
    for (;;) {
        const std::size_t used = bytes.size();
        bytes.resize(used + kPiece);
        const std::size_t got = std::fread(bytes.data() + used, 1, kPiece, file.get());
        bytes.resize(used + got);
        if (bytes.size() > maxBytes) failRead(path, fmt::format("is larger than {} bytes", maxBytes));
        if (got < kPiece) break;
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

void writeFile(const fs::path& path, std::span<const std::uint8_t> bytes) {
    if (const std::optional<Staged> staged = stage(path, bytes)) {
        std::error_code code;
        fs::rename(staged->part, staged->target, code);
        if (!code) return;
        const std::string why = code.message();
        fs::remove(staged->part, code);
        failWrite(path, why);
    }
}

void writeFiles(const std::vector<std::pair<fs::path, Bytes>>& files) {
    std::vector<Staged> staged;
    std::error_code ignored;
    try {
        for (const auto& [path, bytes] : files)
            if (std::optional<Staged> one = stage(path, bytes)) staged.push_back(std::move(*one));
    } catch (const Error&) {
        for (const Staged& one : staged) fs::remove(one.part, ignored);
        throw;
    }
    // The old files live on under other names until all new ones are in place.
    std::vector<fs::path> backups(staged.size());
    for (std::size_t i = 0; i < staged.size(); ++i) {
        std::error_code code;
        if (fs::exists(staged[i].target, code)) {
            backups[i] = staged[i].part;
            backups[i] += ".old";
            fs::create_hard_link(staged[i].target, backups[i], code);
            if (code) fs::rename(staged[i].target, backups[i], code);  // a file system without links
        }
        if (!code) fs::rename(staged[i].part, staged[i].target, code);
        if (!code) continue;
        for (std::size_t k = 0; k <= i; ++k) {
            if (k < i && backups[k].empty()) fs::remove(staged[k].target, ignored);
            if (!backups[k].empty()) fs::rename(backups[k], staged[k].target, ignored);
        }
        for (const Staged& one : staged) fs::remove(one.part, ignored);
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

}  // namespace conelight::io

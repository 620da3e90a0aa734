// SPDX-License-Identifier: MIT
// Whole files in and out as bytes: reading with a clear error, writing beside and renaming so that a reader
// never sees half a file, and the two encodings URIs use (percent signs, base64).
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace conelight::io {

using Bytes = std::vector<std::uint8_t>;

// What is read at most of a file without a limit of its own. Larger files of one scene are not known.
constexpr std::uint64_t kMostFileBytes = std::uint64_t(2) << 30;

// Reads a whole regular file; pipes and devices may never end and are refused unread. Throws Error(BadInput)
// that names the path: missing, not regular, not readable, or larger than `maxBytes`.
Bytes readFile(const std::filesystem::path& path, std::uint64_t maxBytes = kMostFileBytes);

// Why something of that kind is not read: "" for a regular file.
std::string whyNotRegular(const std::filesystem::file_status& status);

// Writes `bytes` to a file beside `path` and renames it over `path`; a special file (/dev/stdout) is written
// directly. Throws Error(Runtime) that names the path; nothing is left behind then.
void writeFile(const std::filesystem::path& path, std::span<const std::uint8_t> bytes);

// Writes files that belong together, in this order: all beside their places first, then all renamed. Should
// one fail, what was there before is there again. Throws Error(Runtime) that names the path.
void writeFiles(const std::vector<std::pair<std::filesystem::path, Bytes>>& files);

// Before long work: makes the folder, and throws what refuseOverwriting and checkWritable throw for files in it;
// Error(Runtime) when there is no folder and none can be made.
void checkFolder(const std::filesystem::path& folder, const std::vector<std::string>& names, bool overwrite);

// Throws Error(Runtime) when no file could be written at `path`: to be called before long work.
void checkWritable(const std::filesystem::path& path);

// A new empty file in the folder of `path`, hidden, of a name that nothing had: whoever asks removes or
// renames it. `ending` with its dot. Throws Error(Runtime) that names `path`.
std::filesystem::path newFileBeside(const std::filesystem::path& path, const std::string& ending);

// Throws Error(Usage) when there is anything of that name and `overwrite` is not given.
void refuseOverwriting(const std::string& path, bool overwrite);

// "a%20b" -> "a b"; a percent sign without two hex digits stays.
std::string percentDecoded(std::string_view text);

std::string base64Encoded(std::span<const std::uint8_t> bytes);
// Bytes of base64 text, white space ignored; nothing when a character does not belong there.
std::optional<Bytes> base64Decoded(std::string_view text);

// The user's folder that the variable names (XDG_CACHE_HOME), else the one of that path below $HOME (.cache); empty where
// neither is an absolute path.
std::filesystem::path userFolder(const char* variable, const char* belowHome);

// Extension in lower case with its dot, "" if none.
std::string lowerExtension(const std::filesystem::path& path);

// `text` as one printable line of at most `maxLength` characters: line ends and control characters become
// spaces. For names and messages that come from files.
std::string oneLine(std::string_view text, std::size_t maxLength = 200);

}  // namespace conelight::io

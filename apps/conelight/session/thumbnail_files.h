// SPDX-License-Identifier: MIT
// Thumbnails of scenes where desktops keep them (freedesktop.org, "Thumbnail Managing Standard" 0.9):
// $XDG_CACHE_HOME/thumbnails, a PNG by the MD5 of the file's URI, with the time at which the file was changed. Those
// of generated scenes, which are no files, are kept beside them in the folder `conelight`.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace conelight::program {

std::string md5Of(std::string_view bytes);  // 32 hexadecimal digits (RFC 1321)

// "file:///home/a%20b.glb".
std::string uriOf(const std::filesystem::path& file);

// Where the thumbnail of a scene is, of at most 256 pixels along an edge, whether it is there or not; "" without a home.
std::string thumbnailPath(const std::string& scene);
// One that is there and belongs to the file as it is now, of any size.
std::optional<std::string> thumbnailOf(const std::string& scene);
// Texts of a thumbnail's header that say what it is of. Empty for generated scenes.
std::vector<std::pair<std::string, std::string>> thumbnailTexts(const std::string& scene);

}  // namespace conelight::program

// SPDX-License-Identifier: MIT
// Files as strangers send them: truncated, lying, hostile, or valid and odd. Generated, so that the
// repository holds no binary files and each says what is special about it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace conelight::test {

enum class Expect {
    Loads,
    Refused,  // one line that names the file, exit status 3
    Either,   // one of the two: what a part of the file is worth is the reader's choice
};

struct CorpusFile {
    std::filesystem::path path;
    Expect expect;
};

// Each writes into `folder` and returns what the program is to be given.
std::vector<CorpusFile> gltfCorpus(const std::filesystem::path& folder);
// Binary glTF compressed in those ways that this build reads.
enum class Packing { Draco, Meshopt, Webp };
std::vector<CorpusFile> compressedCorpus(const std::filesystem::path& folder,
                                         const std::vector<Packing>& packings);
std::vector<CorpusFile> objCorpus(const std::filesystem::path& folder);
std::vector<CorpusFile> thesisCorpus(const std::filesystem::path& folder);
std::vector<CorpusFile> pictureCorpus(const std::filesystem::path& folder);
std::vector<CorpusFile> cameraPathCorpus(const std::filesystem::path& folder);
std::vector<CorpusFile> presetCorpus(const std::filesystem::path& folder);
std::vector<CorpusFile> coneSetCorpus(const std::filesystem::path& folder);
std::vector<CorpusFile> batchJobCorpus(const std::filesystem::path& folder);
std::vector<CorpusFile> scriptCorpus(const std::filesystem::path& folder);

}  // namespace conelight::test

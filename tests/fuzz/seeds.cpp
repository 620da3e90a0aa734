// SPDX-License-Identifier: MIT
// fuzz_seeds DIR: what the fuzz targets start from, a folder each: the files of the tests' corpus.
#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "support/corpus.h"

namespace {

namespace fs = std::filesystem;

// Pipes, devices and folders of the corpus are nothing to start from.
void copyFiles(const fs::path& from, const fs::path& to, const std::vector<std::string>& endings) {
    fs::create_directories(to);
    int number = 0;
    for (const fs::directory_entry& entry :
         fs::recursive_directory_iterator(from, fs::directory_options::skip_permission_denied)) {
        std::error_code loop;  // a link to itself has no status
        const std::string ending = entry.path().extension().string();
        const bool wanted = !entry.is_symlink(loop) && entry.is_regular_file(loop) &&
                            entry.file_size() < 1 << 16 &&
                            std::find(endings.begin(), endings.end(), ending) != endings.end();
        if (wanted) fs::copy_file(entry.path(), to / (std::to_string(number++) + ending));
    }
}

}  // namespace

int main(int count, char** arguments) {
    if (count != 2) {
        std::fputs("usage: fuzz_seeds DIR\n", stderr);
        return 2;
    }
    using namespace conelight::test;
    const fs::path folder = arguments[1];
    const fs::path corpus = folder / "corpus";
    fs::create_directories(corpus / "gltf");
    fs::create_directories(corpus / "obj");
    fs::create_directories(corpus / "thesis");
    fs::create_directories(corpus / "picture");
    gltfCorpus(corpus / "gltf");
    objCorpus(corpus / "obj");
    thesisCorpus(corpus / "thesis");
    pictureCorpus(corpus / "picture");
    copyFiles(corpus / "gltf", folder / "gltf", {".gltf"});
    copyFiles(corpus / "obj", folder / "obj", {".obj", ".mtl"});
    copyFiles(corpus / "thesis", folder / "thesis", {".txt"});
    copyFiles(corpus / "picture", folder / "picture", {".png", ".jpg", ".jpeg"});
    return 0;
}

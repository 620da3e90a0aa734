// SPDX-License-Identifier: MIT
#include "batch/folder.h"

#include <fmt/core.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "batch/sha256.h"
#include "conelight/error.h"
#include "io/files.h"
#include "io/image_file.h"
#include "provenance.h"

namespace conelight::program {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

// One name below batch/ for each task.
std::string keyOf(const BatchTask& task) {
    std::string key = task.files.front();
    for (std::size_t at = 0; (at = key.find_first_of("/_", at)) != std::string::npos; at += 2)
        key.replace(at, 1, key[at] == '/' ? "_s" : "__");
    return key;
}

void makeFolder(const fs::path& path) {
    std::error_code code;
    fs::create_directories(path, code);
    if (code)
        throw Error(ErrorKind::Runtime,
                    fmt::format("{}: cannot be made ({})", io::oneLine(path.string()), code.message()));
}

// What the picture's header says of its device.
std::string deviceOf(const fs::path& file) {
    const io::ImageFormat format = io::imageFormatOf(file);
    std::vector<std::pair<std::string, std::string>> texts;
    if (format == io::ImageFormat::Exr) texts = io::readExr(file).attributes;
    if (format == io::ImageFormat::Png) texts = io::readByteImage(file).attributes;
    for (const auto& [name, text] : texts)
        if (name == "Device") return text;
    return {};
}

// Buffers and pictures that a .gltf names; what cannot be read is found out by `render`.
std::vector<fs::path> namedBy(const std::string& file) {
    std::vector<fs::path> found;
    if (io::lowerExtension(file) != ".gltf") return found;
    const io::Bytes bytes = io::readFile(file);
    const Json root = Json::parse(bytes.begin(), bytes.end(), nullptr, false);
    if (!root.is_object()) return found;
    for (const char* list : {"buffers", "images"})
        for (const Json& one : root.value(list, Json::array())) {
            if (!one.is_object() || !one.contains("uri") || !one["uri"].is_string()) continue;
            const std::string uri = io::percentDecoded(one["uri"].get<std::string>());
            std::error_code code;
            const fs::path path = fs::path(file).parent_path() / uri;
            if (uri.rfind("data:", 0) != 0 && fs::is_regular_file(path, code)) found.push_back(path);
        }
    return found;
}

}  // namespace

std::string BatchFolder::fingerprint(const BatchTask& task) {
    std::string text = softwareName() + '\n';
    for (const std::string& word : task.words) text += word + '\n';
    text += task.output + '\n';
    for (const std::string& input : task.inputs) {
        std::string& hash = inputs_[input];
        if (hash.empty()) {
            std::string all = sha256OfFile(input);
            for (const fs::path& named : namedBy(input)) all += sha256OfFile(named);
            hash = sha256Of(all);
        }
        text += hash + '\n';
    }
    return sha256Of(text);
}

std::filesystem::path BatchFolder::recordFile(const BatchTask& task) const {
    return path_ / "batch" / "records" / (keyOf(task) + ".json");
}

std::filesystem::path BatchFolder::logOf(const BatchTask& task) const {
    return path_ / "batch" / "logs" / (keyOf(task) + ".txt");
}

std::optional<BatchRecord> BatchFolder::recordOf(const BatchTask& task) const {
    std::error_code code;
    if (!fs::is_regular_file(recordFile(task), code)) return std::nullopt;
    const io::Bytes bytes = io::readFile(recordFile(task), 1 << 26);
    const Json root = Json::parse(bytes.begin(), bytes.end(), nullptr, false);
    try {
        BatchRecord record{root.at("fingerprint"), {}, root.at("device"), root.at("seconds")};
        for (const Json& file : root.at("files"))
            record.files.push_back({file.at("name"), file.at("sha256"), file.at("bytes")});
        return record;
    } catch (const Json::exception&) {
        return std::nullopt;  // of another program: as if it were not there
    }
}

bool BatchFolder::isDone(const BatchTask& task) {
    const std::optional<BatchRecord> record = recordOf(task);
    if (!record || record->files.size() != task.files.size() || record->fingerprint != fingerprint(task))
        return false;
    for (const BatchFile& file : record->files) {
        std::error_code code;
        if (fs::file_size(at(file.name), code) != file.bytes || code) return false;
    }
    return true;
}

void BatchFolder::refuseForeignFiles(const std::vector<BatchTask>& tasks) const {
    for (const BatchTask& task : tasks) {
        std::error_code code;
        if (fs::exists(recordFile(task), code)) continue;
        for (const std::string& file : task.files)
            if (fs::exists(at(file), code))
                throw Error(ErrorKind::Usage,
                            fmt::format("{}: is there already, and no batch has made it; another folder "
                                        "would be right",
                                        io::oneLine(at(file).string())));
    }
}

std::filesystem::path BatchFolder::makePartial(const BatchTask& task) const {
    makeFolder(logOf(task).parent_path());
    makeFolder(recordFile(task).parent_path());
    makeFolder(path_ / "batch" / "partial");
    std::string name = (path_ / "batch" / "partial" / "XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr)
        throw Error(ErrorKind::Runtime, io::oneLine(name) + ": no folder can be made there");
    makeFolder((fs::path(name) / task.output).parent_path());
    return name;
}

void BatchFolder::take(const BatchTask& task, const std::filesystem::path& partial, double seconds) {
    BatchRecord record{fingerprint(task), {}, {}, seconds};
    for (const std::string& file : task.files) {
        std::error_code code;
        const std::uintmax_t bytes = fs::file_size(partial / file, code);
        if (code) throw Error(ErrorKind::Runtime, io::oneLine(file) + ": was not written");
        record.files.push_back({file, sha256OfFile(partial / file), bytes});
    }
    record.device = deviceOf(partial / task.files.front());
    Json json = {{"fingerprint", record.fingerprint},
                 {"device", record.device},
                 {"seconds", record.seconds},
                 {"files", Json::array()}};
    for (const BatchFile& file : record.files)
        json["files"].push_back({{"name", file.name}, {"sha256", file.sha256}, {"bytes", file.bytes}});
    // First the record: a file without one is somebody else's.
    const std::string text = json.dump(1) + "\n";
    io::writeFile(recordFile(task), {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
    for (const std::string& file : task.files) {
        makeFolder(at(file).parent_path());
        std::error_code code;
        fs::rename(partial / file, at(file), code);
        if (code)
            throw Error(ErrorKind::Runtime, fmt::format("{}: cannot be written ({})",
                                                        io::oneLine(at(file).string()), code.message()));
    }
}

}  // namespace conelight::program

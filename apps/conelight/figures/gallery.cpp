// SPDX-License-Identifier: MIT
#include "figures/gallery.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "conelight/error.h"
#include "interrupt.h"
#include "io/files.h"

namespace conelight::figures {
namespace {

namespace fs = std::filesystem;
constexpr const char* kGenerator = "conelight figures";
constexpr const char* kList = "figures.json";
constexpr const char* kPage = "index.html";

std::vector<std::uint8_t> bytesOf(const std::string& text) { return {text.begin(), text.end()}; }

const Figure* figureOf(const std::string& id) {
    for (const Figure& figure : allFigures())
        if (figure.id == id) return &figure;
    return nullptr;
}

std::string escaped(std::string_view text) {
    std::string out;
    for (const char c : text) out += c == '&' ? "&amp;" : c == '<' ? "&lt;" : std::string(1, c);
    return out;
}

constexpr const char* kHead = R"(<!doctype html>
<html lang="en"><head><meta charset="utf-8"><meta name="generator" content="conelight figures">
<meta name="viewport" content="width=device-width"><title>Figures of the thesis, drawn by Conelight</title>
<style>
body{font:16px/1.5 system-ui,sans-serif;color:#1f2430;background:#f4f5f8;margin:0 auto;max-width:1200px;padding:1rem}
section{background:#fff;border-radius:8px;padding:1rem 1.5rem;margin:1rem 0;box-shadow:0 1px 3px #0002}
h2{margin:.2rem 0;font-size:1.15rem}h2 span{color:#8b93a3;font-weight:normal;margin-right:.5rem}
.panels{display:flex;flex-wrap:wrap;gap:1rem;margin:.8rem 0}figure{margin:0}
img{max-width:100%;height:auto}figcaption{text-align:center;font-size:.9rem;color:#4a5160}
code{background:#eef1f6;padding:.1rem .3rem;border-radius:3px}p{max-width:75ch}
</style></head><body>
<h1>Figures of the thesis, drawn by Conelight</h1>
)";

}  // namespace

Gallery::Gallery(const std::string& directory) : directory_(directory) {
    std::error_code code;
    fs::create_directories(directory_, code);
    if (!fs::is_directory(directory_))
        throw Error(
            ErrorKind::Runtime,
            fmt::format("{}: cannot be made as a folder; a name that is free would be right", directory));
    read();
}

void Gallery::read() {
    const fs::path list = directory_ / kList;
    if (!fs::exists(list)) {
        refuseForeign(kPage);
        return;
    }
    const io::Bytes bytes = io::readFile(list, 1 << 24);
    const nlohmann::json json = nlohmann::json::parse(bytes.begin(), bytes.end(), nullptr, false);
    const bool ours = json.is_object() && json.value("generator", nlohmann::json()) == kGenerator &&
                      json.contains("figures") && json["figures"].is_array();
    if (!ours)
        throw Error(
            ErrorKind::Usage,
            fmt::format("{}: is not of `conelight figures`; another folder would be right", list.string()));
    for (const nlohmann::json& one : json["figures"]) {
        if (!one.is_object() || !one.contains("files") || !one["files"].is_array()) continue;
        Entry entry{one.value("id", std::string()), {}};
        for (const nlohmann::json& file : one["files"])
            if (file.is_object())
                entry.files.push_back(
                    {file.value("file", std::string()), file.value("label", std::string())});
        if (figureOf(entry.id) != nullptr) entries_.push_back(std::move(entry));
    }
}

void Gallery::refuseForeign(const std::string& file) const {
    for (const Entry& entry : entries_)
        for (const File& one : entry.files)
            if (one.name == file) return;
    if (fs::exists(fs::symlink_status(directory_ / file)))
        throw Error(ErrorKind::Usage,
                    fmt::format("{}: is there already and not of `conelight figures`; another "
                                "folder would be right",
                                (directory_ / file).string()));
}

void Gallery::add(const Figure& figure, const std::vector<Panel>& panels) {
    std::vector<std::pair<fs::path, io::Bytes>> files;
    Entry fresh{std::string(figure.id), {}};
    lastFiles_.clear();
    for (std::size_t i = 0; i < panels.size(); ++i) {
        const std::string name = fileName(figure, i, panels);
        refuseForeign(name);
        files.emplace_back(directory_ / name, panels[i].bytes);
        fresh.files.push_back({name, panels[i].label});
        lastFiles_.push_back(name);
    }
    const program::WritingScope writing;
    io::writeFiles(files);
    const auto old =
        std::find_if(entries_.begin(), entries_.end(), [&](const Entry& e) { return e.id == fresh.id; });
    if (old == entries_.end()) {
        entries_.push_back(std::move(fresh));
    } else {
        std::error_code code;
        for (const File& file : old->files)
            if (std::find(lastFiles_.begin(), lastFiles_.end(), file.name) == lastFiles_.end() &&
                file.name.find('/') == std::string::npos)
                fs::remove(directory_ / file.name, code);
        *old = std::move(fresh);
    }
    const std::span<const Figure> order = allFigures();
    const auto placeOf = [&](const Entry& e) {
        return std::find_if(order.begin(), order.end(), [&](const Figure& f) { return f.id == e.id; });
    };
    std::sort(entries_.begin(), entries_.end(),
              [&](const Entry& a, const Entry& b) { return placeOf(a) < placeOf(b); });
    writePage();
}

void Gallery::writePage() const {
    nlohmann::ordered_json json;
    json["generator"] = kGenerator;
    json["version"] = 1;
    json["figures"] = nlohmann::ordered_json::array();
    std::string page = kHead;
    for (const Entry& entry : entries_) {
        const Figure& figure = *figureOf(entry.id);
        nlohmann::ordered_json one = {
            {"id", entry.id}, {"title", figure.title}, {"kind", nameOf(figure.kind)}};
        one["files"] = nlohmann::ordered_json::array();
        page += fmt::format(
            "<section id=\"{0}\"><h2><span>{0}</span>{1}</h2><p>{2}.</p>\n<div class=\"panels\">\n", entry.id,
            escaped(figure.title), escaped(figure.caption));
        for (const File& file : entry.files) {
            one["files"].push_back({{"file", file.name}, {"label", file.label}});
            const bool picture = file.name.ends_with(".svg") || file.name.ends_with(".png");
            const std::string alt = escaped(fmt::format("{} {}", figure.title, file.label));
            page += picture ? fmt::format(
                                  "<figure><img src=\"{}\" alt=\"{}\"><figcaption>{}</figcaption></figure>\n",
                                  file.name, alt, escaped(file.label))
                            : fmt::format("<p><a href=\"{0}\">{0}</a></p>\n", file.name);
        }
        page +=
            fmt::format("</div><p>{}</p><p><code>conelight figures --only {} -o DIR</code></p></section>\n",
                        escaped(figure.seen), entry.id);
        json["figures"].push_back(std::move(one));
    }
    io::writeFiles({{directory_ / kList, bytesOf(json.dump(1) + "\n")},
                    {directory_ / kPage, bytesOf(page + "</body></html>\n")}});
}

std::string galleryMarkdown() {
    std::string text;
    for (const Figure& figure : allFigures()) {
        text += fmt::format("### {} {}\n\n{}.\n\n", figure.id, figure.title, figure.caption);
        text += fmt::format("{}\n\n    conelight figures --only {} -o DIR\n\n", figure.seen, figure.id);
    }
    return text;
}

}  // namespace conelight::figures

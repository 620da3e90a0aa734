// SPDX-License-Identifier: MIT
// Report -> report.html with its placeholders filled: style, script, the data as JSON, the pixels as base64
// in script elements that no browser runs.
#include "report.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <glm/gtc/packing.hpp>
#include <nlohmann/json.hpp>

#include "conelight/error.h"
#include "conelight/version.h"
#include "embedded_report.h"
#include "io/files.h"
#include "io/image_file.h"
#include "outputs.h"

namespace conelight::program {
namespace {

using nlohmann::ordered_json;

// Appends the bytes of a value, least significant first, whatever the machine's order.
template <class Value>
void append(std::vector<std::uint8_t>& bytes, Value value) {
    for (std::size_t i = 0; i < sizeof(Value); ++i) bytes.push_back(std::uint8_t(value >> (8 * i)));
}

std::vector<std::uint8_t> pixelBytes(const Image& image, bool half) {
    std::vector<std::uint8_t> bytes;
    bytes.reserve(image.pixels.size() * (half ? 6 : 12));
    for (const glm::vec4& pixel : image.pixels)
        for (int c = 0; c < 3; ++c) {
            std::uint32_t bits;
            std::memcpy(&bits, &pixel[c], sizeof bits);
            half ? append(bytes, glm::packHalf1x16(pixel[c])) : append(bytes, bits);
        }
    return bytes;
}

// [0,1] in steps of 1/254; 255 stands for "not a number".
std::vector<std::uint8_t> mapBytes(const std::vector<float>& values) {
    std::vector<std::uint8_t> bytes;
    bytes.reserve(values.size());
    for (const float value : values)
        bytes.push_back(std::isnan(value) ? 255
                                          : std::uint8_t(std::lround(std::clamp(value, 0.0f, 1.0f) * 254)));
    return bytes;
}

// The colour scales of the error maps as 256 colours each, so that page and PNG files agree.
ordered_json colorScale(bool isSigned) {
    std::vector<std::uint8_t> bytes(3 * 256);
    for (int i = 0; i < 256; ++i)
        reference::colorOfError(isSigned ? float(i) / 127.5f - 1 : float(i) / 255, isSigned,
                                &bytes[std::size_t(3 * i)]);
    return io::base64Encoded(bytes);
}

void check(const Report& report) {
    if (report.views.empty()) throw Error(ErrorKind::Usage, "report: there is nothing to show");
    for (const ReportView& view : report.views) {
        if (view.pictures.empty())
            throw Error(ErrorKind::Usage, fmt::format("report: view '{}': has no picture", view.name));
        const Image& first = view.pictures.front().image;
        for (const ReportPicture& picture : view.pictures) {
            const std::size_t count = std::size_t(first.width) * std::size_t(first.height);
            const bool fits = picture.image.width == first.width && picture.image.height == first.height &&
                              picture.image.pixels.size() == count &&
                              (picture.flip.empty() || picture.flip.size() == count) &&
                              (picture.hdrFlip.empty() || picture.hdrFlip.size() == count);
            if (!fits)
                throw Error(ErrorKind::Usage,
                            fmt::format("report: view '{}': picture '{}' and its maps must have the "
                                        "size of the first one, {}x{}",
                                        view.name, picture.name, first.width, first.height));
        }
        if (view.reference && *view.reference >= view.pictures.size())
            throw Error(ErrorKind::Usage, fmt::format("report: view '{}': has no such reference", view.name));
    }
}

bool exactFits(const Report& report) {
    std::size_t bytes = 0;
    for (const ReportView& view : report.views)
        for (const ReportPicture& picture : view.pictures) bytes += picture.image.pixels.size() * 16;
    return bytes <= kExactBytes;
}

ordered_json numberOrText(double value) {
    if (std::isfinite(value)) return value;
    return std::isnan(value) ? "none" : value > 0 ? "infinite" : "-infinite";
}

ordered_json tableJson(const ReportTable& table) {
    ordered_json json = {{"title", table.title}, {"note", table.note}};
    json["columns"] = ordered_json::array();
    for (const ReportColumn& column : table.columns)
        json["columns"].push_back({{"name", column.name},
                                   {"unit", column.unit},
                                   {"digits", column.digits},
                                   {"hint", column.hint},
                                   {"better", column.fewerIsBetter  ? -1
                                              : column.moreIsBetter ? 1
                                                                    : 0}});
    json["rows"] = ordered_json::array();
    for (const std::vector<ReportCell>& row : table.rows) {
        ordered_json cells = ordered_json::array();
        for (const ReportCell& cell : row)
            cells.push_back(cell.number ? numberOrText(*cell.number) : ordered_json(cell.text));
        json["rows"].push_back(std::move(cells));
    }
    return json;
}

// The metrics of a view's pictures; formulas stand in reference/metrics.h.
std::optional<ReportTable> metricsTable(const ReportView& view) {
    ReportTable table;
    table.title = "Error: " + view.name;
    if (view.reference) table.note = "Against " + view.pictures[*view.reference].name + ".";
    table.columns = {{"picture", "", 3, ""},
                     {"bias", "%", 2, "mean / mean of the reference - 1"},
                     {"relRMSE", "%", 2, "root of mean squared error / mean of the reference", true},
                     {"blocks", "%", 2, "relRMSE of means of blocks of pixels", true},
                     {"MAE", "", 3, "mean absolute error, W/(sr m2)", true},
                     {"relMSE", "", 3, "mean of squared error / (reference^2 + 0.01)", true},
                     {"PSNR", "dB", 4, "as displayed", false, true},
                     {"SSIM", "", 4, "structural similarity, as displayed; 1 = equal", false, true},
                     {"FLIP", "", 3, "mean visible difference, as displayed; 0 = none", true},
                     {"HDR-FLIP", "", 3, "mean visible difference, worst over exposures", true},
                     {"bad pixels", "", 6, "not finite; left out of all other numbers", true}};
    for (const ReportPicture& picture : view.pictures) {
        if (!picture.metrics) continue;
        const reference::Metrics& m = *picture.metrics;
        const bool hasFlip = !picture.flip.empty() || m.flip > 0 || m.hdrFlip > 0;
        const ReportCell none("");
        table.rows.push_back({picture.name, m.bias, m.relRmse, m.blockRelRmse, m.mae, m.relMse, m.psnr,
                              m.ssim, hasFlip ? ReportCell(m.flip) : none,
                              hasFlip ? ReportCell(m.hdrFlip) : none, double(m.badPixels)});
    }
    if (table.rows.empty()) return std::nullopt;
    return table;
}

struct Blocks {
    std::string html;  // script elements with base64 text
    std::size_t count = 0;

    std::size_t add(const std::vector<std::uint8_t>& bytes) {
        html += fmt::format("<script type=\"text/plain\" id=\"block{}\">{}</script>\n", count,
                            io::base64Encoded(bytes));
        return count++;
    }
};

ordered_json viewJson(const ReportView& view, bool half, Blocks& blocks) {
    const Image& first = view.pictures.front().image;
    ordered_json json = {{"name", view.name},
                         {"width", first.width},
                         {"height", first.height},
                         {"exposure", view.exposure},
                         {"tone", view.toneMap}};
    json["reference"] = view.reference ? ordered_json(*view.reference) : ordered_json();
    json["pictures"] = ordered_json::array();
    for (const ReportPicture& picture : view.pictures) {
        ordered_json entry = {{"name", picture.name}, {"block", blocks.add(pixelBytes(picture.image, half))}};
        if (!picture.flip.empty()) entry["flip"] = blocks.add(mapBytes(picture.flip));
        if (!picture.hdrFlip.empty()) entry["hdrFlip"] = blocks.add(mapBytes(picture.hdrFlip));
        if (picture.metrics) entry["referenceMean"] = picture.metrics->referenceMean;
        json["pictures"].push_back(std::move(entry));
    }
    if (const std::optional<ReportTable> table = metricsTable(view)) json["metrics"] = tableJson(*table);
    return json;
}

std::string escapedHtml(const std::string& text) {
    std::string html;
    for (const char c : text) {
        if (c == '<')
            html += "&lt;";
        else if (c == '>')
            html += "&gt;";
        else if (c == '&')
            html += "&amp;";
        else if (c == '"')
            html += "&quot;";
        else
            html += c;
    }
    return html;
}

// JSON that can stand in a script element: "</script>" and "<!--" cannot occur. Text that is no UTF-8 (file
// names) gets replacement characters.
std::string scriptJson(const ordered_json& json) {
    std::string safe;
    for (const char c : json.dump(-1, ' ', true, ordered_json::error_handler_t::replace))
        safe += c == '<' ? std::string("\\u003c") : std::string(1, c);
    return safe;
}

std::string filled(const std::string& page, const std::vector<std::pair<std::string, std::string>>& values) {
    std::string result;
    std::size_t at = 0;
    while (at < page.size()) {
        const std::size_t open = page.find("{{", at);
        if (open == std::string::npos) break;
        const std::size_t close = page.find("}}", open);
        result.append(page, at, open - at);
        const std::string key = page.substr(open + 2, close - open - 2);
        for (const auto& [name, value] : values)
            if (name == key) result += value;
        at = close + 2;
    }
    return result.append(page, at);
}

}  // namespace

std::string reportHtml(const Report& report) {
    check(report);
    const bool half = !exactFits(report);
    Blocks blocks;
    ordered_json data = {{"format", half ? "half" : "float"},
                         {"scales", {{"magnitude", colorScale(false)}, {"signed", colorScale(true)}}}};
    data["views"] = ordered_json::array();
    for (const ReportView& view : report.views) data["views"].push_back(viewJson(view, half, blocks));
    data["tables"] = ordered_json::array();
    for (const ReportTable& table : report.tables) data["tables"].push_back(tableJson(table));
    data["commands"] = report.commands;
    data["settings"] = ordered_json::array();
    for (const auto& [key, value] : report.settings) data["settings"].push_back({key, value});

    return filled(embedded::report_html,
                  {{"title", escapedHtml(report.title)},
                   {"summary", escapedHtml(report.summary)},
                   {"version", CONELIGHT_VERSION_STRING},
                   {"style", embedded::report_css},
                   {"script", std::string(embedded::pixels_js) + embedded::tables_js + embedded::report_js},
                   {"data", scriptJson(data)},
                   {"blocks", blocks.html}});
}

void prepareReport(const std::string& directory, const std::vector<std::string>& inputs) {
    std::error_code failed;
    std::filesystem::create_directories(directory, failed);
    if (failed)
        throw Error(ErrorKind::Runtime,
                    fmt::format("{}: cannot be made a folder: {}", io::oneLine(directory), failed.message()));
    checkOutputs({{"--report", (std::filesystem::path(directory) / "index.html").string(), OutputKind::Page}},
                 inputs);
}

void writeReport(const std::string& directory, const Report& report) {
    prepareReport(directory, {});
    const std::string page = reportHtml(report);
    io::writeFile(std::filesystem::path(directory) / "index.html",
                  {reinterpret_cast<const std::uint8_t*>(page.data()), page.size()});
}

}  // namespace conelight::program

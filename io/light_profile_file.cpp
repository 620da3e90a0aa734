// SPDX-License-Identifier: MIT
#include "io/light_profile_file.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <vector>

#include "conelight/error.h"
#include "io/files.h"

namespace conelight::io {
namespace {

constexpr std::size_t kMostProfileBytes = std::size_t{16} << 20;
constexpr int kMostAngles = 4096;
constexpr float kLumenPerWatt = 683;

std::string_view trimmed(std::string_view line) {
    const std::size_t begin = line.find_first_not_of(" \t\r"), end = line.find_last_not_of(" \t\r");
    return begin == std::string_view::npos ? std::string_view() : line.substr(begin, end - begin + 1);
}

class Parser {
  public:
    Parser(const std::string& file, std::string_view text) : file_(file), rest_(text) {}
    std::shared_ptr<LightProfile> parse();

  private:
    [[noreturn]] void fail(const std::string& why) const {
        throw Error(ErrorKind::BadInput, fmt::format("{}: line {}: {}", file_, line_, why));
    }
    std::optional<std::string_view> nextLine();
    double number(const char* what);
    int count(const char* what, int most);
    std::vector<double> angles(const char* what, int count);
    void readHeader();
    void skipTilt();
    void readNumbers();
    void checkAngles() const;
    double candela(std::size_t column, double vertical) const;
    double candela(double horizontal, double vertical) const;

    std::string file_;
    std::string_view rest_, words_;  // words_: what is left of the line
    int line_ = 0;
    std::string tilt_;
    double factor_ = 1;
    std::vector<double> vertical_, horizontal_, values_;  // values_: by horizontal angle, then by vertical
};

std::optional<std::string_view> Parser::nextLine() {
    if (rest_.empty()) return std::nullopt;
    const std::size_t end = rest_.find('\n');
    const std::string_view line = rest_.substr(0, end);
    rest_ = end == std::string_view::npos ? std::string_view() : rest_.substr(end + 1);
    ++line_;
    return trimmed(line);
}

// Numbers are parted by blanks, commas and ends of lines.
double Parser::number(const char* what) {
    constexpr const char* kBetween = " \t,";
    std::size_t begin = words_.find_first_not_of(kBetween);
    while (begin == std::string_view::npos) {
        const auto line = nextLine();
        if (!line) fail(fmt::format("the file ends before {}", what));
        words_ = *line;
        begin = words_.find_first_not_of(kBetween);
    }
    words_ = words_.substr(begin);
    const std::size_t end = std::min(words_.find_first_of(kBetween), words_.size());
    std::string_view word = words_.substr(0, end);
    words_ = words_.substr(end);
    if (word.starts_with('+')) word.remove_prefix(1);
    double value = 0;
    const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || stop != word.data() + word.size() || !std::isfinite(value))
        fail(fmt::format("{}: '{}' is no number", what, oneLine(word, 40)));
    return value;
}

int Parser::count(const char* what, int most) {
    const double value = number(what);
    if (!(value >= 1 && value <= most && value == std::floor(value)))
        fail(fmt::format("{}: {} is not usable; a whole number from 1 to {} would be right", what, value,
                         most));
    return static_cast<int>(value);
}

std::vector<double> Parser::angles(const char* what, int count) {
    std::vector<double> all;
    for (int i = 0; i < count; ++i) {
        all.push_back(number(what));
        if (i > 0 && !(all[all.size() - 1] > all[all.size() - 2]))
            fail(fmt::format("{}: {} follows {}; rising ones would be right", what, all[all.size() - 1],
                             all[all.size() - 2]));
    }
    return all;
}

// To the line with TILT=, before which there is text.
void Parser::readHeader() {
    const auto first = nextLine();
    if (!first) fail("the file is empty");
    for (auto line = first; line; line = nextLine())
        if (line->starts_with("TILT=")) {
            tilt_ = trimmed(line->substr(5));
            return;
        }
    fail(first->starts_with("IES") ? "there is no line TILT="
                                   : "this is no IES file: there is no line TILT=");
}

// How the lamp's strength changes with its tilt is left out, as the light stands as it was measured.
void Parser::skipTilt() {
    if (tilt_ != "INCLUDE") return;
    number("the lamp's position");
    const int pairs = count("number of tilt angles", kMostAngles);
    for (int i = 0; i < 2 * pairs; ++i) number("a tilt angle or factor");
}

void Parser::readNumbers() {
    number("number of lamps");
    number("lumens per lamp");
    factor_ = number("candela multiplier");
    const int verticals = count("number of vertical angles", kMostAngles);
    const int horizontals = count("number of horizontal angles", kMostAngles);
    const double type = number("photometric type");
    if (type != 1) fail(fmt::format("photometric type {}; type C, which is 1, would be right", type));
    for (const char* what : {"units", "width", "length", "height"}) number(what);
    factor_ *= number("ballast factor");
    factor_ *= number("ballast-lamp factor");
    number("input watts");
    if (!(factor_ > 0)) fail("the candela multiplier times the ballast factors is not above 0");
    vertical_ = angles("vertical angle", verticals);
    horizontal_ = angles("horizontal angle", horizontals);
    checkAngles();
    values_.reserve(vertical_.size() * horizontal_.size());
    for (std::size_t i = 0; i < vertical_.size() * horizontal_.size(); ++i) {
        values_.push_back(number("candela value") * factor_);
        if (values_.back() < 0) fail("a candela value is below 0");
    }
}

void Parser::checkAngles() const {
    if (vertical_.size() < 2 || vertical_.front() < 0 || vertical_.back() > 180)
        fail("vertical angles: two or more from 0 to 180 degrees would be right");
    const double first = horizontal_.front(), last = horizontal_.back();
    const bool quarter =
        first == 0 && (last == 0 || last == 90 || last == 180 || (last > 180 && last <= 360));
    const bool half = first == 90 && last == 270;  // LM-63-1995
    if (!quarter && !half)
        fail(fmt::format("horizontal angles from {} to {}; 0 to 0, 90, 180 or 360 would be right", first,
                         last));
}

double Parser::candela(std::size_t column, double vertical) const {
    if (vertical < vertical_.front() - 1e-9 || vertical > vertical_.back() + 1e-9) return 0;
    const auto above = std::upper_bound(vertical_.begin() + 1, vertical_.end() - 1, vertical);
    const auto row = static_cast<std::size_t>(above - vertical_.begin());
    const double part =
        std::clamp((vertical - vertical_[row - 1]) / (vertical_[row] - vertical_[row - 1]), 0.0, 1.0);
    const double* values = &values_[column * vertical_.size()];
    return values[row - 1] + part * (values[row] - values[row - 1]);
}

// Symmetric lamps are measured in a quarter or a half.
double Parser::candela(double horizontal, double vertical) const {
    const double last = horizontal_.back();
    double at = horizontal;
    if (horizontal_.front() == 90) {
        at = at < 90 ? 180 - at : at > 270 ? 540 - at : at;
    } else if (last <= 180) {
        at = at > 180 ? 360 - at : at;
        if (last == 90 && at > 90) at = 180 - at;
    }
    if (horizontal_.size() == 1) return candela(std::size_t{0}, vertical);
    const auto above = std::upper_bound(horizontal_.begin(), horizontal_.end(), at);
    const auto next = static_cast<std::size_t>(above - horizontal_.begin());
    const std::size_t before = next - 1;  // at is at or after the first
    if (before + 1 == horizontal_.size() && (at <= last || last <= 180)) return candela(before, vertical);
    // Beyond the last, which is below 360: on to the first.
    const bool wraps = before + 1 == horizontal_.size();
    const double end = wraps ? horizontal_.front() + 360 : horizontal_[next];
    const double part = (at - horizontal_[before]) / (end - horizontal_[before]);
    const double low = candela(before, vertical), high = candela(wraps ? 0 : next, vertical);
    return low + part * (high - low);
}

std::shared_ptr<LightProfile> Parser::parse() {
    readHeader();
    skipTilt();
    readNumbers();
    auto profile = std::make_shared<LightProfile>();
    profile->file = file_;
    std::vector<double> all;
    double peak = 0;
    for (int row = 0; row < LightProfile::kRows; ++row)
        for (int column = 0; column < LightProfile::kColumns; ++column) {
            all.push_back(
                candela(360.0 * column / LightProfile::kColumns, 180.0 * row / (LightProfile::kRows - 1)));
            peak = std::max(peak, all.back());
        }
    if (!(peak > 0)) fail("all candela values are 0");
    if (!(peak < 1e12)) fail("candela values of 1e12 or more");
    profile->candela = static_cast<float>(peak);
    for (const double value : all) profile->factors.push_back(static_cast<float>(value / peak));
    return profile;
}

}  // namespace

std::shared_ptr<const LightProfile> parseLightProfile(const std::string& file, std::string_view text) {
    if (text.size() > kMostProfileBytes)
        throw Error(ErrorKind::BadInput,
                    fmt::format("{}: {} bytes; at most 16 MiB would be right", file, text.size()));
    auto profile = Parser(file, text).parse();
    profile->text = text;
    return profile;
}

std::shared_ptr<const LightProfile> readLightProfile(const std::string& path) {
    const Bytes bytes = readFile(path);
    return parseLightProfile(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

void setLightProfile(Light& light, std::shared_ptr<const LightProfile> profile) {
    light.intensity = glm::vec3(profile->candela / kLumenPerWatt);
    light.profile = std::move(profile);
    light.customFalloff = false;
}

}  // namespace conelight::io

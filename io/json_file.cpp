// SPDX-License-Identifier: MIT
#include "io/json_file.h"

#include <fmt/core.h>

#include <iterator>
#include <vector>

#include "conelight/error.h"
#include "io/files.h"

namespace conelight::io {
namespace {

constexpr std::uint64_t kMostBytes = std::uint64_t(16) << 20;
constexpr std::size_t kMostLevels = 200;  // real files stay below 10; each value is kept with its whole path

// Counts the line ends before the last character that was taken: a parser looks one character past a number,
// which may be the line's end.
struct CountingIterator {
    using iterator_category = std::input_iterator_tag;
    using value_type = char;
    using difference_type = std::ptrdiff_t;
    using pointer = const char*;
    using reference = const char&;

    const char* at = nullptr;
    int* line = nullptr;
    bool afterEnd = false;  // the character taken last was a line end

    reference operator*() const { return *at; }
    CountingIterator& operator++() {
        if (afterEnd) ++*line;
        afterEnd = *at == '\n';
        ++at;
        return *this;
    }
    CountingIterator operator++(int) {
        const CountingIterator before = *this;
        ++*this;
        return before;
    }
    bool operator==(const CountingIterator& other) const { return at == other.at; }
    bool operator!=(const CountingIterator& other) const { return at != other.at; }
};

class LineFinder : public nlohmann::json_sax<nlohmann::ordered_json> {
  public:
    LineFinder(const int& line, std::map<std::string, int>& lines) : line_(line), lines_(lines) {}
    std::string failure;

    bool null() override { return value(); }
    bool boolean(bool) override { return value(); }
    bool number_integer(number_integer_t) override { return value(); }
    bool number_unsigned(number_unsigned_t) override { return value(); }
    bool number_float(number_float_t, const string_t&) override { return value(); }
    bool string(string_t&) override { return value(); }
    bool binary(binary_t&) override { return value(); }
    bool start_object(std::size_t) override { return open(false); }
    bool start_array(std::size_t) override { return open(true); }
    bool end_object() override { return close(); }
    bool end_array() override { return close(); }
    bool key(string_t& name) override {
        std::string escaped;
        for (const char c : name)
            escaped += c == '~' ? std::string("~0") : c == '/' ? std::string("~1") : std::string(1, c);
        levels_.back().last = escaped;
        if (lines_.emplace(pointer(), line_).second) return true;
        failure = fmt::format("'{}' stands twice; once would be right", oneLine(name, 60));
        return false;
    }
    bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception& error) override {
        // "[json.exception...] parse error at line 1, column 2: syntax error while parsing ..."
        const std::string text = error.what();
        const std::size_t column = text.find("column ");
        const std::size_t colon = text.find(": ", column == std::string::npos ? 0 : column);
        failure = "is not JSON: " + (colon == std::string::npos ? text : text.substr(colon + 2));
        return false;
    }

  private:
    struct Level {
        bool array = false;
        std::size_t count = 0;
        std::string last;  // the key
    };
    std::string pointer() const {
        std::string text;
        for (const Level& level : levels_)
            text += "/" + (level.array ? std::to_string(level.count) : level.last);
        return text;
    }
    bool value() {
        lines_.emplace(pointer(), line_);
        if (!levels_.empty()) ++levels_.back().count;
        return true;
    }
    bool open(bool array) {
        lines_.emplace(pointer(), line_);
        levels_.push_back({array, 0, {}});
        if (levels_.size() <= kMostLevels) return true;
        failure = "is nested too deeply";
        return false;
    }
    bool close() {
        levels_.pop_back();
        if (!levels_.empty()) ++levels_.back().count;
        return true;
    }

    const int& line_;
    std::map<std::string, int>& lines_;
    std::vector<Level> levels_;
};

}  // namespace

JsonFile::JsonFile(const std::string& path) : path_(path) {
    const Bytes bytes = readFile(path, kMostBytes);
    const char* text = reinterpret_cast<const char*>(bytes.data());
    int line = 1;
    LineFinder finder(line, lines_);
    const bool whole = nlohmann::ordered_json::sax_parse(
        CountingIterator{text, &line}, CountingIterator{text + bytes.size(), &line}, &finder);
    if (!whole)
        throw Error(ErrorKind::BadInput,
                    fmt::format("{}:{}: {}", oneLine(path), line, oneLine(finder.failure)));
    root_ = nlohmann::ordered_json::parse(text, text + bytes.size());
}

void JsonFile::fail(std::string pointer, const std::string& message) const {
    while (!pointer.empty() && lines_.count(pointer) == 0) pointer.resize(pointer.rfind('/'));
    const auto found = lines_.find(pointer);
    throw Error(ErrorKind::BadInput,
                fmt::format("{}:{}: {}", oneLine(path_), found == lines_.end() ? 1 : found->second, message));
}

}  // namespace conelight::io

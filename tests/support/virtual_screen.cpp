// SPDX-License-Identifier: MIT
#include "support/virtual_screen.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "support/program.h"

namespace conelight::test {
namespace {

// A condition that has not come by then does not: only what hangs gets there, however busy the machine.
constexpr double kPatience = 900;  // s

double now() {
    using clock = std::chrono::steady_clock;
    return std::chrono::duration<double>(clock::now().time_since_epoch()).count();
}

// Starts `/bin/sh -c command` with the given descriptors as its standard ones (-1: /dev/null).
int start(const std::string& command, int in, int out, int keep = -1) {
    const int process = fork();
    if (process < 0) throw std::runtime_error("fork failed");
    if (process > 0) return process;
    const int nothing = open("/dev/null", O_RDWR);
    dup2(in >= 0 ? in : nothing, 0);
    dup2(out >= 0 ? out : nothing, 1);
    dup2(out >= 0 ? out : nothing, 2);
    for (int descriptor = 3; descriptor < 256; ++descriptor)
        if (descriptor != keep) close(descriptor);
    execl("/bin/sh", "sh", "-c", command.c_str(), static_cast<char*>(nullptr));
    _exit(127);
}

void end(int process) {
    if (process <= 0) return;
    kill(process, SIGTERM);
    for (int i = 0; i < 100; ++i) {
        if (waitpid(process, nullptr, WNOHANG) != 0) return;
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    kill(process, SIGKILL);
    waitpid(process, nullptr, 0);
}

std::uint32_t word(const std::string& bytes, std::size_t index) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i)
        value = value << 8 | static_cast<std::uint8_t>(bytes.at(4 * index + i));
    return value;
}

}  // namespace

glm::vec3 ScreenPixels::mean(const glm::ivec2& from, const glm::ivec2& size) const {
    glm::vec3 sum(0);
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) sum += glm::vec3(at(from + glm::ivec2(x, y)));
    return sum / static_cast<float>(size.x * size.y);
}

int ScreenPixels::changedFrom(const ScreenPixels& other, const glm::ivec4& box, int tolerance) const {
    int changed = 0;
    for (int y = box.y; y < box.y + box.w; ++y)
        for (int x = box.x; x < box.x + box.z; ++x) {
            const glm::ivec3 apart = glm::abs(at({x, y}) - other.at({x, y}));
            changed += std::max({apart.x, apart.y, apart.z}) > tolerance;
        }
    return changed;
}

bool eventually(const std::function<bool()>& condition) {
    const double until = now() + kPatience;
    do {
        if (condition()) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    } while (now() < until);
    return false;
}

std::string VirtualScreen::missing() {
    for (const char* program : {"Xvfb", "xdotool"})
        if (std::system(("command -v " + std::string(program) + " >/dev/null 2>&1").c_str()) != 0)
            return std::string(program) + " is not installed (packages xvfb, xdotool)";
    return {};
}

VirtualScreen::VirtualScreen(int width, int height) {
    int numbers[2];
    if (pipe(numbers) != 0) throw std::runtime_error("pipe failed");
    std::string directory = (std::filesystem::temp_directory_path() / "conelight_screen_XXXXXX").string();
    if (mkdtemp(directory.data()) == nullptr) throw std::runtime_error(directory + " cannot be made");
    directory_ = directory;
    process_ =
        start("exec Xvfb -displayfd " + std::to_string(numbers[1]) + " -screen 0 " + std::to_string(width) +
                  "x" + std::to_string(height) + "x24 -nolisten tcp -fbdir '" + directory_ + "'",
              -1, -1, numbers[1]);
    close(numbers[1]);
    // The number comes when the screen is ready.
    std::string text;
    char c = 0;
    pollfd ready{numbers[0], POLLIN, 0};
    while (poll(&ready, 1, static_cast<int>(1000 * kPatience)) > 0 && read(numbers[0], &c, 1) == 1 &&
           c != '\n')
        text += c;
    close(numbers[0]);
    if (text.empty()) throw std::runtime_error("Xvfb does not start");
    display_ = ":" + text;
}

VirtualScreen::~VirtualScreen() {
    end(process_);
    std::error_code ignored;
    std::filesystem::remove_all(directory_, ignored);
}

// The server's own memory, not `xwd -root`: where a window's visual is not the root's, as OpenGL's need not
// be, xwd composes the dump itself and packs three bytes per pixel under a header that says four.
ScreenPixels VirtualScreen::pixels() const {
    const std::string bytes = bytesOf(directory_ + "/Xvfb_screen0");
    // The X window dump: a header of big-endian words, then its colour map, then rows of BGRX.
    const std::size_t offset = word(bytes, 0) + 12 * std::size_t(word(bytes, 19));
    ScreenPixels screen{static_cast<int>(word(bytes, 4)), static_cast<int>(word(bytes, 5)), {}};
    const auto width = static_cast<std::size_t>(screen.width),
               height = static_cast<std::size_t>(screen.height);
    const std::size_t pitch = word(bytes, 12);
    if (bytes.size() < offset + height * pitch || pitch < 4 * width)
        throw std::runtime_error("the screen's file is not whole");
    screen.pixels.resize(width * height);
    // Tests look over and over: rows without a check for each byte.
    for (std::size_t y = 0; y < height; ++y) {
        const auto* from = reinterpret_cast<const std::uint8_t*>(bytes.data()) + offset + y * pitch;
        for (std::size_t x = 0; x < width; ++x, from += 4)
            screen.pixels[y * width + x] = {from[2], from[1], from[0]};
    }
    return screen;
}

void VirtualScreen::xdotool(const std::string& arguments) const {
    const std::string command = "DISPLAY=" + display_ + " xdotool " + arguments;
    if (std::system(command.c_str()) != 0) throw std::runtime_error(command + " failed");
}

ViewerProcess::ViewerProcess(const VirtualScreen& screen, const std::string& arguments,
                             const std::string& environment) {
    int in[2], out[2];
    if (pipe(in) != 0 || pipe(out) != 0) throw std::runtime_error("pipe failed");
    signal(SIGPIPE, SIG_IGN);
    process_ = start("exec env DISPLAY=" + screen.display() + " " + environment +
                         " '" CONELIGHT_PROGRAM "' view " + arguments,
                     in[0], out[1]);
    close(in[0]);
    close(out[1]);
    in_ = in[1];
    out_ = out[0];
}

ViewerProcess::~ViewerProcess() {
    close(in_);
    if (!ended_) end(process_);
    close(out_);
}

void ViewerProcess::send(const std::string& line) {
    const std::string text = line + "\n";
    if (write(in_, text.data(), text.size()) != static_cast<ssize_t>(text.size()))
        output_ += "(cannot write to the viewer: " + line + ")\n";
}

bool ViewerProcess::readSome(double seconds) {
    pollfd ready{out_, POLLIN, 0};
    if (poll(&ready, 1, static_cast<int>(1e3 * seconds)) <= 0) return true;
    char block[4096];
    const ssize_t n = read(out_, block, sizeof block);
    if (n <= 0) return false;  // the program has ended
    output_.append(block, static_cast<std::size_t>(n));
    return true;
}

std::string ViewerProcess::expect(const std::string& begin) {
    const double until = now() + kPatience;
    do {
        for (std::size_t end; (end = output_.find('\n', taken_)) != std::string::npos;) {
            const std::string line = output_.substr(taken_, end - taken_);
            taken_ = end + 1;
            if (line.compare(0, begin.size(), begin) == 0) return line;
        }
    } while (readSome(0.1) && now() < until);
    return {};
}

std::string ViewerProcess::status(const std::string& key) {
    const std::string begin = "status " + key + ": ";
    send("status " + key);
    const std::string line = expect(begin);
    return line.empty() ? "" : line.substr(begin.size());
}

std::string ViewerProcess::setting(const std::string& key) {
    send("get " + key);
    const std::string begin = key + " = ";
    const std::string line = expect(begin);
    return line.empty() ? "" : line.substr(begin.size(), line.find(' ', begin.size()) - begin.size());
}

std::string ViewerProcess::statusUntil(const std::string& key,
                                       const std::function<bool(const std::string&)>& good) {
    std::string last;
    eventually([&] {
        last = status(key);
        return good(last) || last.empty();
    });
    return last;
}

glm::ivec4 ViewerProcess::placeOf(const std::string& widget) {
    send("where " + widget);
    const std::string begin = "where " + widget + ": ";
    std::string line;
    do line = expect("where");
    while (!line.empty() && line.rfind(begin, 0) != 0 && line.rfind("where: '" + widget + "'", 0) != 0);
    if (line.rfind(begin, 0) != 0) return glm::ivec4(0);  // not on the screen
    std::istringstream numbers(line.substr(begin.size()));
    glm::ivec4 place(0);
    numbers >> place.x >> place.y >> place.z >> place.w;
    return place;
}

glm::ivec2 ViewerProcess::middleOf(const std::string& widget) {
    const glm::ivec4 place = placeOf(widget);
    return {place.x + place.z / 2, place.y + place.w / 2};
}

double ViewerProcess::cpuMs() const {
    // Behind the name in brackets: state, ten other fields, user and system time in clock ticks.
    const std::string text = bytesOf("/proc/" + std::to_string(process_) + "/stat");
    std::istringstream fields(text.substr(std::min(text.size(), text.rfind(')') + 1)));
    std::string skipped;
    for (int i = 0; i < 11; ++i) fields >> skipped;
    double user = 0, system = 0;
    fields >> user >> system;
    return 1e3 * (user + system) / static_cast<double>(sysconf(_SC_CLK_TCK));
}

bool ViewerProcess::waits() const {
    std::error_code gone;
    for (const auto& task :
         std::filesystem::directory_iterator("/proc/" + std::to_string(process_) + "/task", gone)) {
        const std::string text = bytesOf(task.path().string() + "/stat");
        const std::size_t name = text.rfind(") ");
        if (name == std::string::npos || text.at(name + 2) != 'S') return false;
    }
    return !gone;
}

void ViewerProcess::crash() {
    kill(process_, SIGKILL);
    exitStatus();
}
void ViewerProcess::pause() { kill(process_, SIGSTOP); }
void ViewerProcess::resume() { kill(process_, SIGCONT); }

bool ViewerProcess::holdChild() {
    const auto parentOf = [](const std::string& process) {
        const std::string text = bytesOf("/proc/" + process + "/stat");
        std::istringstream fields(text.substr(std::min(text.size(), text.rfind(')') + 1)));
        std::string state;
        int parent = -1;
        fields >> state >> parent;
        return parent;
    };
    const double until = now() + kPatience;
    while (now() < until && running()) {
        std::error_code gone;
        for (const auto& entry : std::filesystem::directory_iterator("/proc", gone)) {
            const std::string name = entry.path().filename().string();
            if (name.find_first_not_of("0123456789") != std::string::npos || parentOf(name) != process_)
                continue;
            child_ = std::stoi(name);
            return kill(child_, SIGSTOP) == 0;
        }
    }
    return false;
}
void ViewerProcess::releaseChild() { kill(child_, SIGCONT); }

bool ViewerProcess::running() {
    int status = 0;
    if (ended_ || waitpid(process_, &status, WNOHANG) == 0) return !ended_;
    ended_ = true;
    status_ = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    return false;
}

int ViewerProcess::exitStatus() {
    const double until = now() + kPatience;
    while (!ended_ && now() < until) {
        readSome(0.02);
        int status = 0;
        if (waitpid(process_, &status, WNOHANG) != process_) continue;
        ended_ = true;
        status_ = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }
    return status_;
}

}  // namespace conelight::test

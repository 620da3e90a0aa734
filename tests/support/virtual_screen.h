// SPDX-License-Identifier: MIT
// A screen without a monitor (Xvfb), and the viewer on it: driven by mouse and keys (xdotool) and through its
// standard input, watched by what it prints and by the screen's pixels (the file that Xvfb keeps them in).
// Nothing here sleeps and hopes: everything waits for a condition, and fails with what there was when it does
// not come.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace conelight::test {

struct ScreenPixels {
    int width = 0, height = 0;
    std::vector<glm::u8vec3> pixels;  // first row on top
    glm::ivec3 at(const glm::ivec2& p) const {
        return pixels.at(static_cast<std::size_t>(p.y) * static_cast<std::size_t>(width) +
                         static_cast<std::size_t>(p.x));
    }
    // Mean of a rectangle, 0..255.
    glm::vec3 mean(const glm::ivec2& at, const glm::ivec2& size) const;
    // How many pixels of a box (x y width height) differ from those of `other` by more than `tolerance` in a
    // channel.
    int changedFrom(const ScreenPixels& other, const glm::ivec4& box, int tolerance = 0) const;
};

class VirtualScreen {
  public:
    // What is missing to run one, or empty.
    static std::string missing();
    VirtualScreen(int width, int height);  // throws std::runtime_error
    ~VirtualScreen();
    VirtualScreen(const VirtualScreen&) = delete;
    VirtualScreen& operator=(const VirtualScreen&) = delete;

    const std::string& display() const { return display_; }  // ":93"
    ScreenPixels pixels() const;
    void xdotool(const std::string& arguments) const;

  private:
    int process_ = -1;
    std::string display_;
    std::string directory_;  // of the file with the screen's pixels
};

class ViewerProcess {
  public:
    // `arguments`: of `conelight view`; `environment`: "NAME=VALUE" words.
    ViewerProcess(const VirtualScreen& screen, const std::string& arguments,
                  const std::string& environment = "");
    ~ViewerProcess();  // ends it
    ViewerProcess(const ViewerProcess&) = delete;
    ViewerProcess& operator=(const ViewerProcess&) = delete;

    void send(const std::string& line);
    // Waits until the program has printed a line that begins with `start`, after what was returned before;
    // "" when none came. Lines before it are passed over.
    std::string expect(const std::string& start);
    // `status KEY`: what follows the name; `get KEY`: the value without its unit.
    std::string status(const std::string& key);
    std::string setting(const std::string& key);
    // Where a widget is: its middle, in pixels of the screen.
    glm::ivec2 middleOf(const std::string& widget);
    glm::ivec4 placeOf(const std::string& widget);  // x y width height
    // Asks again until `good`; returns the last answer.
    std::string statusUntil(const std::string& key, const std::function<bool(const std::string&)>& good);
    // CPU time of the program, and whether all its threads wait for something: what has used time, or waits,
    // has looked at its input, however busy the machine.
    double cpuMs() const;
    bool waits() const;
    // Waits for the end; -1: it did not end.
    int exitStatus();
    bool running();
    void crash();  // ends it at once
    // Holds the program where it is, so that all input meanwhile reaches it at once, and lets it go on.
    void pause();
    void resume();
    // Waits until the program has a process of its own, which it reads foreign files with, and holds that until
    // release(). Returns whether one came.
    bool holdChild();
    void releaseChild();
    const std::string& output() const { return output_; }  // all of it, errors too

  private:
    bool readSome(double seconds);
    int process_ = -1, child_ = -1, in_ = -1, out_ = -1;
    std::string output_;
    std::size_t taken_ = 0;
    int status_ = -1;
    bool ended_ = false;
};

// Whether `condition` comes true in time; asked over and over, with a pause between.
bool eventually(const std::function<bool()>& condition);

}  // namespace conelight::test

// SPDX-License-Identifier: MIT
// A window with an OpenGL 4.5 core context, through GLFW: events, size, scale of the screen. One window per
// process; use it on the main thread only.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <string>
#include <utility>
#include <vector>

struct GLFWwindow;

namespace conelight::platform {

struct WindowOptions {
    int width = 1280;
    int height = 800;  // screen units, not pixels
    std::string title = "Conelight";
    bool visible = true;
    bool debug = false;  // a debug context
};

// Throws Error(NoGl) without a display or without OpenGL 4.5, with what would be right.
class Window {
  public:
    explicit Window(const WindowOptions& options = {});
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    bool shouldClose() const;
    void setShouldClose(bool close);
    void setTitle(const std::string& title);
    // Handles what happened; waits at most `seconds` for something to happen (0: does not wait).
    void pollEvents(double seconds);
    // Ends a wait from another thread.
    static void wake();
    void swapBuffers();

    glm::ivec2 size() const;             // screen units
    glm::ivec2 framebufferSize() const;  // pixels
    float contentScale() const;          // pixels per 96 dpi pixel; 1 on ordinary screens, 2 on HiDPI
    bool minimized() const;
    void show();  // not minimized any more
    bool fullscreen() const { return fullscreen_; }
    void setFullscreen(bool on);
    // Hides the cursor and reports its movement without limits, for flying.
    void captureCursor(bool on);
    bool cursorCaptured() const { return captured_; }
    bool isKeyDown(int glfwKey) const;
    // Keys, characters and mouse buttons are kept, and told to no one else: the GUI's callbacks for them are replaced.
    void listen();
    // As GLFW's callbacks are told them, or a character that came of keys.
    struct KeyEvent {
        int key = 0, scancode = 0, action = 0, modifiers = 0;
        unsigned int character = 0;  // 0: none
        std::uint64_t number = 0;    // among keys, characters and buttons, in the order in which they came
        bool control() const;
        bool shift() const;
    };
    // What came since the last call, in order.
    std::vector<KeyEvent> takeKeyEvents() { return std::exchange(keyEvents_, {}); }
    struct ButtonChange {
        int button = 0;  // GLFW's
        bool down = false;
        glm::dvec2 at{0};          // where the cursor was, screen units
        std::uint64_t number = 0;  // as KeyEvent's
    };
    // Mouse buttons that went down or up since the last call, in order.
    std::vector<ButtonChange> takeButtonChanges() { return std::exchange(buttonChanges_, {}); }
    // Counts what the user does with mouse and keys, and with the mouse's buttons alone.
    std::uint64_t inputs() const { return inputs_; }
    std::uint64_t buttonInputs() const { return buttonInputs_; }
    glm::dvec2 cursor() const;  // screen units from the top left corner

    std::function<void(const std::vector<std::string>& paths)> onDrop;
    // Called while the window is being resized, when the main loop does not run.
    std::function<void()> onRefresh;

    // Clears the framebuffer, for what is drawn over it (the GUI). GL state changed: framebuffer binding,
    // viewport, clear colour.
    void clear(const glm::vec3& color);
    // The framebuffer as it is, before swapBuffers: RGB bytes of framebufferSize(), first row on top.
    std::vector<std::uint8_t> pixels() const;
    GLFWwindow* handle() const { return window_; }
    std::string description() const;  // GL renderer and version

  private:
    static Window& self(GLFWwindow* window);
    GLFWwindow* window_ = nullptr;
    bool fullscreen_ = false;
    bool captured_ = false;
    std::vector<KeyEvent> keyEvents_;
    std::vector<ButtonChange> buttonChanges_;
    glm::dvec2 cursorThen_{0};  // by the events so far, where cursor() is what it is by now
    std::uint64_t inputs_ = 0, buttonInputs_ = 0, events_ = 0;
    glm::ivec2 windowedPosition_{0}, windowedSize_{0};
};

}  // namespace conelight::platform

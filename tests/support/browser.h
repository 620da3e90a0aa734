// SPDX-License-Identifier: MIT
// A headless Chromium that a test drives through the DevTools protocol: JSON messages with a zero byte at the
// end, on file descriptors 3 (to the browser) and 4 (from it). Every wait has a limit; the browser and all it
// started are killed when the object dies, or when the test does.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace conelight::test {

class Browser {
  public:
    // The program: $CONELIGHT_BROWSER, else chromium, chromium-browser or google-chrome of the PATH; "" if
    // none.
    static std::string find();

    // Starts it with a window of that size, one CSS pixel per pixel. Throws std::runtime_error, as all do.
    Browser(const std::string& program, int width, int height);
    ~Browser();
    Browser(const Browser&) = delete;
    Browser& operator=(const Browser&) = delete;

    // Loads a page and waits until it is loaded.
    void open(const std::string& url);
    // Value of a script expression; promises are waited for. Throws what the script throws.
    nlohmann::json evaluate(const std::string& expression);
    // Waits until the expression is true.
    void waitFor(const std::string& expression);

    // Real input: what the page gets is what a user's mouse and keyboard would send. Places in CSS pixels of
    // the window.
    void moveMouse(double x, double y, bool pressed = false);
    void pressMouse(double x, double y);
    void releaseMouse(double x, double y);
    void click(double x, double y);
    // A character, or the name of a key such as ArrowLeft.
    void pressKey(const std::string& key);
    void releaseKey(const std::string& key);
    void typeKey(const std::string& key);

    void screenshot(const std::string& path);  // PNG

    // Errors and warnings of the console, exceptions nobody caught, and resources refused, so far.
    const std::vector<std::string>& problems() const { return problems_; }
    // Addresses that pages asked for, so far.
    const std::vector<std::string>& requests() const { return requests_; }

  private:
    nlohmann::json call(const std::string& method,
                        const nlohmann::json& parameters = nlohmann::json::object());
    nlohmann::json receive();
    void noteEvent(const nlohmann::json& event);
    void stop();

    int process_ = -1, toBrowser_ = -1, fromBrowser_ = -1;
    int lastId_ = 0;
    bool loaded_ = false;
    std::string session_, received_, profile_;
    std::vector<std::string> problems_, requests_;
};

}  // namespace conelight::test

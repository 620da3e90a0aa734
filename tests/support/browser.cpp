// SPDX-License-Identifier: MIT
#include "support/browser.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "io/files.h"
#include "support/gl_fixture.h"

namespace conelight::test {
namespace {

using Clock = std::chrono::steady_clock;

constexpr auto kAnswerPatience = std::chrono::seconds(900);  // for one answer: only what hangs gets there

[[noreturn]] void fail(const std::string& what) { throw std::runtime_error("browser: " + what); }

// In the child, between fork and exec: only calls that are safe there.
[[noreturn]] void becomeBrowser(const std::vector<char*>& arguments, int in, int out) {
    setpgid(0, 0);  // its helpers die with it
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    // The pipes may lie on 3 and 4 in any order: first out of the way, then in place.
    const int input = fcntl(in, F_DUPFD, 10), output = fcntl(out, F_DUPFD, 10);
    const int nowhere = open("/dev/null", O_RDWR);
    dup2(nowhere, 0);
    dup2(nowhere, 1);
    dup2(nowhere, 2);
    dup2(input, 3);
    dup2(output, 4);
    for (int other = 5; other < 256; ++other) close(other);
    execv(arguments[0], arguments.data());
    _exit(127);
}

const char* codeOf(const std::string& key) { return key == " " ? "Space" : key.c_str(); }

nlohmann::json keyEvent(const std::string& type, const std::string& key) {
    nlohmann::json event = {{"type", type}, {"key", key}, {"code", codeOf(key)}};
    const bool isCharacter = key.size() == 1;
    if (isCharacter && type == "keyDown") event["text"] = key;
    const std::pair<const char*, int> codes[] = {
        {"ArrowLeft", 37}, {"ArrowUp", 38}, {"ArrowRight", 39}, {"ArrowDown", 40}, {" ", 32}};
    for (const auto& [name, code] : codes)
        if (key == name) event["windowsVirtualKeyCode"] = code;
    return event;
}

nlohmann::json mouseEvent(const std::string& type, double x, double y, bool pressed) {
    return {{"type", type},
            {"x", x},
            {"y", y},
            {"button", pressed ? "left" : "none"},
            {"buttons", pressed && type != "mouseReleased" ? 1 : 0},
            {"clickCount", type == "mouseMoved" ? 0 : 1}};
}

}  // namespace

std::string Browser::find() {
    if (const char* chosen = std::getenv("CONELIGHT_BROWSER")) return chosen;
    const char* path = std::getenv("PATH");
    for (const char* name : {"chromium", "chromium-browser", "google-chrome"}) {
        std::istringstream folders(path ? path : "");
        for (std::string folder; std::getline(folders, folder, ':');)
            if (access((folder + "/" + name).c_str(), X_OK) == 0) return folder + "/" + name;
    }
    return "";
}

Browser::Browser(const std::string& program, int width, int height) {
    profile_ = scratchDir() + "/browser";
    std::vector<std::string> words = {program,
                                      "--headless",
                                      "--remote-debugging-pipe",
                                      "--no-sandbox",
                                      "--user-data-dir=" + profile_,
                                      "--no-first-run",
                                      "--disable-gpu",
                                      "--enable-unsafe-swiftshader",  // WebGL without a GPU
                                      "--disable-extensions",
                                      "--disable-background-networking",
                                      "--disable-component-update",
                                      "--disable-sync",
                                      "--disable-dev-shm-usage",
                                      "--force-device-scale-factor=1",
                                      "--hide-scrollbars",
                                      "--window-size=" + std::to_string(width) + "," + std::to_string(height),
                                      "about:blank"};
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);

    int to[2], from[2];
    if (pipe2(to, O_CLOEXEC) != 0 || pipe2(from, O_CLOEXEC) != 0) fail("no pipes");
    signal(SIGPIPE, SIG_IGN);  // a browser that died is an error message, not the end of all tests
    process_ = fork();
    if (process_ < 0) fail("cannot be started");
    if (process_ == 0) becomeBrowser(arguments, to[0], from[1]);
    close(to[0]);
    close(from[1]);
    toBrowser_ = to[1];
    fromBrowser_ = from[0];

    try {
        const nlohmann::json target = call("Target.createTarget", {{"url", "about:blank"}});
        const nlohmann::json attached =
            call("Target.attachToTarget", {{"targetId", target["targetId"]}, {"flatten", true}});
        session_ = attached["sessionId"];
        for (const char* domain : {"Page", "Runtime", "Log", "Network"})
            call(std::string(domain) + ".enable");
        call("Emulation.setDeviceMetricsOverride",
             {{"width", width}, {"height", height}, {"deviceScaleFactor", 1}, {"mobile", false}});
    } catch (...) {
        stop();
        throw;
    }
}

Browser::~Browser() { stop(); }

void Browser::stop() {
    if (process_ > 0) {
        kill(-process_, SIGKILL);
        kill(process_, SIGKILL);
        waitpid(process_, nullptr, 0);
    }
    for (const int pipe : {toBrowser_, fromBrowser_})
        if (pipe >= 0) close(pipe);
    process_ = toBrowser_ = fromBrowser_ = -1;
    std::error_code ignored;
    std::filesystem::remove_all(profile_, ignored);
}

nlohmann::json Browser::receive() {
    const auto end = Clock::now() + kAnswerPatience;
    for (;;) {
        const std::size_t zero = received_.find('\0');
        if (zero != std::string::npos) {
            const nlohmann::json message = nlohmann::json::parse(received_.substr(0, zero));
            received_.erase(0, zero + 1);
            return message;
        }
        const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now()).count();
        pollfd waiting = {fromBrowser_, POLLIN, 0};
        if (left <= 0 || poll(&waiting, 1, static_cast<int>(left)) <= 0) fail("gives no answer");
        char buffer[65536];
        const ssize_t count = read(fromBrowser_, buffer, sizeof buffer);
        if (count <= 0) fail("has ended");
        received_.append(buffer, static_cast<std::size_t>(count));
    }
}

nlohmann::json Browser::call(const std::string& method, const nlohmann::json& parameters) {
    nlohmann::json message = {{"id", ++lastId_}, {"method", method}, {"params", parameters}};
    if (!session_.empty()) message["sessionId"] = session_;
    std::string text = message.dump();
    text += '\0';
    for (std::size_t sent = 0; sent < text.size();) {
        const ssize_t count = write(toBrowser_, text.data() + sent, text.size() - sent);
        if (count <= 0) fail("does not listen");
        sent += static_cast<std::size_t>(count);
    }
    for (;;) {
        const nlohmann::json answer = receive();
        if (answer.value("id", 0) != lastId_) {
            noteEvent(answer);
            continue;
        }
        if (answer.contains("error")) fail(method + ": " + answer["error"].dump());
        return answer["result"];
    }
}

void Browser::noteEvent(const nlohmann::json& event) {
    const std::string method = event.value("method", "");
    const nlohmann::json parameters = event.value("params", nlohmann::json::object());
    if (method == "Page.loadEventFired") loaded_ = true;
    if (method == "Network.requestWillBeSent") requests_.push_back(parameters["request"]["url"]);
    if (method == "Runtime.exceptionThrown") problems_.push_back(parameters["exceptionDetails"].dump());
    if (method == "Log.entryAdded") problems_.push_back(parameters["entry"].dump());
    if (method == "Runtime.consoleAPICalled" && parameters["type"] != "log" && parameters["type"] != "info")
        problems_.push_back(parameters.dump());
}

void Browser::open(const std::string& url) {
    loaded_ = false;
    const nlohmann::json result = call("Page.navigate", {{"url", url}});
    if (result.contains("errorText")) fail(url + ": " + result["errorText"].dump());
    while (!loaded_) noteEvent(receive());
}

nlohmann::json Browser::evaluate(const std::string& expression) {
    const nlohmann::json result = call(
        "Runtime.evaluate", {{"expression", expression}, {"returnByValue", true}, {"awaitPromise", true}});
    if (result.contains("exceptionDetails")) fail(expression + ": " + result["exceptionDetails"].dump());
    return result["result"].value("value", nlohmann::json());
}

void Browser::waitFor(const std::string& expression) {
    const auto end = Clock::now() + kAnswerPatience;
    while (evaluate("Boolean(" + expression + ")") != true) {
        if (Clock::now() > end) fail("waited in vain for " + expression);
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
}

void Browser::moveMouse(double x, double y, bool pressed) {
    call("Input.dispatchMouseEvent", mouseEvent("mouseMoved", x, y, pressed));
}
void Browser::pressMouse(double x, double y) {
    call("Input.dispatchMouseEvent", mouseEvent("mousePressed", x, y, true));
}
void Browser::releaseMouse(double x, double y) {
    call("Input.dispatchMouseEvent", mouseEvent("mouseReleased", x, y, true));
}
void Browser::click(double x, double y) {
    moveMouse(x, y);
    pressMouse(x, y);
    releaseMouse(x, y);
}

void Browser::pressKey(const std::string& key) { call("Input.dispatchKeyEvent", keyEvent("keyDown", key)); }
void Browser::releaseKey(const std::string& key) { call("Input.dispatchKeyEvent", keyEvent("keyUp", key)); }
void Browser::typeKey(const std::string& key) {
    pressKey(key);
    releaseKey(key);
}

void Browser::screenshot(const std::string& path) {
    const nlohmann::json result =
        call("Page.captureScreenshot", {{"format", "png"}, {"captureBeyondViewport", true}});
    const std::optional<io::Bytes> bytes = io::base64Decoded(result["data"].get<std::string>());
    if (!bytes) fail("sends no picture");
    io::writeFile(path, *bytes);
}

}  // namespace conelight::test

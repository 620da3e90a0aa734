// SPDX-License-Identifier: MIT
// Light maps in three.js: the page of examples/three_js draws the Cornell box from baked files in a headless browser,
// and its picture is the path tracer's. Skipped without a browser, Python or three.js (libjs-three).
// CONELIGHT_SCREENSHOTS=DIR keeps a picture of the page.
#include <gtest/gtest.h>
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <iostream>

#include "io/scene_file.h"
#include "reference/metrics.h"
#include "reference/path_tracer.h"
#include "support/browser.h"
#include "support/program.h"

namespace conelight::test {
namespace {

namespace fs = std::filesystem;

constexpr int kWidth = 64, kHeight = 48;
constexpr const char* kThree = "/usr/share/javascript/three";

// Serves a folder to this machine until it dies.
class FileServer {
  public:
    explicit FileServer(const std::string& folder) {
        const std::string script =
            "import functools, http.server, os, threading, time\n"
            "class Quiet(http.server.SimpleHTTPRequestHandler):\n"
            "    def log_message(self, *rest): pass\n"
            "server = http.server.ThreadingHTTPServer((\"127.0.0.1\", 0), functools.partial(Quiet, "
            "directory=\"" +
            folder +
            "\"))\n"
            "parent = os.getppid()\n"
            "def watch():\n"
            "    while os.getppid() == parent: time.sleep(1)\n"
            "    os._exit(0)\n"
            "threading.Thread(target=watch, daemon=True).start()\n"
            "print(os.getpid(), server.server_address[1], flush=True)\n"
            "server.serve_forever()\n";
        pipe_ = popen(("exec python3 -c '" + script + "'").c_str(), "r");
        if (pipe_ != nullptr && std::fscanf(pipe_, "%d %d", &process_, &port_) != 2) port_ = 0;
    }
    ~FileServer() {
        if (process_ > 0) kill(process_, SIGTERM);
        if (pipe_ != nullptr) pclose(pipe_);
    }
    FileServer(const FileServer&) = delete;
    FileServer& operator=(const FileServer&) = delete;
    int port() const { return port_; }

  private:
    std::FILE* pipe_ = nullptr;
    int process_ = 0, port_ = 0;
};

TEST(ThreeJsTest, DrawsTheCornellBoxOfThePathTracer) {
    const std::string browserProgram = Browser::find();
    if (browserProgram.empty()) GTEST_SKIP() << "no browser; scripts/install_packages --browser installs one";
    if (!fs::exists(std::string(kThree) + "/build/three.module.js"))
        GTEST_SKIP() << "no three.js; scripts/install_packages --browser installs libjs-three";
    if (runCommand("command -v python3").status != 0) GTEST_SKIP() << "no python3, which serves the page";
    const std::string folder = scratchPath("three_js");
    fs::remove_all(folder);
    fs::create_directories(folder);
    for (const char* name : {"index.html", "light_maps.js"})
        fs::copy_file(std::string(CONELIGHT_SOURCE_DIR) + "/examples/three_js/" + name, folder + "/" + name);
    fs::create_symlink(kThree, folder + "/three");
    const CommandResult baked =
        conelight("bake builtin:cornell --lightmaps --direct --samples 256 --no-check --texel 0.04 -o '" +
                  folder + "/maps'");
    ASSERT_EQ(baked.status, 0) << baked.output;
    const FileServer server(folder);
    ASSERT_GT(server.port(), 0);

    Browser browser(browserProgram, 640, 480);
    browser.open("http://127.0.0.1:" + std::to_string(server.port()) + "/index.html");
    browser.waitFor("typeof window.linearPicture === \"function\"");
    if (const char* keep = std::getenv("CONELIGHT_SCREENSHOTS"))
        browser.screenshot(std::string(keep) + "/three_js.png");
    const nlohmann::json values = browser.evaluate("window.linearPicture(" + std::to_string(kWidth) + ", " +
                                                   std::to_string(kHeight) + ")");
    ASSERT_EQ(values.size(), std::size_t(3 * kWidth * kHeight));

    const Scene scene = io::loadScene("builtin:cornell");
    reference::PathTracerSettings settings;
    settings.samplesPerPixel = 512;
    const reference::PathTracedPicture truth =
        reference::PathTracer(scene).render(scene.cameras[0], kWidth, kHeight, settings);
    // The lamp is as bright as it is; what it lights is compared, without the lamp's edge.
    constexpr float kOfLamp = 4;
    int lamp = 0;
    Image shown = truth.full, wanted = truth.full;
    for (std::size_t i = 0; i < shown.pixels.size(); ++i) {
        for (int c = 0; c < 3; ++c) shown.pixels[i][c] = values[3 * i + std::size_t(c)];
        if (std::max(shown.pixels[i].r, wanted.pixels[i].r) < kOfLamp) continue;
        if (std::min(shown.pixels[i].r, wanted.pixels[i].r) > kOfLamp) {
            EXPECT_NEAR(shown.pixels[i].r, wanted.pixels[i].r, 0.02f * wanted.pixels[i].r);
            ++lamp;
        }
        shown.pixels[i] = wanted.pixels[i] = glm::vec4(0, 0, 0, 1);
    }
    EXPECT_GT(lamp, 4);
    reference::MetricOptions numbers;
    numbers.flip = false;
    const reference::Metrics metrics = compareImages(shown, wanted, numbers);
    std::cout << "three.js against the path tracer: relRMSE " << 100 * metrics.relRmse << " %, 4x4 blocks "
              << 100 * metrics.blockRelRmse << " %, bias " << 100 * metrics.bias << " %\n";
    EXPECT_LT(metrics.blockRelRmse, 0.05);
    EXPECT_LT(std::abs(metrics.bias), 0.02);
    for (const std::string& problem : browser.problems())
        if (problem.find("favicon") == std::string::npos && problem.find("Performance") == std::string::npos)
            ADD_FAILURE() << problem;
}

}  // namespace
}  // namespace conelight::test

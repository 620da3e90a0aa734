// SPDX-License-Identifier: MIT
// An OpenGL 4.5 core context without window or display, through EGL: the device platform (a GPU first, then
// a software device), then Mesa's surfaceless platform. There is no default framebuffer.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "conelight/export.h"

namespace conelight::platform {

constexpr int kAnyDevice = -1;

struct HeadlessOptions {
    int device = kAnyDevice;  // index into listDevices(); kAnyDevice: the first that gives a 4.5 core context
    bool debug = false;       // a debug context, which reports errors (RendererOptions::reportGlErrors)
};

// What EGL has current on a thread.
struct Current {
    void *display = nullptr, *context = nullptr, *draw = nullptr, *read = nullptr;
};

// Current on the creating thread from construction to destruction, when the context that was current before
// comes back. Contexts of one process may live at the same time. Throws Error(NoGl) with what was tried,
// Error(Usage) for a device that is not listed.
class CONELIGHT_API HeadlessContext {
  public:
    explicit HeadlessContext(const HeadlessOptions& options = {});
    ~HeadlessContext();
    HeadlessContext(const HeadlessContext&) = delete;
    HeadlessContext& operator=(const HeadlessContext&) = delete;

    const std::string& description() const { return description_; }  // "EGL device 0, llvmpipe ..., 4.5 ..."
    // Gives the creating thread back what was current before; from then on current as CurrentContext says.
    void release();

  private:
    friend class CurrentContext;
    void release(const Current& previous);
    bool tryDisplay(void* display, const std::string& how, bool debug);
    void* display_ = nullptr;
    void* context_ = nullptr;
    Current previous_;
    std::string description_;
    std::string tried_;
};

// Makes a context that was released current on the calling thread; at its end, what was current there before
// is again. For hosts whose calls come from several threads: one at a time per context. Throws Error(Runtime).
class CONELIGHT_API CurrentContext {
  public:
    explicit CurrentContext(HeadlessContext& context);
    ~CurrentContext();
    CurrentContext(const CurrentContext&) = delete;
    CurrentContext& operator=(const CurrentContext&) = delete;

  private:
    HeadlessContext& context_;
    Current previous_;
};

// One line per EGL device: "0: hardware, /dev/dri/card0", "1: software". Empty without EGL.
CONELIGHT_API std::vector<std::string> listDevices();

// What the current context offers beside what this library uses of it.
struct DeviceLimit {
    std::string name;
    long long value;
    long long used;  // most that Conelight asks for
};
CONELIGHT_API std::vector<DeviceLimit> deviceLimits();
// Extensions Conelight uses when they are there: name, present.
CONELIGHT_API std::vector<std::pair<std::string, bool>> optionalExtensions();

// Call first thing in main(): on software drivers the renderer's memory is freed and re-mapped for every
// draw unless glibc's malloc is told to keep it (20-50 % of the CPU time of raster passes).
CONELIGHT_API void tuneAllocator();

}  // namespace conelight::platform

// SPDX-License-Identifier: MIT
#include "support/x11_client.h"

#include <stdexcept>

#ifdef CONELIGHT_TEST_X11

#include <X11/Xatom.h>
#include <X11/Xlib.h>
#include <X11/Xutil.h>

#include <chrono>
#include <cstdio>
#include <thread>

namespace conelight::test {
namespace {

constexpr double kEventPatience = 900;  // s: only what hangs gets there

class Client {
  public:
    explicit Client(const std::string& display) : display_(XOpenDisplay(display.c_str())) {
        if (display_ == nullptr) throw std::runtime_error(display + " cannot be opened");
        root_ = DefaultRootWindow(display_);
    }
    ~Client() { XCloseDisplay(display_); }
    Client(const Client&) = delete;
    Client& operator=(const Client&) = delete;

    Display* display() const { return display_; }
    Atom atom(const char* name) const { return XInternAtom(display_, name, False); }
    Window root() const { return root_; }

    Window windowNamed(const std::string& title) const {
        Window root = 0, parent = 0, *children = nullptr;
        unsigned count = 0;
        XQueryTree(display_, root_, &root, &parent, &children, &count);
        Window found = 0;
        for (unsigned i = 0; i < count; ++i) {
            char* name = nullptr;
            if (XFetchName(display_, children[i], &name) == 0 || name == nullptr) continue;
            const std::string text = name;
            XFree(name);
            if (text.size() >= title.size() && text.substr(text.size() - title.size()) == title)
                found = children[i];
        }
        if (children != nullptr) XFree(children);
        if (found == 0) throw std::runtime_error("no window is named " + title);
        return found;
    }

    void message(Window window, const char* type, const long (&data)[5]) const {
        XEvent event{};
        event.xclient.type = ClientMessage;
        event.xclient.window = window;
        event.xclient.message_type = atom(type);
        event.xclient.format = 32;
        for (int i = 0; i < 5; ++i) event.xclient.data.l[i] = data[i];
        XSendEvent(display_, window, False, NoEventMask, &event);
        XFlush(display_);
    }

    // The next event of this type (and, of client messages, of this kind).
    bool wait(int type, Atom kind, XEvent& event) const {
        const auto until = std::chrono::steady_clock::now() + std::chrono::duration<double>(kEventPatience);
        while (std::chrono::steady_clock::now() < until) {
            while (XPending(display_) > 0) {
                XNextEvent(display_, &event);
                if (event.type == type && (type != ClientMessage || event.xclient.message_type == kind))
                    return true;
            }
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
        return false;
    }

  private:
    Display* display_;
    Window root_ = 0;
};

// file:///path, with all but plain letters as %XX.
std::string uriOf(const std::string& path) {
    std::string uri = "file://";
    for (const char c : path) {
        const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                           c == '/' || c == '.' || c == '-' || c == '_';
        char escaped[4];
        std::snprintf(escaped, sizeof escaped, "%%%02X",
                      static_cast<unsigned>(static_cast<unsigned char>(c)));
        uri += plain ? std::string(1, c) : std::string(escaped);
    }
    return uri;
}

}  // namespace

std::string x11Missing() { return {}; }

void pressCloseButton(const std::string& display, const std::string& title) {
    const Client client(display);
    client.message(client.windowNamed(title), "WM_PROTOCOLS",
                   {static_cast<long>(client.atom("WM_DELETE_WINDOW")), CurrentTime, 0, 0, 0});
}

void setScreenDpi(const std::string& display, int dpi) {
    const Client client(display);
    const std::string text = "Xft.dpi:\t" + std::to_string(dpi) + "\n";
    XChangeProperty(client.display(), client.root(), client.atom("RESOURCE_MANAGER"), XA_STRING, 8,
                    PropModeReplace, reinterpret_cast<const unsigned char*>(text.data()),
                    static_cast<int>(text.size()));
    // A server starts anew when its last client has gone, unless that one asked it not to.
    XSetCloseDownMode(client.display(), RetainPermanent);
    XSync(client.display(), False);
}

bool dropFiles(const std::string& display, const std::string& title, const std::vector<std::string>& paths) {
    const Client client(display);
    Display* x = client.display();
    const Window target = client.windowNamed(title);
    const Window source = XCreateSimpleWindow(x, client.root(), 0, 0, 1, 1, 0, 0, 0);
    const long from = static_cast<long>(source);
    const Atom selection = client.atom("XdndSelection"), list = client.atom("text/uri-list");
    XSetSelectionOwner(x, selection, source, CurrentTime);
    client.message(target, "XdndEnter", {from, 5L << 24, static_cast<long>(list), 0, 0});
    client.message(
        target, "XdndPosition",
        {from, 0, (50L << 16) | 50, CurrentTime, static_cast<long>(client.atom("XdndActionCopy"))});
    XEvent event;
    if (!client.wait(ClientMessage, client.atom("XdndStatus"), event)) return false;
    if ((event.xclient.data.l[1] & 1) == 0) return false;  // not taken there
    client.message(target, "XdndDrop", {from, 0, CurrentTime, 0, 0});
    if (!client.wait(SelectionRequest, None, event)) return false;
    const XSelectionRequestEvent asked = event.xselectionrequest;
    std::string uris;
    for (const std::string& path : paths) uris += uriOf(path) + "\r\n";
    XChangeProperty(x, asked.requestor, asked.property, asked.target, 8, PropModeReplace,
                    reinterpret_cast<const unsigned char*>(uris.data()), static_cast<int>(uris.size()));
    XEvent answer{};
    answer.xselection.type = SelectionNotify;
    answer.xselection.requestor = asked.requestor;
    answer.xselection.selection = asked.selection;
    answer.xselection.target = asked.target;
    answer.xselection.property = asked.property;
    answer.xselection.time = asked.time;
    XSendEvent(x, asked.requestor, False, NoEventMask, &answer);
    XFlush(x);
    return client.wait(ClientMessage, client.atom("XdndFinished"), event);
}

}  // namespace conelight::test

#else

namespace conelight::test {

std::string x11Missing() { return "built without Xlib (package libx11-dev)"; }
void setScreenDpi(const std::string&, int) { throw std::runtime_error(x11Missing()); }
void pressCloseButton(const std::string&, const std::string&) { throw std::runtime_error(x11Missing()); }
bool dropFiles(const std::string&, const std::string&, const std::vector<std::string>&) {
    throw std::runtime_error(x11Missing());
}

}  // namespace conelight::test

#endif

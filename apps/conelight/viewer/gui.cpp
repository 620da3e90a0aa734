// SPDX-License-Identifier: MIT
#include "viewer/gui.h"

#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>
#include <imgui_internal.h>  // OpenPopupStack

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <set>

#include "viewer/imgui_names.h"

namespace conelight::program {
namespace {

// Fonts of the Debian packages fonts-dejavu-core and fonts-liberation; ImGui's own bitmap font else.
constexpr std::array<const char*, 3> kFonts = {
    "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
    "/usr/share/fonts/truetype/liberation/LiberationSans-Regular.ttf",
    "/usr/share/fonts/truetype/freefont/FreeSans.ttf"};
constexpr float kFontSize = 14.0f;  // px at 96 dpi
constexpr float kMinScale = 0.5f, kMaxScale = 4;

bool isModifier(int key) { return key >= GLFW_KEY_LEFT_SHIFT && key <= GLFW_KEY_RIGHT_SUPER; }

// Ctrl, Shift, Alt and Super as they were when the key came. Newer backends of Dear ImGui ask what is down now,
// when a quick Ctrl may be up again.
void tellModifiers([[maybe_unused]] const platform::Window::KeyEvent& event) {
#if IMGUI_VERSION_NUM >= 18900
    struct Modifier {
        ImGuiKey name;
        int bit, left, right;
    };
    for (const auto& [name, bit, left, right] :
         {Modifier{ImGuiMod_Ctrl, GLFW_MOD_CONTROL, GLFW_KEY_LEFT_CONTROL, GLFW_KEY_RIGHT_CONTROL},
          Modifier{ImGuiMod_Shift, GLFW_MOD_SHIFT, GLFW_KEY_LEFT_SHIFT, GLFW_KEY_RIGHT_SHIFT},
          Modifier{ImGuiMod_Alt, GLFW_MOD_ALT, GLFW_KEY_LEFT_ALT, GLFW_KEY_RIGHT_ALT},
          Modifier{ImGuiMod_Super, GLFW_MOD_SUPER, GLFW_KEY_LEFT_SUPER, GLFW_KEY_RIGHT_SUPER}}) {
        const bool itself = event.key == left || event.key == right;
        const bool down = itself ? event.action != GLFW_RELEASE : (event.modifiers & bit) != 0;
        ImGui::GetIO().AddKeyEvent(name, down);
    }
#endif
}

// Neutral greys, so that the GUI does not tint the eye that judges the picture; one accent. The light ones are the
// dark ones turned round, with a little less contrast between grounds.
void setColors(ImGuiStyle& style, bool light) {
    const ImVec4 accent = light ? ImVec4(0.13f, 0.40f, 0.68f, 1) : ImVec4(0.36f, 0.58f, 0.80f, 1);
    const ImVec4 accentDim = light ? ImVec4(0.60f, 0.76f, 0.92f, 1) : ImVec4(0.28f, 0.40f, 0.52f, 1);
    const auto grey = [light](float value, float alpha = 1) {
        const float shown = light ? std::clamp(1.1f - 1.36f * value, 0.07f, 1.0f) : value;
        return ImVec4(shown, shown, shown, alpha);
    };
    ImVec4* c = style.Colors;
    c[ImGuiCol_Text] = grey(0.88f);
    c[ImGuiCol_TextDisabled] = grey(0.50f);
    c[ImGuiCol_WindowBg] = grey(0.13f);
    c[ImGuiCol_ChildBg] = grey(0.13f);
    c[ImGuiCol_PopupBg] = grey(0.10f, 0.97f);
    c[ImGuiCol_Border] = grey(0.22f);
    c[ImGuiCol_FrameBg] = grey(0.19f);
    c[ImGuiCol_FrameBgHovered] = grey(0.24f);
    c[ImGuiCol_FrameBgActive] = grey(0.27f);
    c[ImGuiCol_TitleBg] = grey(0.11f);
    c[ImGuiCol_TitleBgActive] = grey(0.11f);
    c[ImGuiCol_MenuBarBg] = grey(0.11f);
    c[ImGuiCol_ScrollbarBg] = grey(0.13f);
    c[ImGuiCol_ScrollbarGrab] = grey(0.27f);
    c[ImGuiCol_ScrollbarGrabHovered] = grey(0.33f);
    c[ImGuiCol_ScrollbarGrabActive] = grey(0.38f);
    c[ImGuiCol_CheckMark] = accent;
    c[ImGuiCol_SliderGrab] = accent;
    c[ImGuiCol_SliderGrabActive] = light ? ImVec4(0.08f, 0.30f, 0.56f, 1) : ImVec4(0.45f, 0.68f, 0.90f, 1);
    c[ImGuiCol_Button] = grey(0.21f);
    c[ImGuiCol_ButtonHovered] = grey(0.27f);
    c[ImGuiCol_ButtonActive] = accentDim;
    c[ImGuiCol_Header] = grey(0.19f);
    c[ImGuiCol_HeaderHovered] = grey(0.24f);
    c[ImGuiCol_HeaderActive] = accentDim;
    c[ImGuiCol_Separator] = grey(0.22f);
    c[ImGuiCol_Tab] = grey(0.15f);
    c[ImGuiCol_TabHovered] = grey(0.26f);
    c[kColTabShown] = grey(0.22f);
    c[ImGuiCol_PlotHistogram] = accent;
    c[ImGuiCol_PlotLines] = accent;
    c[ImGuiCol_TableHeaderBg] = grey(0.16f);
    c[ImGuiCol_TableRowBgAlt] = grey(1, 0.02f);
    c[ImGuiCol_TextSelectedBg] = accentDim;
    c[ImGuiCol_ModalWindowDimBg] = {0, 0, 0, 0.45f};
}

}  // namespace

Gui::Gui(platform::Window& window, float scale) : window_(window), followsScreen_(!(scale > 0)) {
    IMGUI_CHECKVERSION();
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;  // the layout follows the window's size
    ImGui::GetIO().ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
    scale_ = wantedScale_ = followsScreen_ ? window.contentScale() : scale;
    applyLook();
    ImGui_ImplGlfw_InitForOpenGL(window.handle(), true);
    window.listen();  // takeEvents() tells what comes
#if IMGUI_VERSION_NUM >= 18700
    ImGui::GetIO().ConfigInputTrickleEventQueue = false;  // events are told in frames already
#endif
    ImGui_ImplOpenGL3_Init("#version 450 core");
}

Gui::~Gui() {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
}

void Gui::applyLook() {
    ImGuiStyle& style = ImGui::GetStyle();
    style = ImGuiStyle();  // sizes are scaled from the originals
    light_ ? ImGui::StyleColorsLight() : ImGui::StyleColorsDark();
    style.WindowRounding = 0;
    style.ChildRounding = 0;
    // Square: a rounded rectangle is up to 46 triangles, and they are half of what the GUI costs a CPU
    // driver.
    style.FrameRounding = 0;
    style.GrabRounding = 0;
    style.TabRounding = 0;
    style.WindowBorderSize = 0;
    style.PopupBorderSize = 1;
    style.WindowPadding = {10, 8};
    style.FramePadding = {7, 3};
    style.ItemSpacing = {7, 5};
    style.IndentSpacing = 14;
    style.ScrollbarSize = 11;
    style.GrabMinSize = 9;
    setColors(style, light_);
    style.ScaleAllSizes(scale_);

    ImGuiIO& io = ImGui::GetIO();
    io.Fonts->Clear();
    for (const char* file : kFonts)
        if (std::error_code ignored; std::filesystem::exists(file, ignored)) {
            io.Fonts->AddFontFromFileTTF(file, std::round(kFontSize * scale_));
            return;
        }
    ImFontConfig config;
    config.SizePixels = std::round(13.0f * scale_);  // the bitmap font's own size
    io.Fonts->AddFontDefault(&config);
}

// Keys are told in their order, each where those before it have led, however many come during one frame. A key
// that is no character ends a frame's share: it may open or leave a field. A field that asks for the keys at that
// has them in the third frame. Keys that go up do not wait for it: one that is held repeats. Dear ImGui looks at keys
// once a frame: none goes down and up in one. What was clicked before a key has its frames before it: text belongs to
// the field that was clicked.
void Gui::takeKeys() {
    constexpr int kFramesToFocus = 3;
    keyPresses_.clear();
    framesToPass_ = std::max(framesToPass_ - 1, 0);
    std::set<int> changed;
    for (; !keyEvents_.empty(); keyEvents_.pop_front()) {
        const platform::Window::KeyEvent& event = keyEvents_.front();
        const bool goesUp = event.character == 0 && event.action == GLFW_RELEASE;
        const bool afterClick = !buttonChanges_.empty() && event.number > buttonChanges_.front().number;
        if (afterClick || (framesToPass_ > 0 && !goesUp)) return;
        // Ctrl of a Ctrl+A that came in two parts is still down in the frame that sees A.
        if (goesUp && isModifier(event.key) && !keyPresses_.empty()) return;
        if (event.character != 0) {
            ImGui_ImplGlfw_CharCallback(window_.handle(), event.character);
            continue;
        }
        const bool character = event.key < GLFW_KEY_ESCAPE && !event.control();
        if (!character && !changed.insert(event.key).second) return;
        ImGui_ImplGlfw_KeyCallback(window_.handle(), event.key, event.scancode, event.action,
                                   event.modifiers);
        tellModifiers(event);
        if (event.action != GLFW_PRESS) continue;
        keyPresses_.push_back(event);
        if (!character && !isModifier(event.key)) framesToPass_ = kFramesToFocus;
    }
}

// Of the mouse's buttons too Dear ImGui sees what they are at a frame, and the cursor then. Of clicks that came while a
// picture was drawn it would see one, where the cursor is by now: it gets one change a frame instead, where the cursor
// was, behind the keys that came before.
void Gui::takeButtons() {
    ImGuiIO& io = ImGui::GetIO();
#if IMGUI_VERSION_NUM < 18700
    std::copy(std::begin(buttonsDown_), std::end(buttonsDown_), std::begin(io.MouseDown));
#else
    if (cursorWasElsewhere_ && !window_.cursorCaptured()) {
        const glm::vec2 cursor(window_.cursor());
        io.AddMousePosEvent(cursor.x, cursor.y);
    }
    cursorWasElsewhere_ = false;
#endif
    if (buttonChanges_.empty()) return;
    const platform::Window::ButtonChange next = buttonChanges_.front();
    if (!keyEvents_.empty() && keyEvents_.front().number < next.number) return;
    buttonChanges_.pop_front();
    const glm::vec2 at(next.at);
#if IMGUI_VERSION_NUM < 18700
    buttonsDown_[static_cast<std::size_t>(next.button)] = io.MouseDown[next.button] = next.down;
    io.MousePos = {at.x, at.y};
#else
    io.AddMousePosEvent(at.x, at.y);
    io.AddMouseButtonEvent(next.button, next.down);
    cursorWasElsewhere_ = true;
#endif
}

void Gui::takeEvents() {
    for (const platform::Window::KeyEvent& event : window_.takeKeyEvents()) keyEvents_.push_back(event);
    for (const platform::Window::ButtonChange& change : window_.takeButtonChanges())
        if (change.button >= 0 && change.button < IM_ARRAYSIZE(ImGui::GetIO().MouseDown))
            buttonChanges_.push_back(change);
    takeKeys();
    takeButtons();
}

void Gui::setScale(float scale) {
    followsScreen_ = !(scale > 0);
    chosenScale_ = followsScreen_ ? 0 : std::clamp(scale, kMinScale, kMaxScale);
    wantedScale_ = followsScreen_ ? window_.contentScale() : *chosenScale_;
}

void Gui::setLight(bool light) {
    light_ = light;
    light ? ImGui::StyleColorsLight() : ImGui::StyleColorsDark();
    setColors(ImGui::GetStyle(), light);
}

void Gui::beginFrame() {
    if (const float scale = followsScreen_ ? window_.contentScale() : wantedScale_; scale != scale_) {
        scale_ = scale;
        applyLook();
        // The font's texture alone: Dear ImGui 1.86 forgets the size of buffers that it makes anew, and draws
        // nothing from then on. Before the first frame there is none.
        if (ImGui::GetIO().Fonts->TexID != ImTextureID{}) {
            ImGui_ImplOpenGL3_DestroyFontsTexture();
            ImGui_ImplOpenGL3_CreateFontsTexture();
        }
    }
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    takeEvents();
    // A captured cursor belongs to the camera.
    if (window_.cursorCaptured()) ImGui::GetIO().MousePos = {-FLT_MAX, -FLT_MAX};
    takeReturn();
    ImGui::NewFrame();
}

// Before Dear ImGui 1.87 Space alone presses what keys have marked; in menus and dialogs Return is expected to.
void Gui::takeReturn() {
#if IMGUI_VERSION_NUM < 18700
    ImGuiIO& io = ImGui::GetIO();
    const bool down = io.KeysDown[GLFW_KEY_ENTER] || io.KeysDown[GLFW_KEY_KP_ENTER];
    if (down && !io.WantTextInput && ImGui::GetCurrentContext()->OpenPopupStack.Size > 0)
        io.NavInputs[ImGuiNavInput_Activate] = 1;
#endif
}

void Gui::endFrame() {
    ImGui::Render();
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

bool Gui::wantsMouse() const { return ImGui::GetIO().WantCaptureMouse; }
bool Gui::wantsKeyboard() const { return ImGui::GetIO().WantTextInput; }

bool Gui::hasInput() const { return !buttonChanges_.empty() || !keyEvents_.empty(); }

}  // namespace conelight::program

// SPDX-License-Identifier: MIT
// A window of SDL2 with an OpenGL 4.5 context, which examples draw in. No display is needed with SDL_VIDEODRIVER=offscreen.
#pragma once

#include <SDL.h>
#include <conelight/error.h>

struct Window {
    SDL_Window* window = nullptr;
    SDL_GLContext context = nullptr;

    // profile: SDL_GL_CONTEXT_PROFILE_...
    Window(const char* title, int width, int height, int profile) {
        SDL_Init(SDL_INIT_VIDEO);
        SDL_GL_SetAttribute(SDL_GL_CONTEXT_PROFILE_MASK, profile);
        SDL_GL_SetAttribute(SDL_GL_CONTEXT_MAJOR_VERSION, 4);
        SDL_GL_SetAttribute(SDL_GL_CONTEXT_MINOR_VERSION, 5);
        window = SDL_CreateWindow(title, SDL_WINDOWPOS_CENTERED, SDL_WINDOWPOS_CENTERED, width, height,
                                  SDL_WINDOW_OPENGL);
        if (window != nullptr) context = SDL_GL_CreateContext(window);
        if (context == nullptr) throw conelight::Error(conelight::ErrorKind::NoGl, SDL_GetError());
    }
    ~Window() {
        SDL_GL_DeleteContext(context);
        SDL_DestroyWindow(window);
        SDL_Quit();
    }
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    // Shows what was drawn. False: it was closed.
    bool show() const {
        SDL_GL_SwapWindow(window);
        for (SDL_Event event; SDL_PollEvent(&event) != 0;)
            if (event.type == SDL_QUIT) return false;
        return true;
    }
};

// SPDX-License-Identifier: MIT
// Work beside the window: the window goes on while a piece lasts, and sees what it drew.
#include "platform/render_thread.h"

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <future>
#include <stdexcept>
#include <vector>

#include "platform/window.h"
#include "support/virtual_screen.h"

namespace conelight::test {
namespace {

TEST(RenderThreadTest, ThePictureIsDrawnWhileTheWindowGoesOn) {
    if (const std::string missing = VirtualScreen::missing(); !missing.empty()) GTEST_SKIP() << missing;
    const VirtualScreen screen(320, 240);
    setenv("DISPLAY", screen.display().c_str(), 1);
    platform::Window window({64, 64});
    std::vector<int> order;
    {
        platform::RenderThread thread(window, true);
        std::promise<void> held;
        GLuint texture = 0;
        thread.post([&] {
            held.get_future().wait();
            const float green[4] = {0, 1, 0, 1};
            glCreateTextures(GL_TEXTURE_2D, 1, &texture);
            glTextureStorage2D(texture, 1, GL_RGBA8, 2, 2);
            glClearTexImage(texture, 0, GL_RGBA, GL_FLOAT, green);
            order.push_back(1);
        });
        EXPECT_FALSE(thread.wait(0)) << "on a software driver it goes on beside";
        window.pollEvents(0);
        window.swapBuffers();
        held.set_value();
        EXPECT_THROW(thread.run([&] {
            order.push_back(2);
            throw std::runtime_error("what the work throws");
        }),
                     std::runtime_error);
        EXPECT_TRUE(thread.wait(60));
        unsigned char pixels[16] = {};
        glGetTextureImage(texture, 0, GL_RGBA, GL_UNSIGNED_BYTE, sizeof pixels, pixels);
        EXPECT_EQ(pixels[12], 0);
        EXPECT_EQ(pixels[13], 255) << "its objects are the window's";
        glDeleteTextures(1, &texture);
        thread.post([&] { order.push_back(3); });
    }
    EXPECT_EQ(order, (std::vector<int>{1, 2, 3})) << "what was posted is done before the thread ends";
    platform::RenderThread own(window, false);
    own.post([&] { order.push_back(4); });
    EXPECT_TRUE(own.wait(0)) << "on the window's thread, at once";
    EXPECT_EQ(order.size(), 4u);
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
}

}  // namespace
}  // namespace conelight::test

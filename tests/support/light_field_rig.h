// SPDX-License-Identifier: MIT
// What tests of LightField share: a room, a host that draws it with shaders of its own, and what Renderer shows of it.
#pragma once

#include <functional>
#include <vector>

#include "conelight/light_field.h"
#include "conelight/renderer.h"
#include "gl/draw.h"
#include "support/gl_fixture.h"

namespace conelight::test {

constexpr int kHostWidth = 60, kHostHeight = 44;

// A room of edge 2 without gloss, but for a box of white metal; boxes turned out of the grid's axes.
Scene hostRoom();
constexpr std::size_t kHostMetal = 6;  // its instance that mirrors

// Finished pictures of few voxels.
Settings hostSettings();

// What a host has: its own program, its own targets.
class HostPicture {
  public:
    // Of the scene's camera.
    HostPicture(const Scene& scene, const glm::mat4& clipFromView, bool reversed = false);
    void draw(const Scene& scene, const gl::Program& program);
    HostSurfaces& surfaces() { return surfaces_; }

  private:
    bool reversed_;
    gl::Texture depth_, normal_, face_, material_, ids_;
    gl::Framebuffer target_;
    HostSurfaces surfaces_;
};

// relRMSE over the pixels that `counts` takes, by their number.
using PixelFilter = std::function<bool(std::size_t)>;
double hostDifference(
    const std::vector<glm::vec4>& image, const std::vector<glm::vec4>& truth,
    const PixelFilter& counts = [](std::size_t) { return true; });
double hostMean(const std::vector<glm::vec4>& image);

class LightFieldRig : public GlTest {
  protected:
    void SetUp() override;
    glm::mat4 lens() const;
    void drawn(HostPicture& host);
    static std::vector<glm::vec4> pixelsOf(std::uint32_t texture);
    // What a new view of the field finds at the host's pixels.
    static std::vector<glm::vec4> diffuseOf(LightField& field, HostPicture& host);
    // Of the host's picture, by casting nothing: read back once.
    std::size_t instanceAt(std::size_t pixel);
    PixelFilter onMetal(bool wanted);

    Scene scene_ = hostRoom();

  private:
    std::vector<std::uint32_t> ids_;
};

}  // namespace conelight::test

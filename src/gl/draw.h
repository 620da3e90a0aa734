// SPDX-License-Identifier: MIT
// Raster state: vertex arrays, framebuffers, and the fixed state of a pass set as a whole. Neither owns the
// buffers and textures it refers to.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "gl/buffer.h"
#include "gl/object.h"
#include "gl/texture.h"

namespace conelight::gl {

class VertexArray : public Object<ObjectType::VertexArray> {
  public:
    struct Attribute {
        unsigned location;
        int components;
        std::uint32_t type;  // GL_FLOAT, GL_UNSIGNED_INT
        bool integer;        // arrives as uint, not converted
        unsigned offset;     // bytes in the vertex
    };
    VertexArray() = default;
    VertexArray(const Buffer& vertices, int stride, const std::vector<Attribute>& attributes,
                const Buffer& indices, const std::string& label);
    explicit VertexArray(const std::string& label);  // no attributes: full-screen triangles
    // Adds an attribute that holds one uint of `values` per draw: the base instance of drawIndexed chooses
    // it, and all instances of that draw see the same.
    void addPerDrawUint(unsigned location, const Buffer& values);
    void bind() const;
};

class Framebuffer : public Object<ObjectType::Framebuffer> {
  public:
    Framebuffer() = default;
    // Colour attachments in order, then depth (may be null), all of one size. Level 0; of textures with
    // layers the first one, or all when `layered`. Throws Error(Runtime) when the driver cannot draw to them.
    Framebuffer(const std::vector<const Texture*>& colors, const Texture* depth, const std::string& label,
                bool layered = false);
    // Without attachments, of a given size (for raster passes that only store images).
    Framebuffer(int width, int height, const std::string& label);
    // One layer of a depth texture, and of a colour texture or none.
    static Framebuffer depthLayer(const Texture& depth, int layer, const std::string& label,
                                  const Texture* color = nullptr);

    int width() const { return width_; }
    int height() const { return height_; }
    void clearColor(int attachment, float r, float g, float b, float a) const;
    void clearColorUint(int attachment, std::uint32_t r) const;
    void clearDepth(float depth) const;

  private:
    void check(const std::string& label) const;
    int width_ = 0;
    int height_ = 0;
};

enum class Cull : std::uint8_t { None, Back, Front };

// All fixed state in which raster passes of this library differ. Front faces are counter-clockwise. What is
// not here is at GL's defaults: HostStateGuard sees to it (gl/host_state.h).
struct RasterState {
    const Framebuffer* framebuffer = nullptr;
    bool depthTest = true;
    bool depthWrite = true;
    Cull cull = Cull::Back;
    bool colorWrite = true;
    bool blend = false;           // premultiplied: one, one minus source alpha
    float depthBiasSlope = 0.0f;  // glPolygonOffset factor
    float depthBiasUnits = 0.0f;
    // Clip space z in [0,1] with 1 at the near plane, greater depths win (float depth then keeps its digits
    // at any distance); clear with 0. false: GL's [-1,1], lesser depths win.
    bool reversedDepth = false;
    bool depthClamp = false;         // what is before the near or behind the far plane is drawn on it
    float farthest = 1.0f;           // depths are stored as [0, farthest]
    int viewport[4] = {0, 0, 0, 0};  // x, y, width, height, fragments outside are cut; width 0: all
};
void apply(const RasterState& state);
void setCull(Cull cull);
void setFrontFace(bool counterClockwise);

// Triangles of the bound vertex array: `count` 32-bit indices from `firstIndex`, each plus `firstVertex`.
struct IndexedDraw {
    std::uint32_t firstIndex;
    std::uint32_t count;
    std::uint32_t firstVertex;
    std::uint32_t baseInstance;
    int instances = 1;
};
void drawIndexed(const IndexedDraw& draw);

// The same by one call for many of them, in their order (multi-draw-indirect). fill() uploads them; draw() needs the
// vertex array bound. GL state changed: none that stays.
class DrawList {
  public:
    void fill(std::span<const IndexedDraw> draws);
    void draw(std::size_t first, std::size_t count) const;

  private:
    Buffer buffer_;
};

// One triangle, corners gl_VertexID 0 to 2, of a vertex array without attributes.
void drawTriangle(const VertexArray& empty);

}  // namespace conelight::gl

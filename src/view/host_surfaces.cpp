// SPDX-License-Identifier: MIT
#include "view/host_surfaces.h"

#include <cmath>
#include <utility>

#include "base/log.h"
#include "gl/gl.h"
#include "shared/host_surfaces.h"
#include "view/camera.h"

namespace conelight::view {
namespace {

glm::dmat4 clipFromWorld(const HostSurfaces& host) {
    return glm::dmat4(host.clipFromView) * glm::dmat4(host.viewFromWorld);
}

glm::dvec4 rowOf(const glm::dmat4& m, int row) { return {m[0][row], m[1][row], m[2][row], m[3][row]}; }

// Points of clip position (x, y) at view depth w are eye + w (forward + x right + y up): the columns of the
// inverse of the rows that make x, y and w of a point. Of parallel rays eye + x right + y up + w forward, with the
// inverse of the rows of x, y and z.
struct Rays {
    glm::dvec3 eye, right, up, forward;
    bool parallel;
    glm::dvec4 depth;                // of parallel rays: the row that makes the view depth of a point
    double depthScale, depthOffset;  // view depth of a texel of the depth texture
    bool usable;
};

bool invert(const glm::dvec4& x, const glm::dvec4& y, const glm::dvec4& z, glm::dmat3& inverse) {
    const glm::dmat3 linear = glm::transpose(glm::dmat3(glm::dvec3(x), glm::dvec3(y), glm::dvec3(z)));
    const double volume = glm::determinant(linear);
    const double size = glm::length(glm::dvec3(x)) * glm::length(glm::dvec3(y)) * glm::length(glm::dvec3(z));
    if (!std::isfinite(volume) || !(std::abs(volume) > 1e-9 * size)) return false;
    inverse = glm::inverse(linear);
    return true;
}

// Where parallel rays begin, before the nearest depths: as a part of the way from there to the farthest. View
// depths are above 0 then.
constexpr double kBeforeNear = 0.01;

Rays parallelRays(const glm::dmat4& m, const HostSurfaces& host) {
    const double w = m[3][3];
    const glm::dvec4 x = rowOf(m, 0) / w, y = rowOf(m, 1) / w, z = rowOf(m, 2) / w;
    Rays rays{};
    glm::dmat3 inverse;
    if (!(std::abs(w) > 0) || !invert(x, y, z, inverse)) return rays;
    // The far side is where nothing was drawn.
    const bool reversed = host.background < 0.5f;
    const double lowest = host.clipDepthZeroToOne ? 0 : -1;
    const double farthest = reversed ? lowest : 1, nearest = reversed ? 1 : lowest;
    const double begin = nearest - kBeforeNear * (farthest - nearest);
    const double perDepth = (farthest > nearest ? 1 : -1) / glm::length(inverse[2]);  // of z
    rays.right = inverse[0];
    rays.up = inverse[1];
    rays.forward = inverse[2] * perDepth;
    rays.eye = inverse * (glm::dvec3(0, 0, begin) - glm::dvec3(x.w, y.w, z.w));
    rays.parallel = true;
    rays.depth = (z - glm::dvec4(0, 0, 0, begin)) / perDepth;
    rays.depthScale = (host.clipDepthZeroToOne ? 1 : 2) / perDepth;
    rays.depthOffset = (lowest - begin) / perDepth;
    rays.usable = true;
    return rays;
}

Rays raysOf(const glm::dmat4& m, const HostSurfaces& host) {
    const glm::dvec4 x = rowOf(m, 0), y = rowOf(m, 1), w = rowOf(m, 3);
    if (glm::dvec3(w) == glm::dvec3(0)) return parallelRays(m, host);
    Rays rays{};
    glm::dmat3 inverse;
    if (!invert(x, y, w, inverse)) return rays;
    rays.eye = -(inverse * glm::dvec3(x.w, y.w, w.w));
    rays.right = inverse[0];
    rays.up = inverse[1];
    rays.forward = inverse[2];
    rays.depthScale = host.clipDepthZeroToOne ? 1 : 2;
    rays.depthOffset = host.clipDepthZeroToOne ? 0 : -1;
    rays.usable = true;
    return rays;
}

struct ImportKey {
    bool faceNormals, roughness, reflectance, instances;
    gl::ProgramDesc desc() const {
        const auto word = [](bool on) { return on ? "1" : "0"; };
        return {{"view/whole_picture.vert.glsl", "view/host_surfaces.frag.glsl"},
                {{"FACE_NORMALS", word(faceNormals)},
                 {"ROUGHNESS", word(roughness)},
                 {"REFLECTANCE", word(reflectance)},
                 {"INSTANCES", word(instances)}}};
    }
    static std::vector<ImportKey> all() {
        std::vector<ImportKey> keys;
        for (int bits = 0; bits < 16; ++bits)
            keys.push_back({(bits & 1) != 0, (bits & 2) != 0, (bits & 4) != 0, (bits & 8) != 0});
        return keys;
    }
};

}  // namespace

void requireUsable(const HostSurfaces& host) {
    if (host.width < 1 || host.height < 1 || host.width > kMaxEdge || host.height > kMaxEdge)
        base::fail(ErrorKind::Usage, "surfaces of %d x %d; 1 to %d in each direction would be right",
                   host.width, host.height, kMaxEdge);
    for (const auto& [name, texture] : {std::pair("depth", host.depth), std::pair("normal", host.normal)})
        if (texture == 0)
            base::fail(ErrorKind::Usage, "surfaces: no texture of %s; the name of one would be right", name);
    if (host.roughnessChannel < 0 || host.roughnessChannel > 3)
        base::fail(ErrorKind::Usage, "surfaces: roughness in channel %d; 0 to 3 would be right",
                   host.roughnessChannel);
    if (host.motion != 0 && !(std::isfinite(host.motionScale.x) && std::isfinite(host.motionScale.y)))
        base::fail(ErrorKind::Usage,
                   "surfaces: motionScale is not finite; 1, 1 for parts of the picture's size");
    if (!raysOf(clipFromWorld(host), host).usable)
        base::fail(
            ErrorKind::Usage,
            "surfaces: clipFromView * viewFromWorld sees no space; finite matrices whose rays meet in an "
            "eye or are parallel would be right");
}

gpu::FrameConstants frameConstants(const HostSurfaces& host, int reduction) {
    const glm::dmat4 whole = clipFromWorld(host);
    const glm::ivec2 size = (glm::ivec2(host.width, host.height) + reduction - 1) / reduction;
    // Pixel i of the reduced picture has its centre where that of pixel reduction * i is.
    glm::dmat4 reduced = whole;
    for (int axis = 0; axis < 2; ++axis) {
        const double full = axis == 0 ? host.width : host.height;
        const double stretch = full / (reduction * static_cast<double>(size[axis]));
        const double shift = stretch * (1 + (reduction - 1) / full) - 1;
        for (int column = 0; column < 4; ++column)
            reduced[column][axis] = stretch * whole[column][axis] + shift * whole[column][3];
    }
    const Rays rays = raysOf(reduced, host);
    if (rays.parallel) {
        reduced /= reduced[3][3];
        for (int column = 0; column < 4; ++column) reduced[column][2] = rays.depth[column];
    }
    gpu::FrameConstants frame{};
    frame.clipFromWorld = glm::mat4(reduced);
    frame.eye = glm::vec3(rays.eye);
    frame.viewForward = glm::vec3(rays.forward);
    frame.viewRight = glm::vec3(rays.right);
    frame.viewUp = glm::vec3(rays.up);
    frame.footprint = static_cast<float>(reduction);
    frame.blending = -1.0f;
    frame.parallel = rays.parallel ? 1.0f : 0.0f;
    frame.width = static_cast<std::uint32_t>(size.x);
    frame.height = static_cast<std::uint32_t>(size.y);
    return frame;
}

HostSurfaceImport::HostSurfaceImport()
    : nearest_({GL_NEAREST, GL_NEAREST, GL_CLAMP_TO_EDGE}, "host surfaces"),
      constants_(sizeof(gpu::HostSurfaceConstants), "host surfaces"),
      noVertices_("no vertices") {}

void HostSurfaceImport::draw(const gl::Device& device, const Picture& picture, const gl::Buffer& frameBlock,
                             GBuffer& gbuffer) {
    const gl::PassScope pass(device.profiler, "host surfaces");
    const HostSurfaces& host = picture.host;
    const glm::dmat4 clip = clipFromWorld(host);
    const glm::dvec4 z = rowOf(clip, 2);
    const Rays rays = raysOf(clip, host);
    gpu::HostSurfaceConstants c{};
    c.worldFromView = glm::mat4(glm::transpose(glm::mat3(host.viewFromWorld)));
    c.depthRow = glm::vec3(z);
    c.depthOfEye = static_cast<float>(glm::dot(glm::dvec3(z), rays.eye) + z.w);
    c.depthScale = static_cast<float>(rays.depthScale);
    c.depthOffset = static_cast<float>(rays.depthOffset);
    c.background = host.background;
    c.encoding = static_cast<std::uint32_t>(host.normalEncoding);
    c.reduction = static_cast<std::uint32_t>(picture.reduction);
    c.instances = static_cast<std::uint32_t>(picture.instances);
    c.roughnessChannel = static_cast<std::uint32_t>(host.roughnessChannel);
    constants_.update(c);

    gl::Inputs inputs;
    inputs.uniform("FrameBlock", frameBlock).uniform("HostSurfaceBlock", constants_);
    inputs.foreignTexture("hostDepth", host.depth, nearest_);
    inputs.foreignTexture("hostNormal", host.normal, nearest_);
    if (host.geometricNormal != 0) inputs.foreignTexture("hostFaceNormal", host.geometricNormal, nearest_);
    if (host.roughness != 0) inputs.foreignTexture("hostRoughness", host.roughness, nearest_);
    if (host.reflectance != 0) inputs.foreignTexture("hostReflectance", host.reflectance, nearest_);
    if (host.instances != 0) inputs.foreignTexture("hostInstances", host.instances, nearest_);
    gl::RasterState state;
    state.framebuffer = &gbuffer.framebuffer();
    state.cull = gl::Cull::None;
    gl::apply(state);
    gbuffer.framebuffer().clearDepth(1.0f);
    device
        .get(ImportKey{host.geometricNormal != 0, host.roughness != 0, host.reflectance != 0,
                       host.instances != 0}
                 .desc())
        .use(inputs);
    gl::drawTriangle(noVertices_);
}

std::vector<gl::ProgramDesc> HostSurfaceImport::programDescs() {
    std::vector<gl::ProgramDesc> descs;
    for (const ImportKey& key : ImportKey::all()) descs.push_back(key.desc());
    return descs;
}

}  // namespace conelight::view

// SPDX-License-Identifier: MIT
#include "light/shadow_maps.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "gl/gl.h"
#include "scene/gpu_lights.h"
#include "shared/bindings.h"
#include "shared/rect_points.h"

namespace conelight::light {
namespace {

// The nearest thing that casts a shadow, as a fraction of the scene's diagonal. Reversed float depth has the
// same relative precision for any value, so it is only bounded by what must not vanish.
constexpr float kNearFraction = 1e-5f;

// Texels that a map keeps beyond the frustum it covers, which may lie on another side of a cube: the filter's
// reach, and two for rounding.
int guardTexels(int filterRadius) { return filterRadius + 2; }
constexpr int kRectGuard = 2;  // lib/shadow.glsl: filter radius 0 and the move, each one texel

struct Axes {
    glm::vec3 u, v, forward;
};

// Sides of a cube in the order of lib/shadow.glsl's cubeSide, in the frame (x, y, z).
Axes cubeSide(int side, const glm::vec3& x, const glm::vec3& y, const glm::vec3& z) {
    const std::array<glm::vec3, 3> axes{x, y, z};
    const auto axis = static_cast<std::size_t>(side / 2);
    return {axes[(axis + 1) % 3], axes[(axis + 2) % 3], (side & 1) != 0 ? -axes[axis] : axes[axis]};
}

// Rows of a matrix that acts on world points: row_i . (p - origin) + constant_i.
glm::mat4 rows(const glm::vec3& origin, const std::array<glm::vec4, 4>& rowsAndConstants) {
    glm::mat4 m(0.0f);
    for (int i = 0; i < 4; ++i) {
        const glm::vec4& row = rowsAndConstants[static_cast<std::size_t>(i)];
        for (int c = 0; c < 3; ++c) m[c][i] = row[c];
        m[3][i] = row.w - glm::dot(glm::vec3(row), origin);
    }
    return m;
}

// One map: where it lies in the array and how the world is projected into it.
struct View {
    glm::mat4 clipFromWorld;
    glm::vec2 slopeUnit;  // depth per texel of a slope of 1: x + y * depth
    int layer, x, y, width, height;
    bool surfaces;  // whether slopes and outlines are drawn

    bool samePlace(const View& other) const {
        return layer == other.layer && x == other.x && y == other.y && width == other.width &&
               height == other.height;
    }
};

// A perspective map, reversed depth near / distance. The tile's centre in v is at `middleV` texels.
View perspectiveView(const glm::vec3& origin, const Axes& axes, float nearDistance, float texel, int width,
                     int height, float middleV) {
    const float su = 2.0f / (texel * static_cast<float>(width));
    const float sv = 2.0f / (texel * static_cast<float>(height));
    const float shiftV = 2.0f * middleV / static_cast<float>(height) - 1.0f;
    View view{};
    view.clipFromWorld =
        rows(origin, {glm::vec4(axes.u * su, 0), glm::vec4(axes.v * sv + axes.forward * shiftV, 0),
                      glm::vec4(0, 0, 0, nearDistance), glm::vec4(axes.forward, 0)});
    view.slopeUnit = {0, texel};
    view.surfaces = true;
    view.width = width;
    view.height = height;
    return view;
}

// light/shadow_view.glsl.
struct ViewConstants {
    glm::mat4 clipFromWorld;
    glm::vec2 slopeUnit;
    glm::vec2 middle;    // of the map, in texels of the layer
    glm::vec2 halfSize;  // texels
    glm::vec2 pad;
};

// Places a view in tile `tile` of an array whose layers are cut into n x n tiles.
void place(View& view, int tile, int n, int layerSize) {
    const int size = layerSize / n;
    view.layer = tile / (n * n);
    view.x = (tile % n) * size;
    view.y = (tile / n % n) * size;
}

// True when the box is outside one of the planes of clip space (no far plane: depth is reversed, far is 0).
bool isOutside(const glm::mat4& clipFromWorld, const Aabb& box) {
    int outside[5] = {0, 0, 0, 0, 0};
    for (const glm::vec3& corner : box.corners()) {
        const glm::vec4 p = clipFromWorld * glm::vec4(corner, 1);
        outside[0] += p.x < -p.w;
        outside[1] += p.x > p.w;
        outside[2] += p.y < -p.w;
        outside[3] += p.y > p.w;
        outside[4] += p.z > p.w;
    }
    return std::any_of(std::begin(outside), std::end(outside), [](int count) { return count == 8; });
}

bool isMasked(const gpu::Material& material) {
    return (material.flags & (MATERIAL_ALPHA_MASK | MATERIAL_ALPHA_BLEND)) != 0;
}

gl::ProgramDesc programDesc(bool masked, bool surfaces) {
    gl::ProgramDesc desc{{"light/shadow.vert.glsl"},
                         {{"MASKED", masked ? "1" : "0"}, {"SURFACES", surfaces ? "1" : "0"}}};
    if (surfaces) desc.files.emplace_back("light/shadow.geom.glsl");
    if (masked || surfaces) desc.files.emplace_back("light/shadow.frag.glsl");
    return desc;
}

// Lays out the maps of a scene's lights and fills in the lights' shadow fields.
class Layout {
  public:
    // `first`: bounds that do not change when something moves, for the near distance.
    Layout(const Aabb& bounds, const Aabb& first, const LightSettings& settings)
        : bounds_(bounds),
          size_(std::max(settings.shadowSize / 8 * 8, 64)),
          guard_(std::min(guardTexels(settings.shadowFilter), size_ / 8)),
          near_(std::max(kNearFraction * glm::length(first.extent()), 1e-12f)) {}

    void add(std::vector<gpu::Light>& lights) {
        // Kinds one after the other, each from a new layer on: tiles of a kind have consecutive numbers.
        // Rectangles last: their layers have no surfaces.
        for (const std::uint32_t kind : {LIGHT_SPOT, LIGHT_DIRECTIONAL, LIGHT_POINT, LIGHT_RECT}) {
            if (kind == LIGHT_RECT) surfaceLayers_ = layers_;
            for (gpu::Light& light : lights)
                if (light.type == kind && (light.flags & LIGHT_CASTS_SHADOW) != 0) addLight(light);
        }
    }
    int size() const { return size_; }
    int layers() const { return layers_; }
    int surfaceLayers() const { return surfaceLayers_; }  // the first ones
    const std::vector<View>& views() const { return views_; }

  private:
    void addLight(gpu::Light& light) {
        light.shadowNear = near_;
        switch (light.type) {
            case LIGHT_POINT:
                addPoint(light);
                break;
            case LIGHT_SPOT:
                addSpot(light);
                break;
            case LIGHT_DIRECTIONAL:
                addDirectional(light);
                break;
            default:
                addRect(light);
                break;
        }
    }

    // Takes `count` tiles of layers cut in n x n; returns the number of the first.
    int take(int n, int count) {
        if (n != tilesPerEdge_) {
            tilesPerEdge_ = n;
            nextTile_ = layers_ * n * n;
        }
        const int first = nextTile_;
        nextTile_ += count;
        layers_ = (nextTile_ + n * n - 1) / (n * n);
        return first;
    }

    void addPoint(gpu::Light& light) {
        const int tile = size_ / 2;
        light.shadow = take(2, 6);
        // The square of the side, tangent 1, plus the guard on each edge.
        light.shadowTexel = 2.0f / static_cast<float>(tile - 2 * guard_);
        for (int side = 0; side < 6; ++side) {
            const Axes axes = cubeSide(side, {1, 0, 0}, {0, 1, 0}, {0, 0, 1});
            View view = perspectiveView(light.position, axes, near_, light.shadowTexel, tile, tile,
                                        0.5f * static_cast<float>(tile));
            place(view, light.shadow + side, 2, size_);
            views_.push_back(view);
        }
    }

    void addSpot(gpu::Light& light) {
        light.shadow = take(1, 1);
        const float tangent = std::tan(std::acos(light.cosOuter));
        light.shadowTexel = 2.0f * std::max(tangent, 1e-3f) / static_cast<float>(size_ - 2 * guard_);
        View view = perspectiveView(light.position, {light.halfU, light.halfV, light.direction}, near_,
                                    light.shadowTexel, size_, size_, 0.5f * static_cast<float>(size_));
        place(view, light.shadow, 1, size_);
        views_.push_back(view);
    }

    // Fits the map to the scene's bounds. Texel size and centre move in steps, so that shadows do not crawl
    // when the bounds change: sizes by powers of 2^(1/8), the centre by whole texels.
    void addDirectional(gpu::Light& light) {
        light.shadow = take(1, 1);
        float half = 0, nearest = 1e30f, farthest = -1e30f;
        const Aabb box = bounds_.empty() ? Aabb{glm::vec3(0), glm::vec3(0)} : bounds_;
        const glm::vec3 centre = box.center();
        for (const glm::vec3& p : box.corners()) {
            half = std::max({half, std::abs(glm::dot(p - centre, light.halfU)),
                             std::abs(glm::dot(p - centre, light.halfV))});
            nearest = std::min(nearest, glm::dot(p - centre, light.direction));
            farthest = std::max(farthest, glm::dot(p - centre, light.direction));
        }
        half = std::exp2(std::ceil(8.0f * std::log2(std::max(half, 1e-6f))) / 8.0f);
        // One more texel for the snapped centre.
        light.shadowTexel = 2.0f * half / static_cast<float>(size_ - 2 * guard_ - 2);
        const auto snapped = [&](const glm::vec3& axis) {
            return std::floor(glm::dot(centre, axis) / light.shadowTexel) * light.shadowTexel;
        };
        // One percent more on either side, for what rounding puts out of the bounds.
        const float range = std::max(farthest - nearest, 1e-6f) * 1.02f;
        light.position = light.halfU * snapped(light.halfU) + light.halfV * snapped(light.halfV) +
                         light.direction * (glm::dot(centre, light.direction) + nearest - range * 0.01f);
        light.shadowNear = 1.0f / range;

        const float scale = 2.0f / (light.shadowTexel * static_cast<float>(size_));
        View view{};
        view.clipFromWorld =
            rows(light.position, {glm::vec4(light.halfU * scale, 0), glm::vec4(light.halfV * scale, 0),
                                  glm::vec4(-light.direction * light.shadowNear, 1), glm::vec4(0, 0, 0, 1)});
        view.slopeUnit = {light.shadowNear * light.shadowTexel, 0};
        view.surfaces = true;
        view.width = view.height = size_;
        place(view, light.shadow, 1, size_);
        views_.push_back(view);
    }

    void addRect(gpu::Light& light) {
        const int tile = size_ / 4;
        const int samples = static_cast<int>(light.sampleGrid * light.sampleGrid);
        light.shadow = take(4, 3 * samples);
        // A half side holds tangents 0 to 1 and a guard at both ends in half a tile.
        light.shadowTexel = 1.0f / static_cast<float>(tile / 2 - 2 * kRectGuard);
        const glm::vec3 u = glm::normalize(light.halfU);
        const glm::vec3 v = glm::cross(light.direction, u);
        for (int sample = 0; sample < samples; ++sample) {
            const glm::vec3 point = rectSamplePoint(light, sample);
            for (int side = 0; side < 5; ++side) {
                const bool front = side == 4;
                Axes axes = cubeSide(side, u, v, light.direction);
                if (side == 2 || side == 3) std::swap(axes.u, axes.v);
                View view =
                    perspectiveView(point, axes, near_, light.shadowTexel, tile, front ? tile : tile / 2,
                                    front ? 0.5f * static_cast<float>(tile) : static_cast<float>(kRectGuard));
                view.surfaces = false;
                place(view, light.shadow + 3 * sample + (front ? 0 : 1 + side / 2), 4, size_);
                if (!front && (side & 1) != 0) view.y += tile / 2;
                views_.push_back(view);
            }
        }
    }

    // C++ twin of lib/shadow.glsl's.
    static glm::vec3 rectSamplePoint(const gpu::Light& light, int k) {
        const auto column = static_cast<std::uint32_t>(k);
        const std::uint32_t grid = light.sampleGrid, count = grid * grid;
        const std::uint32_t row =
            count == RECT_POINT_COUNT ? RECT_POINT_ROW(column) : column % grid * grid + column / grid;
        const glm::vec2 uv = (glm::vec2(column, row) + 0.5f) * (2.0f / static_cast<float>(count)) - 1.0f;
        const float lift = 1e-3f * std::min(glm::length(light.halfU), glm::length(light.halfV));
        return light.position + uv.x * light.halfU + uv.y * light.halfV + lift * light.direction;
    }

    Aabb bounds_;
    int size_, guard_;
    float near_;
    int tilesPerEdge_ = 1, nextTile_ = 0, layers_ = 0, surfaceLayers_ = 0;
    std::vector<View> views_;
};

}  // namespace

struct ShadowMaps::Impl {
    gl::Texture maps, surfaces;
    gl::Sampler plainSampler;  // depths as numbers, without comparison
    std::vector<gl::Framebuffer> layers;
    gl::Buffer viewBlock;

    // What was drawn last, and the scene it was drawn of.
    std::vector<View> drawnViews;
    std::uint64_t sceneIdentity = 0;
    std::vector<std::uint64_t> revisions;
    std::vector<Aabb> casterBoxes;  // empty: casts no shadow
    int redrawn = 0;

    void allocate(int size, int layerCount, int surfaceLayers) {
        // No surfaces: one texel, for the sampler.
        const int surfaceSize = surfaceLayers > 0 ? size : 1;
        if (maps && maps.width() == size && maps.depth() == layerCount && surfaces.width() == surfaceSize &&
            surfaces.depth() == std::max(surfaceLayers, 1))
            return;
        drawnViews.clear();
        layers.clear();
        maps =
            gl::Texture({GL_TEXTURE_2D_ARRAY, GL_DEPTH_COMPONENT32F, size, size, layerCount}, "shadow maps");
        surfaces = gl::Texture(
            {GL_TEXTURE_2D_ARRAY, GL_RG32UI, surfaceSize, surfaceSize, std::max(surfaceLayers, 1)},
            "shadow surfaces");
        surfaces.parameter(GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        surfaces.parameter(GL_TEXTURE_MAG_FILTER, GL_NEAREST);
        surfaces.parameter(GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
        surfaces.parameter(GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
        maps.parameter(GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        maps.parameter(GL_TEXTURE_MAG_FILTER, GL_NEAREST);
        maps.parameter(GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
        maps.parameter(GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
        maps.parameter(GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
        maps.parameter(GL_TEXTURE_COMPARE_FUNC, GL_GEQUAL);  // reversed depth: visible when not farther
        for (int layer = 0; layer < layerCount; ++layer)
            layers.push_back(gl::Framebuffer::depthLayer(maps, layer, "shadow layer " + std::to_string(layer),
                                                         layer < surfaceLayers ? &surfaces : nullptr));
        clear();
    }

    void clear() {
        const float nothing = 0.0f;
        maps.clear(0, GL_DEPTH_COMPONENT, GL_FLOAT, &nothing);
        surfaces.clear(0, GL_RG_INTEGER, GL_UNSIGNED_INT, nullptr);
    }

    void draw(gl::ProgramLibrary& programs, const scene::GpuScene& scene, const View& view);
    bool keepsPlaces(const scene::GpuScene& scene, const std::vector<View>& views) const;
    std::vector<Aabb> changedBoxes(const scene::GpuScene& scene) const;
    void remember(const scene::GpuScene& scene, const std::vector<View>& views);
};

namespace {

Aabb casterBox(const scene::GpuScene& scene, std::size_t instance) {
    return (scene.instances()[instance].flags & INSTANCE_CASTS_SHADOW) != 0 ? scene.instanceBounds(instance)
                                                                            : Aabb{};
}

}  // namespace

// Whether the maps hold the same views of the same scene, moved at most.
bool ShadowMaps::Impl::keepsPlaces(const scene::GpuScene& scene, const std::vector<View>& views) const {
    return sceneIdentity == scene.identity() &&
           std::equal(views.begin(), views.end(), drawnViews.begin(), drawnViews.end(),
                      [](const View& a, const View& b) { return a.samePlace(b); });
}

// Where casters have changed since the maps were drawn: old boxes and new ones.
std::vector<Aabb> ShadowMaps::Impl::changedBoxes(const scene::GpuScene& scene) const {
    std::vector<Aabb> boxes;
    for (std::size_t i = 0; i < revisions.size(); ++i) {
        if (revisions[i] == scene.instanceRevision(i)) continue;
        for (const Aabb& box : {casterBoxes[i], casterBox(scene, i)})
            if (!box.empty()) boxes.push_back(box);
    }
    return boxes;
}

void ShadowMaps::Impl::remember(const scene::GpuScene& scene, const std::vector<View>& views) {
    drawnViews = views;
    sceneIdentity = scene.identity();
    revisions.resize(scene.instances().size());
    casterBoxes.resize(revisions.size());
    for (std::size_t i = 0; i < revisions.size(); ++i) {
        revisions[i] = scene.instanceRevision(i);
        casterBoxes[i] = casterBox(scene, i);
    }
}

void ShadowMaps::Impl::draw(gl::ProgramLibrary& programs, const scene::GpuScene& scene, const View& view) {
    gl::RasterState state;
    state.framebuffer = &layers[static_cast<std::size_t>(view.layer)];
    state.cull = gl::Cull::None;
    state.reversedDepth = true;
    state.viewport[0] = view.x;
    state.viewport[1] = view.y;
    state.viewport[2] = view.width;
    state.viewport[3] = view.height;
    gl::apply(state);
    const glm::vec2 half = 0.5f * glm::vec2(view.width, view.height);
    viewBlock.update(
        ViewConstants{view.clipFromWorld, view.slopeUnit, glm::vec2(view.x, view.y) + half, half, {}});
    viewBlock.bindUniform(BINDING_PASS);

    const std::vector<gpu::Instance>& instances = scene.instances();
    std::vector<char> drawn(instances.size());
    bool anyOf[2] = {false, false};
    for (std::size_t i = 0; i < instances.size(); ++i) {
        if ((instances[i].flags & INSTANCE_CASTS_SHADOW) == 0) continue;
        if (isOutside(view.clipFromWorld, scene.instanceBounds(i))) continue;
        const bool masked = isMasked(scene.materials()[instances[i].material]);
        drawn[i] = masked ? 2 : 1;
        anyOf[masked ? 1 : 0] = true;
    }
    for (const bool masked : {false, true}) {
        if (!anyOf[masked ? 1 : 0]) continue;
        programs.get(programDesc(masked, view.surfaces)).use();
        const auto accepted = [&](const gpu::Instance& instance) {
            return drawn[static_cast<std::size_t>(&instance - instances.data())] == (masked ? 2 : 1);
        };
        // Of a mesh in the middle of the scene each side of a cube sees a part only.
        const auto isSeen = [&](const gpu::Instance& instance, const Aabb& objectBox) {
            return !isOutside(view.clipFromWorld * instance.worldFromObject, objectBox);
        };
        scene.draw(accepted, gl::Cull::None, masked, 1, isSeen);
    }
}

ShadowMaps::ShadowMaps() : impl_(std::make_unique<Impl>()) {
    impl_->allocate(8, 1, 0);
    impl_->viewBlock = gl::Buffer(sizeof(ViewConstants), "shadow view");
    impl_->plainSampler = gl::Sampler({GL_NEAREST, GL_NEAREST, GL_CLAMP_TO_EDGE}, "shadow depths");
}
ShadowMaps::~ShadowMaps() = default;

void ShadowMaps::update(gl::ProgramLibrary& programs, gl::Profiler& profiler, scene::GpuScene& scene,
                        const LightSettings& settings, bool everything) {
    const gl::PassScope pass(profiler, "shadow maps");

    // Lay out the maps.
    std::vector<gpu::Light> lights = scene.lights();
    const auto grid =
        static_cast<std::uint32_t>(std::lround(std::sqrt(static_cast<float>(settings.areaSamples))));
    for (gpu::Light& light : lights) {
        light.shadow = -1;
        light.sampleGrid = std::max(grid, 1u);
    }
    Layout layout(scene.bounds(), scene.firstBounds(), settings);
    if (settings.shadowSize > 0) layout.add(lights);
    scene.updateLights(lights);

    // Draw them, or those that look different now or see a caster that changed.
    impl_->redrawn = 0;
    if (layout.layers() == 0) {
        impl_->allocate(8, 1, 0);
        return;
    }
    impl_->allocate(layout.size(), layout.layers(), layout.surfaceLayers());
    const bool whole = everything || !impl_->keepsPlaces(scene, layout.views());
    const std::vector<Aabb> changed = whole ? std::vector<Aabb>{} : impl_->changedBoxes(scene);
    if (whole) impl_->clear();
    for (std::size_t i = 0; i < layout.views().size(); ++i) {
        const View& view = layout.views()[i];
        if (!whole) {
            const bool touched = view.clipFromWorld != impl_->drawnViews[i].clipFromWorld ||
                                 std::any_of(changed.begin(), changed.end(), [&](const Aabb& box) {
                                     return !isOutside(view.clipFromWorld, box);
                                 });
            if (!touched) continue;
            const glm::ivec3 corner(view.x, view.y, view.layer), extent(view.width, view.height, 1);
            impl_->maps.clearRegion(0, corner, extent, GL_DEPTH_COMPONENT, GL_FLOAT);
            if (view.surfaces) impl_->surfaces.clearRegion(0, corner, extent, GL_RG_INTEGER, GL_UNSIGNED_INT);
        }
        impl_->draw(programs, scene, view);
        ++impl_->redrawn;
    }
    impl_->remember(scene, layout.views());

    // Leave neither reversed depth nor a scissor behind.
    gl::RasterState plain;
    plain.framebuffer = &impl_->layers.front();
    gl::apply(plain);
}

int ShadowMaps::redrawn() const { return impl_->redrawn; }

void ShadowMaps::bind() const {
    impl_->maps.bind(UNIT_SHADOW);
    gl::unbindSampler(UNIT_SHADOW);
    impl_->maps.bind(UNIT_SHADOW_DEPTHS);
    impl_->plainSampler.bind(UNIT_SHADOW_DEPTHS);
    impl_->surfaces.bind(UNIT_SHADOW_SURFACES);
    gl::unbindSampler(UNIT_SHADOW_SURFACES);
}

std::vector<gl::ProgramDesc> ShadowMaps::programDescs() {
    return {programDesc(false, false), programDesc(false, true), programDesc(true, false),
            programDesc(true, true)};
}

namespace {

// Lights up to this number are read at constant places by unrolled code; more would make programs long.
constexpr std::uint32_t kFixedLights = 4;

gl::Defines definesOf(const std::array<std::uint32_t, 4>& counts, bool shadows, int filter) {
    const std::uint32_t total = counts[0] + counts[1] + counts[2] + counts[3];
    const bool fixed = total <= kFixedLights;
    const auto number = [&](std::uint32_t count) {
        return std::to_string(fixed ? count : std::min(count, 1u));
    };
    return {{"LIGHTS_POINT", number(counts[0])},       {"LIGHTS_SPOT", number(counts[1])},
            {"LIGHTS_DIRECTIONAL", number(counts[2])}, {"LIGHTS_RECT", number(counts[3])},
            {"LIGHTS_FIXED", fixed ? "1" : "0"},       {"LIGHTS_SHADOWS", shadows ? "1" : "0"},
            {"SHADOW_FILTER", std::to_string(filter)}};
}

}  // namespace

gl::Defines lightDefines(const scene::GpuScene& scene, const LightSettings& settings) {
    const glm::uvec4 ends = scene::lightEnds(scene.lights());
    return definesOf({ends.x, ends.y - ends.x, ends.z - ends.y, ends.w - ends.z}, settings.shadowSize > 0,
                     settings.shadowFilter);
}

std::vector<gl::ProgramDesc> lightVariants(const gl::ProgramDesc& base) {
    std::vector<gl::ProgramDesc> descs;
    const auto add = [&](const std::array<std::uint32_t, 4>& counts, bool shadows, int filter) {
        gl::ProgramDesc desc = base;
        for (auto& define : definesOf(counts, shadows, filter)) desc.defines.push_back(std::move(define));
        descs.push_back(std::move(desc));
    };
    constexpr std::uint32_t many = kFixedLights + 1;
    for (std::size_t kind = 0; kind < 4; ++kind)
        for (const std::uint32_t count : {1u, many}) {
            std::array<std::uint32_t, 4> counts{};
            counts[kind] = count;
            add(counts, true, 0);
        }
    for (int filter = 0; filter <= 4; ++filter) add({many, many, many, many}, true, filter);
    add({1, 1, 1, 1}, true, 0);
    add({many, many, many, many}, false, 0);
    add({0, 0, 0, 0}, false, 0);
    return descs;
}

}  // namespace conelight::light

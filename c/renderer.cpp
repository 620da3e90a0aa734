// SPDX-License-Identifier: MIT
// Renderers for C: in the caller's context, or with one of their own that is current during calls alone.
#include "conelight/renderer.h"

#include <memory>
#include <optional>

#include "changes.h"
#include "guests.h"
#include "platform/headless_context.h"
#include "settings.h"
#include "structs.h"

using namespace conelight;
using c::guarded;
using c::need;

struct conelight_renderer {
    std::unique_ptr<platform::HeadlessContext> context;  // null: the caller's
    std::unique_ptr<Renderer> renderer;
    int width = 0, height = 0;  // of the last picture; 0: none
};

namespace {

// A renderer during a call, its context current.
class Use {
  public:
    explicit Use(const conelight_renderer* renderer) : used_(need(renderer, "renderer")) {
        if (used_.context) current_.emplace(*used_.context);
    }
    Renderer& operator*() const { return *used_.renderer; }
    Renderer* operator->() const { return used_.renderer.get(); }

  private:
    const conelight_renderer& used_;
    std::optional<platform::CurrentContext> current_;
};

// Throws Error(Usage) unless the picture has `count` values at `channels` a pixel.
void checkCount(const conelight_renderer* renderer, size_t channels, size_t count) {
    const conelight_renderer& of = need(renderer, "renderer");
    const size_t wanted = channels * static_cast<size_t>(of.width) * static_cast<size_t>(of.height);
    if (wanted == 0) c::failUsage("renderer: nothing was rendered; conelight_renderer_render before it");
    if (count != wanted)
        c::failUsage("count: " + std::to_string(count) + "; " + std::to_string(wanted) + " would be right");
}

// A call of render that failed may have left a picture of another size.
void checkRead(size_t had, size_t wanted) {
    if (had != wanted)
        throw Error(ErrorKind::Runtime, "renderer: the last picture failed; another would be right");
}

void refuseHeadless(const conelight_renderer* renderer) {
    if (need(renderer, "renderer").context)
        c::failUsage("renderer: it has a context of its own; one in the caller's context would be right");
}

}  // namespace

conelight_result conelight_renderer_create(const conelight_renderer_options* options,
                                           conelight_renderer** renderer) {
    return guarded([&] {
        const conelight_renderer_options given = c::optionsOf(options);
        need(renderer, "renderer");
        c::registerGuests();
        auto made = std::make_unique<conelight_renderer>();
        if (given.headless != 0) {
            platform::HeadlessOptions context;
            context.device = given.device;
            context.debug = given.report_gl_errors != 0;
            made->context = std::make_unique<platform::HeadlessContext>(context);
        }
        RendererOptions own;
        own.shaderDirectory = c::textOf(given.shader_directory);
        own.reportGlErrors = given.report_gl_errors != 0;
        own.rows = given.top_first != 0 ? RowOrder::TopFirst : RowOrder::BottomFirst;
        made->renderer = std::make_unique<Renderer>(own);
        if (made->context) made->context->release();
        *renderer = made.release();
    });
}

void conelight_renderer_destroy(conelight_renderer* renderer) {
    if (renderer == nullptr) return;
    const conelight_result freed = guarded([&] {
        const Use current(renderer);
        renderer->renderer.reset();
    });
    // Its context cannot be current here: what it holds goes with that.
    if (freed != CONELIGHT_OK) static_cast<void>(renderer->renderer.release());
    delete renderer;
}

conelight_result conelight_renderer_set_scene(conelight_renderer* renderer, const conelight_scene* scene) {
    return c::setScene<Use>(renderer, scene);
}

conelight_result conelight_renderer_set_transform(conelight_renderer* renderer, size_t instance,
                                                  const float world_from_object[16]) {
    return c::setTransform<Use>(renderer, instance, world_from_object);
}

conelight_result conelight_renderer_set_instance(conelight_renderer* renderer, size_t index,
                                                 const conelight_instance* instance) {
    return c::setInstance<Use>(renderer, index, instance);
}

conelight_result conelight_renderer_set_mesh(conelight_renderer* renderer, size_t index,
                                             const conelight_mesh* mesh) {
    return c::setMesh<Use>(renderer, index, mesh);
}

conelight_result conelight_renderer_set_host_mesh(conelight_renderer* renderer, size_t index,
                                                  const conelight_host_mesh* mesh) {
    const conelight_result refused = guarded([&] { refuseHeadless(renderer); });
    if (refused != CONELIGHT_OK) return refused;
    return c::setHostMesh<Use>(renderer, index, mesh);
}

conelight_result conelight_renderer_set_host_texture(conelight_renderer* renderer, size_t index,
                                                     const conelight_host_texture* texture) {
    const conelight_result refused = guarded([&] { refuseHeadless(renderer); });
    if (refused != CONELIGHT_OK) return refused;
    return c::setHostTexture<Use>(renderer, index, texture);
}

conelight_result conelight_renderer_set_texture(conelight_renderer* renderer, size_t index,
                                                const conelight_texture* texture) {
    return c::setTexture<Use>(renderer, index, texture);
}

conelight_result conelight_renderer_set_material(conelight_renderer* renderer, size_t index,
                                                 const conelight_material* material) {
    return c::setMaterial<Use>(renderer, index, material);
}

conelight_result conelight_renderer_set_light(conelight_renderer* renderer, size_t index,
                                              const conelight_light* light) {
    return c::setLight<Use>(renderer, index, light);
}

conelight_result conelight_renderer_set_lights(conelight_renderer* renderer, const conelight_scene* scene) {
    return c::setLights<Use>(renderer, scene);
}

conelight_result conelight_renderer_set_sky(conelight_renderer* renderer, const float radiance[3]) {
    return c::setSky<Use>(renderer, radiance);
}

conelight_result conelight_renderer_set_environment(conelight_renderer* renderer,
                                                    const conelight_scene* scene) {
    return c::setEnvironment<Use>(renderer, scene);
}

conelight_result conelight_renderer_add_mesh(conelight_renderer* renderer, const conelight_mesh* mesh,
                                             int32_t* index) {
    return c::addMesh<Use>(renderer, mesh, index);
}

conelight_result conelight_renderer_add_host_mesh(conelight_renderer* renderer,
                                                  const conelight_host_mesh* mesh, int32_t* index) {
    const conelight_result refused = guarded([&] { refuseHeadless(renderer); });
    if (refused != CONELIGHT_OK) return refused;
    return c::addHostMesh<Use>(renderer, mesh, index);
}

conelight_result conelight_renderer_add_host_texture(conelight_renderer* renderer,
                                                     const conelight_host_texture* texture, int32_t* index) {
    const conelight_result refused = guarded([&] { refuseHeadless(renderer); });
    if (refused != CONELIGHT_OK) return refused;
    return c::addHostTexture<Use>(renderer, texture, index);
}

conelight_result conelight_renderer_add_texture(conelight_renderer* renderer,
                                                const conelight_texture* texture, int32_t* index) {
    return c::addTexture<Use>(renderer, texture, index);
}

conelight_result conelight_renderer_add_material(conelight_renderer* renderer,
                                                 const conelight_material* material, int32_t* index) {
    return c::addMaterial<Use>(renderer, material, index);
}

conelight_result conelight_renderer_add_instance(conelight_renderer* renderer,
                                                 const conelight_instance* instance, int32_t* index) {
    return c::addInstance<Use>(renderer, instance, index);
}

conelight_result conelight_renderer_remove_instance(conelight_renderer* renderer, size_t index) {
    return c::removeInstance<Use>(renderer, index);
}

conelight_result conelight_renderer_remove_mesh(conelight_renderer* renderer, size_t index) {
    return c::removeMesh<Use>(renderer, index);
}

conelight_result conelight_renderer_set_region(conelight_renderer* renderer, const float low[3],
                                               const float high[3]) {
    return c::setRegion<Use>(renderer, low, high);
}

conelight_result conelight_renderer_render(conelight_renderer* renderer, const conelight_camera* camera,
                                           int32_t width, int32_t height, const conelight_settings* settings,
                                           const char* component) {
    return guarded([&] {
        const Use use(renderer);
        Settings shown = settings != nullptr ? settings->settings : Settings{};
        if (component != nullptr) setSetting(shown, "component", component);
        std::optional<Camera> view;
        if (camera != nullptr) view = c::cameraOf(c::readStruct(camera, "camera"));
        if (!view) {
            const Scene& scene = use->scene();
            view = scene.cameras.empty() ? frameCamera(scene.bounds()) : scene.cameras.front();
        }
        use->render(*view, width, height, shown);
        if (width == 0 || height == 0) return;  // the last picture stays
        renderer->width = width;
        renderer->height = height;
    });
}

conelight_result conelight_renderer_read(const conelight_renderer* renderer, float* rgba, size_t count) {
    return guarded([&] {
        checkCount(renderer, 4, count);
        need(rgba, "rgba");
        const Use use(renderer);
        const Image image = use->readImage();
        checkRead(image.pixels.size(), count / 4);
        std::memcpy(rgba, image.pixels.data(), count * sizeof(float));
    });
}

conelight_result conelight_renderer_read_display(const conelight_renderer* renderer,
                                                 const conelight_settings* settings, uint8_t* rgb,
                                                 size_t count) {
    return guarded([&] {
        checkCount(renderer, 3, count);
        need(rgb, "rgb");
        const Use use(renderer);
        const ImageSettings shown = settings != nullptr ? settings->settings.image : ImageSettings{};
        const std::vector<std::uint8_t> bytes = toneMapped(use->readImage(), shown);
        checkRead(bytes.size(), count);
        std::memcpy(rgb, bytes.data(), count);
    });
}

conelight_result conelight_renderer_copy_to_framebuffer(const conelight_renderer* renderer,
                                                        uint32_t framebuffer, int32_t x, int32_t y) {
    return guarded([&] {
        refuseHeadless(renderer);
        Use(renderer)->copyToFramebuffer(framebuffer, x, y);
    });
}

conelight_result conelight_renderer_copy_to_texture(const conelight_renderer* renderer, uint32_t texture) {
    return guarded([&] {
        refuseHeadless(renderer);
        Use(renderer)->copyToTexture(texture);
    });
}

conelight_result conelight_renderer_set_profiling(conelight_renderer* renderer, int on) {
    return guarded([&] { Use(renderer)->setProfiling(on != 0, false); });
}

conelight_result conelight_renderer_get_stats(const conelight_renderer* renderer, conelight_stats* stats) {
    return guarded([&] {
        const FrameStats& of = need(renderer, "renderer").renderer->stats();
        size_t bytes = 0;
        for (const MemoryStats& object : of.memory) bytes += object.bytes;
        c::writeStruct(stats, conelight_stats{0, of.cpuMs, of.wallMs, bytes}, "stats");
    });
}

// SPDX-License-Identifier: MIT
// What a picture in the window holds: the picture that is drawn, what the last one shows, and who works for it beside the
// window.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "platform/picture_texture.h"
#include "scene_upload.h"
#include "viewer/background_bake.h"
#include "viewer/background_reference.h"
#include "viewer/background_static_bake.h"
#include "viewer/face_budget.h"
#include "viewer/picture_key.h"
#include "viewer/picture_noise.h"
#include "viewer/picture_passes.h"
#include "viewer/picture_renderer.h"
#include "viewer/picture_slot.h"

namespace conelight::program {

struct PictureSlot::Impl {
    // A picture that is drawn in parts, and what it will show.
    struct Drawing {
        PictureKey key;
        Settings settings;  // the session's
        glm::ivec2 size;
        bool moving = false;  // coarse: it is finished though the view has gone on meanwhile
    };

    Impl(RendererOptions options, platform::RenderThread& thread) : renderer(std::move(options), thread) {}

    std::optional<Drawing> drawing;
    SceneUpload upload;                // of the session's scene; the renderer's while it takes that over
    std::shared_ptr<const Scene> lit;  // the baked scene that the renderer holds instead
    FrameStats stats;                  // of its last picture

    // What the last picture shows.
    std::string mode;
    std::optional<PictureKey> shown;
    Settings shownSettings;
    bool own = false;      // the picture is the mode's and of this view
    bool preview = false;  // it is another mode's while the mode has none
    bool asked = false;    // redraw()
    bool due = false;      // the last draw() left something to do
    float headlight = 0;
    int width = 0, height = 0;
    PicturePasses passes;              // of the picture
    int settling = 0;                  // passes to come
    PictureNoise noise;                // of what settles
    double frameMs = 0, updateMs = 0;  // the light cache's part
    // What updates of the light cache may take while the camera flies: a quarter of PictureView's aim.
    static constexpr double kFlyingUpdateMs = 25;
    FaceBudget flyingFaces{kFlyingUpdateMs};
    bool flyingUpdate = false;  // the last update was of flyingFaces
    double voxelsMadeAt = 0;    // ms; ViewFlags::dynamic
    std::uint64_t version = 0;
    std::uint32_t texture = 0;
    std::optional<Image> linear;
    std::optional<std::string> error;
    std::string lastError;  // said once while it stays

    platform::PictureTexture cpuTexture;
    ImageSettings cpuLook;
    BackgroundReference reference, beams{BackgroundReference::Method::Beams};
    std::uint64_t referenceVersion = 0, linearJob = 0;
    BackgroundBake bake;
    BackgroundStaticBake statics;             // of mode hybrid
    std::shared_ptr<const BakedLight> baked;  // that the last picture shows
    PictureRenderer renderer;                 // last: its work ends before what it works on

    bool draw(const Session& session, int w, int h, const How& how);
    bool drawScene(const Session& session, const std::string& drawnMode, int w, int h, const How& how);
    bool drawTraced(BackgroundReference& traced, const Session& session, int w, int h, const How& how);
    bool drawRadiosity(const Session& session, int w, int h, const How& how);
    void drawNothing(const Session& session, int w, int h);
    bool giveScene(const Session& session);
    void begin(const Session& session, const std::string& drawnMode, bool voxelsDue, const glm::ivec2& size,
               const How& how);
    void takeFinished(const Session& session, const std::string& drawnMode);
    void followDrawing(const Session& session, const glm::ivec2& size, const How& how);
    void drop();
    void countPass(const std::string& drawnMode);
    void renderFrame(const Session& session, const Settings& settings, int w, int h);
    void takeFrame(const Session& session, const Drawing& drawn, double start);
    void showImage(const ImageSettings& look);
    const Image& read();
    std::shared_ptr<const BakedLight> bakedFor(const Session& session, const std::string& drawnMode,
                                               const How& how);
    void followUpdateTime();
    void followLook(const Session& session);
    bool onlyLook(const Session& session) const;
    void startAnew();
};

}  // namespace conelight::program

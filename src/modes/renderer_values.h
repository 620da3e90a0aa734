// SPDX-License-Identifier: MIT
// What a renderer holds: the values of a picture, in the order in which they are made, and a picture that is drawn in
// parts. renderer.cpp is the public face, renderer_picture.cpp draws.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "base/steps.h"
#include "conelight/renderer.h"
#include "gl/pace.h"
#include "gl/work.h"
#include "image/display.h"
#include "image/headlight.h"
#include "image/image.h"
#include "image/shadow_view.h"
#include "image/temporal_picture.h"
#include "image/view_mean.h"
#include "image/wireframe.h"
#include "light/lights.h"
#include "modes/execution.h"
#include "modes/memory_fit.h"
#include "modes/mode.h"
#include "modes/owner_guard.h"
#include "scene/held_scene.h"
#include "shared/lookups.h"
#include "view/shadow_cascades.h"
#include "view/surfaces.h"

namespace conelight {

struct [[gnu::visibility("hidden")]] Renderer::Impl {  // not public, though in a public class
    std::uint32_t owner = 0;
    gl::ProgramLibrary programs;
    gl::Profiler profiler;
    gl::Device device;
    std::string deviceName;
    bool countLookups = false;
    bool countDispatches = false;
    bool everyFrame = false;
    bool lightHeld = false;

    // The values of a picture, in the order in which they are made.
    scene::HeldScene scene;
    light::Lights lights;
    view::ShadowCascades cascades;
    view::Surfaces surfaces;         // at the pixels' centres
    view::Surfaces reducedSurfaces;  // in fewer pixels, for what is gathered there
    view::Surfaces partSurfaces;     // beside them, of the view that is drawn for an anti-aliased picture
    std::unique_ptr<modes::ModeRenderer> mode;  // holds those between surfaces and image
    Mode modeKind = Mode::Traced;
    image::LinearImage image;
    image::LinearImage nextImage;  // of a picture in parts, until it is finished
    image::ViewMean views;
    std::optional<image::TemporalPicture> temporal;
    // Other looks at them.
    image::Display display;
    RowOrder rows = RowOrder::BottomFirst;  // of textures for the host
    gl::Texture turned;                     // the picture, if its top row is to come first
    image::ShadowView shadowMapView;
    image::WireframeView wireframe;
    image::Headlight headlight;
    float headlightIrradiance = 0;
    gl::Buffer lookupCounters{4 * LOOKUPS_WORDS, "lookup counters"};
    // Of the last picture.
    FrameStats stats;
    modes::MemoryFit fit;

    // What a picture was asked for.
    struct WantedPicture {
        Camera camera;
        int width = 0, height = 0;
        Settings settings;
    };
    WantedPicture shownAs;
    gl::Work work;  // told by what runs under a gl::WorkScope of it
    // A picture in parts.
    gl::Pace pace;
    base::Steps steps;
    bool inParts = false;
    bool left = false;             // the last one was dropped: surfaces may be of it
    double cpuMs = 0, wallMs = 0;  // of its parts so far

    explicit Impl(const RendererOptions& options) : Impl(options, modes::profileOf(options.execution)) {}
    Impl(const RendererOptions& options, gl::ExecutionProfile profile)
        : programs(modes::shadersOf(options, profile), modes::programsOf(options)),
          device{programs, profiler, profile},
          rows(options.rows) {}

    // The scene, to change it: a picture of it as it was is dropped.
    modes::OwnerScene changed() {
        drop();
        return {owner, scene};
    }
    image::LinearImage& target() { return inParts ? nextImage : image; }
    void require(const WantedPicture& asked);
    bool goOn(double milliseconds);
    void drop();
    base::Steps renderWithin(WantedPicture asked);
    void forgetPicture();
    base::Steps render(WantedPicture asked);
    base::Steps prepare(const Settings& settings);
    base::Steps prepareCascades(const Camera& camera, const Settings& settings);
    modes::Frame frame(const Settings& settings);
    base::Steps drawLight(const modes::Frame& frame);
    base::Steps drawPicture(const WantedPicture& asked);
    base::Steps drawParts(const Camera& camera, const Settings& settings, int count);
    base::Steps drawTemporal(const Camera& camera, const Settings& settings);
    base::Steps seePart(const Camera& camera, const Settings& settings, view::PixelPart part);
    base::Steps seeCenters(const WantedPicture& asked);
    base::Steps seeReduced(view::Surfaces::Picture picture, const Settings& settings);
    void drawOverlays(const Settings& settings);
    PixelInspection inspect(int x, int y);
    void collectStats();
};

}  // namespace conelight

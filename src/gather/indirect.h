// SPDX-License-Identifier: MIT
// Indirect light at pixels, as a value: surfaces + lit voxels -> irradiance for diffuse reflection, radiance
// in the specular lobe, occlusion; and light of lamps that are drawn by chance. Means over passes and frames are
// kept, and taken up again where the same surface is seen.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "base/revision.h"
#include "base/steps.h"
#include "gather/carried_picture.h"
#include "gather/picture_parts.h"
#include "gather/pixel_rays.h"
#include "scene/instance_history.h"

namespace conelight::gather {

class Indirect {
  public:
    // Draws the light samples that the next passes of a finished picture aim at, by the number of the draw.
    using Redraw = std::function<base::Steps(std::uint32_t)>;

    // Which parts a picture needs of it; a finished picture, or one more pass on top of what is known.
    struct Wanted {
        const TracedSettings& settings;
        PictureParts parts;
        const gl::Buffer* lookupCounters = nullptr;
        Redraw redraw = {};
        // Not null: the same picture in fewer pixels, whose irradiance is that of all.
        const view::Surfaces* reduced = nullptr;
    };

    // Gathers what the settings ask rays for. GL state changed: as PixelRays.
    void gather(const gl::Device& device, const RayInputs& inputs, const Wanted& wanted) {
        gatherInSteps(device, inputs, wanted).finish();
    }
    // Left before it is done, it leaves no picture; what was gathered before is taken up again by the next.
    base::Steps gatherInSteps(const gl::Device& device, const RayInputs& inputs, const Wanted& wanted);
    base::Steps gatherOcclusion(const gl::Device& device, const RayInputs& inputs,
                                const TracedSettings& settings);
    // What the last gather() found, as `inputs.surfaces` see it, a part of a pixel beside: irradiance() and
    // lobe() are of these then. GL state changed: as CarriedPicture.
    base::Steps carry(const gl::Device& device, const RayInputs& inputs, const TracedSettings& settings);
    // Records the recorder's pixel; what was gathered stays.
    void record(const gl::Device& device, const RayInputs& inputs, const Wanted& wanted,
                StepRecorder& recorder);
    void recordOcclusion(const gl::Device& device, const RayInputs& inputs, const TracedSettings& settings,
                         StepRecorder& recorder);

    // Of the last gather() or carry(), pictures of lib/pixel_history.glsl; null: rays were not asked for it,
    // and the cache, or the irradiance, stands in.
    const gl::Texture* irradiance() const { return diffuse_.picture; }
    const gl::Texture* lobe() const { return specular_.picture; }
    // Of lamps that are drawn by chance, as a white surface would show it; null where there are none.
    const gl::Texture* lamps() const { return lamps_.picture; }
    const PixelRectangle& lobes() const { return specular_.rays.lobes(); }  // where `lobe` has anything
    // Radiance in the lobes of clear coats, where any are seen; null: the irradiance stands in.
    const gl::Texture* coat() const { return coats_.picture; }
    const gl::Texture& occlusion() const { return *occlusion_.picture; }

  private:
    // The means so far: from where, of how many passes.
    struct History {
        std::optional<gpu::FrameConstants> view;
        int passes = 0;
        std::uint32_t number = 0;  // of the next pass in motion, which gives it random numbers of its own
        base::Revision light{};    // LitVoxels::sources() of the last pass
    };
    // One of the pictures: its rays, its means, and where it is.
    struct Gathered {
        PixelRays rays;
        History history;
        CarriedPicture carried;
        const gl::Texture* found = nullptr;  // by gather(), which carry() starts from
        gpu::FrameConstants foundView{};
        const gl::Texture* picture = nullptr;  // of the last gather() or carry()
    };
    void forget();
    void follow(const RayInputs& inputs, const TracedSettings& settings,
                const view::Surfaces* reduced = nullptr);
    void followInstances(const scene::GpuScene& scene);
    // A picture that is asked for, at these pixels, by so many rays of each in a pass.
    struct PictureRays {
        Gathered* gathered;
        int rays;
        RayInputs inputs;
    };
    std::vector<PictureRays> wantedPictures(const RayInputs& inputs, const Wanted& wanted);
    void carryOne(const gl::Device& device, const RayInputs& inputs, const TracedSettings& settings,
                  Gathered& gathered);
    static bool isKnown(const RayInputs& inputs, const Gathered& gathered);
    bool isStill(const RayInputs& inputs, const Gathered& gathered) const;
    int keptPasses(const RayInputs& inputs, Gathered& gathered);
    base::Steps addPass(const gl::Device& device, const RayInputs& inputs, const RayPass& pass,
                        Gathered& gathered);
    base::Steps addPasses(const gl::Device& device, const RayInputs& inputs, const RayPass& pass, int until,
                          Gathered& gathered);
    void recordPasses(const gl::Device& device, const Wanted& wanted, const PictureRays& picture,
                      StepRecorder& recorder);
    base::Steps gatherAll(const gl::Device& device, const Wanted& wanted,
                          const std::vector<PictureRays>& pictures);

    Gathered diffuse_{PixelRays(RayPicture::Diffuse), {}, {}};
    Gathered specular_{PixelRays(RayPicture::Specular), {}, {}};
    Gathered coats_{PixelRays(RayPicture::Coat), {}, {}};
    Gathered occlusion_{PixelRays(RayPicture::Occlusion), {}, {}};
    Gathered lamps_{PixelRays(RayPicture::Lamps), {}, {}};

    scene::InstanceHistory instances_;  // since the last picture
    gl::Buffer motion_;                 // where from they have come since
    bool moved_ = false;
    bool unfinished_ = false;  // what was begun last was left

    // What the histories were gathered from.
    base::Revision lightFrom_;
    base::Revision lampsFrom_, lampVoxelsFrom_;  // of lamps
    std::optional<TracedSettings> settings_;
};

}  // namespace conelight::gather

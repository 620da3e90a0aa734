// SPDX-License-Identifier: MIT
// What a scene's cones see: one picture of indirect diffuse light per set of cones, and the truth. One bounce
// everywhere, so that the volume is the same for all sets.
#pragma once

#include <string>
#include <vector>

#include "picture_source.h"
#include "reference/ring_search.h"

namespace conelight::program {

struct ConePicture {
    Image image;         // component diffuse
    double samples = 0;  // of the volume, per pixel
};

class ConePictures {
  public:
    // Keeps references.
    ConePictures(PictureSource& source, const Scene& scene, const ViewOptions& view, Progress& progress);
    // Throws InterruptedError after a signal.
    ConePicture by(const std::vector<SetCone>& cones, bool countSamples = false);
    ConePicture by(DiffuseSet set, int count);
    // Two independent pictures of the truth.
    std::pair<Image, Image> truth(int samplesPerPixel, std::uint32_t seed);

  private:
    ConePicture draw(bool countSamples);

    PictureSource& source_;
    Progress& progress_;
    PictureRequest request_;
};

}  // namespace conelight::program

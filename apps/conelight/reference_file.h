// SPDX-License-Identifier: MIT
// Reference pictures as EXR files, with their parts, their halves and what made them; and a folder in which
// they are kept, so that a second run does not render them again.
#pragma once

#include <string>

#include "picture_source.h"

namespace conelight::program {

// What a picture is measured against. Parts that a file does not hold have no pixels.
struct ReferencePicture {
    Image full, direct, indirect, diffuse, specular;
    Image halfA, halfB, indirectA, indirectB;  // independent halves
    int samplesPerPixel = 0;                   // 0: unknown, as is the noise
    double noise = 0;
    double cpuSeconds = 0;
    std::uint64_t rays = 0;
    std::string origin;  // "rendered", "kept: FILE", "FILE"
    std::string file;    // where it lies; empty: nowhere

    const Image* part(Component component) const;  // null: it does not hold it
    bool hasHalves() const { return !halfA.pixels.empty(); }
};

void writeReference(const std::string& path, const ReferencePicture& picture, const std::string& key);
// Throws Error(BadInput) for a file that cannot be read.
ReferencePicture readReference(const std::string& path);

// The picture for `request` (its mode and components are ignored) from the folder `cache`, or rendered and
// put there. An empty folder name: neither. `name` starts the file's name. Throws InterruptedError when a
// signal came.
ReferencePicture referenceFor(PictureSource& source, const Scene& scene, const PictureRequest& request,
                              const std::string& cache, const std::string& name, Progress* progress);

}  // namespace conelight::program

// SPDX-License-Identifier: MIT
// How far a picture is, in a line: of modes that work in the background, and of those of the renderer.
#pragma once

#include <optional>
#include <string>

#include "conelight/renderer.h"
#include "viewer/background_reference.h"
#include "viewer/bake_progress.h"
#include "viewer/picture_passes.h"

namespace conelight::program {

// `preview`: until then another mode's picture stands there.
std::string referenceLabel(const ReferenceStatus& status, bool preview);
std::string beamsLabel(const ReferenceStatus& status, bool preview);
std::string radiosityLabel(const BakeStatus& status, bool preview);
std::string hybridLabel(const BakeStatus& status, bool baked);  // `baked`: shown with some baked light

std::string workLabel(const PictureWork& work);  // "building programs, 3", "textures, 4 of 30"

// `left` of the passes are to come.
std::string passesLabel(const std::string& mode, const PicturePasses& passes, int left,
                        const std::optional<double>& noise);

}  // namespace conelight::program

// SPDX-License-Identifier: MIT
#include "thesis/format/format.h"

#include "conelight/thesis/thesis.h"
#include "io/scene_format.h"
#include "thesis/format/scene.h"
#include "thesis/format/write.h"

namespace conelight::thesis {

void registerThesisFormat() {
    io::registerSceneFormat(
        {kSceneFormat, "the thesis's format", {".txt", ".scene"}, loadThesisScene, writeThesisScene});
}

}  // namespace conelight::thesis

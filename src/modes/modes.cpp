// SPDX-License-Identifier: MIT
#include "modes/modes.h"

#include <algorithm>

#include "base/log.h"
#include "gather/phong_shade.h"
#include "modes/cones_mode.h"
#include "modes/hybrid_mode.h"
#include "modes/phong_mode.h"
#include "modes/traced_mode.h"

namespace conelight::modes {
namespace {

template <class T>
std::unique_ptr<ModeRenderer> make() {
    return std::make_unique<T>();
}

std::vector<ModeEntry>& all() {
    static std::vector<ModeEntry> modes{
        {Mode::Phong, make<PhongMode>, gather::phongShadeProgramDescs},
        {Mode::Cones, make<ConesMode>, ConesMode::programDescs},
        {Mode::Hybrid, make<HybridMode>, HybridMode::programDescs},
        {Mode::Traced, make<TracedMode>, TracedMode::programDescs},
    };
    return modes;
}

}  // namespace

void registerMode(const ModeEntry& entry) {
    const bool isThere =
        std::any_of(all().begin(), all().end(), [&](const ModeEntry& one) { return one.mode == entry.mode; });
    if (!isThere) all().push_back(entry);
}

const std::vector<ModeEntry>& registeredModes() { return all(); }

std::unique_ptr<ModeRenderer> makeModeRenderer(Mode mode) {
    for (const ModeEntry& entry : all())
        if (entry.mode == mode) return entry.make();
    base::fail(ErrorKind::Usage, "mode: nobody registered it; a registered one would be right");
}

}  // namespace conelight::modes

// SPDX-License-Identifier: MIT
// Text of an IES file: read, or refused with one line; what is read is a valid profile.
#include <cstdint>
#include <cstdlib>

#include "conelight/error.h"
#include "io/light_profile_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try {
        conelight::Scene scene;
        scene.lights.resize(1);
        conelight::io::setLightProfile(
            scene.lights[0],
            conelight::io::parseLightProfile("fuzz.ies", {reinterpret_cast<const char*>(data), size}));
        scene.validate();
    } catch (const conelight::Error&) {
    }
    return 0;
}

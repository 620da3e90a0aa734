// SPDX-License-Identifier: MIT
// JSON of a camera path -> cameras between its keys, all of finite numbers.
#include "session/camera_path.h"

#include <cmath>
#include <cstdlib>

#include "conelight/error.h"
#include "folder.h"
#include "io/files.h"
#include "json_mutation.h"

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t maxSize,
                                               unsigned seed) {
    using Json = conelight::fuzz::Json;
    static const std::vector<Json> kOdd = {
        0,     -1, 1,     2,        1e-30, 1e30,          -1e30,          1e300, 1e-45,  0.1,
        "fov", "", "eye", "target", "up",  Json::array(), Json::object(), true,  nullptr};
    return conelight::fuzz::mutateJson(kOdd, data, size, maxSize, seed);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace conelight;
    static const std::filesystem::path kFile = fuzz::folder() / "path.json";
    io::writeFile(kFile, {data, size});
    try {
        const program::CameraPath path = program::readCameraPath(kFile.string());
        constexpr int kFrames = 17;
        for (int i = 0; i < kFrames; ++i) {
            const Camera camera = path.frame(i, kFrames);
            for (const glm::vec3& vector : {camera.eye, camera.target, camera.up})
                for (int axis = 0; axis < 3; ++axis)
                    if (!std::isfinite(vector[axis])) std::abort();
        }
    } catch (const Error&) {
    }
    return 0;
}

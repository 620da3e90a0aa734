// SPDX-License-Identifier: MIT
#include "reference/denoise_oidn.h"

#include "base/log.h"
#include "reference/denoise.h"

#if CONELIGHT_OIDN
#include <OpenImageDenoise/oidn.hpp>
#endif

namespace conelight::reference {

#if CONELIGHT_OIDN

bool hasOidn() { return true; }

void filterByOidn(std::vector<glm::vec3>& color, const GuideTable& guide) {
    oidn::DeviceRef device = oidn::newDevice(oidn::DeviceType::CPU);
    device.commit();
    oidn::FilterRef filter = device.newFilter("RT");
    const auto set = [&](const char* name, const std::vector<glm::vec3>& image) {
        filter.setImage(name, const_cast<glm::vec3*>(image.data()), oidn::Format::Float3,
                        static_cast<std::size_t>(guide.width), static_cast<std::size_t>(guide.height));
    };
    std::vector<glm::vec3> result(color.size());
    set("color", color);
    set("albedo", guide.albedo);
    set("normal", guide.normal);
    set("output", result);
    filter.set("hdr", true);
    filter.commit();
    filter.execute();
    const char* message = nullptr;
    if (device.getError(message) != oidn::Error::None)
        base::fail(ErrorKind::Runtime, "Open Image Denoise: %s", message);
    color = std::move(result);
}

#else

bool hasOidn() { return false; }

void filterByOidn(std::vector<glm::vec3>& /*color*/, const GuideTable& /*guide*/) {
    base::fail(ErrorKind::Usage, "denoise: this build has no Open Image Denoise; own would be right");
}

#endif

}  // namespace conelight::reference

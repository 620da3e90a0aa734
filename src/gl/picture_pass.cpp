// SPDX-License-Identifier: MIT
#include "gl/picture_pass.h"

#include <cstdint>

#include "gl/pace.h"

namespace conelight::gl {
namespace {

constexpr int kBandRows = 8;  // at least: a group's

}  // namespace

base::Steps dispatchPicture(const Device& device, PicturePass pass) {
    Buffer& block = device.programs.firstRow();
    Inputs given = pass.inputs;
    given.uniform("FirstRowBlock", block);
    for (Pieces rows(device, pass.size.y, kBandRows); rows.next();) {
        {
            const PassScope scope(device.profiler, pass.name);
            const auto first = static_cast<std::uint32_t>(rows.first());
            block.update(0, &first, sizeof first);
            device.get(pass.desc).dispatch(given, pass.size.x, rows.count());
        }
        co_await rest(device);
    }
}

}  // namespace conelight::gl

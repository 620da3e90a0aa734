// SPDX-License-Identifier: MIT
#include "gather/pixel_list.h"

namespace conelight::gather {
namespace {

constexpr std::size_t kFirstRow = 16;  // bytes before that of the list

}  // namespace

base::Steps dispatchListed(const gl::Device& device, ListedPass pass) {
    const gl::Program& program = device.get(pass.desc);
    if (device.pace == nullptr) {
        const gl::PassScope scope(device.profiler, pass.name);
        program.dispatchIndirect(pass.inputs, pass.list);
        co_return;
    }
    const std::vector<std::uint32_t> groups = pass.list.read<std::uint32_t>(2);
    const glm::ivec3 group = program.groupSize();
    for (gl::Pieces rows(device, static_cast<int>(groups[1]), 1); rows.next();) {
        {
            const gl::PassScope scope(device.profiler, pass.name);
            const auto first = static_cast<std::uint32_t>(rows.first());
            pass.list.update(kFirstRow, &first, sizeof first);
            program.dispatch(pass.inputs, static_cast<int>(groups[0]) * group.x, rows.count() * group.y);
        }
        co_await gl::rest(device);
    }
    constexpr std::uint32_t kAll = 0;
    pass.list.update(kFirstRow, &kAll, sizeof kAll);
}

}  // namespace conelight::gather

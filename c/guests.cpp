// SPDX-License-Identifier: MIT
#include "guests.h"

#include <mutex>

#include "conelight/thesis/thesis.h"

namespace conelight::c {

void registerGuests() {
    static std::once_flag once;
    std::call_once(once, thesis::registerThesis);
}

}  // namespace conelight::c

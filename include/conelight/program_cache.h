// SPDX-License-Identifier: MIT
// Programs that the driver has linked, kept by the host from one start to the next (RendererOptions::programs).
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "conelight/export.h"

namespace conelight {

// Where a host keeps them. The bytes are the driver's and this library's: whoever keeps them need not understand them.
// Damaged ones cost a line of the log, and the program is built from its sources. A key is 32 hexadecimal digits, of
// the sources and the driver's name and version, so that nothing has to be removed when either changes.
// io/program_files.h keeps them in a folder. Called on the thread of the renderer.
class CONELIGHT_API ProgramCache {
  public:
    virtual ~ProgramCache() = default;
    // Whether a renderer on such a driver uses it. Mesa's software driver finds again by itself what it compiled before,
    // and sooner.
    virtual bool suits(bool softwareDriver) const { return !softwareDriver; }
    // What was kept under this key; empty: nothing.
    virtual std::vector<std::uint8_t> load(const std::string& key) = 0;
    virtual void keep(const std::string& key, std::span<const std::uint8_t> bytes) = 0;
};

// How many programs renderers of this process have built from sources and taken from caches. Thread-safe.
struct ProgramStats {
    std::uint64_t built = 0, loaded = 0;
};
CONELIGHT_API ProgramStats programStats();

}  // namespace conelight

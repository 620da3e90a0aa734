// SPDX-License-Identifier: MIT
// Which mode draws the picture: a name. The library brings four; a guest has a constant of its own and
// registers it with its renderer.
#pragma once

#include <compare>
#include <string_view>

namespace conelight {

class Mode {
  public:
    // `name` is kept, not copied: a literal.
    explicit constexpr Mode(std::string_view name) : name_(name) {}
    constexpr std::string_view name() const { return name_; }
    constexpr bool operator==(const Mode&) const = default;
    constexpr auto operator<=>(const Mode&) const = default;

    static const Mode Phong;   // local illumination only, by the Phong model
    static const Mode Cones;   // energy-normalised cone tracing, physically based shading
    static const Mode Hybrid;  // light baked on what does not move, cones for what does
    static const Mode Traced;  // rays through surface voxels, irradiance cached per voxel face, all bounces

  private:
    std::string_view name_;
};

inline constexpr Mode Mode::Phong{"phong"};
inline constexpr Mode Mode::Cones{"cones"};
inline constexpr Mode Mode::Hybrid{"hybrid"};
inline constexpr Mode Mode::Traced{"traced"};

}  // namespace conelight

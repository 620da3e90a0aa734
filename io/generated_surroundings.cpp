// SPDX-License-Identifier: MIT
// The clear sky is that of Preetham, Shirley and Smits 1999, "A Practical Analytic Model for Daylight": the
// luminance distribution of Perez with coefficients by turbidity, and the sun behind Rayleigh's and Angstrom's
// attenuation. Luminance becomes radiance by 683 lm/W. With a low sun and below the horizon, as much light comes from the
// sky as Janiczek and DeYoung 1987 tabulate, "Computer Programs for Sun and Moon Illuminance" (US Naval Observatory
// Circular 171): dusk, and a night without moon. How dusk is spread over the sky, and its colours, are chosen by eye.
#include "io/generated_surroundings.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "conelight/error.h"
#include "conelight/studio.h"
#include "io/generated_scenes.h"

namespace conelight::io {
namespace {

constexpr double kLumenPerWatt = 683;
constexpr int kColumns = 1024;  // 0.35 degrees: a sky is smooth

constexpr GeneratedParameter kSkyParameters[] = {
    {"latitude", 48, -66, 66, false, "of the place, degrees north"},
    {"day", 172, 1, 365, true, "of the year; 172 is the northern summer solstice"},
    {"hour", 10, 0, 24, false, "solar time; 12 is noon"},
    {"turbidity", 3, 2, 10, false, "haze: 2 very clear, 10 hazy"},
    {"ground", 0.2, 0, 1, false, "albedo of the ground below the horizon"},
};
constexpr GeneratedParameter kStudioParameters[] = {
    {"key", 12, 0, 1e4, false, "radiance of the large lamp, W/(sr m^2)"},
    {"fill", 3, 0, 1e4, false, "radiance of the lamps beside and behind, W/(sr m^2)"},
    {"room", 0.35, 0, 1e4, false, "radiance of the room around them, W/(sr m^2)"},
    {"floor", 0, 0, 1e4, false, "radiance below the horizon, W/(sr m^2); 0: the room goes on there"},
};

glm::dvec3 linearFromXyz(const glm::dvec3& c) {
    return {3.2404542 * c.x - 1.5371385 * c.y - 0.4985314 * c.z,
            -0.9692660 * c.x + 1.8760108 * c.y + 0.0415560 * c.z,
            0.0556434 * c.x - 0.2040259 * c.y + 1.0572252 * c.z};
}

// Towards the sun: x east, y up, z south.
glm::dvec3 sunDirection(double latitudeDeg, double day, double hour) {
    const double latitude = latitudeDeg * std::numbers::pi / 180;
    const double declination = 0.4093 * std::sin(2 * std::numbers::pi * (day - 81) / 368);
    const double angle = std::numbers::pi * hour / 12;  // of the sun's way, from midnight
    return {std::cos(declination) * std::sin(angle),
            std::sin(latitude) * std::sin(declination) -
                std::cos(latitude) * std::cos(declination) * std::cos(angle),
            -(std::cos(latitude) * std::sin(declination) +
              std::sin(latitude) * std::cos(declination) * std::cos(angle))};
}

// Perez's distribution: towards a point at `zenithAngle`, `sunAngle` from the sun.
using Perez = std::array<double, 5>;
double distribution(const Perez& k, double zenithAngle, double sunAngle) {
    const double c = std::cos(sunAngle);
    return (1 + k[0] * std::exp(k[1] / std::max(std::cos(zenithAngle), 0.01))) *
           (1 + k[2] * std::exp(k[3] * sunAngle) + k[4] * c * c);
}

// The zenith's chromaticity: a cubic in the sun's angle, a quadratic in turbidity.
double zenithChromaticity(const std::array<std::array<double, 4>, 3>& table, double turbidity, double angle) {
    double value = 0;
    for (std::size_t row = 0; row < 3; ++row) {
        double sum = 0;
        for (std::size_t i = 0; i < 4; ++i) sum = sum * angle + table[row][i];
        value = value * turbidity + sum;
    }
    return value;
}

class ClearSky {
  public:
    ClearSky(const glm::dvec3& sun, double turbidity) : sun_(sun), turbidity_(turbidity) {
        const double t = turbidity, angle = std::acos(sun.y);
        const double chi = (4.0 / 9 - t / 120) * (std::numbers::pi - 2 * angle);
        zenith_ = {zenithChromaticity({{{0.00166, -0.00375, 0.00209, 0},
                                        {-0.02903, 0.06377, -0.03202, 0.00394},
                                        {0.11693, -0.21196, 0.06052, 0.25886}}},
                                      t, angle),
                   zenithChromaticity({{{0.00275, -0.00610, 0.00317, 0},
                                        {-0.04214, 0.08970, -0.04153, 0.00516},
                                        {0.15346, -0.26756, 0.06670, 0.26688}}},
                                      t, angle),
                   std::max((4.0453 * t - 4.9710) * std::tan(chi) - 0.2155 * t + 2.4192, 0.0) * 1000};
        perez_ = {Perez{-0.0193 * t - 0.2592, -0.0665 * t + 0.0008, -0.0004 * t + 0.2125,
                        -0.0641 * t - 0.8989, -0.0033 * t + 0.0452},
                  Perez{-0.0167 * t - 0.2608, -0.0950 * t + 0.0092, -0.0079 * t + 0.2102,
                        -0.0441 * t - 1.6537, -0.0109 * t + 0.0529},
                  Perez{0.1787 * t - 1.4630, -0.3554 * t + 0.4275, -0.0227 * t + 5.3251, 0.1206 * t - 2.5771,
                        -0.0670 * t + 0.3703}};
        for (std::size_t i = 0; i < 3; ++i) scale_[i] = zenith_[i] / distribution(perez_[i], 0, angle);
    }

    // W/(sr m^2), from above the horizon.
    glm::dvec3 radiance(const glm::dvec3& direction) const {
        const double zenithAngle = std::acos(std::clamp(direction.y, 0.0, 1.0));
        const double sunAngle = std::acos(std::clamp(glm::dot(direction, sun_), -1.0, 1.0));
        std::array<double, 3> xyY{};
        for (std::size_t i = 0; i < 3; ++i)
            xyY[i] = scale_[i] * distribution(perez_[i], zenithAngle, sunAngle);
        const glm::dvec3 xyz(xyY[0] / xyY[1], 1, (1 - xyY[0] - xyY[1]) / xyY[1]);
        return glm::max(linearFromXyz(xyz) * (xyY[2] / kLumenPerWatt), glm::dvec3(0));
    }

    // Of the sun on a plane that faces it, W/m^2.
    glm::dvec3 sunIrradiance() const {
        constexpr double kAboveAir = 133000 / kLumenPerWatt;
        const double angle = std::acos(sun_.y);
        const double mass = 1 / (sun_.y + 0.15 * std::pow(93.885 - angle * 180 / std::numbers::pi, -1.253));
        const double beta = 0.04608365822050 * turbidity_ - 0.04586025928522;
        glm::dvec3 result(0);
        const double wavelengths[3] = {0.61, 0.55, 0.465};  // of red, green and blue, micrometres
        for (int c = 0; c < 3; ++c)
            result[c] = kAboveAir * std::exp(-0.008735 * std::pow(wavelengths[c], -4.08) * mass -
                                             beta * std::pow(wavelengths[c], -1.3) * mass);
        return result;
    }

  private:
    glm::dvec3 sun_;
    double turbidity_;
    std::array<double, 3> zenith_{}, scale_{};  // of x, y and luminance in cd/m^2
    std::array<Perez, 3> perez_{};
};

// Mean over places of equal share of the cosine-weighted hemisphere, times pi: irradiance on the ground.
template <class Radiance>
glm::dvec3 irradianceFrom(const Radiance& radiance) {
    constexpr int kRows = 32, kTurns = 128;
    glm::dvec3 sum(0);
    for (int row = 0; row < kRows; ++row)
        for (int turn = 0; turn < kTurns; ++turn) {
            const double radius = std::sqrt((row + 0.5) / kRows),
                         angle = 2 * std::numbers::pi * turn / kTurns;
            sum += radiance(glm::dvec3(radius * std::cos(angle), std::sqrt(1 - radius * radius),
                                       radius * std::sin(angle)));
        }
    return sum * std::numbers::pi / double(kRows * kTurns);
}

double luminanceOf(const glm::dvec3& c) { return 0.2126729 * c.r + 0.7151522 * c.g + 0.0721750 * c.b; }

// On the ground by the sun's elevation in degrees, lux, without moon: the circular's polynomials in parts of 90 degrees.
// Below -18 degrees it stays: stars and airglow.
double tabulatedLux(double elevation) {
    struct Piece {
        double from;
        std::array<double, 4> terms;
    };
    constexpr Piece kPieces[] = {{-0.8, {2.88, 22.26, -207.64, 1034.30}},
                                 {-5, {2.88, 21.81, -258.11, -858.36}},
                                 {-12, {2.70, 12.17, -431.69, -1899.83}},
                                 {-18, {13.84, 262.72, 1447.42, 2797.93}}};
    elevation = std::max(elevation, -18.0);
    const Piece* piece = kPieces;
    while (elevation < piece->from) ++piece;
    const double x = elevation / 90;
    const auto& k = piece->terms;
    return std::pow(10, k[0] + x * (k[1] + x * (k[2] + x * k[3])));
}

double smooth(double from, double to, double value) {
    const double t = std::clamp((value - from) / (to - from), 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

// Dusk and night, of luminance about 1 overhead: an even blue, paler at night, that brightens towards the
// horizon, and a glow above where the sun went down.
class Dusk {
  public:
    Dusk(const glm::dvec3& sun, double elevation)
        : towardsSun_(glm::normalize(glm::dvec3(sun.x, 0, sun.z) + glm::dvec3(1e-9, 0, 0))),
          night_(smooth(-9, -18, elevation)),
          glow_(40 * std::exp(std::min(elevation, 0.0) / 6) * (1 - night_)) {}

    glm::dvec3 radiance(const glm::dvec3& direction) const {
        // Chromaticities (0.25, 0.25), (0.28, 0.29) and (0.45, 0.41), of luminance 1.
        constexpr glm::dvec3 kBlue(0.71, 0.99, 1.97), kNight(0.85, 1, 1.42), kOrange(1.85, 0.83, 0.22);
        const double low = 1 - std::clamp(direction.y, 0.0, 1.0);
        const double ahead = 0.5 + 0.5 * glm::dot(direction, towardsSun_);
        const double glow = glow_ * std::exp(-std::max(direction.y, 0.0) / 0.12) * ahead * ahead * ahead;
        return glm::mix(kBlue, kNight, night_) * (1 + low * low * low) + kOrange * glow;
    }

  private:
    glm::dvec3 towardsSun_;
    double night_, glow_;
};

// The sky at any hour: by day Preetham's, from sunset on dusk takes its place.
class AnySky {
  public:
    AnySky(const glm::dvec3& sun, double turbidity)
        : elevation_(std::asin(std::clamp(sun.y, -1.0, 1.0)) * 180 / std::numbers::pi),
          day_(raised(sun, kLeastDay), turbidity),
          dusk_(sun, elevation_),
          share_(smooth(0, -6, elevation_)) {
        if (elevation_ >= kLow) return;
        const auto lux = [](const auto& sky) {
            return kLumenPerWatt *
                   luminanceOf(irradianceFrom([&](const glm::dvec3& d) { return sky.radiance(d); }));
        };
        if (elevation_ <= 0)
            scale_ = tabulatedLux(elevation_) / lux(*this);
        else  // from the model to the table, in logarithms
            scale_ = std::pow(tabulatedLux(0) / lux(ClearSky(raised(sun, kLeastDay, 0), turbidity)),
                              1 - elevation_ / kLow);
    }

    // W/(sr m^2), from above the horizon.
    glm::dvec3 radiance(const glm::dvec3& direction) const {
        if (share_ >= 1) return scale_ * dusk_.radiance(direction);
        const glm::dvec3 day = day_.radiance(direction);
        if (share_ <= 0) return scale_ * day;
        // As bright as the day's low sky, so that one passes into the other.
        const double overhead = luminanceOf(day_.radiance({0, 1, 0}));
        return scale_ * glm::mix(day, overhead * dusk_.radiance(direction), share_);
    }

    // The light of the sun, as much of it as is above the horizon; none below.
    std::optional<Light> sunLight(const glm::dvec3& sun) const {
        const double above = std::clamp(0.5 + elevation_ / kSunDiameter, 0.0, 1.0);
        if (above <= 0) return {};
        const glm::dvec3 from = raised(sun, std::sin(0.5 * kSunDiameter * std::numbers::pi / 180));
        return generated::sunLight(kGeneratedSunName, glm::vec3(-from),
                                   glm::vec3(above * day_.sunIrradiance()));
    }

  private:
    static constexpr double kLeastDay =
        0.01;                          // height of the sun down to which the model of daylight is used
    static constexpr double kLow = 5;  // degrees: where the table takes over from the model
    static constexpr double kSunDiameter = 0.53;  // degrees

    // Over the same place of the horizon, but at least, or just, so high.
    static glm::dvec3 raised(const glm::dvec3& sun, double least, double most = 1) {
        const double y = std::clamp(std::min(sun.y, most), least, 1.0);
        const double along = std::max(std::hypot(sun.x, sun.z), 1e-9), kept = std::sqrt(1 - y * y) / along;
        return {sun.x * kept, y, sun.z * kept};
    }

    double elevation_;
    ClearSky day_;
    Dusk dusk_;
    double share_, scale_ = 1;
};

template <class Radiance>
std::shared_ptr<const EnvironmentImage> drawn(int width, const Radiance& radiance) {
    auto image = std::make_shared<EnvironmentImage>();
    image->width = width;
    image->height = width / 2;
    for (int y = 0; y < image->height; ++y)
        for (int x = 0; x < width; ++x) {
            const glm::vec2 uv((static_cast<float>(x) + 0.5f) / static_cast<float>(width),
                               (static_cast<float>(y) + 0.5f) / static_cast<float>(image->height));
            image->radiance.emplace_back(radiance(glm::dvec3(environmentDirection(uv))));
        }
    return image;
}

LoadedEnvironment buildSky(const std::string&, const generated::Values& values) {
    const glm::dvec3 sun = sunDirection(values["latitude"], values["day"], values["hour"]);
    const AnySky sky(sun, values["turbidity"]);
    const auto radiance = [&](const glm::dvec3& d) { return sky.radiance(d); };
    LoadedEnvironment loaded;
    loaded.sun = sky.sunLight(sun);
    // The ground reflects what it gets.
    glm::dvec3 irradiance = irradianceFrom(radiance);
    if (loaded.sun) irradiance += glm::dvec3(loaded.sun->intensity) * -double(loaded.sun->direction.y);
    const glm::dvec3 ground = values["ground"] * irradiance / std::numbers::pi;
    loaded.environment.image =
        drawn(kColumns, [&](const glm::dvec3& d) { return d.y >= 0 ? radiance(d) : ground; });
    return loaded;
}

LoadedEnvironment buildStudio(const std::string&, const generated::Values& values) {
    LoadedEnvironment loaded;
    loaded.environment.image =
        studioPicture({values["key"], values["fill"], values["room"], values["floor"]});
    return loaded;
}

struct SurroundingsEntry {
    GeneratedSceneInfo info;
    LoadedEnvironment (*build)(const std::string& spec, const generated::Values& values);
};
constexpr SurroundingsEntry kEntries[] = {
    {{"sky", "clear sky with its sun, by place and time, at night too; north is -z, east is +x",
      kSkyParameters},
     buildSky},
    {{"studio", "neutral room with a large soft lamp and two weaker ones", kStudioParameters}, buildStudio},
};

}  // namespace

std::span<const GeneratedSceneInfo> generatedSurroundings() {
    static const std::array<GeneratedSceneInfo, std::size(kEntries)> infos = {kEntries[0].info,
                                                                              kEntries[1].info};
    return infos;
}

LoadedEnvironment generateSurroundings(const std::string& spec) {
    const std::string_view text = spec;
    const std::size_t mark = text.find('?');
    const std::string_view rest = mark == std::string_view::npos ? std::string_view() : text.substr(mark + 1);
    std::string known;
    for (const SurroundingsEntry& entry : kEntries) {
        if (entry.info.name == text.substr(0, mark))
            return entry.build(spec, generated::parseValues(spec, entry.info, rest));
        known += fmt::format("{}{}", known.empty() ? "" : ", ", entry.info.name);
    }
    throw Error(ErrorKind::Usage, fmt::format("builtin:{}: unknown surroundings \"{}\"; known are {}", spec,
                                              text.substr(0, mark), known));
}

}  // namespace conelight::io

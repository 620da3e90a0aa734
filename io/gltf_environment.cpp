// SPDX-License-Identifier: MIT
#include "io/gltf_environment.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/quaternion.hpp>

#include "conelight/error.h"
#include "io/generated_surroundings.h"
#include "io/image_file.h"

namespace conelight::io {

namespace {

constexpr const char* kImageBased = "EXT_lights_image_based";
constexpr int kMostCubeSize = 2048;

// Six square pictures of linear radiance: +x -x +y -y +z -z, each as seen from inside.
struct Cube {
    int size = 0;
    std::array<std::vector<glm::vec3>, 6> faces;

    // Between the four nearest texels of the face that the direction meets.
    glm::vec3 at(const glm::vec3& direction) const;
};

glm::vec3 Cube::at(const glm::vec3& d) const {
    const glm::vec3 a = glm::abs(d);
    const int axis = a.x >= a.y && a.x >= a.z ? 0 : a.y >= a.z ? 1 : 2;
    const bool negative = d[axis] < 0;
    // The table of OpenGL's cube maps (its specification, section 8.13), turned about its vertical axis as the
    // extension wants pictures to be.
    const float sign = negative ? -1.0f : 1.0f;
    const float s = axis == 0 ? -sign * d.z : axis == 1 ? d.x : sign * d.x;
    const float t = axis == 1 ? sign * d.z : -d.y;
    const auto pixel = [&](float coordinate) {
        const float at = 0.5f * (coordinate / a[axis] + 1) * static_cast<float>(size) - 0.5f;
        return glm::clamp(at, 0.0f, static_cast<float>(size - 1));
    };
    const float x = pixel(-s), y = pixel(t);
    const std::vector<glm::vec3>& face = faces[static_cast<std::size_t>(2 * axis + (negative ? 1 : 0))];
    const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
    const auto texel = [&](int column, int row) {
        return face[static_cast<std::size_t>(std::min(row, size - 1)) * static_cast<std::size_t>(size) +
                    static_cast<std::size_t>(std::min(column, size - 1))];
    };
    const float fx = x - static_cast<float>(x0), fy = y - static_cast<float>(y0);
    return glm::mix(glm::mix(texel(x0, y0), texel(x0 + 1, y0), fx),
                    glm::mix(texel(x0, y0 + 1), texel(x0 + 1, y0 + 1), fx), fy);
}

// RGBD: sRGB-encoded colour divided by alpha. Pictures without alpha have it everywhere 1.
std::vector<glm::vec3> radianceOf(const ByteImage& picture) {
    std::array<float, 256> linear;
    for (std::size_t i = 0; i < linear.size(); ++i) linear[i] = linearFromSrgb(float(i) / 255.0f);
    std::vector<glm::vec3> out;
    out.reserve(picture.pixels.size() / 4);
    for (std::size_t i = 0; i + 3 < picture.pixels.size(); i += 4) {
        const float divisor = std::max<float>(picture.pixels[i + 3], 1.0f) / 255.0f;
        out.push_back(glm::vec3(linear[picture.pixels[i]], linear[picture.pixels[i + 1]],
                                linear[picture.pixels[i + 2]]) /
                      divisor);
    }
    return out;
}

Cube readCube(GltfFile& file, const GltfValue& light) {
    const GltfValue faces = light["specularImages"][std::size_t(0)];
    if (faces.size() != 6) faces.fail("six pictures expected, one for each side of a cube");
    Cube cube;
    for (std::size_t f = 0; f < 6; ++f) {
        const std::optional<std::size_t> image = faces[f].index(file.array("images").size());
        if (!image) faces[f].fail("is missing");
        const GltfValue value = file.array("images")[*image];
        const ByteImage picture = decodeRgba(file.imageBytes(value), file.name() + ": " + value.path());
        if (picture.width != picture.height || picture.width > kMostCubeSize ||
            (f > 0 && picture.width != cube.size))
            value.fail(
                fmt::format("{} x {} pixels; a square of at most {}, the same for all six, would be right",
                            picture.width, picture.height, kMostCubeSize));
        cube.size = picture.width;
        cube.faces[f] = radianceOf(picture);
    }
    return cube;
}

std::shared_ptr<const EnvironmentImage> latitudeLongitude(const Cube& cube, const glm::quat& worldFromCube) {
    auto image = std::make_shared<EnvironmentImage>();
    image->width = 4 * cube.size;
    image->height = 2 * cube.size;
    image->radiance.reserve(static_cast<std::size_t>(image->width) * static_cast<std::size_t>(image->height));
    const glm::quat cubeFromWorld = glm::conjugate(worldFromCube);
    for (int y = 0; y < image->height; ++y)
        for (int x = 0; x < image->width; ++x) {
            // Environment (scene.h): the middle is seen along -z, the right half towards +x.
            const float theta = glm::pi<float>() * (float(y) + 0.5f) / float(image->height);
            const float phi = glm::two_pi<float>() * ((float(x) + 0.5f) / float(image->width) - 0.5f);
            const glm::vec3 direction(std::sin(theta) * std::sin(phi), std::cos(theta),
                                      -std::sin(theta) * std::cos(phi));
            image->radiance.push_back(cube.at(cubeFromWorld * direction));
        }
    return image;
}

}  // namespace

void readOwnEnvironment(GltfFile& file, const GltfValue& own, Environment& to) {
    if (!own.isObject()) return;
    const std::string name = oneLine(own["file"].text(""));
    if (own["bufferView"].exists()) {
        auto image = std::make_shared<EnvironmentImage>();
        image->width = static_cast<int>(own["width"].whole(0) & 0xffff);
        image->height = static_cast<int>(own["height"].whole(0) & 0xffff);
        const std::span<const std::uint8_t> bytes = file.bufferView(own["bufferView"]);
        image->radiance.resize(static_cast<std::size_t>(image->width) *
                               static_cast<std::size_t>(image->height));
        if (image->radiance.empty() || bytes.size() != image->radiance.size() * sizeof(glm::vec3))
            own.fail(fmt::format("{} x {} texels and {} bytes do not belong together", image->width,
                                 image->height, bytes.size()));
        std::memcpy(image->radiance.data(), bytes.data(), bytes.size());
        to.image = std::move(image);
    } else {
        try {
            // Files are never read by name: a scene would reach out of its folder.
            to.image =
                generateSurroundings(name.substr(std::min<std::size_t>(name.find(':') + 1, name.size())))
                    .environment.image;
        } catch (const Error& error) {
            own["file"].fail(error.what());
        }
    }
    to.file = name;
    to.rotation = own["rotation"].number(0);
    to.strength = own["strength"].number(1);
}

void readImageBasedLight(GltfFile& file, const GltfValue& scene, Environment& to,
                         std::vector<std::string>& notes) {
    const GltfValue lights = file.root().extension(kImageBased)["lights"];
    const std::optional<std::size_t> at = scene.extension(kImageBased)["light"].index(lights.size());
    if (!at) return;
    const GltfValue light = lights[*at];
    const glm::vec4 xyzw = light["rotation"].vector<4>(glm::vec4(0, 0, 0, 1));
    const glm::quat rotation(xyzw.w, xyzw.x, xyzw.y, xyzw.z);
    if (!(glm::length(rotation) > 0)) light["rotation"].fail("a rotation expected; it has no length");
    to.image = latitudeLongitude(readCube(file, light), glm::normalize(rotation));
    to.file = oneLine(light["name"].text(kImageBased));
    to.strength = std::max(light["intensity"].number(1), 0.0f);
    // What is diffuse follows from the picture, exactly and with what hides the sky.
    if (light["irradianceCoefficients"].exists())
        notes.push_back(light.path() + ": irradiance is found from its pictures, not from its coefficients");
}

}  // namespace conelight::io

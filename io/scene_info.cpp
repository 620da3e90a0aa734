// SPDX-License-Identifier: MIT
// A scene in words: see scene_info.h.
#include "io/scene_info.h"

#include <fmt/core.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <type_traits>

#include "conelight/scene_fields.h"
#include "io/files.h"
#include "io/scene_format.h"

namespace conelight::io {

namespace {

constexpr float kDegreesPerRadian = 57.2957795f;

std::string text(const glm::vec3& v) { return fmt::format("{:.4g} {:.4g} {:.4g}", v.x, v.y, v.z); }

std::string bytesText(std::size_t bytes) {
    if (bytes < 10'000) return fmt::format("{} B", bytes);
    if (bytes < 10'000'000) return fmt::format("{:.1f} kB", double(bytes) / 1e3);
    return fmt::format("{:.1f} MB", double(bytes) / 1e6);
}

std::size_t memoryOf(const Mesh& mesh) {
    return mesh.positions.size() * sizeof(glm::vec3) + mesh.normals.size() * sizeof(glm::vec3) +
           mesh.uvs.size() * sizeof(glm::vec2) + mesh.tangents.size() * sizeof(glm::vec4) +
           mesh.colors.size() * sizeof(glm::vec4) + mesh.indices.size() * sizeof(std::uint32_t);
}

const char* wrapName(TextureWrap wrap) {
    switch (wrap) {
        case TextureWrap::Clamp:
            return "clamp";
        case TextureWrap::Mirror:
            return "mirror";
        default:
            return "repeat";
    }
}

// Writes one heading and up to maxRows rows.
class Report {
  public:
    explicit Report(std::size_t maxRows) : maxRows_(maxRows) {}

    template <typename... Args>
    void line(fmt::format_string<Args...> format, Args&&... args) {
        fmt::format_to(std::back_inserter(out_), format, std::forward<Args>(args)...);
        out_ += '\n';
    }
    template <typename T, typename Row>
    void list(const std::vector<T>& items, const Row& row) {
        for (std::size_t i = 0; i < std::min(items.size(), maxRows_); ++i)
            line("  {:>3}  {}", i, row(items[i]));
        if (items.size() > maxRows_) line("  ... {} more", items.size() - maxRows_);
    }
    std::string take() { return std::move(out_); }

  private:
    std::size_t maxRows_;
    std::string out_;
};

// " (the format's title without its article)"; by its name when nobody registered it.
std::string formatOf(const Scene& scene) {
    if (scene.format.empty()) return "";
    const SceneFormat* known = sceneFormatNamed(scene.format);
    const std::string title = known != nullptr ? known->title : scene.format;
    return fmt::format(" ({})", title.rfind("the ", 0) == 0 ? title.substr(4) : title);
}

// ", 3 hidden"; nothing for none.
std::string andSome(std::size_t count, const char* what) {
    return count > 0 ? fmt::format(", {} {}", count, what) : "";
}

std::string describe(const Material& m) {
    std::string out =
        fmt::format("{}: base {}", m.name.empty() ? "(unnamed)" : m.name, text(glm::vec3(m.baseColor)));
    if (m.baseColor.a < 1.0f) out += fmt::format(", opacity {:.3g}", m.baseColor.a);
    if (m.phong)
        out += fmt::format(", Phong ambient {:.3g} diffuse {:.3g} specular {:.3g} shininess {:.3g}",
                           m.phong->ambientStrength, m.phong->diffuseStrength, m.phong->specularStrength,
                           m.phong->shininess);
    else
        out += fmt::format(", metallic {:.3g}, roughness {:.3g}", m.metallic, m.roughness);
    if (m.specular != 1.0f) out += fmt::format(", specular {:.3g}", m.specular);
    if (m.specularColor != glm::vec3(1)) out += fmt::format(", specular colour {}", text(m.specularColor));
    if (m.ior != 1.5f) out += fmt::format(", ior {:.3g}", m.ior);
    if (m.transmission > 0) {
        out += fmt::format(", transmission {:.3g}, {}", m.transmission, m.thickness > 0 ? "solid" : "thin");
        if (m.attenuationDistance > 0)
            out += fmt::format(", {} after {:.3g} m", text(m.attenuationColor), m.attenuationDistance);
    }
    if (m.coat > 0) out += fmt::format(", coat {:.3g} of roughness {:.3g}", m.coat, m.coatRoughness);
    if (m.sheenColor != glm::vec3(0))
        out += fmt::format(", sheen {} of roughness {:.3g}", text(m.sheenColor), m.sheenRoughness);
    if (m.emission != glm::vec3(0)) out += fmt::format(", emission {} W/(sr m^2)", text(m.emission));
    std::string maps;
    visitFields(
        [&maps](const char* name, const auto& value) {
            if constexpr (std::is_same_v<decltype(value), const TextureRef&>)
                if (value.used())
                    maps += fmt::format("{}{} #{}", maps.empty() ? "" : ", ", name, value.texture);
        },
        m);
    if (!maps.empty()) out += fmt::format(", textures {}", maps);
    if (m.alphaMode == AlphaMode::Mask) out += fmt::format(", mask below {:.3g}", m.alphaCutoff);
    if (m.alphaMode == AlphaMode::Blend) out += ", blended";
    if (m.doubleSided) out += ", double-sided";
    if (m.unlit) out += ", unlit";
    return out;
}

std::string describe(const Light& l) {
    std::string out = fmt::format("{}: {}, {} {}", l.name.empty() ? "(unnamed)" : l.name,
                                  lightTypeName(l.type), text(l.intensity), lightUnit(l.type));
    if (const auto flux = radiantFlux(l)) out += fmt::format(", flux {} W", text(*flux));
    if (l.type != LightType::Directional) out += fmt::format(", at {}", text(l.position));
    if (hasDirection(l.type)) out += fmt::format(", towards {}", text(l.direction));
    if (l.type == LightType::Spot)
        out += fmt::format(", cone {:.3g} to {:.3g} deg", l.innerAngle * kDegreesPerRadian,
                           l.outerAngle * kDegreesPerRadian);
    if (l.type == LightType::Sphere) out += fmt::format(", radius {:.3g} m", glm::length(l.halfU));
    if (l.type == LightType::Rect || l.type == LightType::Disk)
        out += fmt::format(", {:.3g} x {:.3g} m", 2.0f * glm::length(l.halfU), 2.0f * glm::length(l.halfV));
    if (l.profile != nullptr) out += fmt::format(", profile {}", oneLine(l.profile->file));
    if (l.customFalloff)
        out += fmt::format(", falloff 1/({:.3g} + {:.3g} d + {:.3g} d^2)", l.falloff.x, l.falloff.y,
                           l.falloff.z);
    if (l.range > 0.0f) out += fmt::format(", range {:.3g} m", l.range);
    if (!l.enabled) out += ", off";
    if (!l.castsShadow) out += ", no shadow";
    return out;
}

std::string lensText(const Camera& camera) {
    if (!camera.hasLens()) return {};
    return fmt::format(", lens {:.4g} m, focus {:.4g} m", camera.lensDiameter, camera.focus());
}

std::string describe(const Camera& c) {
    const std::string sees = c.isOrthographic()
                                 ? fmt::format("orthographic, {:.4g} m high", c.orthographicHeight)
                                 : fmt::format("{:.4g} deg vertical", c.fovY * kDegreesPerRadian);
    return fmt::format("{}: at {}, to {}, {}, {:.3g} to {:.3g} m{}", c.name.empty() ? "(unnamed)" : c.name,
                       text(c.eye), text(c.target), sees, c.zNear, c.zFar, lensText(c));
}

}  // namespace

const char* lightTypeName(LightType type) {
    switch (type) {
        case LightType::Spot:
            return "spot";
        case LightType::Directional:
            return "directional";
        case LightType::Rect:
            return "rect";
        case LightType::Disk:
            return "disk";
        case LightType::Sphere:
            return "sphere";
        default:
            return "point";
    }
}

const char* lightUnit(LightType type) {
    switch (type) {
        case LightType::Directional:
            return "W/m^2";
        case LightType::Rect:
        case LightType::Disk:
        case LightType::Sphere:
            return "W/(sr m^2)";
        default:
            return "W/sr";
    }
}

std::string describeScene(const Scene& scene, std::size_t maxRows) {
    Report report(maxRows);
    std::size_t triangles = 0, voxelized = 0, hidden = 0, emissive = 0, dynamic = 0;
    for (const Instance& instance : scene.instances) {
        const std::size_t count = scene.meshes[std::size_t(instance.mesh)].triangleCount();
        if (!instance.visible) {
            ++hidden;
            continue;
        }
        triangles += count;
        if (instance.dynamic) ++dynamic;
        if (instance.voxelized) voxelized += count;
        if (instance.material >= 0 &&
            scene.materials[std::size_t(instance.material)].emission != glm::vec3(0))
            emissive += count;
    }
    std::size_t meshBytes = 0, meshTriangles = 0, textureBytes = 0;
    for (const Mesh& mesh : scene.meshes) {
        meshBytes += memoryOf(mesh);
        meshTriangles += mesh.triangleCount();
    }
    for (const Texture& texture : scene.textures) textureBytes += texture.rgba.size();

    const Aabb bounds = scene.bounds();
    report.line("scene      {}{}", scene.name.empty() ? "(unnamed)" : scene.name, formatOf(scene));
    report.line("triangles  {} drawn, {} voxelized, {} emissive", triangles, voxelized, emissive);
    report.line("instances  {}{}{}", scene.instances.size(), andSome(hidden, "hidden"),
                andSome(dynamic, "dynamic"));
    report.line("meshes     {}, {} triangles, {}", scene.meshes.size(), meshTriangles, bytesText(meshBytes));
    if (bounds.empty())
        report.line("bounds     empty");
    else
        report.line("bounds     {} to {} m, size {} m", text(bounds.min), text(bounds.max),
                    text(bounds.extent()));
    report.line("sky        {} W/(sr m^2)", text(scene.sky));
    if (const EnvironmentImage* image = scene.environment.image.get())
        report.line("environment {}: {} x {}, turned by {:.4g} degrees, times {:.4g}",
                    scene.environment.file.empty() ? "(unnamed)" : scene.environment.file, image->width,
                    image->height, glm::degrees(scene.environment.rotation), scene.environment.strength);
    report.line("materials  {}", scene.materials.size());
    report.list(scene.materials, [](const Material& m) { return describe(m); });
    report.line("textures   {}, {}", scene.textures.size(), bytesText(textureBytes));
    report.list(scene.textures, [](const Texture& t) {
        return fmt::format("{}: {} x {}, {}, {}, {}/{}{}", t.name.empty() ? "(unnamed)" : t.name, t.width,
                           t.height, t.srgb ? "sRGB" : "linear", bytesText(t.rgba.size()), wrapName(t.wrapU),
                           wrapName(t.wrapV), t.filter == TextureFilter::Nearest ? ", nearest" : "");
    });
    if (!scene.groups.empty()) report.line("groups     {}", scene.groups.size());
    report.line("lights     {}", scene.lights.size());
    report.list(scene.lights, [](const Light& l) { return describe(l); });
    report.line("cameras    {}", scene.cameras.size());
    report.list(scene.cameras, [](const Camera& c) { return describe(c); });
    if (!scene.settings.empty()) report.line("settings   {}", scene.settings.size());
    for (const auto& [key, value] : scene.settings) report.line("  {} = {}", key, value);
    for (const std::string& note : scene.notes) report.line("note       {}", note);
    return report.take();
}

std::string describeObjects(const Scene& scene) {
    std::vector<std::string> names;
    std::map<std::string, std::size_t> counts;
    for (const Instance& instance : scene.instances)
        if (++counts[instance.name] == 1 && !instance.name.empty()) names.push_back(instance.name);
    std::string out = fmt::format("objects    {}\n", names.size());
    const auto line = [&](const std::string& text, std::size_t count) {
        out += "  " + text + (count > 1 ? fmt::format(", {} instances\n", count) : "\n");
    };
    for (const std::string& name : names) line(oneLine(name), counts[name]);
    if (const std::size_t unnamed = counts[""]) line("(unnamed)", unnamed);
    return out;
}

}  // namespace conelight::io

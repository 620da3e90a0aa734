// SPDX-License-Identifier: MIT
// Commands that list, choose and edit what the scene holds: objects, materials, sky; saving. Lights:
// commands_light.cpp.
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <set>

#include "conelight/error.h"
#include "console/console.h"
#include "console/names.h"
#include "io/environment_file.h"
#include "io/files.h"
#include "io/gltf_write.h"
#include "io/image_file.h"
#include "session/material_edit.h"
#include "session/save.h"
#include "session/usage.h"

namespace conelight::program {
namespace {

void listObjects(const CommandContext& context) {
    const Scene& scene = context.session.scene();
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        const Instance& one = scene.instances[i];
        const std::size_t triangles =
            one.mesh < 0 ? 0 : scene.meshes[static_cast<std::size_t>(one.mesh)].triangleCount();
        const std::string material =
            one.material < 0 ? "-" : scene.materials[static_cast<std::size_t>(one.material)].name;
        context.print(fmt::format("{:3} {:<20} {:>9} triangles  material {:<16} at {}{}{}{}", i, one.name,
                                  triangles, material, textOf(glm::vec3(one.worldFromObject[3])),
                                  one.visible ? "" : "  hidden", one.voxelized ? "" : "  not voxelized",
                                  one.dynamic ? "  dynamic" : ""));
    }
}

void listMaterials(const CommandContext& context) {
    const std::vector<Material>& materials = context.session.scene().materials;
    for (std::size_t i = 0; i < materials.size(); ++i) {
        const Material& one = materials[i];
        const glm::vec3 color = one.phong ? one.phong->color : glm::vec3(one.baseColor);
        context.print(fmt::format("{:3} {:<20} color {}  roughness {:.3g}  metallic {:.3g}{}", i, one.name,
                                  textOf(color), one.roughness, one.metallic,
                                  one.emission == glm::vec3(0) ? "" : "  emission " + textOf(one.emission)));
    }
}

void listScene(const CommandContext& context) {
    const std::string what = context.count() > 0 ? context.words[0] : "objects";
    if (what == "objects") listObjects(context);
    if (what == "materials") listMaterials(context);
    if (what == "lights") printLights(context);
    if (what == "cameras") {
        const std::vector<std::string> names = cameraNames(context.session);
        for (std::size_t i = 0; i < names.size(); ++i) context.print(fmt::format("{:3} {}", i, names[i]));
    }
    if (what == "modes")
        for (const std::string& one : sessionModes())
            context.print(fmt::format("{:<10} {}", one, aboutMode(one)));
}

// All that can be selected together.
std::vector<Selection> everything(const Session& session) {
    std::vector<Selection> all;
    for (std::size_t i = 0; i < session.scene().lights.size(); ++i) all.push_back({SelectionKind::Light, i});
    for (std::size_t i = 0; i < session.scene().instances.size(); ++i)
        all.push_back({SelectionKind::Instance, i});
    return all;
}

// The first kind of thing that has the name.
std::vector<Selection> selectable(const Session& session, const std::string& word) {
    const std::pair<SelectionKind, std::vector<std::size_t>> kinds[] = {
        {SelectionKind::Instance, objectsNamed(session, word)},
        {SelectionKind::Light, lightsNamed(session, word)},
        {SelectionKind::Material, materialsNamed(session, word)}};
    std::vector<Selection> found;
    for (const auto& [kind, indices] : kinds) {
        for (const std::size_t i : indices) found.push_back({kind, i});
        // Lights of a group stand beside its objects.
        if (!found.empty() && (!isGroupName(word) || kind == SelectionKind::Light)) return found;
    }
    requireName("select", "object, light or material", wordsOf(session, {"", ArgumentKind::Selectable}),
                word);
    return found;
}

void select(const CommandContext& context) {
    Session& session = context.session;
    const std::string& first = context.words[0];
    if (context.count() == 1 && first == "none") return session.select({});
    if (context.count() == 1 && (first == "all" || first == "invert")) {
        std::vector<Selection> all = everything(session);
        if (first == "invert")
            std::erase_if(all, [&](const Selection& one) { return session.isSelected(one); });
        return session.selectAll(all);
    }
    std::vector<Selection> found;
    for (const std::string& word : context.words)
        for (const Selection& one : selectable(session, word)) found.push_back(one);
    // Of several the first counts as the last one chosen; a material stands alone.
    if (found.front().kind == SelectionKind::Material) return session.select(found.front());
    std::rotate(found.begin(), found.begin() + 1, found.end());
    session.selectAll(found);
}

struct Property {
    const char* name;
    std::size_t values;  // 0: on or off
    double low, high;
    const char* unit;
};
constexpr Property kProperties[] = {
    {"color", 3, 0, 1, ""},
    {"opacity", 1, 0, 1, ""},
    {"roughness", 1, 0, 1, ""},
    {"metallic", 1, 0, 1, ""},
    {"ior", 1, 1, 10, ""},
    {"specular", 1, 0, 1, ""},
    {"transmission", 1, 0, 1, ""},
    {"thickness", 1, 0, 1e9, "m"},
    {"attenuation_color", 3, kLeastAttenuationColor, 1, ""},
    {"attenuation_distance", 1, 0, 1e9, "m"},
    {"coat", 1, 0, 1, ""},
    {"coat_roughness", 1, 0, 1, ""},
    {"sheen", 3, 0, 1, ""},
    {"sheen_roughness", 1, 0, 1, ""},
    {"emission", 3, 0, 1e9, "W/(sr m^2)"},
    {"shininess", 1, 0, 10000, ""},
    {"ambient_str", 1, 0, 100, ""},
    {"diffuse_str", 1, 0, 100, ""},
    {"specular_str", 1, 0, 100, ""},
    {"double_sided", 0, 0, 0, ""},
    {"unlit", 0, 0, 0, ""},
};

const Property& propertyOf(const std::string& word) {
    std::vector<std::string> names;
    for (const Property& property : kProperties) {
        if (word == property.name) return property;
        names.push_back(property.name);
    }
    const std::string near = nearest(word, names);
    std::string all;
    for (const std::string& name : names) all += (all.empty() ? "" : ", ") + name;
    usage(fmt::format("material: there is no property '{}'; {} would be right", word,
                      near.empty() ? "one of " + all : near));
}

std::array<float, 3> valuesOf(const CommandContext& context, const Property& property) {
    const std::size_t given = context.count() - 2;
    // One number stands for three equal ones.
    if (given != property.values && !(property.values == 3 && given == 1))
        usage(fmt::format("material: {} takes {} number{}, got {}", property.name, property.values,
                          property.values == 1 ? "" : "s", given));
    std::array<float, 3> values{};
    for (std::size_t i = 0; i < property.values; ++i) {
        const std::string& word = context.words[2 + std::min(i, given - 1)];
        const double value = numberFrom(std::string("material: ") + property.name, word);
        if (value < property.low || value > property.high)
            usage(fmt::format("material: {}: '{}' is not usable; {:g} to {:g}{}{} would be right",
                              property.name, word, property.low, property.high,
                              *property.unit == '\0' ? "" : " ", property.unit));
        values[i] = static_cast<float>(value);
    }
    return values;
}

bool onOff(const CommandContext& context, const Property& property) {
    const std::string word = context.count() == 3 ? context.words[2] : "";
    if (word == "on" || word == "true") return true;
    if (word == "off" || word == "false") return false;
    usage(fmt::format("material: {}: on or off would be right", property.name));
}

void change(Material& material, const CommandContext& context) {
    const Property& property = propertyOf(context.words[1]);
    const std::string name = property.name;
    if (property.values == 0) {
        (name == "unlit" ? material.unlit : material.doubleSided) = onOff(context, property);
        return;
    }
    const std::array<float, 3> v = valuesOf(context, property);
    PhongMaterial phong = phongOf(material);
    if (name == "color") setColor(material, {v[0], v[1], v[2]});
    if (name == "emission") material.emission = {v[0], v[1], v[2]};
    if (name == "opacity") {
        material.baseColor.a = v[0];
        if (v[0] < 1 && material.alphaMode == AlphaMode::Opaque) material.alphaMode = AlphaMode::Blend;
    }
    if (name == "roughness") material.roughness = v[0];
    if (name == "metallic") material.metallic = v[0];
    if (name == "ior") material.ior = v[0];
    if (name == "specular") material.specular = v[0];
    if (name == "transmission") material.transmission = v[0];
    if (name == "thickness") material.thickness = v[0];
    if (name == "attenuation_color") material.attenuationColor = {v[0], v[1], v[2]};
    if (name == "attenuation_distance") material.attenuationDistance = v[0];
    if (name == "coat") material.coat = v[0];
    if (name == "coat_roughness") material.coatRoughness = v[0];
    if (name == "sheen") material.sheenColor = {v[0], v[1], v[2]};
    if (name == "sheen_roughness") material.sheenRoughness = v[0];
    if (name == "shininess") phong.shininess = v[0];
    if (name == "ambient_str") phong.ambientStrength = v[0];
    if (name == "diffuse_str") phong.diffuseStrength = v[0];
    if (name == "specular_str") phong.specularStrength = v[0];
    if (name == "shininess" || name.find("_str") != std::string::npos) setPhong(material, phong);
}

void printMaterial(const CommandContext& context, const Material& m) {
    context.print("material " + m.name);
    context.print(fmt::format("  color {}  opacity {:.6g}{}", textOf(glm::vec3(m.baseColor)), m.baseColor.a,
                              m.baseColorTexture.used() ? "  times a texture" : ""));
    context.print(fmt::format("  roughness {:.6g}  metallic {:.6g}  ior {:.6g}  specular {:.6g}", m.roughness,
                              m.metallic, m.ior, m.specular));
    if (m.transmission > 0)
        context.print(
            fmt::format("  transmission {:.6g}  thickness {:.6g} m  attenuation_color {}"
                        "  attenuation_distance {:.6g} m",
                        m.transmission, m.thickness, textOf(m.attenuationColor), m.attenuationDistance));
    if (m.coat > 0 || m.sheenColor != glm::vec3(0))
        context.print(fmt::format("  coat {:.6g}  coat_roughness {:.6g}  sheen {}  sheen_roughness {:.6g}{}",
                                  m.coat, m.coatRoughness, textOf(m.sheenColor), m.sheenRoughness,
                                  hasLayers(m) ? "" : "  (not shown: glass or unlit)"));
    context.print(fmt::format("  emission {} W/(sr m^2)", textOf(m.emission)));
    const PhongMaterial phong = phongOf(m);
    context.print(
        fmt::format("  Phong{}: color {}  shininess {:.6g}  ambient_str {:.6g}  diffuse_str {:.6g}"
                    "  specular_str {:.6g}",
                    m.phong ? "" : " (derived)", textOf(phong.color), phong.shininess, phong.ambientStrength,
                    phong.diffuseStrength, phong.specularStrength));
    context.print(
        fmt::format("  double_sided {}  unlit {}", m.doubleSided ? "on" : "off", m.unlit ? "on" : "off"));
}

void material(const CommandContext& context) {
    Session& session = context.session;
    const std::string& word = context.words[0];
    if (context.count() > 1) propertyOf(context.words[1]);  // before anything is changed
    std::set<std::size_t> indices;
    for (const std::size_t index : materialsNamed(session, word)) indices.insert(index);
    if (indices.empty())
        for (const std::size_t object : objectsNamed(session, word))
            indices.insert(session.materialOf(object));
    if (indices.empty()) {
        std::vector<std::string> names = materialNames(session);
        const std::vector<std::string> objects = objectNames(session);
        names.insert(names.end(), objects.begin(), objects.end());
        requireName("material", "material or object", names, word);
    }
    std::vector<std::pair<std::size_t, Material>> changes;
    for (const std::size_t index : indices) {
        Material changed = session.scene().materials[index];
        if (context.count() == 1) {
            printMaterial(context, changed);
            continue;
        }
        change(changed, context);
        changes.emplace_back(index, std::move(changed));
    }
    if (!changes.empty()) session.setMaterials(changes, "material " + word + " " + context.words[1]);
}

void sky(const CommandContext& context) {
    if (context.count() == 0)
        return context.print("sky: " + textOf(context.session.scene().sky) + " W/(sr m^2)");
    if (context.count() != 1 && context.count() != 3)
        usage(fmt::format("sky: takes 1 or 3 numbers, got {}; sky R G B would be right", context.count()));
    glm::vec3 color(0);
    for (int c = 0; c < 3; ++c)
        color[c] = static_cast<float>(context.number(context.count() == 3 ? static_cast<std::size_t>(c) : 0));
    context.session.setSky(color, "sky");
}

// environment [FILE|none] [DEGREES] [STRENGTH]
void environment(const CommandContext& context) {
    Session& session = context.session;
    const Environment& now = session.scene().environment;
    if (context.count() == 0)
        return context.print(now.image == nullptr
                                 ? "environment: none"
                                 : fmt::format("environment: {}, turned by {:.4g} degrees, times {:.4g}",
                                               now.file, glm::degrees(now.rotation), now.strength));
    const auto rotation = context.count() > 1 ? glm::radians(static_cast<float>(context.number(1))) : 0.0f;
    const auto strength = context.count() > 2 ? static_cast<float>(context.number(2)) : 1.0f;
    io::LoadedEnvironment loaded;
    if (context.words[0] != "none") loaded = io::loadEnvironment(context.words[0]);
    Scene changed;
    changed.lights = session.scene().lights;
    io::useEnvironment(changed, std::move(loaded), rotation, strength);
    session.setEnvironment(changed.environment, changed.lights, "environment " + context.words[0]);
}

void save(const CommandContext& context) {
    for (const std::string& note : saveSession(context.session, context.words[0], context.count() > 1))
        context.print(note);
    context.print("saved " + context.words[0]);
}

void bake(const CommandContext& context) {
    const std::string& file = context.words[0];
    Request request{RequestKind::Bake, file};
    request.overwrite = context.count() > 1;
    const std::string extension = io::lowerExtension(file);
    if (extension != ".glb" && extension != ".gltf")
        usage("bake: " + file + ": a name ending in .glb or .gltf would be right");
    io::refuseOverwriting(file, request.overwrite);
    io::refuseForeignBuffer(file, request.overwrite);
    io::checkWritable(file);
    context.session.request(std::move(request));
}

Command listCommand() {
    Argument what{"WHAT", ArgumentKind::Choice, true};
    what.choices = {"objects", "materials", "lights", "cameras", "modes"};
    return command("list", {what}, "what there is, with its numbers", listScene, "Without WHAT: objects.");
}

}  // namespace

CommandGroup sceneCommands() {
    CommandGroup group{
        "Scene",
        {
            listCommand(),
            command("select", {{"NAME", ArgumentKind::Selectable, false, true}},
                    "choose objects, lights or a material; all, none, invert", select,
                    "Several names select all of them, `invert` what is not selected."),
            command("material",
                    {{"NAME", ArgumentKind::Material},
                     {"PROPERTY", ArgumentKind::Text, true},
                     {"VALUE", ArgumentKind::Text, true, true}},
                    "print a material, or change one of its properties", material,
                    "NAME is a material's or an object's.\n"
                    "color R G B, emission R G B (W/(sr m^2)): one number stands for three equal ones\n"
                    "roughness, metallic, opacity, specular: 0 to 1; ior: 1 to 10\n"
                    "shininess, ambient_str, diffuse_str, specular_str: Phong's, modes phong and thesis\n"
                    "double_sided, unlit: on or off"),
            lightCommand(),
            command("sky", {{"RADIANCE", ArgumentKind::Number, true, true, "W/(sr m^2)", 0, 1e9, {}}},
                    "radiance of the surroundings: R G B, or one number", sky,
                    "Without RADIANCE it is printed."),
            command("environment",
                    {{"FILE", ArgumentKind::SceneFile, true},
                     {"DEGREES", ArgumentKind::Number, true, false, "turn", -360, 360, {}},
                     {"STRENGTH", ArgumentKind::Number, true, false, "factor", 0, 1e9, {}}},
                    "surroundings from a picture", environment,
                    "FILE: a latitude-longitude picture (.exr .hdr), builtin:sky, builtin:studio, or none; "
                    "without it "
                    "what there is\nis printed. The turn is counter-clockwise as seen from above."),
            command("save",
                    {{"FILE", ArgumentKind::File},
                     {"OVERWRITE", ArgumentKind::Choice, true, false, "", 0, 0, {"overwrite", "force"}}},
                    "write the edited scene: .gltf .glb, or .txt (the thesis's format)", save,
                    "What exists is left alone, the .bin beside a .gltf too, unless `overwrite` is said; "
                    "nothing is "
                    "half-written.\nWhat the format cannot hold is named. The .txt format keeps settings and "
                    "view too, and its meshes as .obj files "
                    "beside it."),
            command(
                "bake",
                {{"FILE", ArgumentKind::File},
                 {"OVERWRITE", ArgumentKind::Choice, true, false, "", 0, 0, {"overwrite", "force"}}},
                "solve radiosity for the scene as it is and write it lit: .glb, .gltf", bake,
                "As `render --mode radiosity --bake`: any mode draws the file from anywhere, mode phong at "
                "once.\nA window stays live meanwhile; with as many bounces as `traced.bounces` says in that "
                "mode.\nWhat exists is left alone unless `overwrite` is said."),
        }};
    std::vector<Command> objects = objectCommands();
    for (Command& one : additionCommands()) objects.push_back(std::move(one));
    group.commands.insert(group.commands.begin() + 2, objects.begin(), objects.end());  // behind `select`
    return group;
}

}  // namespace conelight::program

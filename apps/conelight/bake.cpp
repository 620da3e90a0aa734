// SPDX-License-Identifier: MIT
// `conelight bake SCENE -o DIR`: light probes or light maps for other programs, and how wrong a picture lit by them is.
#include <fmt/core.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "bake_check.h"
#include "bake_state.h"
#include "command.h"
#include "io/files.h"
#include "io/lightmap_files.h"
#include "io/probe_files.h"
#include "memory_limit.h"
#include "provenance.h"
#include "reference/lightmaps.h"
#include "reference/probes.h"
#include "scene_hash.h"
#include "truth_options.h"

namespace conelight::program {
namespace {

constexpr int kBakeFormat = 1;  // of bake.partial

struct BakeOptions {
    std::string scene, out, json;
    double spacing = 0, texel = 0;
    int samples = 1024, mapSize = 2048;
    bool lightmaps = false, direct = false, directional = false;
    std::string placement = "grid";
    bool force = false, noCheck = false;
    BakeCheck check;
    // Of indirect light.
    int bounces() const { return parseBounces(check.bounces, 1000); }
};

float longestSide(const Scene& scene) {
    const glm::vec3 extent = scene.bounds().extent();
    return std::max({extent.x, extent.y, extent.z});
}

io::ProbeFiles filesOf(const reference::ProbeVolume& volume, const BakeOptions& options) {
    io::ProbeFiles files;
    files.scene = options.scene;
    files.origin = volume.grid.origin;
    files.spacing = volume.grid.spacing;
    files.counts = volume.grid.counts;
    files.irradianceSide = reference::kIrradianceSide;
    files.distanceSide = reference::kDistanceSide;
    files.samples = options.samples;
    files.seed = options.check.seed;
    for (const reference::Probe& probe : volume.probes) {
        files.probes.push_back({probe.position, probe.active, probe.harmonics});
        files.irradiance.insert(files.irradiance.end(), probe.irradiance.begin(), probe.irradiance.end());
        files.distance.insert(files.distance.end(), probe.distance.begin(), probe.distance.end());
    }
    return files;
}

// What is written is the scene with its vertices doubled where charts end.
io::LightmapFiles filesOf(const Scene& scene, const reference::LightmapLayout& layout,
                          const std::vector<reference::Lightmap>& maps, const BakeOptions& options) {
    io::LightmapFiles files;
    files.scene = options.scene;
    files.texel = layout.texel;
    files.samples = options.samples;
    files.seed = options.check.seed;
    files.direct = options.direct;
    for (const reference::Lightmap& map : maps) {
        io::LightmapPicture& picture = files.maps.emplace_back();
        picture.size = map.size;
        picture.irradiance = map.irradiance;
        for (std::size_t i = 0; i < map.direct.size(); ++i) picture.irradiance[i] += map.direct[i];
        if (options.directional) picture.direction = map.direction;
    }
    for (const reference::ChartedMesh& mesh : layout.meshes) {
        std::vector<glm::vec2>& uvs = files.places.uvs.emplace_back();
        for (const glm::vec2& texels : mesh.uvs) uvs.push_back(texels / glm::vec2(mesh.size));
    }
    for (std::size_t i = 0; i < layout.places.size(); ++i) {
        const reference::LightmapPlace& place = layout.places[i];
        io::GltfLightmaps::Place& to = files.places.instances.emplace_back();
        if (place.map < 0) continue;
        const glm::vec2 size(layout.sizes[static_cast<std::size_t>(place.map)]);
        to.map = place.map;
        to.offset = glm::vec2(place.offset) / size;
        to.scale = glm::vec2(layout.meshes[static_cast<std::size_t>(scene.instances[i].mesh)].size) / size;
    }
    return files;
}

// Of all that results depend on.
std::string keyOf(const Scene& scene, const BakeOptions& options, const std::string& kind) {
    Hash hash;
    addScene(hash, scene);
    return fmt::format("{} {} {} scene {} samples {} bounces {} seed {} direct {} {}", softwareName(),
                       kBakeFormat, kind, hash.hex(), options.samples, options.bounces(), options.check.seed,
                       options.direct, options.directional);
}

// Calls bake(onProgress); what it has done is kept when it is stopped, and gone on from.
template <class Bake>
void bakeOn(BakeState& state, Progress& progress, const std::string& what, Bake bake) {
    const HostMemoryLimit limit;
    if (state.found() > 0) fmt::print(stderr, "conelight: going on from {:.0f} %\n", 100 * state.found());
    bake([&](double done) {
        progress.show(fmt::format("baking {}, {:.0f} %", what, 100 * done));
        if (!interrupted()) state.saveNowAndThen();
        return !interrupted();
    });
    progress.finish();
    if (!interrupted()) return;
    state.save();
    fmt::print(stderr, "conelight: interrupted; the same command goes on from {:.0f} %\n",
               100 * state.partial().share());
    throw InterruptedError();
}

nlohmann::ordered_json bakeProbesOf(const Scene& scene, const BakeOptions& options, Progress& progress) {
    const reference::ProbeGrid grid = reference::fitProbeGrid(
        scene.bounds(), options.spacing > 0 ? static_cast<float>(options.spacing) : longestSide(scene) / 8);
    reference::ProbeSettings settings;
    settings.samples = options.samples;
    settings.bounces = options.bounces();
    settings.seed = options.check.seed;
    settings.nearSurfaces = options.placement == "surfaces";
    const StoppableScope stoppable;
    io::checkProbeFolder(options.out, options.force);
    BakeState state(options.out, keyOf(scene, options,
                                       fmt::format("probes {:.9g} {:.9g} {:.9g} {}", grid.spacing.x,
                                                   grid.spacing.y, grid.spacing.z, options.placement)));
    reference::ProbeVolume volume;
    bakeOn(state, progress, fmt::format("{} probes", grid.size()), [&](const auto& onProgress) {
        volume = reference::bakeProbes(scene, grid, settings, onProgress, &state.partial());
    });
    io::writeProbes(options.out, filesOf(volume, options), options.force);
    state.remove();
    const auto active = std::count_if(volume.probes.begin(), volume.probes.end(),
                                      [](const reference::Probe& probe) { return probe.active; });
    fmt::print("written {}/probes.json: {} x {} x {} probes, {:.3g} x {:.3g} x {:.3g} m apart, {} {}\n",
               options.out, grid.counts.x, grid.counts.y, grid.counts.z, grid.spacing.x, grid.spacing.y,
               grid.spacing.z, grid.size() - static_cast<std::size_t>(active),
               settings.nearSurfaces ? "in walls or left out" : "in walls");
    nlohmann::ordered_json json = {{"probes", grid.size()}, {"active", active}};
    if (options.noCheck) return json;
    const auto kind = [&](const char* name, reference::ProbeKind what) {
        return BakedKind{name, [&, what](const Camera& camera, const reference::PathTracedPicture& truth) {
                             return drawWithProbes(scene, volume, what, camera, truth);
                         }};
    };
    json["errors"] = checkBake(
        scene, options.check, "probes",
        {kind("sh", reference::ProbeKind::Harmonics), kind("octahedral", reference::ProbeKind::Octahedral)},
        progress);
    return json;
}

nlohmann::ordered_json bakeLightmapsOf(Scene scene, const BakeOptions& options, Progress& progress) {
    const float texel = options.texel > 0 ? static_cast<float>(options.texel) : longestSide(scene) / 64;
    const reference::LightmapLayout layout = reference::layOutLightmaps(scene, texel, options.mapSize);
    reference::LightmapSettings settings;
    settings.samples = options.samples;
    settings.bounces = options.bounces();
    settings.direct = options.direct;
    settings.directions = options.directional;
    settings.seed = options.check.seed;
    const StoppableScope stoppable;
    io::checkLightmapFolder(options.out, layout.sizes.size(), options.directional, options.force);
    BakeState state(options.out,
                    keyOf(scene, options, fmt::format("light maps {:.9g} {}", texel, options.mapSize)));
    std::vector<reference::Lightmap> maps;
    bakeOn(state, progress, fmt::format("{} texels", layout.texels()), [&](const auto& onProgress) {
        maps = reference::bakeLightmaps(scene, layout, settings, onProgress, &state.partial());
    });
    const io::LightmapFiles files = filesOf(scene, layout, maps, options);
    {
        Scene charted = scene;
        for (std::size_t i = 0; i < charted.meshes.size(); ++i)
            if (!layout.meshes[i].uvs.empty()) charted.meshes[i] = layout.meshes[i].mesh;
        for (const std::string& note : io::writeLightmaps(options.out, charted, files, options.force))
            fmt::print(stderr, "conelight: scene.glb: {}\n", note);
    }
    state.remove();
    const auto mapped = std::count_if(layout.places.begin(), layout.places.end(),
                                      [](const reference::LightmapPlace& place) { return place.map >= 0; });
    fmt::print("written {}/lightmaps.json: {} objects in {} {}, {} texels of {:.3g} m\n", options.out, mapped,
               maps.size(), maps.size() == 1 ? "map" : "maps", layout.texels(), texel);
    nlohmann::ordered_json json = {{"objects", mapped}, {"maps", maps.size()}, {"texels", layout.texels()}};
    if (options.noCheck) return json;
    std::vector<BakedKind> kinds;
    for (const bool directional : {false, true})
        if (!directional || options.directional)
            kinds.push_back(
                {directional ? "directional" : "irradiance",
                 [&, directional](const Camera& camera, const reference::PathTracedPicture& truth) {
                     return drawWithLightmaps(scene, layout, maps, directional, camera, truth);
                 }});
    json["errors"] = checkBake(scene, options.check, "light maps", kinds, progress);
    return json;
}

// Throws Error(Usage), before anything is written.
void checkOptions(const BakeOptions& options) {
    validateCheck(options.check);
    for (const auto& [name, length] :
         {std::pair{"--spacing", options.spacing}, std::pair{"--texel", options.texel}})
        if (length < 0)
            usage(fmt::format("{}: {} is not usable; a distance above 0 would be right", name, length));
    if (options.samples < 16 || options.samples > (1 << 20))
        usage(fmt::format("--samples: {} is not usable; 16 to 1048576 would be right", options.samples));
    if (options.bounces() == 0)
        usage("--bounces: 0 leaves no indirect light; 1 to 1000, or all, would be right");
}

void run(const BakeOptions& options) {
    checkOptions(options);
    for (const std::string& file : {options.json, options.check.picture})
        if (!file.empty()) io::refuseOverwriting(file, options.force);
    Progress progress;
    const Scene scene = openScene(options.scene, options.check.view, progress);
    nlohmann::ordered_json root = {{"version", 1}, {"scene", options.scene}};
    root.update(options.lightmaps ? bakeLightmapsOf(scene, options, progress)
                                  : bakeProbesOf(scene, options, progress));
    if (options.json.empty() || options.noCheck) return;
    const std::string text = root.dump(1) + "\n";
    io::writeFile(options.json, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

}  // namespace

void addBake(CLI::App& app) {
    auto options = std::make_shared<BakeOptions>();
    BakeCheck& check = options->check;
    CLI::App* command =
        app.add_subcommand("bake", "light probes or light maps of a scene, for other programs");
    command->add_option("scene", options->scene, "a scene file, or builtin:NAME")->required();
    command->add_option("-o,--output", options->out, "the folder that gets the files")->required();
    CLI::Option* lightmaps = command->add_flag(
        "--lightmaps", options->lightmaps, "light maps with second texture coordinates, instead of probes");
    command
        ->add_option("--spacing", options->spacing,
                     "between probes at most, m; without: an eighth of the scene")
        ->excludes(lightmaps);
    command
        ->add_option("--placement", options->placement,
                     "of probes: grid, all of it; surfaces, those that a lookup at a surface reads")
        ->check(CLI::IsMember({"grid", "surfaces"}))
        ->excludes(lightmaps)
        ->capture_default_str();
    command->add_option("--texel", options->texel, "of light maps, m; without: a 64th of the scene")
        ->needs(lightmaps);
    command->add_option("--map-size", options->mapSize, "most texels of a light map a side, 16 to 16384")
        ->needs(lightmaps)
        ->capture_default_str();
    command->add_flag("--direct", options->direct, "light maps with direct light, too")->needs(lightmaps);
    command
        ->add_flag("--directional", options->directional, "also the mean direction of light, for normal maps")
        ->needs(lightmaps);
    command->add_option("--samples", options->samples, "rays of a probe or texel, 16 to 1048576")
        ->capture_default_str();
    command->add_option("--bounces", check.bounces, "of indirect light, 1 to 1000, or all")
        ->capture_default_str();
    command->add_option("--seed", check.seed, "of all random numbers")->capture_default_str();
    command->add_flag("--overwrite,--force", options->force, "write over files that are there");
    command->add_flag("--no-check", options->noCheck, "no picture, no errors");
    command->add_option("--check-size", check.size, "of the picture that is checked, WxH")
        ->capture_default_str();
    command->add_option("--check-spp", check.samples, "its samples per pixel")->capture_default_str();
    command->add_option("--picture", check.picture, "that picture as a file, by the last row of the table");
    command->add_option("--json", options->json, "the errors as a file");
    command->add_option("--camera", check.view.camera, "the camera of the picture, by name");
    check.view.addEnvironmentTo(*command);
    addMemory(*command);
    addAllowOutside(*command, check.view.allowOutside);
    check.view.noGround = true;  // what is written is the file's own
    command->callback([options] { run(*options); });
}

}  // namespace conelight::program

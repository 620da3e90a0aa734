// SPDX-License-Identifier: MIT
// Light probes as arrays.
#include <pybind11/stl.h>

#include <algorithm>

#include "arrays.h"
#include "bindings.h"
#include "calls.h"
#include "reference/probes.h"
#include "scene_handle.h"

namespace conelight::python {
namespace {

using reference::Probe;
using reference::ProbeGrid;
using reference::ProbeSettings;
using reference::ProbeVolume;

// (z, y, x, ...) by what `row` gives of each probe: `count` floats.
template <class Row>
py::array_t<float> perProbe(const ProbeVolume& volume, const std::vector<py::ssize_t>& rest, Row row) {
    const glm::ivec3 counts = volume.grid.counts;
    std::vector<py::ssize_t> shape = {counts.z, counts.y, counts.x};
    std::size_t count = 1;
    for (const py::ssize_t length : rest) {
        shape.push_back(length);
        count *= static_cast<std::size_t>(length);
    }
    py::array_t<float> array(shape);
    float* to = array.mutable_data();
    for (const Probe& probe : volume.probes) to = std::copy_n(row(probe), count, to);
    return array;
}

py::dict arraysOf(const ProbeVolume& volume) {
    const glm::ivec3 counts = volume.grid.counts;
    py::dict all;
    all["origin"] = tupleOf(volume.grid.origin);
    all["spacing"] = tupleOf(volume.grid.spacing);
    all["position"] = perProbe(volume, {3}, [](const Probe& p) { return &p.position.x; });
    py::array_t<bool> active({counts.z, counts.y, counts.x});
    std::transform(volume.probes.begin(), volume.probes.end(), active.mutable_data(),
                   [](const Probe& p) { return p.active; });
    all["active"] = active;
    all["sh"] = perProbe(volume, {9, 3}, [](const Probe& p) { return &p.harmonics[0].x; });
    constexpr py::ssize_t kFine = reference::kDistanceSide, kCoarse = reference::kIrradianceSide;
    all["irradiance"] =
        perProbe(volume, {kCoarse, kCoarse, 3}, [](const Probe& p) { return &p.irradiance[0].x; });
    all["distance"] = perProbe(volume, {kFine, kFine, 2}, [](const Probe& p) { return &p.distance[0].x; });
    return all;
}

ProbeSettings settingsOf(Keywords& given) {
    ProbeSettings settings;
    settings.samples = given.take("samples", settings.samples);
    settings.seed = given.take("seed", settings.seed);
    settings.threads = given.take("threads", settings.threads);
    settings.bounces = bouncesOf(given.take("bounces"), 1);
    return settings;
}

py::dict bakeProbes(const SceneHandle& handle, const py::kwargs& options) {
    Keywords given("bake_probes", options);
    const auto spacing = given.take("spacing", 0.0f);
    ProbeSettings settings = settingsOf(given);
    settings.nearSurfaces = given.take("near_surfaces", false);
    ProgressCall progress(given.take("progress"));
    given.finish();
    if (!(spacing >= 0))
        throw Error(ErrorKind::Usage,
                    "spacing: is below 0; metres, or 0 for an eighth of the scene, would be right");
    const std::shared_ptr<const Scene> scene = handle.shared();
    const ProbeVolume volume = unlocked([&] {
        const Aabb bounds = scene->bounds();
        const glm::vec3 extent = bounds.extent();
        const float step = spacing > 0 ? spacing : std::max({extent.x, extent.y, extent.z}) / 8;
        return reference::bakeProbes(*scene, reference::fitProbeGrid(bounds, step), settings,
                                     [&](double done) { return progress(done); });
    });
    progress.rethrow();
    return progress.stopped() ? py::dict() : arraysOf(volume);
}

}  // namespace

void bindBake(py::module_& module) {
    module.def(
        "bake_probes", &bakeProbes, py::arg("scene"),
        "Light probes on a grid that fills the scene, by the path tracer, on all cores: a dict.\n\n"
        "What arrives, less what lights and flat emissive quads send straight; as `conelight bake` writes "
        "it.\n"
        "origin, spacing: of the grid, (x, y, z), metres. Arrays begin (z, y, x):\n"
        "position (..., 3), world, metres; active, bool: False is in a wall or left out, and not to be "
        "used;\n"
        "sh (..., 9, 3): radiance, W/(sr m^2), in spherical harmonics 1; y, z, x; xy, yz, 3z^2-1, xz, "
        "x^2-y^2;\n"
        "irradiance (..., 8, 8, 3): W/m^2, octahedral by normal; distance (..., 16, 16, 2): mean of it and "
        "of\n"
        "its square, metres. All but active are float32.\n\n"
        "By name:\n"
        "spacing: between probes at most, metres; 0 is an eighth of the scene (0). samples: rays of a "
        "probe,\n"
        "16 to 2^20 (1024). bounces: of indirect light, 1 or more, or 'all' ('all'). seed: same seed, same\n"
        "bits (1). threads: 0 is all cores (0). near_surfaces: leave out what no lookup at a surface reads\n"
        "(False). progress: called with 0 to 1 now and then; False stops, and "
        "an\n"
        "empty dict is returned.");
}

}  // namespace conelight::python

// SPDX-License-Identifier: MIT
// The table of settings: for each its place in the structs, its range, its unit and its help. Every other
// list of settings (--set, `conelight settings`, the documentation, the viewer's panels, checks) is made from
// it.
#include "settings/registry.h"

namespace conelight::settings {
namespace {

constexpr const char* kShiftHelp = "moves the grid, to see what its place changes (conelight score shift)";

constexpr Numbers kAnchorRange{-1e9, 1e9};
constexpr const char* kAnchorHelp =
    "point of the world that nested grids lie round: all views have the same voxels; auto: the eye";

constexpr Choice<Component> kComponents[] = {
    {"full", Component::Full},       {"direct", Component::Direct},     {"indirect", Component::Indirect},
    {"diffuse", Component::Diffuse}, {"specular", Component::Specular}, {"occlusion", Component::Occlusion},
    {"albedo", Component::Albedo},   {"normal", Component::Normal},     {"depth", Component::Depth},
    {"voxels", Component::Voxels},   {"emission", Component::Emission}, {"shadow_map", Component::ShadowMap}};
constexpr Choice<Toggle> kToggles[] = {{"auto", Toggle::Auto}, {"off", Toggle::Off}, {"on", Toggle::On}};
constexpr Choice<DiffuseSet> kDiffuseSets[] = {{"1", DiffuseSet::One},
                                               {"5", DiffuseSet::Five},
                                               {"6", DiffuseSet::Six},
                                               {"9", DiffuseSet::Nine},
                                               {"fibonacci", DiffuseSet::Fibonacci},
                                               {"best_6", DiffuseSet::Best6},
                                               {"best_9", DiffuseSet::Best9},
                                               {"best_12", DiffuseSet::Best12},
                                               {"best_16", DiffuseSet::Best16},
                                               {"own", DiffuseSet::Own}};
constexpr Choice<VolumeDirections> kVolumeDirections[] = {{"isotropic", VolumeDirections::Isotropic},
                                                          {"six", VolumeDirections::Six}};
constexpr Choice<VolumeStorage> kVolumeStorages[] = {{"dense", VolumeStorage::Dense},
                                                     {"octree", VolumeStorage::Octree}};
constexpr Choice<OpacityModel> kOpacityModels[] = {{"fog", OpacityModel::Fog}, {"area", OpacityModel::Area}};
constexpr Choice<ConesIndirect> kConesIndirect[] = {{"cones", ConesIndirect::Cones},
                                                    {"cache", ConesIndirect::Cache}};
constexpr Choice<ConesShadows> kConesShadows[] = {{"maps", ConesShadows::Maps},
                                                  {"cones", ConesShadows::Cones}};
constexpr Choice<Wireframe> kWireframes[] = {
    {"off", Wireframe::Off}, {"over", Wireframe::Over}, {"alone", Wireframe::Alone}};
constexpr Choice<VoxelData> kVoxelData[] = {
    {"radiance", VoxelData::Radiance}, {"irradiance", VoxelData::Irradiance},
    {"age", VoxelData::Age},           {"albedo", VoxelData::Albedo},
    {"normal", VoxelData::Normal},     {"emission", VoxelData::Emission},
    {"coverage", VoxelData::Coverage}, {"bricks", VoxelData::Bricks},
    {"level", VoxelData::Level}};
constexpr Choice<VoxelShape> kVoxelShapes[] = {
    {"auto", VoxelShape::Auto},   {"cubes", VoxelShape::Cubes},   {"edges", VoxelShape::Edges},
    {"faces", VoxelShape::Faces}, {"volume", VoxelShape::Volume}, {"surfaces", VoxelShape::Surfaces}};
constexpr Choice<ToneMap> kToneMaps[] = {{"none", ToneMap::None},
                                         {"reinhard", ToneMap::Reinhard},
                                         {"aces", ToneMap::Aces},
                                         {"agx", ToneMap::Agx},
                                         {"neutral", ToneMap::Neutral}};

constexpr Choice<ExposureCheck> kExposureChecks[] = {{"off", ExposureCheck::Off},
                                                     {"clipping", ExposureCheck::Clipping},
                                                     {"false_color", ExposureCheck::FalseColor}};

// A mode is one of those that are registered.
Setting<Settings> modeSetting() {
    SettingInfo info;
    info.key = "mode";
    info.kind = SettingKind::Choice;
    info.help = "how the picture is made";
    return {info,
            Chosen<Settings>{
                [](const Settings& s) { return std::string(s.mode.name()); },
                [](Settings& s, std::size_t index) { s.mode = knownModes()[index]; },
            },
            std::nullopt};
}

std::vector<Setting<Settings>> pictureSettings() {
    return {
        modeSetting(),
        {"component", &Settings::component, kComponents, "the part of the picture that is shown"},
    };
}

std::vector<Setting<VoxelSettings>> voxelSettings() {
    return {
        {"size", &VoxelSettings::size, Numbers{8, 512, 4}, "voxels",
         "voxels along the longest axis of the grid"},
        {"padding", &VoxelSettings::padding, Numbers{0, 1}, "",
         "grid beyond the scene's bounds, as a fraction per side"},
        {"shift_x", within(&VoxelSettings::shift, &glm::vec3::x), Numbers{0, 1}, "voxels", kShiftHelp},
        {"shift_y", within(&VoxelSettings::shift, &glm::vec3::y), Numbers{0, 1}, "voxels", kShiftHelp},
        {"shift_z", within(&VoxelSettings::shift, &glm::vec3::z), Numbers{0, 1}, "voxels", kShiftHelp},
        {"levels", &VoxelSettings::levels, Numbers{0, 8}, "",
         "nested grids in mode traced: each halves the voxels around the eye, at most 1024 / voxels.size of "
         "them; 1: one grid; 0: as many as make voxels at the eye at most 0.15 m"},
        {"anchor_x", within(&VoxelSettings::anchor, &VoxelAnchor::x), kAnchorRange, "m", kAnchorHelp},
        {"anchor_y", within(&VoxelSettings::anchor, &VoxelAnchor::y), kAnchorRange, "m", kAnchorHelp},
        {"anchor_z", within(&VoxelSettings::anchor, &VoxelAnchor::z), kAnchorRange, "m", kAnchorHelp},
    };
}

std::vector<Setting<LightSettings>> lightSettings() {
    return {
        {"shadow_size", &LightSettings::shadowSize, Numbers{64, 8192, 1, true, false}, "texels",
         "edge of a shadow map; 0: no shadows"},
        {"shadow_filter", &LightSettings::shadowFilter, Numbers{0, 4}, "texels",
         "blur of shadow edges to either side; 0: as sharp as the map"},
        {"area_samples", &LightSettings::areaSamples, Numbers{1, 64, 1, false, true}, "",
         "points per area light, a square number"},
        {"emissive_quads", &LightSettings::emissiveQuads,
         "treat flat rectangular emitters as area lights, exactly"},
        {"small_lamps", &LightSettings::smallLamps,
         "modes phong, cones and traced: treat emissive balls and boxes as area lights, where they are less "
         "than two voxels of a grid of 128 wide or thick and no more than 4 of a kind"},
        {"caustics", &LightSettings::caustics, Numbers{1024, 1048576, 1, true, false}, "",
         "light paths from each light through each solid of glass, in modes traced and cones; 0: none, light "
         "goes straight through solids"},
        {"exact_lamps", &LightSettings::exactLamps, Numbers{0, 1000000}, "",
         "mode traced asks so many point lights and spots one by one; where there are more, it draws a few "
         "for each "
         "place, and rays tell their shadows"},
    };
}

std::vector<Setting<PhongSettings>> phongSettings() {
    return {
        {"shadows", &PhongSettings::shadows, kToggles,
         "shadow maps in mode phong; auto: off in scenes whose lights follow other conventions"},
    };
}

std::vector<Setting<ConesSettings>> conesSettings() {
    return {
        {"diffuse_set", &ConesSettings::diffuseSet, kDiffuseSets,
         "cones per hemisphere at diffuse surfaces; more take more time; best_N: found by `conelight study "
         "cones`; own: those of --cone-set, or 6 without it"},
        {"count", &ConesSettings::count, Numbers{1, 64}, "", "number of cones of the set fibonacci"},
        {"directional", &ConesSettings::directional, kVolumeDirections,
         "radiance per voxel; isotropic: one value; six: one per facing direction, which takes six times the "
         "memory and closes walls"},
        {"storage", &ConesSettings::storage, kVolumeStorages,
         "where radiance lies; dense: a texture of all voxels; octree: the same picture from less memory, in "
         "more time"},
        {"opacity", &ConesSettings::opacity, kOpacityModels,
         "how opacity adds up along a cone; fog: as unrelated droplets; area: as parts of one surface"},
        {"step", &ConesSettings::step, Numbers{0.1, 2}, "footprints",
         "distance between samples along a cone"},
        {"offset", &ConesSettings::offset, Numbers{0, 4}, "voxels", "where cones start, above the surface"},
        {"max_footprint", &ConesSettings::maxFootprint, Numbers{0.01, 1}, "",
         "largest footprint as a fraction of the grid; smaller is slower, leaks less and may miss "
         "small lights"},
        {"max_distance", &ConesSettings::maxDistance, Numbers{0, 1e6}, "m",
         "length of cones; beyond it they see the sky; auto: through the grid"},
        {"specular_min_aperture", &ConesSettings::specularMinAperture, Numbers{0.01, 1}, "rad",
         "full angle of the narrowest specular cone; narrower is sharper and slower"},
        {"occlusion_distance", &ConesSettings::occlusionDistance, Numbers{0, 1e6}, "m",
         "reach of component occlusion; auto: a tenth of the grid"},
        {"bounces", &ConesSettings::bounces, Numbers{0, 8}, "", "bounces of indirect light; 0: none"},
        {"indirect", &ConesSettings::indirect, kConesIndirect,
         "what fills the volume with indirect light; cones: cones from voxel faces; cache: the rays of mode "
         "traced, by its settings, all bounces"},
        {"fractional_levels", &ConesSettings::fractionalLevels,
         "cone samples blend the two nearest levels of the volume; off: the nearest alone"},
        {"shadows", &ConesSettings::shadows, kConesShadows,
         "where shadows come from; maps: shadow maps; cones: a cone to each light, soft"},
        {"shadow_aperture", &ConesSettings::shadowAperture, Numbers{0.01, 1.2}, "rad",
         "full angle of the shadow cone to a point or directional light; wider is softer"},
        {"refraction", &ConesSettings::refraction,
         "glass bends light: a reflected and a refracted cone per pixel that sees it; off: tinted panes that "
         "bend nothing"},
        {"voxel_level", &ConesSettings::voxelLevel, Numbers{0, 6}, "",
         "level of the volume that component voxels shows"},
    };
}

std::vector<Setting<TracedSettings>> tracedSettings() {
    return {
        {"pixel_rays", &TracedSettings::pixelRays, Numbers{0, 64}, "",
         "cosine-sampled rays per pixel and pass, and as many light-sampled ones; 0: the cache alone"},
        {"specular_rays", &TracedSettings::specularRays, Numbers{0, 16}, "",
         "rays per pixel and pass into the specular lobe"},
        {"specular_limit", &TracedSettings::specularLimit, Numbers{0, 1}, "",
         "roughness above which surfaces reflect their irradiance, without rays"},
        {"passes", &TracedSettings::passes, Numbers{1, 1024}, "", "passes of pixel rays that are averaged"},
        {"filter_levels", &TracedSettings::filterLevels, Numbers{0, 4}, "",
         "edge-stopping filter between pixels; 1: 3x3 pixels, 2: 7x7, 3: 15x15, 4: 31x31; 0: none"},
        {"reduction", &TracedSettings::reduction, Numbers{1, 4}, "",
         "cosine- and light-sampled rays for one of N x N pixels; all show what those about them gathered "
         "on the same surface: faster, contacts are softer"},
        {"cache_rays", &TracedSettings::cacheRays, Numbers{1, 64}, "",
         "cosine-sampled rays per voxel face and update, and as many light-sampled ones"},
        {"cache_updates", &TracedSettings::cacheUpdates, Numbers{1, 4096}, "",
         "updates of all voxel faces after a change, fewer of more than 262,144; then the cache stands "
         "still"},
        {"face_budget", &TracedSettings::faceBudget, Numbers{0, 100000000}, "faces",
         "faces updated per budgeted frame; 0: all"},
        {"time_budget", &TracedSettings::timeBudget, Numbers{0, 10000}, "ms",
         "time for updates of faces in a budgeted frame, as many as fit; pictures then depend on the "
         "machine; 0: one update"},
        {"bounces", &TracedSettings::bounces, Numbers{.low = 0, .high = 15, .word = 16}, "",
         "bounces of indirect light; 16 is read as all"},
        {"exact_hits", &TracedSettings::exactHits,
         "rays look up point, spot and directional lights in shadow maps where they hit; off: what the cache "
         "holds"},
        {"exact_mirrors", &TracedSettings::exactMirrors,
         "rays from mirrors (roughness up to 0.3) meet textured triangles; off: voxels, faster"},
        {"exact_near", &TracedSettings::exactNear,
         "rays of pixels meet triangles within a voxel of their start, so folds, thin things and contacts "
         "hide light; off: voxels, faster"},
        {"exact_shadows", &TracedSettings::exactShadows,
         "a ray to the triangles decides where a shadow map leaves the shadow of a point, spot or "
         "directional light open: sharp edges at every size of map; off: maps alone, faster"},
        {"budgeted", &TracedSettings::budgeted,
         "for moving pictures: one update and one pass per frame, which reuses earlier frames; off: every "
         "frame is finished"},
    };
}

std::vector<Setting<ViewSettings>> viewSettings() {
    return {
        {"wireframe", &ViewSettings::wireframe, kWireframes,
         "edges of the triangles; over: visible edges on the picture; alone: without the picture"},
        {"shrink", &ViewSettings::shrink, Numbers{0, 0.95}, "",
         "shrinks each triangle about its middle by this fraction, to show how surfaces are made of "
         "triangles; 0: whole"},
        {"voxels", &ViewSettings::voxels,
         "draws voxels among the objects, whichever is nearer, except in mode phong; component voxels shows "
         "them alone"},
        {"voxel_data", &ViewSettings::voxelData, kVoxelData,
         "what voxels show. Colours from blue to red: age 0 to 256 updates, bricks of 1 to 64 voxels, level "
         "0 to 6. Modes without surface voxels have radiance, coverage and level"},
        {"voxel_shape", &ViewSettings::voxelShape, kVoxelShapes,
         "how voxels are drawn; auto: as the mode's rays or cones meet them; faces: plane pieces, in mode "
         "traced only; surfaces: voxel colours on the objects"},
        {"voxel_level", &ViewSettings::voxelLevel, Numbers{0, 8}, "",
         "level of the voxels that are shown, each 2^level voxels wide; auto: the mode's voxel_level, 0 in "
         "mode traced"},
        {"voxel_aperture", &ViewSettings::voxelAperture, Numbers{0, 1.5}, "rad",
         "shows at each distance the level that a cone of this full angle from the eye would read; 0: one "
         "level everywhere"},
        {"voxel_density", &ViewSettings::voxelDensity, Numbers{0.001, 1}, "",
         "how much a voxel hides in shape volume: 1 - (1 - coverage)^density"},
        {"voxels_inside", &ViewSettings::voxelsInside,
         "an eye outside looks through the first wall of voxels: into a closed room"},
        {"light", &ViewSettings::light, Numbers{0, 4095}, "",
         "number of the light whose shadow map component shadow_map shows"},
    };
}

std::vector<Setting<ImageSettings>> imageSettings() {
    return {
        {"antialiasing", &ImageSettings::antialiasing, Numbers{2, 64, 1, true, false}, "",
         "smooth edges of stills, and of the viewer's picture at rest: the mean of this many views, each at "
         "an "
         "offset within a pixel; 0: one view of the pixels' centres, in the viewer 8, in mode traced 16"},
        {"temporal", &ImageSettings::temporal, kToggles,
         "smooth edges of moving pictures: views at offsets within a pixel add up over frames and follow "
         "what moves. Replaces antialiasing; auto: on in the viewer, in mode traced at rest only; else off"},
        {"bloom", &ImageSettings::bloom, Numbers{0, 1}, "",
         "fraction of the light that spreads around its pixel, as in an eye or a lens; in 8-bit pictures "
         "only; 0: none"},
        {"exposure", &ImageSettings::exposure, Numbers{-20, 20}, "stops",
         "brightness before the tone map: 2^exposure; auto: the picture's mean becomes middle grey"},
        {"white_balance", &ImageSettings::whiteBalance, Numbers{1500, 15000}, "K",
         "colour temperature of the light that 8-bit pictures show as white; 6500: colours as they are"},
        {"tint", &ImageSettings::tint, Numbers{-50, 50}, "",
         "how far that light is from such a lamp's or daylight towards green, thousandths of Duv: above 0 "
         "takes "
         "green out of 8-bit pictures, below 0 magenta"},
        {"tone_map", &ImageSettings::toneMap, kToneMaps, "curve from linear radiance to the 8-bit picture"},
        {"check", &ImageSettings::check, kExposureChecks,
         "marks in 8-bit pictures; clipping: red stripes where a channel is at its most, blue ones where all "
         "are black; false_color: a colour per stop of luminance, middle grey as grey"},
        {"srgb", &ImageSettings::srgb, "encode 8-bit pictures as sRGB"},
    };
}

}  // namespace

Table coreTable() {
    Table table;
    add(table, "", placeOf<Settings>([](auto& s) -> auto& { return s; }), pictureSettings());
    add(table, "voxels.", placeOf<Settings>(&Settings::voxels), voxelSettings());
    add(table, "light.", placeOf<Settings>(&Settings::light), lightSettings());
    add(table, "phong.", placeOf<Settings>(&Settings::phong), phongSettings());
    add(table, "cones.", placeOf<Settings>(&Settings::cones), conesSettings());
    add(table, "traced.", placeOf<Settings>(&Settings::traced), tracedSettings());
    add(table, "view.", placeOf<Settings>(&Settings::view), viewSettings());
    add(table, "image.", placeOf<Settings>(&Settings::image), imageSettings());
    return table;
}

}  // namespace conelight::settings

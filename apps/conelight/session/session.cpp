// SPDX-License-Identifier: MIT
#include "session/session.h"

#include <fmt/core.h>

#include <algorithm>
#include <atomic>
#include <limits>
#include <utility>

#include "conelight/error.h"
#include "conelight/studio.h"

namespace conelight::program {
namespace {

// Steps kept. A step holds tables of lights or single materials: far below a megabyte each.
constexpr std::size_t kSteps = 1000;

bool changesScene(const Step& step) { return std::any_of(step.edits.begin(), step.edits.end(), isOfScene); }

// Whether two steps change the same things, so that the later one can take the place of the earlier.
bool sameTargets(const Step& a, const Step& b) {
    if (a.edits.size() != b.edits.size()) return false;
    for (std::size_t i = 0; i < a.edits.size(); ++i) {
        if (a.edits[i].index() != b.edits[i].index()) return false;
        const auto* instance = std::get_if<InstanceEdit>(&a.edits[i]);
        if (instance != nullptr && instance->index != std::get<InstanceEdit>(b.edits[i]).index) return false;
        const auto* material = std::get_if<MaterialEdit>(&a.edits[i]);
        if (material != nullptr && material->index != std::get<MaterialEdit>(b.edits[i]).index) return false;
    }
    return true;
}

void takeAfter(Edit& edit, const Edit& later) {
    std::visit(
        [&]<class E>(E& one) {
            if constexpr (requires { one.after; }) one.after = std::get<E>(later).after;
        },
        edit);
}

// Sessions follow one another in one place: what is known of one is of no other.
std::uint64_t firstRevision() {
    static std::atomic<std::uint64_t> sessions{0};
    return ++sessions << 32;
}

template <class E, class T>
Edit editOf(const T& before, const T& after) {
    E edit;
    edit.before = before;
    edit.after = after;
    return edit;
}

}  // namespace

Session::Session() {
    scene_.name = "empty";
    completeScene(scene_);
    camera_ = scene_.cameras.empty() ? Camera{} : scene_.cameras.front();
    mode_ = getSetting(settings_, "mode");
    revisions_.scene = firstRevision();
    startRevisions();
}

Session::Session(Scene scene, std::string path, const Settings& settings, std::string mode,
                 const Camera& camera)
    : scene_(std::move(scene)),
      path_(std::move(path)),
      settings_(settings),
      mode_(mode.empty() ? getSetting(settings, "mode") : std::move(mode)),
      camera_(camera) {
    revisions_.scene = firstRevision();
    startRevisions();
}

void Session::startRevisions() {
    instanceRevisions_.assign(scene_.instances.size(), 0);
    materialRevisions_.assign(scene_.materials.size(), 0);
    meshRevisions_.assign(scene_.meshes.size(), 0);
    textureRevisions_.assign(scene_.textures.size(), 0);
}

OpenedScene readScene(const std::string& path, const OpenHow& how, const io::LoadOptions& options) {
    io::LoadOptions load = options;
    load.allowOutside = how.allowOutside;
    if (how.up.first == path) load.up = how.up.second;
    OpenedScene opened;
    opened.path = path;
    opened.scene = io::loadMovingScene(path, load, opened.animation);
    completeScene(opened.scene, {.ground = how.addsGround});
    const auto& given = opened.scene.settings;
    const bool names =
        std::any_of(given.begin(), given.end(), [](const auto& one) { return one.first == "mode"; });
    opened.start = startSettings(opened.scene, !names && isSettingsMode(how.mode) ? how.mode : std::string());
    opened.mode = getSetting(opened.start, "mode");
    if (!how.mode.empty() && names && how.mode != opened.mode) opened.instead = how.mode;
    if (!how.mode.empty() && !names) opened.mode = how.mode;
    return opened;
}

std::vector<std::string> Session::open(const std::string& path, bool keepView) {
    return take(readScene(path, openHow_), keepView);
}

std::vector<std::string> Session::take(OpenedScene opened, bool keepView) {
    scene_ = std::move(opened.scene);
    startRevisions();
    setAnimation(std::move(opened.animation));
    path_ = opened.path;
    if (!keepView) {
        settings_ = opened.start;
        mode_ = opened.mode.empty() ? getSetting(opened.start, "mode") : opened.mode;
        camera_ = scene_.cameras.front();
        playing_.reset();
        flags_ = {};
        ++revisions_.settings;
        ++revisions_.camera;
        ++revisions_.flags;
    }
    selection_ = {};
    selected_.clear();
    rayMark_.reset();
    done_.clear();
    undone_.clear();
    sealed_ = true;
    ++stepsTaken_;
    savedSerial_ = forgottenSerial_ = 0;
    ++revisions_.scene;
    ++revisions_.selection;
    std::vector<std::string> notes = scene_.notes;
    if (!keepView && !opened.instead.empty())
        notes.push_back("mode " + mode_ + ", as the file says; `mode " + opened.instead + "` goes back");
    return notes;
}

void Session::markRecovered(const std::string& path) {
    path_ = path;
    savedSerial_ = std::numeric_limits<std::uint64_t>::max();  // of no step
    ++recoveries_;
    ++revisions_.scene;
}

Settings Session::startingSettings() const { return startSettings(scene_, getSetting(settings_, "mode")); }

Settings Session::shownSettings() const {
    Settings shown = settings_;
    const std::string mode = shownMode();
    if (isSettingsMode(mode)) conelight::setSetting(shown, "mode", mode);
    if (flags_.drawVoxels) {
        // Among the objects, unless these are not drawn or are only wires.
        shown.view.voxels = flags_.drawObjects && !flags_.wireframeObjects;
        if (!shown.view.voxels) shown.component = Component::Voxels;
        if (flags_.wireframeVoxels)
            shown.view.voxelShape = VoxelShape::Edges;
        else if (shown.view.voxelShape == VoxelShape::Auto)
            shown.view.voxelShape = VoxelShape::Cubes;
    } else if (flags_.localizedLod) {
        shown.component = Component::Voxels;
        shown.view.voxelShape = VoxelShape::Surfaces;
    }
    if (flags_.drawObjects && (flags_.wireframeObjects || flags_.wireframeOverlay))
        shown.view.wireframe =
            flags_.wireframeObjects && !flags_.drawVoxels ? Wireframe::Alone : Wireframe::Over;
    return shown;
}

std::string Session::shownMode() const {
    // Colours of the volume on surfaces exist in mode thesis only; modes without voxels show its volume.
    if (flags_.localizedLod && !flags_.drawVoxels) return "thesis";
    const bool hasVoxels = mode_ != "phong" && isSettingsMode(mode_);
    return flags_.drawVoxels && !hasVoxels ? "thesis" : mode_;
}

bool Session::showsNothing() const { return !flags_.drawObjects && !flags_.drawVoxels; }

void Session::setSettings(const Settings& settings, const std::string& label, const std::string& mergeKey) {
    validateSettings(settings);
    const bool otherMode = settings.mode != settings_.mode;
    if (settings == settings_) return;
    Step step{label, mergeKey, {}};
    step.edits.push_back(editOf<SettingsEdit, PictureSettings>(
        {settings_, mode_}, {settings, otherMode ? getSetting(settings, "mode") : mode_}));
    commit(std::move(step));
}

void Session::setSetting(const std::string& key, const std::string& value, const std::string& mergeKey) {
    if (key == "mode") return setMode(value);
    Settings changed = settings_;
    conelight::setSetting(changed, key, value);
    setSettings(changed, "set " + key + " " + value, mergeKey);
}

void Session::setMode(const std::string& mode) {
    const std::vector<std::string> known = sessionModes();
    if (std::find(known.begin(), known.end(), mode) == known.end()) {
        std::string names;
        for (const std::string& one : known)
            names += (names.empty() ? "" : one == known.back() ? " or " : ", ") + one;
        throw Error(ErrorKind::Usage,
                    fmt::format("mode: there is no mode '{}'; {} would be right", mode, names));
    }
    if (mode == mode_) return;
    Settings changed = settings_;
    if (isSettingsMode(mode)) {
        const Settings oldStart = startingSettings(), newStart = startSettings(scene_, mode);
        for (const SettingInfo& info : settingInfos())
            if (getSetting(changed, info.key) == getSetting(oldStart, info.key))
                conelight::setSetting(changed, info.key, getSetting(newStart, info.key));
        conelight::setSetting(changed, "mode", mode);
    }
    Step step{"mode " + mode, {}, {}};
    step.edits.push_back(editOf<SettingsEdit, PictureSettings>({settings_, mode_}, {changed, mode}));
    commit(std::move(step));
}

void Session::jumpCamera(const Camera& camera, const std::string& label, const std::string& mergeKey) {
    if (camera == camera_) return;
    Step step{label, mergeKey, {}};
    step.edits.push_back(editOf<CameraEdit>(camera_, camera));
    commit(std::move(step));
}

void Session::setFlags(const ViewFlags& flags, const std::string& label) {
    if (flags == flags_) return;
    Step step{label, {}, {}};
    step.edits.push_back(editOf<FlagsEdit>(flags_, flags));
    commit(std::move(step));
}

void Session::setMaterials(const std::vector<std::pair<std::size_t, Material>>& changed,
                           const std::string& label, const std::string& mergeKey) {
    Step step{label, mergeKey, {}};
    for (const auto& [index, material] : changed) {
        Edit edit = editOf<MaterialEdit>(scene_.materials.at(index), material);
        std::get<MaterialEdit>(edit).index = index;
        step.edits.push_back(std::move(edit));
    }
    if (!step.edits.empty()) commit(std::move(step));
}

std::size_t Session::materialOf(std::size_t instance) {
    Instance changed = scene_.instances.at(instance);
    if (changed.material >= 0) return static_cast<std::size_t>(changed.material);
    std::vector<Material> materials = scene_.materials;
    materials.emplace_back();
    materials.back().name = changed.name;
    changed.material = static_cast<int>(scene_.materials.size());
    Step step{"material of " + changed.name, {}, {}};
    step.edits.push_back(editOf<MaterialsEdit>(scene_.materials, materials));
    Edit edit = editOf<InstanceEdit>(scene_.instances[instance], changed);
    std::get<InstanceEdit>(edit).index = instance;
    step.edits.push_back(std::move(edit));
    commit(std::move(step));
    return materials.size() - 1;
}

void Session::setLights(const std::vector<Light>& lights, const std::string& label,
                        const std::string& mergeKey) {
    Step step{label, mergeKey, {}};
    step.edits.push_back(editOf<LightsEdit>(scene_.lights, lights));
    commit(std::move(step));
}

void Session::setCameras(const std::vector<Camera>& cameras, const std::string& label) {
    Step step{label, {}, {}};
    step.edits.push_back(editOf<CamerasEdit>(scene_.cameras, cameras));
    commit(std::move(step));
}

void Session::setCameraPath(const CameraPath& path, const std::string& label, const std::string& mergeKey) {
    Step step{label, mergeKey, {}};
    step.edits.push_back(editOf<PathEdit>(cameraPath_, path));
    commit(std::move(step));
}

void Session::applyPreset(const Preset& preset, const std::string& label) {
    const std::string mode = preset.mode.empty() ? mode_ : preset.mode;
    Settings changed = startSettings(scene_, isSettingsMode(mode) ? mode : getSetting(settings_, "mode"));
    preset.apply(changed);
    if (changed == settings_ && mode == mode_) return;
    Step step{label, {}, {}};
    step.edits.push_back(editOf<SettingsEdit, PictureSettings>({settings_, mode_}, {changed, mode}));
    commit(std::move(step));
}

Preset Session::preset() const {
    Preset preset;
    preset.mode = mode_;
    Settings bare;
    conelight::setSetting(bare, "mode", getSetting(settings_, "mode"));
    std::vector<std::string> keys;
    for (const Settings& from : {bare, startingSettings()})
        for (const auto& [key, value] : differences(from, settings_)) keys.push_back(key);
    for (const SettingInfo& info : settingInfos())
        if (std::find(keys.begin(), keys.end(), info.key) != keys.end())
            preset.values.emplace_back(info.key, getSetting(settings_, info.key));
    return preset;
}

void Session::setSky(const glm::vec3& sky, const std::string& label, const std::string& mergeKey) {
    if (sky == scene_.sky) return;
    Step step{label, mergeKey, {}};
    step.edits.push_back(editOf<SkyEdit>(scene_.sky, sky));
    commit(std::move(step));
}

void Session::setEnvironment(const Environment& environment, const std::vector<Light>& lights,
                             const std::string& label, const std::string& mergeKey) {
    if (environment == scene_.environment && lights == scene_.lights) return;
    Step step{label, mergeKey, {}};
    step.edits.push_back(editOf<EnvironmentEdit>(scene_.environment, environment));
    if (lights != scene_.lights) step.edits.push_back(editOf<LightsEdit>(scene_.lights, lights));
    commit(std::move(step));
}

void Session::moveCamera(const Camera& camera) {
    if (camera == camera_) return;
    playing_.reset();
    place(camera);
}

void Session::place(const Camera& camera) {
    camera_ = camera;
    ++revisions_.camera;
}

void Session::playPath(double seconds) {
    place(cameraPath_.at(cameraPath_.start()));
    playing_ = Playing{std::chrono::steady_clock::now(), seconds};
}

void Session::finishPlaying() {
    if (playing_ && !cameraPath_.empty()) place(cameraPath_.at(cameraPath_.end()));
    playing_.reset();
}

std::optional<double> Session::playedSeconds() const {
    if (!playing_ || cameraPath_.empty()) return std::nullopt;
    const std::chrono::duration<double> gone = std::chrono::steady_clock::now() - playing_->from;
    const double part = std::min(gone.count() / playing_->seconds, 1.0);
    return cameraPath_.start() + part * (cameraPath_.end() - cameraPath_.start());
}

void Session::frameDrawn(double ms) {
    frameTimes_.add(ms);
    const std::optional<double> seconds = playedSeconds();
    if (!seconds || *seconds >= cameraPath_.end()) return finishPlaying();
    place(cameraPath_.at(*seconds));
}

void Session::setRayMark(const std::optional<RayMark>& mark) {
    rayMark_ = mark;
    ++revisions_.selection;
}

// Serial of the last step that made the scene what it is.
std::uint64_t Session::sceneSerial() const {
    const auto last = std::find_if(done_.rbegin(), done_.rend(), changesScene);
    return last == done_.rend() ? forgottenSerial_ : last->serial;
}

void Session::commit(Step step) {
    for (const Edit& edit : step.edits) apply(edit, true);
    step.serial = ++lastSerial_;
    ++stepsTaken_;
    undone_.clear();
    const bool merges = !sealed_ && !step.mergeKey.empty() && !done_.empty() &&
                        done_.back().mergeKey == step.mergeKey && sameTargets(done_.back(), step);
    sealed_ = false;
    if (merges) {
        for (std::size_t i = 0; i < step.edits.size(); ++i) takeAfter(done_.back().edits[i], step.edits[i]);
        done_.back().label = std::move(step.label);
        done_.back().serial = step.serial;
        return;
    }
    done_.push_back(std::move(step));
    if (done_.size() <= kSteps) return;
    if (changesScene(done_.front())) forgottenSerial_ = done_.front().serial;
    done_.pop_front();
}

void Session::apply(const Edit& edit, bool forward) {
    const auto side = [forward](const auto& one) -> const auto& { return forward ? one.after : one.before; };
    if (const auto* instance = std::get_if<InstanceEdit>(&edit)) {
        Instance& target = scene_.instances[instance->index];
        if (instance->before.worldFromObject != instance->after.worldFromObject) ++revisions_.transforms;
        Instance rest = instance->after;
        rest.worldFromObject = instance->before.worldFromObject;
        if (rest != instance->before) ++revisions_.instances;
        target = side(*instance);
        ++instanceRevisions_[instance->index];
    } else if (const auto* list = std::get_if<InstancesEdit>(&edit)) {
        takeInstances(side(*list));
    } else if (const auto* added = std::get_if<AddEdit>(&edit)) {
        takeAddition(*added, forward);
    } else if (const auto* material = std::get_if<MaterialEdit>(&edit)) {
        scene_.materials[material->index] = side(*material);
        ++materialRevisions_[material->index];
        ++revisions_.materials;
    } else if (const auto* materials = std::get_if<MaterialsEdit>(&edit)) {
        scene_.materials = side(*materials);
        materialRevisions_.resize(scene_.materials.size());
        for (std::uint64_t& revision : materialRevisions_) ++revision;
        ++revisions_.materials;
        deselectFrom(SelectionKind::Material, scene_.materials.size());
    } else if (const auto* lights = std::get_if<LightsEdit>(&edit)) {
        scene_.lights = side(*lights);
        ++revisions_.lights;
        deselectFrom(SelectionKind::Light, scene_.lights.size());
    } else if (const auto* cameras = std::get_if<CamerasEdit>(&edit)) {
        scene_.cameras = side(*cameras);
        ++revisions_.cameras;
    } else if (const auto* sky = std::get_if<SkyEdit>(&edit)) {
        scene_.sky = side(*sky);
        ++revisions_.sky;
    } else if (const auto* environment = std::get_if<EnvironmentEdit>(&edit)) {
        scene_.environment = side(*environment);
        ++revisions_.sky;
    } else if (const auto* settings = std::get_if<SettingsEdit>(&edit)) {
        settings_ = side(*settings).settings;
        if (mode_ != side(*settings).mode) openHow_.mode = side(*settings).mode;
        mode_ = side(*settings).mode;
        ++revisions_.settings;
    } else if (const auto* camera = std::get_if<CameraEdit>(&edit)) {
        camera_ = side(*camera);
        ++revisions_.camera;
        playing_.reset();
    } else if (const auto* path = std::get_if<PathEdit>(&edit)) {
        cameraPath_ = side(*path);
        playing_.reset();
    } else if (const auto* flags = std::get_if<FlagsEdit>(&edit)) {
        flags_ = side(*flags);
        ++revisions_.flags;
    }
}

std::optional<std::string> Session::undo() {
    if (done_.empty()) return std::nullopt;
    Step step = std::move(done_.back());
    done_.pop_back();
    for (auto edit = step.edits.rbegin(); edit != step.edits.rend(); ++edit) apply(*edit, false);
    sealed_ = true;
    ++stepsTaken_;
    undone_.push_back(std::move(step));
    return undone_.back().label;
}

std::optional<std::string> Session::redo() {
    if (undone_.empty()) return std::nullopt;
    Step step = std::move(undone_.back());
    undone_.pop_back();
    for (const Edit& edit : step.edits) apply(edit, true);
    sealed_ = true;
    ++stepsTaken_;
    done_.push_back(std::move(step));
    return done_.back().label;
}

std::optional<Request> Session::takeRequest() {
    if (requests_.empty()) return std::nullopt;
    Request next = std::move(requests_.front());
    requests_.pop_front();
    return next;
}

}  // namespace conelight::program

// SPDX-License-Identifier: MIT
// What a viewer acts on, without a window and without OpenGL: the edited scene, the picture's settings, the
// camera, the selection and the view flags, with undo, with counters of what changed, and with the requests
// that the main loop carries out between frames. Console and panels change it through the same calls; one
// thread only.
//
// Loop:  console.runQueued();  while (request = session.takeRequest()) carry it out;  draw shownSettings()
// through camera(), after SceneUpload has brought its changes to the renderer;  session.frameDrawn(ms);
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/animation.h"
#include "io/scene_file.h"
#include "session/camera_path.h"
#include "session/edit.h"
#include "session/frame_times.h"
#include "session/preset.h"
#include "session/request.h"
#include "session/revisions.h"
#include "session/selection.h"

namespace conelight::program {

// The pose of a scene with clips.
struct ClipState {
    std::size_t clip = 0;
    double seconds = 0;
    bool posed = false;  // else: as it was opened
    bool playing = false, loops = true;
};

// Where the last ray met a surface, to be drawn as a mark.
struct RayMark {
    glm::vec3 position{0};
    glm::vec3 normal{0};
};

// A scene that was read and completed, for Session::take.
struct OpenedScene {
    std::string path;
    Scene scene;
    io::SceneAnimation animation;
    Settings start;
    std::string mode;     // that it starts in; empty: that of `start`
    std::string instead;  // the user's, where the file itself names `mode`
};
struct OpenHow {
    bool allowOutside = false;              // it may name files outside its folder
    bool addsGround = true;                 // without light it stands on a ground
    std::pair<std::string, io::UpAxis> up;  // of a file
    std::string mode;                       // of scenes that name none; empty: nobody has chosen one
};
// Throws what io::loadScene throws. Any thread.
OpenedScene readScene(const std::string& path, const OpenHow& how, const io::LoadOptions& options = {});
// Parts of a scene that change in one step of undo; none: they stay.
struct SceneEdits {
    std::vector<std::pair<std::size_t, Instance>> instances;
    std::optional<std::vector<Instance>> instanceList;  // all of them: adds and removes
    std::optional<std::vector<Material>> materialList;  // only adds
    std::optional<std::vector<Light>> lights;
    // Goes behind what is there; its indices are those that it will have then.
    std::shared_ptr<const Scene> added;
};

// Settings that a scene starts with in a mode ("": the default or the scene's own): its format's look, then
// its own block.
Settings startSettings(const Scene& scene, const std::string& mode = {});
// "x", "y", "z" or "auto"; nothing for other words.
std::optional<io::UpAxis> upAxisOf(const std::string& word);
std::string wordOf(io::UpAxis up);
// Words that a setting or preset takes (or true, false); empty for numbers and unknown keys.
std::vector<std::string> settingChoices(const std::string& key);
// All settings, preset words before the group that they fill in: what lists show.
std::vector<const SettingInfo*> listedSettings();
// All modes of the program: those of the renderer, then those on the CPU.
std::vector<std::string> sessionModes();
// What a mode is, in a line; empty for other names. README.md has the same words.
const char* aboutMode(const std::string& mode);
// `mode` as a mode of the renderer: those on the CPU have none of their own, and stand on `cones`.
bool isSettingsMode(const std::string& mode);

class Session {
  public:
    Session();
    // `scene` is valid and complete (completeScene). `mode` may be one of the CPU's.
    Session(Scene scene, std::string path, const Settings& settings, std::string mode, const Camera& camera);

    // Reads and completes a scene; its notes are returned. On an error the session is as before. keepView:
    // camera, settings and flags stay.
    std::vector<std::string> open(const std::string& path, bool keepView);
    // The same with what was read elsewhere.
    std::vector<std::string> take(OpenedScene opened, bool keepView);
    // How scenes are opened.
    const OpenHow& openHow() const { return openHow_; }
    void setOpenHow(const OpenHow& how) {
        openHow_ = how;
    }  // a mode that is chosen later takes the place of its
    // That file is opened so from now on.
    void takeUpAxis(const std::string& path, io::UpAxis up) { openHow_.up = {path, up}; }

    const Scene& scene() const { return scene_; }
    const std::string& path() const { return path_; }
    const Settings& settings() const { return settings_; }
    // What the scene starts with in the present mode: what `reset` goes back to.
    Settings startingSettings() const;
    const std::string& mode() const { return mode_; }
    const Camera& camera() const { return camera_; }
    const ViewFlags& flags() const { return flags_; }
    // What was chosen last, and all that is: sorted; only objects and lights can be several.
    const Selection& selection() const { return selection_; }
    const std::vector<Selection>& selected() const { return selected_; }
    bool isSelected(const Selection& what) const;
    std::vector<std::size_t> selectedOf(SelectionKind kind) const;
    const std::optional<RayMark>& rayMark() const { return rayMark_; }
    const Revisions& revisions() const { return revisions_; }
    const CameraPath& cameraPath() const { return cameraPath_; }
    // What applyPreset makes these settings and this mode of, in this scene and in one that says nothing.
    Preset preset() const;
    // Grow with every change of that one; another scene starts them anew (Revisions::scene).
    const std::vector<std::uint64_t>& instanceRevisions() const { return instanceRevisions_; }
    const std::vector<std::uint64_t>& materialRevisions() const { return materialRevisions_; }
    const std::vector<std::uint64_t>& meshRevisions() const { return meshRevisions_; }
    const std::vector<std::uint64_t>& textureRevisions() const { return textureRevisions_; }

    // Settings and mode with the flags that change the picture in them: what is to be drawn.
    Settings shownSettings() const;
    std::string shownMode() const;
    bool showsNothing() const;  // objects and voxels are both off: the picture is background

    // Changes. Each is one step of undo, labelled; a change to the same is none. With a mergeKey equal to
    // that of the step before, and no seal() in between, both become one step.
    void setSettings(const Settings& settings, const std::string& label, const std::string& mergeKey = {});
    void setSetting(const std::string& key, const std::string& value, const std::string& mergeKey = {});
    // Settings that were the scene's own for the old mode become its own for the new one. Throws Error(Usage)
    // that names the known modes.
    void setMode(const std::string& mode);
    void jumpCamera(const Camera& camera, const std::string& label, const std::string& mergeKey = {});
    void setFlags(const ViewFlags& flags, const std::string& label);
    void setInstances(const std::vector<std::pair<std::size_t, Instance>>& changed, const std::string& label,
                      const std::string& mergeKey = {});
    void edit(const SceneEdits& edits, const std::string& label, const std::string& mergeKey = {});
    // All of them: adds and removes. No instance is selected then.
    void setInstanceList(const std::vector<Instance>& instances, const std::string& label);
    void setMaterials(const std::vector<std::pair<std::size_t, Material>>& changed, const std::string& label,
                      const std::string& mergeKey = {});
    // Gives an instance without material one of its own, which can be edited; returns its index.
    std::size_t materialOf(std::size_t instance);
    void setLights(const std::vector<Light>& lights, const std::string& label,
                   const std::string& mergeKey = {});
    void setCameras(const std::vector<Camera>& cameras, const std::string& label);
    void setCameraPath(const CameraPath& path, const std::string& label, const std::string& mergeKey = {});
    // Settings and mode of a preset; what it does not name is as the scene starts.
    void applyPreset(const Preset& preset, const std::string& label);
    void setSky(const glm::vec3& sky, const std::string& label, const std::string& mergeKey = {});
    // With the lights that go with it.
    void setEnvironment(const Environment& environment, const std::vector<Light>& lights,
                        const std::string& label, const std::string& mergeKey = {});
    void seal(bool on = true) { sealed_ = on; }
    bool sealed() const { return sealed_; }
    // Raised by each step that is made, undone or done again, and by open().
    std::uint64_t stepsTaken() const { return stepsTaken_; }

    // No steps of undo: flying, looking, choosing.
    void moveCamera(const Camera& camera);
    // The camera goes along its path, which has a key, in so many seconds of the clock: a step after each
    // drawn frame. Any other movement of the camera ends it.
    void playPath(double seconds);
    bool playing() const { return playing_.has_value(); }
    std::optional<double> playedSeconds() const;  // of the path, where it is
    void stopPlaying() { playing_.reset(); }
    void finishPlaying();                              // at once at the path's end
    void select(const Selection& selection);           // it alone
    void selectAll(std::vector<Selection> selection);  // the last one is selection() then
    void toggleSelected(const Selection& what);        // beside the others, or not any more
    void setRayMark(const std::optional<RayMark>& mark);
    // Clips of the scene as it is now, which was loaded with `animation`. Poses are no steps of undo.
    void setAnimation(io::SceneAnimation animation);
    const io::SceneAnimation& animation() const { return animation_; }
    const std::vector<io::AnimationClip>& clips() const { return animation_.clips; }
    const ClipState& clipState() const { return clip_; }
    // Whether the objects are those that the scene was opened with: clips fit to no others.
    bool clipsFit() const { return clipList_ == revisions_.instanceList; }
    // What the clip does not move stays where it was put by hand. Throws Error(Usage) without such a clip, and
    // when it does not fit.
    void poseClip(std::size_t clip, double seconds);
    void playClip(std::size_t clip);  // from where it is, from its start at its end
    void stopClip() { clip_.playing = false; }
    void setClipLoops(bool loops) { clip_.loops = loops; }
    void restClip();
    void stepClip(double seconds);  // of the clock, while one plays; ends it when it no longer fits
    // What differs between two states of this scene that have its tables, as at two hours of a day: instances, materials,
    // lights, surroundings. No step of undo.
    void takeChanges(const Scene& before, const Scene& now);
    void askForVoxels() { ++revisions_.voxels; }

    // Return the label of what was undone or redone; nothing when there is none.
    std::optional<std::string> undo();
    std::optional<std::string> redo();
    std::size_t undoSteps() const { return done_.size(); }
    std::size_t redoSteps() const { return undone_.size(); }
    // Whether the scene is another than was opened or last saved; one that was changed and undone is not.
    bool unsaved() const { return sceneSerial() != savedSerial_; }
    void markSaved() {
        savedSerial_ = sceneSerial();
        ++saves_;
    }
    std::uint64_t saves() const { return saves_; }  // how often it was saved
    // What was opened are unsaved changes of the scene of this name.
    void markRecovered(const std::string& path);
    std::uint64_t recoveries() const { return recoveries_; }

    void request(Request request) { requests_.push_back(std::move(request)); }
    std::optional<Request> takeRequest();
    bool hasRequests() const { return !requests_.empty(); }
    const Request* nextRequest() const { return requests_.empty() ? nullptr : &requests_.front(); }

    FrameTimes& frameTimes() { return frameTimes_; }
    const FrameTimes& frameTimes() const { return frameTimes_; }
    void frameDrawn(double ms);

  private:
    void commit(Step step);
    std::uint64_t sceneSerial() const;
    void apply(const Edit& edit, bool forward);
    void place(const Camera& camera);
    void takeSelection(std::vector<Selection> all, const Selection& last);
    void deselectFrom(SelectionKind kind, std::size_t first);
    void takeInstances(const std::vector<Instance>& instances);
    void takeAddition(const AddEdit& edit, bool forward);
    void takePose(const io::NodePoses& poses);
    void followClipCamera();
    double clipDuration(std::size_t clip) const;

    struct Playing {
        std::chrono::steady_clock::time_point from;
        double seconds = 0;
    };
    void startRevisions();

    OpenHow openHow_;
    Scene scene_;
    std::string path_;
    Settings settings_;
    std::string mode_;
    Camera camera_;
    ViewFlags flags_;
    Selection selection_;
    std::vector<Selection> selected_;
    std::optional<RayMark> rayMark_;
    CameraPath cameraPath_;
    std::optional<Playing> playing_;
    Revisions revisions_;
    std::vector<std::uint64_t> instanceRevisions_, materialRevisions_;
    std::vector<std::uint64_t> meshRevisions_, textureRevisions_;
    std::uint64_t additions_ = 0;
    io::SceneAnimation animation_;
    ClipState clip_;
    Scene clipRest_, clipPosed_;            // instances, lights and cameras alone
    std::vector<std::uint8_t> clipHidden_;  // by instance: whether it has no size in the pose
    std::vector<glm::mat4> clipPlaced_;     // by instance: where the last pose had it
    std::uint64_t clipList_ = 0;            // Revisions::instanceList that the clips fit to
    std::optional<std::pair<std::size_t, Camera>> clipCamera_;  // of the file, and where a pose put it
    FrameTimes frameTimes_;
    std::deque<Request> requests_;
    std::deque<Step> done_;
    std::vector<Step> undone_;
    bool sealed_ = true;
    std::uint64_t stepsTaken_ = 0;
    std::uint64_t lastSerial_ = 0, forgottenSerial_ = 0, savedSerial_ = 0, saves_ = 0, recoveries_ = 0;
};

}  // namespace conelight::program

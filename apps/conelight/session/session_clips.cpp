// SPDX-License-Identifier: MIT
// Clips of a session's scene: poses, and playing them by a clock that the main loop holds.
#include <algorithm>
#include <cmath>
#include <utility>

#include "conelight/error.h"
#include "session/session.h"

namespace conelight::program {

void Session::setAnimation(io::SceneAnimation animation) {
    animation_ = std::move(animation);
    clip_ = {};
    clipList_ = revisions_.instanceList;
    clipCamera_.reset();
    clipRest_ = clipPosed_ = {};
    clipHidden_.clear();
    clipPlaced_.clear();
    if (animation_.clips.empty()) return;
    clipRest_.instances = scene_.instances;
    clipRest_.lights = scene_.lights;
    clipRest_.cameras = scene_.cameras;
    clipPosed_ = clipRest_;
    clipHidden_.assign(scene_.instances.size(), 0);
    for (const Instance& instance : scene_.instances) clipPlaced_.push_back(instance.worldFromObject);
}

void Session::poseClip(std::size_t clip, double seconds) {
    if (clip >= animation_.clips.size())
        throw Error(ErrorKind::Usage,
                    "clip: nothing moves in this scene; a glTF file with clips would be right");
    if (!clipsFit())
        throw Error(
            ErrorKind::Usage,
            "clip: objects were added or removed since the scene was opened; opening it anew would be right");
    clip_.clip = clip;
    clip_.seconds = std::clamp(seconds, 0.0, double(animation_.clips[clip].duration));
    clip_.posed = true;
    takePose(io::posesAt(animation_, clip, static_cast<float>(clip_.seconds)));
}

void Session::restClip() {
    clip_.playing = clip_.posed = false;
    clip_.seconds = 0;
    if (clipsFit()) takePose(io::restPoses(animation_));
}

void Session::takePose(const io::NodePoses& poses) {
    const std::vector<Light> lightsBefore = clipPosed_.lights;
    io::poseScene(animation_, poses, clipRest_, clipPosed_);
    for (const io::SceneAnimation::Hung& hung : animation_.instances) {
        Instance& mine = scene_.instances[hung.index];
        const Instance& posed = clipPosed_.instances[hung.index];
        const bool hides = !posed.visible && clipRest_.instances[hung.index].visible;
        const bool turns = std::exchange(clipHidden_[hung.index], hides ? 1 : 0) != (hides ? 1 : 0);
        const bool moves =
            std::exchange(clipPlaced_[hung.index], posed.worldFromObject) != posed.worldFromObject;
        if (!turns && !moves) continue;
        if (turns) mine.visible = !hides;
        mine.worldFromObject = posed.worldFromObject;
        ++instanceRevisions_[hung.index];
        ++(turns ? revisions_.instances : revisions_.transforms);
    }
    for (const io::DeformedMesh& moving : animation_.meshes)
        if (io::deform(moving, poses, scene_.meshes[moving.mesh])) {
            ++meshRevisions_[moving.mesh];
            ++revisions_.meshes;
        }
    bool lit = false;
    for (const io::SceneAnimation::Hung& hung : animation_.lights) {
        const Light &posed = clipPosed_.lights[hung.index], &before = lightsBefore[hung.index];
        const bool moves = posed.position != before.position || posed.direction != before.direction;
        // Lights may have come and gone.
        const bool isIt = hung.index < scene_.lights.size() && scene_.lights[hung.index].name == posed.name;
        if (!moves || !isIt) continue;
        scene_.lights[hung.index].position = posed.position;
        scene_.lights[hung.index].direction = posed.direction;
        lit = true;
    }
    if (lit) ++revisions_.lights;
    followClipCamera();
}

// The view goes along while it is that of a camera of the file.
void Session::followClipCamera() {
    for (std::size_t c = 0; c < clipRest_.cameras.size(); ++c) {
        const bool looks = camera_ == clipRest_.cameras[c] ||
                           (clipCamera_ && clipCamera_->first == c && camera_ == clipCamera_->second);
        if (!looks) continue;
        clipCamera_ = {c, clipPosed_.cameras[c]};
        if (!(camera_ == clipPosed_.cameras[c])) place(clipPosed_.cameras[c]);
        return;
    }
}

void Session::playClip(std::size_t clip) {
    const bool again = clip_.posed && clip_.clip == clip && clip_.seconds < clipDuration(clip);
    poseClip(clip, again ? clip_.seconds : 0);
    clip_.playing = true;
}

double Session::clipDuration(std::size_t clip) const {
    return clip < animation_.clips.size() ? animation_.clips[clip].duration : 0;
}

void Session::stepClip(double seconds) {
    clip_.playing = clip_.playing && clipsFit();
    if (!clip_.playing) return;
    const double duration = clipDuration(clip_.clip);
    double at = clip_.seconds + seconds;
    if (at >= duration) {
        clip_.playing = clip_.loops && duration > 0;
        at = clip_.playing ? std::fmod(at, duration) : duration;
    }
    poseClip(clip_.clip, at);
}

}  // namespace conelight::program

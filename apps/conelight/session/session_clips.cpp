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
    clipRest_ = {};
    clipRest_.instances = scene_.instances;
    clipRest_.lights = scene_.lights;
    clipRest_.cameras = scene_.cameras;
    clipPosed_ = clipRest_;
    clipHidden_.assign(scene_.instances.size(), 0);
    clipList_ = revisions_.instanceList;
    clipCamera_.reset();
}

void Session::poseClip(std::size_t clip, double seconds) {
    if (clip >= animation_.clips.size())
        throw Error(ErrorKind::Usage,
                    "clip: nothing moves in this scene; a glTF file with clips would be right");
    if (clipList_ != revisions_.instanceList)
        throw Error(
            ErrorKind::Usage,
            "clip: objects were added or removed since the scene was opened; opening it anew would be right");
    clip_.clip = clip;
    clip_.seconds = std::clamp(seconds, 0.0, double(animation_.clips[clip].duration));
    clip_.posed = true;
    const float time = static_cast<float>(clip_.seconds);
    io::poseScene(animation_, clip, time, clipRest_, clipPosed_);
    takePose(io::posesAt(animation_, clip, time));
}

void Session::restClip() {
    clip_.playing = clip_.posed = false;
    clip_.seconds = 0;
    if (clipList_ != revisions_.instanceList) return;
    clipPosed_ = clipRest_;
    takePose(io::restPoses(animation_));
}

// clipPosed_, and the vertices of these poses.
void Session::takePose(const io::NodePoses& poses) {
    for (const io::SceneAnimation::Hung& hung : animation_.instances) {
        Instance& mine = scene_.instances[hung.index];
        const Instance& posed = clipPosed_.instances[hung.index];
        const bool hides = !posed.visible && clipRest_.instances[hung.index].visible;
        const bool turns = std::exchange(clipHidden_[hung.index], hides ? 1 : 0) != (hides ? 1 : 0);
        if (!turns && mine.worldFromObject == posed.worldFromObject) continue;
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
        if (scene_.lights.size() != clipRest_.lights.size()) break;  // some came or went
        Light& mine = scene_.lights[hung.index];
        const Light& posed = clipPosed_.lights[hung.index];
        lit = lit || mine.position != posed.position || mine.direction != posed.direction;
        mine.position = posed.position;
        mine.direction = posed.direction;
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

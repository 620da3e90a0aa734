// SPDX-License-Identifier: MIT
// Poses of a clip as changes of a session: instances, lights, and the camera where it is one of the file's.
#include "clip_film.h"

#include <cmath>
#include <memory>
#include <utility>

#include "conelight/error.h"

namespace conelight::program {
namespace {

struct Motion {
    io::SceneAnimation animation;
    Scene rest, posed;
    std::size_t clip = 0;
    float framesPerSecond = 30;

    void show(Session& session, int frame) {
        const float time = float(frame) / framesPerSecond;
        io::poseScene(animation, clip, time, rest, posed);
        const io::NodePoses poses = io::posesAt(animation, clip, time);
        for (const io::DeformedMesh& moving : animation.meshes) {
            Mesh mesh = session.scene().meshes[moving.mesh];
            if (io::deform(moving, poses, mesh)) session.setMesh(moving.mesh, std::move(mesh));
        }
        std::vector<std::pair<std::size_t, Instance>> changed;
        for (const io::SceneAnimation::Hung& hung : animation.instances)
            if (!(posed.instances[hung.index] == session.scene().instances[hung.index]))
                changed.emplace_back(hung.index, posed.instances[hung.index]);
        if (!changed.empty()) session.setInstances(changed, "pose", "pose");
        if (!(posed.lights == session.scene().lights)) session.setLights(posed.lights, "pose", "pose");
        const bool starts = std::exchange(starts_, false);
        for (std::size_t c = 0; c < rest.cameras.size(); ++c)
            if (starts ? session.camera() == rest.cameras[c] : shown == int(c)) {
                shown = int(c);
                session.moveCamera(posed.cameras[c]);
                break;
            }
    }
    int shown = -1;  // the file's camera that the film looks through
    bool starts_ = true;
};

}  // namespace

ClipFilm clipFilm(const std::string& file, const Scene& rest, io::SceneAnimation animation,
                  const std::string& clip, float framesPerSecond) {
    const auto motion = std::make_shared<Motion>();
    motion->animation = std::move(animation);
    try {
        motion->clip = io::clipNumber(motion->animation, clip);
    } catch (const Error& error) {
        throw Error(error.kind(), file + ": --animate: " + error.what());
    }
    // What moves, without the meshes.
    motion->rest.instances = rest.instances;
    motion->rest.lights = rest.lights;
    motion->rest.cameras = rest.cameras;
    motion->posed = motion->rest;
    motion->framesPerSecond = framesPerSecond;
    const float duration = motion->animation.clips[motion->clip].duration;
    const double frames = 1 + std::round(double(duration) * double(framesPerSecond));
    if (!(frames <= 100000))
        throw Error(ErrorKind::Usage,
                    file + ": --animate: the clip has more than 100000 frames; a lower --fps would be right");
    return {int(frames), [motion](Session& session, int frame) { motion->show(session, frame); }};
}

}  // namespace conelight::program

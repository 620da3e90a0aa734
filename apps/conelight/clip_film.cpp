// SPDX-License-Identifier: MIT
#include "clip_film.h"

#include <cmath>

#include "conelight/error.h"

namespace conelight::program {

ClipFilm clipFilm(const std::string& file, const io::SceneAnimation& animation, const std::string& clip,
                  float framesPerSecond) {
    std::size_t number = 0;
    try {
        number = io::clipNumber(animation, clip);
    } catch (const Error& error) {
        throw Error(error.kind(), file + ": --animate: " + error.what());
    }
    const double frames = 1 + std::round(double(animation.clips[number].duration) * double(framesPerSecond));
    if (!(frames <= 100000))
        throw Error(ErrorKind::Usage,
                    file + ": --animate: the clip has more than 100000 frames; a lower --fps would be right");
    return {int(frames), [number, framesPerSecond](Session& session, int frame) {
                session.poseClip(number, double(float(frame) / framesPerSecond));
            }};
}

}  // namespace conelight::program

// SPDX-License-Identifier: MIT
// What changes while a score watches: the camera, an object, a light, or the hour of the day. Frame `index` of `count` of them.
#pragma once

#include <optional>
#include <string>

#include "command.h"
#include "hour_of_day.h"
#include "session/camera_path.h"

namespace conelight::program {

class ScorePath {
  public:
    // orbit=DEGREES, dolly=PART, object=NAME:X,Y,Z, light=NAME:X,Y,Z, dim=NAME:PART (in each second frame), clip=NAME (all of
    // it), or a file of a camera path (docs/reference/camera_path.md), whose hours are of the scene that `view` opens. Throws
    // Error(Usage), and what reading the file throws.
    ScorePath(const std::string& text, const std::string& scene, const ViewOptions& view);

    // What the scene is to be opened with; null: no clip.
    io::SceneAnimation* animation() { return kind_ == Kind::Clip ? &animation_ : nullptr; }
    bool movesScene() const {
        return kind_ == Kind::Object || kind_ == Kind::Light || kind_ == Kind::Dim || kind_ == Kind::Clip ||
               hours_;
    }
    Camera cameraAt(const Camera& start, int index, int count) const;
    // Throws Error(Usage) for an object, a light or a clip that `scene` has not.
    Scene sceneAt(const Scene& scene, int index, int count) const;

  private:
    enum class Kind { Orbit, Dolly, Object, Light, Dim, Clip, File };
    std::string takeName(const std::string& text);
    void takeTravel(Kind kind, const std::string& value);
    void takeDimming(const std::string& value);
    float numberIn(const std::string& value) const;
    void dim(Scene& scene, float to) const;
    void moveObject(Scene& scene, const glm::vec3& by) const;
    void moveLight(Scene& scene, const glm::vec3& by) const;

    std::string text_;
    Kind kind_ = Kind::Orbit;
    float amount_ = 0;
    std::string name_;  // of the object, the light, what is dimmed or the clip
    glm::vec3 travel_{0};
    CameraPath keys_;
    io::SceneAnimation animation_;
    std::optional<HourOfDay> hours_;
};

// The scene along a path, frame by frame.
class SceneAlong {
  public:
    SceneAlong(const ScorePath& path, const Scene& rest, int count)
        : path_(path), rest_(rest), count_(count) {}
    // Stays until the next call but one.
    const Scene& at(int index) {
        if (!path_.movesScene()) return rest_;
        turn_ = 1 - turn_;
        return held_[turn_].emplace(path_.sceneAt(rest_, index, count_));
    }

  private:
    const ScorePath& path_;
    const Scene& rest_;
    int count_, turn_ = 0;
    std::optional<Scene> held_[2];
};

}  // namespace conelight::program

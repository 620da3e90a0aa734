// SPDX-License-Identifier: MIT
// What takes longer than a frame, and what commands wait for: a scene to load, a flight along the path, pictures
// and films to write, a bake, `settle`. The window stays alive meanwhile; a strip over the picture shows how far the work
// is and ends it.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "reference/path_tracer.h"
#include "reference/radiosity.h"
#include "session/session.h"
#include "viewer/background_load.h"
#include "viewer/file_bake.h"
#include "viewer/picture_job.h"
#include "viewer/picture_view.h"
#include "viewer/viewer_console.h"

namespace conelight::program {

struct Film {
    int frames = 120;
    reference::PathTracerSettings traced;  // of each frame, in mode reference
};

class LongWork {
  public:
    struct Inputs {
        Session& session;
        PictureView& view;
        ViewerConsole& console;
    };
    LongWork(const Inputs& inputs, const reference::RadiositySettings& radiosity)
        : in_(inputs), radiosity_(radiosity) {}

    Film film;

    void startPictures(const Request& request);  // Screenshot or Record
    void startBake(const Request& request);
    // A scene, in the background. One that is loaded already is stopped first: false until it has ended.
    bool startLoad(const Request& request);
    // Of a file into the scene, in the same way.
    bool startImport(const Request& request);
    // The first scene, whose failure ends the program: follow() throws it.
    void startFirst(const std::string& name, BackgroundLoad::Read read);
    // What to do when the scene was changed, and not saved, while another was read: it would be lost.
    std::function<void(const Request&)> onChangedMeanwhile;
    void settle() { settling_ = true; }  // commands wait for the picture

    bool holdsRequests() const { return job_.busy(); }
    bool holdsCommands() const { return settling_ || bake_.busy() || job_.busy() || load_.busy(); }
    bool wakesWindow() const { return settling_ || bake_.busy() || load_.busy(); }  // nobody has to look
    bool loads() const { return load_.busy(); }
    std::string loadText() const { return load_.status().text; }  // what is read, and how far that is
    void stopLoading() { load_.stop(); }
    bool restsBetweenPictures() const { return job_.busy() && job_.waits(); }
    bool waits() const;  // whether commands wait for something that can be ended

    // Ends it all; the commands behind it go on.
    void stop();
    // `stop`, or `path stop` during a flight, while commands wait: done at once. Else false.
    bool stopAtOnce(const std::vector<std::string>& words);

    void follow();                           // takes over what the background has finished
    void lookWhetherSettled(bool improves);  // `improves`: another frame would change the picture
    bool drawPictures();                     // a little of them; false: there are none to draw
    void showStrips(const glm::vec2& at, const glm::vec2& size);

  private:
    void takeOver(const Request& request, OpenedScene& opened, std::uint64_t stepsBefore);
    void followLoad();
    void followBake();

    Inputs in_;
    reference::RadiositySettings radiosity_;  // of bakes
    BackgroundLoad load_;
    bool loadsFirst_ = false;
    FileBake bake_;
    PictureJob job_;
    bool settling_ = false;
};

}  // namespace conelight::program

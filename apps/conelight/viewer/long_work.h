// SPDX-License-Identifier: MIT
// What takes longer than a frame, and what commands wait for: a flight along the path, pictures and films to
// write, a bake, `settle`. The window stays alive meanwhile; a strip over the picture shows how far the work
// is and ends it.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "reference/path_tracer.h"
#include "reference/radiosity.h"
#include "session/session.h"
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
    void settle() { settling_ = true; }  // commands wait for the picture

    bool holdsRequests() const { return job_.busy(); }
    bool holdsCommands() const { return settling_ || bake_.busy() || job_.busy(); }
    bool wakesWindow() const { return settling_ || bake_.busy(); }  // when it goes on: nobody has to look
    bool restsBetweenPictures() const { return job_.busy() && job_.waits(); }
    bool waits() const;  // whether commands wait for something that can be ended

    // Ends it all; the commands behind it go on.
    void stop();
    // `stop`, or `path stop` during a flight, while commands wait: done at once. Else false.
    bool stopAtOnce(const std::vector<std::string>& words);

    void follow();                           // takes what the background has finished
    void lookWhetherSettled(bool improves);  // `improves`: another frame would change the picture
    bool drawPictures();                     // a little of them; false: there are none to draw
    void showStrips(const glm::vec2& at, const glm::vec2& size);

  private:
    Inputs in_;
    reference::RadiositySettings radiosity_;  // of bakes
    FileBake bake_;
    PictureJob job_;
    bool settling_ = false;
};

}  // namespace conelight::program

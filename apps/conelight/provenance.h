// SPDX-License-Identifier: MIT
// How a picture was made, as texts that PNG and EXR files keep in their headers.
#pragma once

#include <string>

#include "picture_file.h"
#include "picture_source.h"
#include "script_run.h"

namespace conelight::program {

// "Conelight 0.1.0", with the commit of the sources behind it where it is known.
std::string softwareName();

// What of a command line changed the scene, and the console commands that it ran, for PictureRequest.
std::string sceneOptionsOf(const ViewOptions& view);
std::string commandsOf(const ScriptOptions& script);

// Software, Scene, Mode, Camera, Size, Settings (those that are not the defaults, as words for --set), Options,
// Commands, Samples
// and Seed of modes on the CPU (samples of 0: neither is known), Device. Nothing of time and place: the same call makes the same file.
// `scene`: as it was named. `device`: of OpenGL, "" where it is not known.
PictureTexts provenanceOf(const PictureRequest& request, const std::string& scene, const std::string& device);

}  // namespace conelight::program

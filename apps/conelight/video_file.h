// SPDX-License-Identifier: MIT
// Frames to a film (through the program ffmpeg) or to numbered pictures (frame%04d.png). A film is written
// beside its place and renamed when finish() is reached.
#pragma once

#include <cstdio>
#include <memory>
#include <string>

#include "picture_file.h"

namespace conelight::program {

class VideoFile {
  public:
    // `file` as isVideoName() takes it; numbered pictures start at `first`. Throws Error(Runtime) when it cannot
    // be written.
    // `format`: its size does not count.
    VideoFile(const std::string& file, int width, int height, int framesPerSecond = 30, int first = 0,
              const PictureFormat& format = {});
    ~VideoFile();
    VideoFile(const VideoFile&) = delete;
    VideoFile& operator=(const VideoFile&) = delete;

    // Throws Error(Runtime), of ffmpeg too: that it is not installed, or what it ended with.
    // `image`: as of writePicture(). `texts` and `layers`: of numbered pictures.
    void add(const Image& image, const ImageSettings& settings, const PictureTexts& texts = {},
             const PictureLayers& layers = {});
    void finish();

  private:
    std::string file_, partial_;
    PictureFormat format_;
    int count_ = 0;
    std::FILE* pipe_ = nullptr;
};

}  // namespace conelight::program

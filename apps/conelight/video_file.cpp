// SPDX-License-Identifier: MIT
#include "video_file.h"

#include <fmt/core.h>
#include <signal.h>

#include <cstdlib>
#include <filesystem>

#include "command_line.h"
#include "conelight/error.h"
#include "io/files.h"

namespace conelight::program {
namespace {

// ffmpeg may end before it has read all; the write then fails instead of killing the program.
class IgnorePipeSignal {
  public:
    IgnorePipeSignal() : before_(::signal(SIGPIPE, SIG_IGN)) {}
    ~IgnorePipeSignal() { ::signal(SIGPIPE, before_); }

  private:
    void (*before_)(int);
};

std::string numbered(const std::string& pattern, int number) {
    const std::size_t percent = pattern.find('%');
    const std::size_t end = pattern.find('d', percent);
    const std::string width = pattern.substr(percent + 1, end - percent - 1);
    const int digits = width.empty() ? 1 : std::atoi(width.c_str());
    return fmt::format("{}{:0{}}{}", pattern.substr(0, percent), number, digits, pattern.substr(end + 1));
}

// ffmpeg's options by the kind of film.
std::string encodingOf(const std::string& file, bool alpha) {
    const std::string ending = std::filesystem::path(file).extension().string();
    if (alpha) return "-c:v prores_ks -profile:v 4444 -pix_fmt yuva444p10le";
    if (ending == ".gif")  // a palette of its own: the usual one dithers coarsely
        return "-filter_complex 'split[a][b];[a]palettegen=stats_mode=diff[p];[b][p]paletteuse=dither=bayer'";
    if (ending == ".webp") return "-c:v libwebp_anim -loop 0 -quality 82";
    // Even sizes: the usual pixel format of films holds colour at half resolution.
    return "-vf 'pad=ceil(iw/2)*2:ceil(ih/2)*2' -pix_fmt yuv420p";
}

}  // namespace

VideoFile::VideoFile(const std::string& file, int width, int height, int framesPerSecond, int first,
                     const PictureFormat& format)
    : file_(file), format_(format), count_(first) {
    if (file.find('%') != std::string::npos) {
        io::checkWritable(numbered(file, first));
        return;
    }
    io::checkWritable(file);
    if (std::system("command -v ffmpeg >/dev/null 2>&1") != 0)
        throw Error(
            ErrorKind::Runtime,
            fmt::format("{}: films need the program ffmpeg, which is not installed; numbered pictures "
                        "as in frame%04d.png would be right",
                        file));
    // ffmpeg knows the format by the ending.
    partial_ = io::newFileBeside(file, ".part" + std::filesystem::path(file).extension().string()).string();
    const std::string command =
        fmt::format("ffmpeg -y -loglevel error -f rawvideo -pix_fmt {} -s {}x{} -r {} -i - {} {} >/dev/null",
                    format.alpha ? "rgba" : "rgb24", width, height, framesPerSecond,
                    encodingOf(file, format.alpha), shellWord(partial_));
    pipe_ = ::popen(command.c_str(), "w");
    if (pipe_ == nullptr) {
        std::error_code ignored;
        std::filesystem::remove(partial_, ignored);
        throw Error(ErrorKind::Runtime, file + ": ffmpeg cannot be started");
    }
}

VideoFile::~VideoFile() {
    if (pipe_ == nullptr) return;
    const IgnorePipeSignal ignore;
    ::pclose(pipe_);
    std::error_code code;
    std::filesystem::remove(partial_, code);
}

void VideoFile::add(const Image& image, const ImageSettings& settings, const PictureTexts& texts,
                    const PictureLayers& layers) {
    if (partial_.empty())
        return writePicture(numbered(file_, count_++), image, settings, texts, layers, format_);
    const IgnorePipeSignal ignore;
    const std::vector<std::uint8_t> bytes =
        format_.alpha ? shownWithAlpha<std::uint8_t>(image, settings) : toneMapped(image, settings);
    if (std::fwrite(bytes.data(), 1, bytes.size(), pipe_) != bytes.size() || std::fflush(pipe_) != 0)
        throw Error(ErrorKind::Runtime, file_ + ": ffmpeg stopped reading; its own message stands above");
    ++count_;
}

void VideoFile::finish() {
    if (pipe_ == nullptr) return;
    const IgnorePipeSignal ignore;
    const int status = ::pclose(pipe_);
    pipe_ = nullptr;
    std::error_code code;
    if (status == 0) std::filesystem::rename(partial_, file_, code);
    if (status != 0 || code) {
        std::filesystem::remove(partial_, code);
        throw Error(ErrorKind::Runtime, file_ + ": ffmpeg failed; its own message stands above");
    }
}

}  // namespace conelight::program

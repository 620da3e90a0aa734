// SPDX-License-Identifier: MIT
// The dialog of pictures and films that are written: size, kind of file, alpha, and for films what moves, how long
// and at which rate. It makes a line of the console, `screenshot` or `record`.
#pragma once

#include <optional>
#include <string>

#include "session/session.h"

namespace conelight::program {

class PictureDialog {
  public:
    // `frames`: of a film, to begin with.
    void open(bool film, int frames);
    // Draws it when it is open; returns the line that was asked for, once.
    std::optional<std::string> show(const Session& session);

  private:
    void sizeRows();
    void kindRows();
    void movementRows(const Session& session);
    void nameRow();
    std::string line() const;
    int frames() const;

    bool wanted_ = false, film_ = false, entered_ = false;
    int size_ = 0, width_ = 1920, height_ = 1080;  // size_: of the list
    int pictureKind_ = 0, filmKind_ = 0;
    bool alpha_ = false;
    int movement_ = 0;
    float seconds_ = 4;
    int rate_ = 30;
    std::string name_;
};

}  // namespace conelight::program

// SPDX-License-Identifier: MIT
#include "film_along.h"

#include <utility>

namespace conelight::program {

FilmAlong::FilmAlong(const std::string& file, const std::string& scene, const ViewOptions& view,
                     const Scene& opened)
    : keys_(readCameraPath(file)), hours_(hoursOf(keys_, file, scene, view)) {
    if (hours_) shown_ = opened;
}

Camera FilmAlong::show(Session& session, double seconds) {
    if (hours_) {
        Scene now = hours_->at(*shown_, *keys_.hourAt(seconds));
        session.takeChanges(*shown_, now);
        *shown_ = std::move(now);
    }
    return keys_.at(seconds);
}

}  // namespace conelight::program

// SPDX-License-Identifier: MIT
#include "study/cone_pictures.h"

namespace conelight::program {

ConePictures::ConePictures(PictureSource& source, const Scene& scene, const ViewOptions& view,
                           Progress& progress)
    : source_(source), progress_(progress) {
    source_.setScene(scene);
    request_.mode = "cones";
    request_.settings = settingsFor(scene, "cones", view);
    request_.settings.cones.bounces = 1;
    request_.settings.image.antialiasing = 0;
    request_.camera = cameraFor(scene, view);
    request_.size = parseSize(view.size);
    request_.components = {Component::Diffuse};
}

ConePicture ConePictures::draw(bool countSamples) {
    request_.profile = countSamples;
    Picture picture = source_.draw(request_, &progress_);
    if (picture.stopped || interrupted()) throw InterruptedError();
    ConePicture drawn{std::move(picture.images.front()), 0};
    for (const auto& [kind, count] : picture.stats.lookupsPerPixel) drawn.samples += count;
    return drawn;
}

ConePicture ConePictures::by(const std::vector<SetCone>& cones, bool countSamples) {
    request_.settings.cones.diffuseSet = DiffuseSet::Own;
    request_.settings.cones.ownSet = cones;
    return draw(countSamples);
}

ConePicture ConePictures::by(DiffuseSet set, int count) {
    request_.settings.cones.diffuseSet = set;
    request_.settings.cones.count = count;
    return draw(true);
}

std::pair<Image, Image> ConePictures::truth(int samplesPerPixel, std::uint32_t seed) {
    PictureRequest request = request_;
    request.mode = "reference";
    request.profile = false;
    request.reference.samplesPerPixel = samplesPerPixel;
    request.reference.bounces = 1;
    std::vector<Image> halves;
    for (const std::uint32_t offset : {0u, 1u}) {
        request.reference.seed = seed + offset;
        Picture picture = source_.draw(request, &progress_);
        if (picture.stopped || interrupted()) throw InterruptedError();
        halves.push_back(std::move(picture.images.front()));
    }
    return {std::move(halves[0]), std::move(halves[1])};
}

}  // namespace conelight::program

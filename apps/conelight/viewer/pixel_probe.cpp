// SPDX-License-Identifier: MIT
#include "viewer/pixel_probe.h"

#include <utility>

#include "conelight/error.h"

namespace conelight::program {

void PixelProbe::inspectPixel(const glm::ivec2& pixel) {
    const Image& linear = view_.slot(false).linear();
    inspect({(glm::vec2(pixel) + 0.5f) / glm::max(glm::vec2(linear.width, linear.height), 1.0f)});
}

std::optional<Pick> PixelProbe::pickAt(const glm::vec2& part, const glm::ivec2& size) {
    const glm::ivec2 pixel = glm::clamp(glm::ivec2(part * glm::vec2(size)), glm::ivec2(0), size - 1);
    return picker_.atPixel(session_, size.x, size.y, pixel.x, pixel.y);
}

Selection PixelProbe::at(const glm::vec2& part) {
    if (const auto light = view_.lights.at(part)) return {SelectionKind::Light, *light};
    const glm::ivec2 size = view_.pictureSize();
    if (size.x == 0) return {};
    const std::optional<Pick> hit = pickAt(part, size);
    return hit ? Selection{SelectionKind::Instance, hit->instance} : Selection{};
}

void PixelProbe::choose(const PictureView::Click& click) {
    const Selection there = at(click.part);
    if (click.adds) return session_.toggleSelected(there);
    if (there.kind != SelectionKind::None && !session_.isSelected(there)) session_.select(there);
}

void PixelProbe::select(const PictureView::Click& click) {
    PictureSlot& slot = view_.slotAt(click.part.x);
    if (const auto light = view_.lights.at(click.part)) {
        clear();
        return session_.select({SelectionKind::Light, *light});
    }
    const Image& linear = slot.linear();
    const glm::ivec2 size(linear.width, linear.height);
    if (size.x == 0) return;
    Inspection inspection;
    const glm::ivec2 pixel = glm::clamp(glm::ivec2(click.part * glm::vec2(size)), glm::ivec2(0), size - 1);
    inspection.pixel = pixel;
    inspection.radiance = linear.pixels[static_cast<std::size_t>(pixel.y) * static_cast<std::size_t>(size.x) +
                                        static_cast<std::size_t>(pixel.x)];
    inspection.hit = pickAt(click.part, size);
    session_.select(inspection.hit ? Selection{SelectionKind::Instance, inspection.hit->instance}
                                   : Selection{});
    gathering_ = nullptr;
    gathersIn_ = inspection.hit ? &slot : nullptr;  // nothing gathers in the sky
    found_ = inspection;
    tables_ = session_.revisions().sceneTables();
    mode_ = session_.mode();
    settings_ = session_.settings();
}

void PixelProbe::inspect(const PictureView::Click& click) {
    select(click);
    PictureSlot* const slot = std::exchange(gathersIn_, nullptr);
    if (slot == nullptr || !found_ || !slot->inspects()) return;
    try {
        found_->gathered = slot->inspectPixel(found_->pixel);
    } catch (const Error&) {
        // The picture has another size by now: there is nothing to show.
    }
}

bool PixelProbe::gather() {
    PictureSlot* const slot = std::exchange(gathersIn_, nullptr);
    if (slot == nullptr || !found_ || !slot->inspects()) return false;
    gathering_ = slot;
    slot->beginInspection(found_->pixel);
    return true;
}

// Exposure and tone map change nothing of it, and lines follow the camera.
void PixelProbe::follow() {
    if (!found_) return;
    if (gathering_ != nullptr) found_->gathered = gathering_->takeInspection();
    if (found_->gathered) gathering_ = nullptr;
    settings_.image = session_.settings().image;
    const bool same = tables_ == session_.revisions().sceneTables() && mode_ == session_.mode() &&
                      settings_ == session_.settings();
    if (!same) clear();
}

}  // namespace conelight::program

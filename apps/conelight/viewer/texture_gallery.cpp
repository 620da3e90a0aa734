// SPDX-License-Identifier: MIT
#include "viewer/texture_gallery.h"

#include <imgui.h>

#include <algorithm>

#include "viewer/imgui_names.h"
#include "viewer/widget_places.h"

namespace conelight::program {
namespace {

constexpr int kThumbnailPx = 96, kLargePx = 1024;

}  // namespace

// Other textures may stand in the place of those that were there.
void TextureGallery::follow(const Session& session) {
    if (scene_ == session.revisions().scene && revisions_ == session.textureRevisions()) return;
    scene_ = session.revisions().scene;
    revisions_ = session.textureRevisions();
    thumbnails_.clear();
    open_.reset();
}

const platform::PictureTexture& TextureGallery::thumbnail(const Session& session, std::size_t index) {
    std::unique_ptr<platform::PictureTexture>& picture = thumbnails_[index];
    if (picture) return *picture;
    picture = std::make_unique<platform::PictureTexture>();
    const Texture& texture = session.scene().textures[index];
    const glm::ivec2 size = previewSize(texture, kThumbnailPx);
    picture->update(size.x, size.y, previewOf(texture, size, TextureChannel::Color));
    return *picture;
}

void TextureGallery::showThumbnails(const Session& session, const Material& material) {
    follow(session);
    const float edge = 3 * ImGui::GetFontSize();
    for (const TextureUse& use : texturesOf(material)) {
        if (use.texture < 0) continue;
        const auto index = static_cast<std::size_t>(use.texture);
        const platform::PictureTexture& picture = thumbnail(session, index);
        const float longer = static_cast<float>(std::max(picture.width(), picture.height()));
        ImGui::PushID(use.name);
        const ImVec2 size{edge * static_cast<float>(picture.width()) / longer,
                          edge * static_cast<float>(picture.height()) / longer};
        ImGui::Image(textureId(picture.name()), size);
        notePlace(std::string("texture:") + use.name);
        if (ImGui::IsItemClicked()) open_ = Large{index};
        if (ImGui::IsItemHovered())
            ImGui::SetTooltip("%s", describe(session.scene().textures[index]).c_str());
        ImGui::SameLine();
        ImGui::TextUnformatted(use.name);
        ImGui::PopID();
    }
}

void TextureGallery::showOpen(const Session& session) {
    follow(session);
    if (!open_) return;
    const Texture& texture = session.scene().textures[open_->texture];
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({0.5f * display.x, 0.5f * display.y}, ImGuiCond_Appearing, {0.5f, 0.5f});
    const float edge = 0.6f * std::min(display.x, display.y);
    ImGui::SetNextWindowSize({edge, edge}, ImGuiCond_Appearing);
    bool stays = true;
    ImGui::Begin("Texture", &stays, ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoCollapse);
    ImGui::TextUnformatted(describe(texture).c_str());
    static constexpr const char* kChannels[] = {"colour", "red", "green", "blue", "opacity"};
    for (int i = 0; i < 5; ++i) {
        if (i > 0) ImGui::SameLine();
        const auto channel = static_cast<TextureChannel>(i);
        if (ImGui::RadioButton(kChannels[i], open_->channel == channel))
            open_ = Large{open_->texture, channel};
        notePlace(std::string("texture channel:") + kChannels[i]);
    }
    if (!open_->drawn) {
        const glm::ivec2 size = previewSize(texture, kLargePx);
        large_.update(size.x, size.y, previewOf(texture, size, open_->channel));
        open_->drawn = true;
    }
    const ImVec2 room = ImGui::GetContentRegionAvail();
    const float scale =
        std::min(room.x / static_cast<float>(large_.width()), room.y / static_cast<float>(large_.height()));
    if (scale > 0)
        ImGui::Image(textureId(large_.name()), {scale * static_cast<float>(large_.width()),
                                                scale * static_cast<float>(large_.height())});
    notePlace("texture view");
    if (escapePressed() && ImGui::IsWindowFocused()) stays = false;
    ImGui::End();
    if (!stays) open_.reset();
}

}  // namespace conelight::program

// SPDX-License-Identifier: MIT
// Handles on the selected object or light in the picture: arrows move it along the world's axes, rings turn
// it about them, boxes scale it along its own axes, the box in the middle along all. A drag is one step of
// undo. Drawn with ImGui, as no package of Debian 12 has such handles.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "session/session.h"

namespace conelight::program {

enum class GizmoTool { Move, Turn, Scale };

class Gizmo {
  public:
    GizmoTool tool = GizmoTool::Move;

    // Into the current ImGui window, over the picture at `at`; takes the mouse when `hovered` and over a
    // handle.
    void show(Session& session, const glm::vec2& at, const glm::vec2& size, bool hovered);
    bool active() const { return drag_.has_value(); }  // a handle is dragged

  private:
    // The picture, and its mouse, as lengths and rays.
    struct View {
        Camera camera;
        glm::vec2 at{0}, size{1};
        std::optional<glm::vec2> onScreen(const glm::vec3& point) const;
        glm::vec3 ray(const glm::vec2& mouse) const;
    };
    struct Handle {
        int axis = 0;  // 3: the middle
        glm::vec3 direction{0};
        std::vector<glm::vec2> line;  // screen
    };
    struct Drag {
        Selection what;
        Handle handle;
        glm::vec3 pivot{0};
        glm::vec2 mouse{0};          // where it began
        glm::vec2 last{0};           // up to where it has been followed
        std::optional<float> along;  // the axis, or the angle about it, there
        Instance instance;           // as it was
        glm::vec3 light{0};
    };
    std::vector<Handle> handles(const View& view, const glm::vec3& pivot, const glm::mat3& own,
                                bool onlyMoves) const;
    std::optional<float> along(const View& view, const Handle& handle, const glm::vec3& pivot,
                               const glm::vec2& mouse) const;
    void drag(Session& session, const View& view, const glm::vec2& mouse);

    std::optional<Drag> drag_;
};

}  // namespace conelight::program

// SPDX-License-Identifier: MIT
// Handles on what is selected in the picture, about its common middle: arrows move it along the world's axes, rings
// turn it about them, boxes scale an object along its own axes, several along the world's, the box in the middle
// along all. Lights are moved, and turn with objects. A drag is one step of undo. Drawn with ImGui, as no package of
// Debian 12 has such handles.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "session/mesh_bounds.h"
#include "session/projection.h"
#include "session/session.h"

namespace conelight::program {

enum class GizmoTool { Move, Turn, Scale };

class Gizmo {
  public:
    GizmoTool tool = GizmoTool::Move;

    // Into the current ImGui window, over the picture at `at`; takes the mouse when `hovered` and over a
    // handle.
    void show(Session& session, MeshBounds& bounds, const glm::vec2& at, const glm::vec2& size, bool hovered);
    bool active() const { return drag_.has_value(); }  // a handle is dragged

  private:
    // The picture, and its mouse, as lengths and rays.
    struct View {
        Camera camera;
        glm::vec2 at{0}, size{1};
        std::optional<glm::vec2> onScreen(const glm::vec3& point) const;
        ViewRay ray(const glm::vec2& mouse) const;
    };
    struct Handle {
        int axis = 0;  // 3: the middle
        glm::vec3 direction{0};
        std::vector<glm::vec2> line;  // screen
    };
    struct Drag {
        std::vector<Selection> what;
        Handle handle;
        glm::vec3 pivot{0};
        glm::vec2 mouse{0};          // where it began
        glm::vec2 last{0};           // up to where it has been followed
        std::optional<float> along;  // the axis, or the angle about it, there
        // As they were.
        std::vector<std::pair<std::size_t, Instance>> instances;
        std::vector<Light> lights;
    };
    std::vector<Handle> handles(const View& view, const glm::vec3& pivot, const glm::mat3& own,
                                bool onlyMoves) const;
    std::optional<float> along(const View& view, const Handle& handle, const glm::vec3& pivot,
                               const glm::vec2& mouse) const;
    std::optional<glm::mat4> changeBy(const View& view, const glm::vec2& mouse) const;
    void drag(Session& session, const View& view, const glm::vec2& mouse);
    void begin(const Session& session, const View& view, const Handle& handle, const glm::vec3& pivot,
               const glm::vec2& mouse);
    static void draw(const Handle& handle, bool arrow, bool hot);

    std::optional<Drag> drag_;
};

}  // namespace conelight::program

// SPDX-License-Identifier: MIT
// A scene of OpenSceneGraph, lit by Conelight: its nodes become a scene, its shader looks the light up. A ball goes round.
//   example_07_open_scene_graph [OUT.png]
// With OUT.png it draws 24 frames, writes the last and ends; it needs no display then.
#include "host_renderer.h"  // its OpenGL comes first

#include <conelight/light_field.h>
#include <cstdio>
#include <glm/gtc/type_ptr.hpp>
#include <osg/MatrixTransform>
#include <osg/Program>
#include <osg/ShapeDrawable>
#include <osg/TriangleIndexFunctor>
#include <osgViewer/Viewer>

#include "io/image_file.h"
#include "sdl_window.h"

namespace {

constexpr int kWidth = 480, kHeight = 360;
// Behind the texture units and blocks that OpenSceneGraph uses.
constexpr conelight::LookupSlots kSlots{.firstBlock = 4, .firstTexture = 8};
const osg::Vec3f kLamp(0.6f, -0.5f, 1.8f);

const char* const kVertex = R"(#version 450 compatibility
uniform mat4 osg_ViewMatrixInverse;
out vec3 world, normal;
void main() {
    world = (osg_ViewMatrixInverse * gl_ModelViewMatrix * gl_Vertex).xyz;
    normal = mat3(osg_ViewMatrixInverse * gl_ModelViewMatrix) * gl_Normal;
    gl_FrontColor = gl_Color;
    gl_Position = gl_ModelViewProjectionMatrix * gl_Vertex;
}
)";
const char* const kFragment = R"(
uniform vec3 lamp;
in vec3 world, normal;
out vec4 color;
void main() {
    vec3 n = normalize(normal), start = world + 0.5 * conelight_voxelSize(world) * n, toLamp = lamp - start;
    vec3 light = conelight_irradiance(world, n);
    float met;
    conelight_trace(start, toLamp, met);
    if (met < 0 || met > length(toLamp)) light += vec3(1.2) * max(dot(n, normalize(toLamp)), 0) / dot(toLamp, toLamp);
    color = vec4(pow(1 - exp(-gl_Color.rgb * light), vec3(1 / 2.2)), 1);
}
)";

struct Triangles {
    std::vector<std::uint32_t> indices;
    void operator()(unsigned a, unsigned b, unsigned c) { indices.insert(indices.end(), {a, b, c}); }
};

// [collect]
// Each drawable becomes a mesh, a material and an instance.
class Collector : public osg::NodeVisitor {
  public:
    Collector() : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN) {}
    conelight::Scene scene;

    void apply(osg::Drawable& drawable) override {
        osg::Geometry& geometry = *drawable.asGeometry();
        const auto& points = static_cast<const osg::Vec3Array&>(*geometry.getVertexArray());
        const auto& colors = static_cast<const osg::Vec4Array&>(*geometry.getColorArray());
        osg::TriangleIndexFunctor<Triangles> triangles;
        geometry.accept(triangles);
        conelight::Mesh& mesh = scene.meshes.emplace_back();
        for (const osg::Vec3& p : points) mesh.positions.emplace_back(p.x(), p.y(), p.z());
        mesh.indices = triangles.indices;
        scene.materials.emplace_back().baseColor = glm::make_vec4(colors[0].ptr());
        conelight::Instance& instance = scene.instances.emplace_back();
        instance.mesh = instance.material = static_cast<int>(scene.meshes.size()) - 1;
        instance.worldFromObject = glm::mat4(glm::make_mat4(osg::computeLocalToWorld(getNodePath()).ptr()));
    }
};
// [/collect]

void add(osg::Group* to, osg::Shape* shape, float green) {
    auto* const drawable = new osg::ShapeDrawable(shape);
    drawable->setColor({0.75f, green, green, 1});
    to->addChild(drawable);
}

// A room without a front, the last child a ball that turns.
osg::Group* makeRoom() {
    auto* const root = new osg::Group;
    add(root, new osg::Box({0, 0, -0.05f}, 2.2f, 2.2f, 0.1f), 0.75f);
    add(root, new osg::Box({0, 1.05f, 1}, 2.2f, 0.1f, 2), 0.75f);
    add(root, new osg::Box({-1.05f, 0, 1}, 0.1f, 2.2f, 2), 0.08f);
    add(root, new osg::Box({1.05f, 0, 1}, 0.1f, 2.2f, 2), 0.75f);
    add(root, new osg::Cone({0.35f, 0.35f, 0.3f}, 0.35f, 1), 0.75f);
    auto* const turning = new osg::MatrixTransform;
    add(turning, new osg::Sphere({-0.4f, -0.1f, 0.3f}, 0.3f), 0.75f);
    root->addChild(turning);
    auto* const program = new osg::Program;
    program->addShader(new osg::Shader(osg::Shader::VERTEX, kVertex));
    program->addShader(new osg::Shader(
        osg::Shader::FRAGMENT, "#version 450 compatibility\n" + conelight::lookupsGlsl(kSlots) + kFragment));
    root->getOrCreateStateSet()->setAttributeAndModes(program);
    root->getOrCreateStateSet()->addUniform(new osg::Uniform("lamp", kLamp));
    return root;
}

void run(const char* path, const Window& window) {
    const osg::ref_ptr<osg::Group> root = makeRoom();
    osgViewer::Viewer viewer;
    viewer.setThreadingModel(osgViewer::Viewer::SingleThreaded);
    viewer.setUpViewerAsEmbeddedInWindow(0, 0, kWidth, kHeight);
    viewer.getCamera()->setProjectionMatrixAsPerspective(40, double(kWidth) / kHeight, 0.1, 20);
    viewer.getCamera()->setViewMatrixAsLookAt({0, -3.8, 1.1}, {0, 0, 0.85}, {0, 0, 1});
    viewer.setSceneData(root);

    // [frame]
    Collector collected;
    root->accept(collected);
    collected.scene.lights.push_back(
        {.intensity = glm::vec3(3.14159f * 1.2f), .position = glm::make_vec3(kLamp.ptr())});
    conelight::LightField field;
    conelight::Settings settings = conelight::realtimeSettings();
    settings.voxels.size = 48;
    field.setSettings(settings);
    field.setScene(collected.scene);
    field.update({.updates = 16});  // while loading
    conelight::Instance& ball = collected.scene.instances.back();
    for (int frame = 0; path == nullptr || frame < 24; ++frame) {
        const auto turn = osg::Matrix::rotate(0.02 * frame, osg::Vec3(0, 0, 1));
        static_cast<osg::MatrixTransform&>(*root->getChild(5)).setMatrix(turn);
        ball.worldFromObject = glm::mat4(glm::make_mat4(turn.ptr()));
        field.setInstance(collected.scene.instances.size() - 1, ball);
        field.update({.updates = 4, .milliseconds = 30});
        field.bindLookups(kSlots);
        viewer.frame();
        // [/frame]
        if (path == nullptr && !window.show()) return;
    }
    conelight::io::writePng(path, {kWidth, kHeight, 3, shownPixels(kWidth, kHeight)});
    std::printf("picture at %s\n", path);
}

}  // namespace

int main(int argc, char** argv) try {
    const Window window("OpenSceneGraph", kWidth, kHeight, SDL_GL_CONTEXT_PROFILE_COMPATIBILITY);
    run(argc > 1 ? argv[1] : nullptr, window);
    return 0;
} catch (const conelight::Error& error) {
    std::fprintf(stderr, "07_open_scene_graph: %s\n", error.what());
    return 1;
}

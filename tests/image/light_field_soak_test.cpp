// SPDX-License-Identifier: MIT
// A light field of a host for a long time, by random changes: things move, bend on the CPU and on the GPU, come and go,
// as do lamps, texels, materials, views and settings. After every frame the host's OpenGL state is what it was, and every
// so often the field holds what it held: objects of OpenGL, their bytes, the heap.
//
// A seed gives the same changes. CONELIGHT_SOAK_FRAMES=N goes on for so many frames (tools/soak --frames N).
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <glm/gtc/matrix_transform.hpp>
#include <map>
#include <random>
#include <utility>

#include "support/heap.h"
#include "support/host_state.h"
#include "support/light_field_rig.h"
#include "support/scenes.h"

namespace conelight::test {
namespace {

constexpr int kFramesOfTurn = 10;  // between two looks at what is held
constexpr int kTurns = 3;          // in the suite
constexpr std::size_t kMostThings = 4;

// Objects by kind and label, and their bytes. Programs are left out: those asked for last stay.
using HeldObjects = std::map<std::pair<gl::ObjectType, std::string>, std::pair<int, std::size_t>>;
HeldObjects heldObjects() {
    HeldObjects held;
    for (const gl::LiveObject& object : gl::liveObjects()) {
        if (object.type == gl::ObjectType::Program) continue;
        auto& [count, bytes] = held[{object.type, object.label}];
        ++count;
        bytes += object.bytes;
    }
    return held;
}

// What a host changes from frame to frame, in a field that it began with a scene.
class ChangingHost {
  public:
    ChangingHost(LightField& field, const Scene& scene, const HostSurfaces& surfaces, GLuint buffer)
        : field_(field), scene_(scene), surfaces_(surfaces) {
        hostMesh_.vertexCount = hostMesh_.indexCount = 36;
        hostMesh_.positions = {buffer, 0, 12};
        hostMesh_.bounds = {glm::vec3(-1.5f), glm::vec3(1.5f)};
    }

    // The same scene, as at first; nothing else is left.
    void begin(unsigned seed) {
        random_.seed(seed);
        now_ = scene_;
        things_.clear();
        field_.setSettings(settings(16));
        field_.setRegion({});
        field_.setScene(scene_);
        writeBox(glm::vec3(1));
        hostMeshIndex_ = field_.addMesh(hostMesh_);
        Instance instance = scene_.instances.back();
        instance.mesh = static_cast<int>(hostMeshIndex_);
        hostInstance_ = field_.addInstance(instance);
    }

    // One change or two, an update, and the light at the pixels of a view.
    void frame() {
        change();
        if (within(3) == 0) change();
        field_.update({.updates = 1 + within(2), .faces = within(2) * 500});
        if (view_ == 0 || within(10) == 0) {
            if (view_ != 0) field_.removeView(view_);
            view_ = field_.addView();
        }
        field_.gather(view_, surfaces_, {.reduction = 1 + within(2)});
        ++frames_;
    }

    // At rest: the scene of the beginning, one update, one view.
    void rest() {
        begin(0);
        field_.update();
        if (view_ != 0) field_.removeView(view_);
        view_ = field_.addView();
        field_.gather(view_, surfaces_);
    }
    int frames() const { return frames_; }

  private:
    int within(int count) { return static_cast<int>(random_() % static_cast<unsigned>(count)); }
    float number() { return static_cast<float>(within(2001)) / 1000 - 1; }
    glm::vec3 place() { return 0.6f * glm::vec3(number(), number(), number()); }
    glm::mat4 placed() {
        return glm::translate(glm::mat4(1), place()) *
               glm::rotate(glm::mat4(1), 3 * number(), glm::vec3(0, 1, 0)) *
               glm::scale(glm::mat4(1), glm::vec3(0.2f + 0.1f * number()));
    }
    static Settings settings(int size) {
        Settings settings = realtimeSettings(Quality::Draft);
        settings.voxels.size = size;
        settings.light.shadowSize = 64;
        return settings;
    }

    void change() {
        switch (within(12)) {
            case 0:
                return move();
            case 1:
                return bend();
            case 2:
                return bendOnGpu();
            case 3:
                return add();
            case 4:
                return remove();
            case 5:
                return lamps();
            case 6:
                return texels();
            case 7:
                return paint();
            case 8:
                return field_.setSky(glm::vec3(0.1f * static_cast<float>(within(4))));
            case 9:
                return field_.setSettings(settings(within(2) == 0 ? 12 : 16));
            case 10:
                return field_.setRegion(within(2) == 0 ? Aabb{} : Aabb{glm::vec3(-1), glm::vec3(1)});
            default:
                return field_.setInstance(hostInstance_, hostInstance());
        }
    }
    Instance hostInstance() {
        Instance instance = field_.scene().instances[hostInstance_];
        instance.worldFromObject = placed();
        instance.visible = within(4) != 0;
        return instance;
    }
    void move() {
        Instance& box = now_.instances.back();
        box.worldFromObject[3] = glm::vec4(place(), 1);
        field_.setInstance(now_.instances.size() - 1, box);
    }
    void bend() {
        Mesh mesh = scene_.meshes.back();
        for (glm::vec3& p : mesh.positions) p *= 1 + 0.2f * number();
        field_.setMesh(scene_.meshes.size() - 1, mesh);
    }
    // The host writes its own buffer, and says so.
    void bendOnGpu() {
        writeBox({1 + 0.4f * number(), 1, 1 + 0.4f * number()});
        field_.setMesh(hostMeshIndex_, hostMesh_);
    }
    void writeBox(const glm::vec3& scale) const {
        const Mesh box = boxMesh();
        std::vector<glm::vec3> corners;
        for (const std::uint32_t index : box.indices) corners.push_back(scale * box.positions[index]);
        glNamedBufferSubData(hostMesh_.positions.buffer, 0, static_cast<GLsizeiptr>(12 * corners.size()),
                             corners.data());
    }
    void add() {
        if (things_.size() >= kMostThings) return remove();
        const std::size_t mesh = field_.addMesh(within(2) == 0 ? boxMesh() : sphereMesh(6 + within(4), 5));
        Instance instance;
        instance.mesh = static_cast<int>(mesh);
        instance.material = within(static_cast<int>(scene_.materials.size()));
        instance.worldFromObject = placed();
        things_.emplace_back(field_.addInstance(instance), mesh);
    }
    void remove() {
        if (things_.empty()) return;
        const auto [instance, mesh] = things_.back();
        things_.pop_back();
        field_.removeInstance(instance);
        field_.removeMesh(mesh);
    }
    void lamps() {
        std::vector<Light> lights = scene_.lights;
        for (int i = within(3); i > 0; --i) {
            lights.push_back(lights.front());
            lights.back().position = place();
            lights.back().intensity = glm::vec3(0.3f);
        }
        field_.setLights(lights);
    }
    void texels() {
        Texture texture;
        texture.width = texture.height = 1 + within(8);
        for (int i = 0; i < 4 * texture.width * texture.height; ++i)
            texture.rgba.push_back(static_cast<std::uint8_t>(within(256)));
        field_.setTexture(0, texture);
    }
    void paint() {
        Material material = scene_.materials[1];
        material.baseColor = glm::vec4(glm::abs(place()), 1);
        material.emission = glm::vec3(within(4) == 0 ? 0.5f : 0.0f);
        field_.setMaterial(1, material);
    }

    LightField& field_;
    const Scene& scene_;
    HostSurfaces surfaces_;
    HostMesh hostMesh_;
    std::size_t hostMeshIndex_ = 0, hostInstance_ = 0;
    Scene now_;
    std::vector<std::pair<std::size_t, std::size_t>> things_;  // that came: instance and mesh
    std::mt19937 random_;
    int view_ = 0, frames_ = 0;
};

class LightFieldSoak : public LightFieldRig {
  protected:
    void SetUp() override {
        LightFieldRig::SetUp();
        for (Mesh& mesh : scene_.meshes) mesh.uvs.assign(mesh.positions.size(), {0.3f, 0.6f});
        scene_.textures.emplace_back();
        scene_.textures[0].width = scene_.textures[0].height = 1;
        scene_.textures[0].rgba.assign(4, 200);
        scene_.materials[0].baseColorTexture.texture = 0;
        glCreateBuffers(1, &buffer_);
        glNamedBufferStorage(buffer_, 12 * 36, nullptr, GL_DYNAMIC_STORAGE_BIT);
    }
    void TearDown() override {
        glDeleteBuffers(1, &buffer_);
        LightFieldRig::TearDown();
    }
    // Frames of one seed, the state of the host looked at after each.
    void turn(ChangingHost& host, unsigned seed) {
        host.begin(seed);
        for (int frame = 0; frame < kFramesOfTurn && !HasFailure(); ++frame) {
            host.frame();
            EXPECT_TRUE(snapshot() == state_) << "seed " << seed << ", frame " << frame;
        }
        host.rest();
    }

    GLuint buffer_ = 0;
    Snapshot state_;
};

TEST_F(LightFieldSoak, FramesWithChangesLeaveNothingBehind) {
    const char* asked = std::getenv("CONELIGHT_SOAK_FRAMES");
    const int wanted = asked != nullptr ? std::atoi(asked) : kTurns * kFramesOfTurn;
    HostPicture picture(scene_, lens());
    drawn(picture);
    const HostState odd;  // as no pass of the library wants it
    odd.set();
    LightField field;
    ChangingHost host(field, scene_, picture.surfaces(), buffer_);
    state_ = snapshot();
    turn(host, 1);
    const HeldObjects first = heldObjects();
    std::size_t heap = 0, mostHeap = 0;
    for (unsigned seed = 2; host.frames() < wanted && !HasFailure(); ++seed) {
        turn(host, seed);
        EXPECT_EQ(heldObjects(), first) << seed;
        // The first turns fill the library with programs.
        if (host.frames() <= wanted / 2)
            heap = std::max(heap, heapBytes());
        else
            mostHeap = std::max(mostHeap, heapBytes());
        if (asked == nullptr || seed % 50 != 0) continue;
        std::printf("%d frames: heap %.1f MB\n", host.frames(), static_cast<double>(heapBytes()) / (1 << 20));
        std::fflush(stdout);
    }
    // Short runs build programs to their end.
    constexpr int kManyFrames = 2000;
    if (wanted >= kManyFrames) {
        EXPECT_LE(static_cast<double>(mostHeap), 1.1 * static_cast<double>(heap));
    }
    EXPECT_GE(host.frames(), wanted);
    std::size_t bytes = 0, objects = 0;
    for (const auto& [key, one] : first) {
        objects += static_cast<std::size_t>(one.first);
        bytes += one.second;
    }
    std::printf(
        "%d frames, each with the host's state as it was; %zu objects of %.1f MB at rest, after each turn "
        "the same; heap %.1f MB at most in the first half, %.1f MB in the second\n",
        host.frames(), objects, static_cast<double>(bytes) / (1 << 20), static_cast<double>(heap) / (1 << 20),
        static_cast<double>(mostHeap) / (1 << 20));
}

}  // namespace
}  // namespace conelight::test

// SPDX-License-Identifier: MIT
// Random commands of the console for a long time, on one renderer: scenes that are opened, edited, animated, and
// drawn in all modes and sizes. Every so often the picture is that of a fresh renderer, bit for bit, and OpenGL
// objects are as many and as large as its own. The host's memory does not grow where the same commands come again.
//
// A seed gives the same commands. CONELIGHT_SOAK_SECONDS=N goes on with other seeds for so long (tools/soak). The heap of
// the later half is that of the earlier.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <map>
#include <random>

#include "conelight/console/console.h"
#include "conelight/error.h"
#include "conelight/renderer.h"
#include "conelight/scene_upload.h"
#include "conelight/thesis/settings.h"
#include "support/gl_fixture.h"
#include "support/heap.h"
#include "support/moving_scene.h"

namespace conelight::test {
namespace {

using namespace program;

// Objects by label, programs left out: those asked for last stay (gl::ProgramLibrary).
using Held = std::map<std::string, std::pair<int, std::size_t>>;  // how many, bytes

Held held() {
    Held held;
    for (const gl::LiveObject& object : gl::liveObjects()) {
        if (object.type == gl::ObjectType::Program) continue;
        auto& [count, bytes] = held[object.label];
        ++count;
        bytes += object.bytes;
    }
    return held;
}

std::size_t programCount() {
    const std::vector<gl::LiveObject> all = gl::liveObjects();
    return static_cast<std::size_t>(std::count_if(all.begin(), all.end(), [](const gl::LiveObject& object) {
        return object.type == gl::ObjectType::Program;
    }));
}

// Labels of which there is more than before; empty: none.
std::string more(const Held& now, const Held& before) {
    std::string text;
    for (const auto& [label, one] : now) {
        const auto found = before.find(label);
        const auto [count, bytes] = found == before.end() ? std::pair<int, std::size_t>() : found->second;
        if (one.first > count || one.second > bytes)
            text += fmt::format("'{}': {} of {} bytes, not {} of {}; ", label, one.first, one.second, count,
                                bytes);
    }
    return text;
}

std::size_t medianOf(std::vector<std::size_t> all) {
    const auto middle = all.begin() + std::ssize(all) / 2;
    std::nth_element(all.begin(), middle, all.end());
    return *middle;
}

constexpr int kSteps = 40;  // of a pass
constexpr int kPasses = 2;  // with other commands, at least
// A pass asks for more than twice as many programs, so that most are deleted and built again.
constexpr std::size_t kFewPrograms = 48;
constexpr std::size_t kOfAPicture = 40;  // more programs than a picture asks for here

class Soak {
  public:
    explicit Soak(std::vector<std::string> scenes) : scenes_(std::move(scenes)) {
        renderer_ = std::make_unique<Renderer>();
        open();
    }

    void begin(unsigned seed) {
        random_.seed(seed);
        renderer_->setDynamic(false);
        open();
    }

    // One command, and the picture after it.
    void step() {
        run(command());
        if (within(8) == 0) size_ = {8 + within(60), 8 + within(44)};
        if (within(12) == 0) renderer_->setDynamic(within(2) == 0);
        draw(*renderer_, upload_);
        if (within(6) == 0) renderer_->inspectPixel(within(size_.x), within(size_.y));
    }

    // The scene and the settings as they are, from the beginning: by this renderer and by a fresh one.
    void compareWithFresh() {
        renderer_->setDynamic(false);
        run("set traced.budgeted false; set image.temporal off; set view.wireframe off");
        upload_.forget();
        const Image soaked = draw(*renderer_, upload_);
        Renderer other;
        SceneUpload upload;
        EXPECT_EQ(soaked.pixels, draw(other, upload).pixels) << last_;
    }

    // A picture of nothing special, so that what is held can be compared. Other looks before it: what they keep of
    // a few bytes is made when it is first needed, once per renderer.
    void rest() {
        renderer_->setDynamic(false);
        size_ = {32, 24};
        session_ = Session();
        open(scenes_.front());
        upload_.forget();
        for (const char* look :
             {"set component shadow_map", "set component voxels", "set view.wireframe objects",
              "set image.antialiasing 2", "set image.exposure auto; set image.bloom 0.1",
              "set component full; set view.wireframe off"}) {
            run(look);
            draw(*renderer_, upload_);
        }
        // Tables keep the room of what was longest: more lights than commands add.
        std::string lights;
        for (int i = 0; i < kSteps; ++i) lights += "light add point; ";
        run(lights);
        draw(*renderer_, upload_);
        open(scenes_.front());
        upload_.forget();
        draw(*renderer_, upload_);
    }
    int refused() const { return refused_; }
    int commands() const { return commands_; }

  private:
    int within(int count) { return static_cast<int>(random_() % static_cast<unsigned>(count)); }
    template <class T>
    const T& anyOf(const std::vector<T>& all) {
        return all[static_cast<std::size_t>(within(static_cast<int>(all.size())))];
    }
    std::string number(int low, int high, int parts) {
        return fmt::format("{:g}",
                           (low * parts + within((high - low) * parts + 1)) / static_cast<double>(parts));
    }

    void open() { open(anyOf(scenes_)); }
    void open(const std::string& scene) {
        session_.open(scene, false);
        console_.emplace(session_, [this](const ConsoleLine& line) { refused_ += line.isError; });
        run("set voxels.size 16; set light.shadow_size 64; set light.area_samples 1; set traced.passes 2; "
            "set traced.cache_updates 3; set image.antialiasing 0; set light.caustics 1024; set "
            "cones.bounces 1");
    }
    void run(const std::string& text) {
        last_ = text;
        ++commands_;
        console_->submit(text);
        while (!console_->idle()) {
            console_->runQueued();
            while (std::optional<Request> request = session_.takeRequest())
                if (request->kind == RequestKind::Load) session_.open(request->file, request->keepView);
            if (session_.playing()) session_.finishPlaying();
            console_->endWait();
        }
    }
    std::string object() {
        const std::vector<Instance>& all = session_.scene().instances;
        return all.empty() ? "none" : quoted(anyOf(all).name);
    }
    std::string light() {
        const std::vector<Light>& all = session_.scene().lights;
        return all.empty() ? "none" : std::to_string(within(static_cast<int>(all.size())));
    }
    std::string setting() {
        static const std::vector<std::pair<const char*, std::vector<std::string>>> kSettings{
            {"voxels.size", {"8", "16", "24", "32"}},
            {"voxels.padding", {"0", "0.03", "0.5"}},
            {"light.shadow_size", {"0", "64", "128"}},
            {"light.shadow_filter", {"0", "2"}},
            {"light.area_samples", {"1", "4"}},
            {"light.emissive_quads", {"true", "false"}},
            {"light.caustics", {"0", "1024"}},
            {"component",
             {"full", "full", "full", "direct", "indirect", "specular", "occlusion", "albedo", "voxels",
              "emission", "shadow_map", "depth"}},
            {"cones.storage", {"dense", "octree"}},
            {"cones.directional", {"isotropic", "six"}},
            {"cones.diffuse_set", {"one", "five", "best_9", "fibonacci"}},
            {"cones.bounces", {"0", "1", "2"}},
            {"cones.indirect", {"cones", "cache"}},
            {"cones.shadows", {"maps", "cones"}},
            {"cones.fractional_levels", {"true", "false"}},
            {"phong.shadows", {"on", "off"}},
            {"thesis.storage", {"dense", "octree"}},
            {"thesis.published", {"true", "false"}},
            {"thesis.bounces", {"1", "2"}},
            {"traced.quality", {"draft", "interactive"}},
            {"traced.passes", {"1", "2"}},
            {"traced.cache_updates", {"1", "4"}},
            {"traced.pixel_rays", {"0", "1", "2"}},
            {"traced.filter_levels", {"0", "3"}},
            {"traced.bounces", {"0", "2", "all"}},
            {"traced.exact_shadows", {"true", "false"}},
            {"traced.exact_mirrors", {"true", "false"}},
            {"traced.budgeted", {"true", "false"}},
            {"image.temporal", {"on", "off"}},
            {"image.antialiasing", {"0", "2"}},
            {"image.exposure", {"auto", "1"}},
            {"image.bloom", {"0", "0.1"}},
            {"view.wireframe", {"off", "objects"}},
            {"view.voxels", {"true", "false"}},
        };
        const auto& [key, values] =
            kSettings[static_cast<std::size_t>(within(static_cast<int>(std::size(kSettings))))];
        std::string text = std::string("set ") + key + " " + anyOf(values);
        // A quality brings its own passes.
        if (std::string(key) == "traced.quality") text += "; set traced.passes 2; set traced.cache_updates 3";
        return text;
    }
    std::string edit() {
        switch (within(13)) {
            case 0:
                return "translate " + object() + " " + anyOf<std::string>({"x", "y", "z"}) + " " +
                       number(-1, 1, 8);
            case 1:
                return "rotate " + object() + " y " + number(-90, 90, 1);
            case 2:
                return "scale " + object() + " " + number(1, 2, 4);
            case 3:
                return "duplicate " + object();
            case 4:
                return "delete " + object();
            case 5:
                return anyOf<std::string>({"hide ", "show ", "moving "}) + object();
            case 6:
                return "material " + object() + " " +
                       anyOf<std::string>({"roughness 0.3", "metallic 1", "metallic 0", "transmission 1",
                                           "transmission 0", "emission 1 2 3", "color 0.2 0.5 0.9"});
            case 7:
                return "light add " + anyOf<std::string>({"point", "spot", "directional", "rect"});
            case 8:
                return "light " + light() + " " +
                       anyOf<std::string>({"intensity 2 2 1", "position 0.2 0.5 0.1", "delete", "off", "on"});
            case 9:
                return "sky " + number(0, 2, 4);
            case 10:
                return "environment " + anyOf<std::string>({"builtin:sky", "none"});
            case 11:
                return "camera orbit " + number(-40, 40, 1) + " " + number(-10, 10, 1);
            default:
                return anyOf<std::string>({"undo", "undo", "undo", "redo"});
        }
    }
    std::string command() {
        const int kind = within(20);
        if (kind == 0) {
            open();
            return "list";
        }
        if (kind <= 3) return "mode " + anyOf<std::string>({"traced", "cones", "hybrid", "thesis", "phong"});
        if (kind <= 10) return setting();
        if (kind <= 12 && !session_.clips().empty())
            return anyOf<std::string>({"clip rest", "clip at " + number(0, 1, 8), "clip show 0"});
        return edit();
    }
    Image draw(Renderer& renderer, SceneUpload& upload) {
        upload.follow(renderer, session_);
        Settings settings = session_.shownSettings();
        renderer.render(session_.camera(), size_.x, size_.y, settings);
        renderer.displayTexture(settings.image);
        return renderer.readImage();
    }

    std::vector<std::string> scenes_;
    std::mt19937 random_;
    Session session_;
    std::optional<Console> console_;
    std::unique_ptr<Renderer> renderer_;
    SceneUpload upload_;
    glm::ivec2 size_{32, 24};
    std::string last_;
    int refused_ = 0, commands_ = 0;
};

struct SoakTest : public GlTest {
    static std::vector<std::string> scenes() {
        return {"builtin:cornell",          "builtin:sunroom", risingBlock("rises.gltf"),
                growingBlock("grows.gltf"), "builtin:colours", "builtin:lanterns"};
    }
    // One pass; what is held at its end.
    static Held pass(Soak& soak, unsigned seed) {
        soak.begin(seed);
        for (int step = 1; step <= kSteps; ++step) {
            soak.step();
            if (step % (kSteps / 4) == 0) soak.compareWithFresh();
            if (HasFailure()) {
                ADD_FAILURE() << "seed " << seed << ", step " << step;
                break;
            }
        }
        soak.rest();
        return held();
    }
    // Passes with other commands, kPasses at least and for so long. The heap after each depends on the programs that
    // are kept, which differ; its median does not grow.
    static void goOn(Soak& soak, const Held& first, int seconds) {
        const std::size_t mostPrograms = seconds > 0 ? gl::kMostPrograms : kFewPrograms;
        gl::setMostPrograms(mostPrograms);
        const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(seconds);
        std::vector<std::size_t> heaps;
        while (!HasFailure() && (std::ssize(heaps) < kPasses || std::chrono::steady_clock::now() < end)) {
            const unsigned seed = 2 + static_cast<unsigned>(heaps.size());
            EXPECT_EQ(more(pass(soak, seed), first), "") << seed;
            EXPECT_LE(programCount(), mostPrograms + kOfAPicture) << seed;
            heaps.push_back(heapBytes());
            std::printf("seed %u: %d commands, %zu programs, heap %.1f MB\n", seed, soak.commands(),
                        programCount(), static_cast<double>(heaps.back()) / (1 << 20));
            std::fflush(stdout);
        }
        // The first passes fill the library with programs.
        constexpr std::ptrdiff_t kFilling = 4, kLeast = 12;
        if (std::ssize(heaps) < kLeast) return;
        const auto middle = heaps.begin() + (kFilling + std::ssize(heaps)) / 2;
        const auto earlier = static_cast<double>(medianOf({heaps.begin() + kFilling, middle}));
        const auto later = static_cast<double>(medianOf({middle, heaps.end()}));
        // Passes are up to 1.5 times apart, by the programs that they ask for.
        EXPECT_LE(later, 1.25 * earlier) << "bytes of the heap";
    }
};

TEST_F(SoakTest, RandomCommandsLeaveNothingBehind) {
    gl::setMostPrograms(kFewPrograms);
    Soak soak(scenes());
    const Held first = pass(soak, 1);
    // The same again: nothing may be more. What drivers do on threads of their own after the first pass, such as
    // keeping programs on disk, is done after the second.
    EXPECT_EQ(more(pass(soak, 1), first), "");
    // What is not given back is more after each pass. Threads of a driver take pools of megabytes and leave them, in
    // passes that differ from run to run. Without threads a driver that keeps its programs on disk holds the same after
    // each; one that translates them again keeps a hundred kilobytes.
    const char* threads = std::getenv("LP_NUM_THREADS");
    const std::ptrdiff_t slack = threads != nullptr && std::string(threads) == "0" ? 1 << 18 : 1 << 22;
    std::size_t before = heapBytes();
    auto least = std::numeric_limits<std::ptrdiff_t>::max();
    for (int i = 0; i < 4; ++i) {
        EXPECT_EQ(more(pass(soak, 1), first), "");
        const std::size_t now = heapBytes();
        least = std::min(least, static_cast<std::ptrdiff_t>(now - before));
        before = now;
    }
    EXPECT_LE(least, slack);
    EXPECT_LE(programCount(), kFewPrograms + kOfAPicture);
    // Most commands do something.
    EXPECT_LT(4 * soak.refused(), soak.commands());

    const char* seconds = std::getenv("CONELIGHT_SOAK_SECONDS");
    goOn(soak, first, seconds == nullptr ? 0 : std::atoi(seconds));
}

}  // namespace
}  // namespace conelight::test

// SPDX-License-Identifier: MIT
#include "reference/beam_tracer.h"

#include <algorithm>
#include <thread>
#include <utility>

#include "base/clock.h"
#include "base/log.h"
#include "reference/beam_raster.h"
#include "reference/radiosity_parallel.h"

namespace conelight::reference {
namespace {

constexpr int kMostLampPoints = 16;
constexpr int kMostSide = 16384;

void checkArguments(const Camera& camera, int width, int height, const BeamSettings& s) {
    if (width < 1 || height < 1 || width > kMostSide || height > kMostSide)
        base::fail(ErrorKind::Usage, "beams: picture of %d x %d pixels; right would be 1 to %d a side", width,
                   height, kMostSide);
    if (s.lampPoints < 1 || s.lampPoints > kMostLampPoints || s.bounces < -1 || s.threads < 0)
        base::fail(
            ErrorKind::Usage,
            "beams: bounces %d, lamp points %d, threads %d; right would be -1 or more, 1 to %d, 0 or more",
            s.bounces, s.lampPoints, s.threads, kMostLampPoints);
    if (!(camera.zNear > 0 && camera.zFar > camera.zNear))
        base::fail(ErrorKind::Usage, "beams: camera sees from %g to %g m; right would be 0 < near < far",
                   static_cast<double>(camera.zNear), static_cast<double>(camera.zFar));
}

// The parts of all beams, and within them what each lamp lights, as pieces of the picture.
class Pieces {
  public:
    Pieces(const BeamScene& scene, const std::vector<LitParts>& lit, const BeamTree& tree, const Lens& lens,
           const glm::dvec2& size)
        : scene_(scene), lit_(lit), tree_(tree), lens_(lens), size_(size) {
        int part = 0;
        for (const Beam& beam : tree.beams) {
            firstPart_.push_back(part);
            part += static_cast<int>(beam.parts.size());
        }
        for (std::size_t b = 0; b < tree.beams.size(); ++b)
            for (std::size_t p = 0; p < tree.beams[b].parts.size(); ++p) addPart(b, p);
    }
    std::vector<BeamPiece> take() { return std::move(pieces_); }

  private:
    void addPart(std::size_t beamIndex, std::size_t partIndex) {
        const Beam& beam = tree_.beams[beamIndex];
        const BeamPart& part = beam.parts[partIndex];
        const BeamPolygon* polygon = part.polygon == kNoPolygon ? nullptr : &scene_.polygons()[part.polygon];
        BeamPiece piece;
        piece.what = {static_cast<int>(beamIndex), part.polygon, BeamLight::kOwn};
        piece.part = firstPart_[beamIndex] + static_cast<int>(partIndex);
        if (beam.parent >= 0) piece.mirrorPart = firstPart_[std::size_t(beam.parent)] + beam.parentPart;
        piece.depth = beam.depth;
        piece.covers = polygon == nullptr || polygon->triangleCount > 0;
        // A lamp that is seen in one mirror is direct light on that mirror, as the path tracer has it.
        piece.direct = beam.depth == 0 || (beam.depth == 1 && polygon != nullptr && polygon->quadLamp);
        piece.textured = polygon != nullptr && polygon->textured;
        for (const Beam* b = &beam; b->parent >= 0; b = &tree_.beams[std::size_t(b->parent)])
            piece.textured |= scene_.polygons()[b->mirror].textured;
        show(piece, beam, part.corners);
        piece.direct = beam.depth == 0;
        if (polygon == nullptr || polygon->unlit || polygon->triangleCount == 0) return;
        const std::vector<BeamPlane> sides = sidesOf(beam.apex, part.corners);
        BeamBox box;
        box.grow(part.corners);
        for (std::size_t lamp = 0; lamp < lit_.size(); ++lamp) {
            piece.what.lamp = static_cast<int>(lamp);
            addLit(piece, beam, part, sides, box);
        }
    }

    // What a lamp lights of a part.
    void addLit(const BeamPiece& piece, const Beam& beam, const BeamPart& part,
                const std::vector<BeamPlane>& sides, const BeamBox& box) {
        const auto lamp = static_cast<std::size_t>(piece.what.lamp);
        const BeamPolygon& polygon = scene_.polygons()[part.polygon];
        if (!scene_.lamps()[lamp].castsShadow) return show(piece, beam, part.corners);
        // A surface is in its own way, unless it casts no shadow.
        const bool sameSide =
            scene_.lamps()[lamp].apex.side(polygon.plane) * beam.apex.side(polygon.plane) > 0;
        if (!sameSide && polygon.castsShadow) return;
        for (const Corners& lit : lit_[lamp][part.polygon]) {
            BeamBox litBox;
            litBox.grow(lit);
            if (!litBox.meets(box, 0)) continue;
            Corners both = lit;
            if (std::all_of(sides.begin(), sides.end(),
                            [&](const BeamPlane& side) { return keepFront(both, side, 0); }))
                show(piece, beam, both);
        }
    }

    void show(BeamPiece piece, const Beam& beam, const Corners& corners) {
        piece.low = glm::dvec2(1e300);
        piece.high = glm::dvec2(-1e300);
        for (const glm::dvec3& corner : corners) {
            const glm::dvec2 place(lens_.placeOf(glm::dvec3(beam.unfolded * glm::dvec4(corner, 1))));
            const glm::dvec2 pixels = glm::dvec2(place.x + 1, 1 - place.y) * 0.5 * size_;
            piece.corners.push_back(pixels);
            piece.low = glm::min(piece.low, pixels);
            piece.high = glm::max(piece.high, pixels);
        }
        pieces_.push_back(std::move(piece));
    }

    const BeamScene& scene_;
    const std::vector<LitParts>& lit_;
    const BeamTree& tree_;
    const Lens& lens_;
    glm::dvec2 size_;
    std::vector<int> firstPart_;
    std::vector<BeamPiece> pieces_;
};

// Steps of the work, as parts of its whole; chosen by eye.
class Progress {
  public:
    explicit Progress(const std::function<bool(double)>& report) : report_(report) {}
    bool at(double done) {
        goesOn_ = goesOn_ && (!report_ || report_(done));
        return goesOn_;
    }
    bool goesOn() const { return goesOn_; }

  private:
    const std::function<bool(double)>& report_;
    bool goesOn_ = true;
};

}  // namespace

BeamPicture traceBeams(const Scene& scene, const Camera& camera, int width, int height,
                       const BeamSettings& settings, const std::function<bool(double)>& onProgress) {
    checkArguments(camera, width, height, settings);
    const double cpuStart = base::processCpuMs(), wallStart = base::wallMs();
    const int cores = static_cast<int>(std::max(std::thread::hardware_concurrency(), 1u));
    const int threads = settings.threads > 0 ? settings.threads : cores;
    Progress progress(onProgress);
    const BeamScene polygons(scene, settings.emissiveQuads, settings.lampPoints);
    const Lens lens(camera, width, height);

    std::vector<LitParts> lit(polygons.lamps().size());
    for (std::size_t i = 0; i < lit.size() && progress.at(0.3 * double(i) / double(lit.size())); ++i)
        lit[i] = litParts(polygons, polygons.lamps()[i]);
    BeamTreeSettings treeSettings;
    if (settings.bounces >= 0)
        treeSettings.mostMirrors = std::min(settings.bounces, treeSettings.mostMirrors);
    treeSettings.background = !scene::Surroundings(scene).isBlack();
    BeamTree tree;
    if (progress.goesOn()) tree = beamTree(polygons, lens, treeSettings, [&] { return progress.at(0.3); });

    BeamFilm film(width, height);
    BeamPicture picture;
    if (progress.goesOn()) {
        const std::vector<BeamPiece> pieces =
            Pieces(polygons, lit, tree, lens, glm::dvec2(width, height)).take();
        const BeamLight light(polygons, tree, lens);
        parallelFor(
            static_cast<std::size_t>(height), threads,
            [&](std::size_t begin, std::size_t end) {
                film.draw(pieces, light, lens, settings.filter, static_cast<int>(begin),
                          static_cast<int>(end));
            },
            [&](double done) { return progress.at(0.5 + 0.5 * done); });
    }
    picture.stopped = !progress.goesOn();
    picture.direct = std::move(film.direct);
    picture.mirrored = std::move(film.mirrored);
    picture.full = picture.direct;
    for (std::size_t i = 0; i < picture.full.pixels.size(); ++i) {
        picture.mirrored.pixels[i].a = picture.direct.pixels[i].a;
        picture.full.pixels[i] += glm::vec4(glm::vec3(picture.mirrored.pixels[i]), 0);
    }
    picture.stats = {polygons.polygons().size(),
                     polygons.order().partCount(),
                     tree.beams.size(),
                     tree.partCount(),
                     lit.size(),
                     0,
                     0,
                     0};
    for (const LitParts& ofLamp : lit)
        for (const std::vector<Corners>& parts : ofLamp) picture.stats.litParts += parts.size();
    picture.stats.cpuSeconds = (base::processCpuMs() - cpuStart) * 1e-3;
    picture.stats.wallSeconds = (base::wallMs() - wallStart) * 1e-3;
    return picture;
}

}  // namespace conelight::reference

// SPDX-License-Identifier: MIT
// Beam tracing: parts fill the picture, shadows end where they should, direct light and mirrors are those of the path
// tracer, edges those of very many samples; what beams cannot show is refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "conelight/error.h"
#include "io/generated.h"
#include "reference/beam_tracer.h"
#include "reference/beam_tree.h"
#include "support/truth_rig.h"

namespace conelight::test {
namespace {

using namespace reference;

constexpr int kWidth = 64, kHeight = 48;

const Scene& mirrorHall() {
    static const Scene scene = io::generateScene("mirror-hall");
    return scene;
}

BeamPicture beams(const Scene& scene, PixelFilter filter = PixelFilter::Center, BeamSettings settings = {}) {
    settings.filter = filter;
    return traceBeams(scene, scene.cameras.at(0), kWidth, kHeight, settings);
}

PathTracedPicture paths(const Scene& scene, PixelFilter filter, int samples) {
    PathTracerSettings settings;
    settings.paths = Paths::Mirrors;
    settings.filter = filter;
    settings.samplesPerPixel = samples;
    return PathTracer(scene).render(scene.cameras.at(0), kWidth, kHeight, settings);
}

Material mirror(float reflectance) {
    Material m;
    m.baseColor = glm::vec4(glm::vec3(reflectance), 1);
    m.metallic = 1;
    m.roughness = 0;
    return m;
}

TEST(Beams, EqualThePathTracerAtPixelCentres) {
    const BeamPicture drawn = beams(mirrorHall());
    const PathTracedPicture truth = paths(mirrorHall(), PixelFilter::Center, 128);
    EXPECT_GT(drawn.stats.beams, 20u);
    EXPECT_GT(meanOf(drawn.mirrored), 0.1 * meanOf(drawn.direct));
    // Direct light of point lamps has no noise: rounding. Paths end at mirrors by chance: 0.5 % for 128 of them.
    EXPECT_LT(relRmse(drawn.direct, truth.direct), 0.001);
    EXPECT_LT(relRmse(drawn.full, truth.full), 0.01);
    for (std::size_t i = 0; i < drawn.full.pixels.size(); ++i) EXPECT_EQ(drawn.full.pixels[i].a, 1.0f) << i;
}

TEST(Beams, EdgesAreThoseOfManySamples) {
    const PathTracedPicture truth = paths(mirrorHall(), PixelFilter::Box, 512);
    const BeamPicture areas = beams(mirrorHall(), PixelFilter::Box), points = beams(mirrorHall());
    // Half of it is the truth's own noise. One point per pixel shows stairs.
    const double ofAreas = relRmse(areas.full, truth.full);
    EXPECT_LT(ofAreas, 0.01);
    EXPECT_GT(relRmse(points.full, truth.full), 8 * ofAreas);
    // Parts are disjoint and leave no gap.
    for (std::size_t i = 0; i < areas.full.pixels.size(); ++i)
        EXPECT_NEAR(areas.full.pixels[i].a, 1, 1e-5) << i;
}

// What a lamp lights of a floor below a square: all but the square's shadow, twice as wide.
TEST(Beams, ShadowsAreExactPolygons) {
    Scene scene;
    addInstance(scene, quadMesh({-4, 0, 4}, {8, 0, 0}, {0, 0, -8}), diffuseMaterial());
    addInstance(scene, quadMesh({-0.5f, 1, 0.5f}, {1, 0, 0}, {0, 0, -1}), diffuseMaterial());
    Light lamp;
    lamp.position = {0.3f, 2, -0.2f};
    scene.lights.push_back(lamp);
    const BeamScene polygons(scene, true, 4);
    ASSERT_EQ(polygons.polygons().size(), 2u);  // two triangles are one quadrangle
    const LitParts lit = litParts(polygons, polygons.lamps().at(0));
    const auto areaOf = [](const std::vector<Corners>& parts) {
        double area = 0;
        for (const Corners& part : parts)
            for (std::size_t i = 2; i < part.size(); ++i)
                area += 0.5 * glm::length(glm::cross(part[i - 1] - part[0], part[i] - part[0]));
        return area;
    };
    EXPECT_NEAR(areaOf(lit[0]), 64 - 4, 1e-6);
    EXPECT_NEAR(areaOf(lit[1]), 1, 1e-9);
    for (const Corners& part : lit[0]) {
        // The shadow: from the lamp through the square's corners, one metre further.
        const glm::dvec3 middle = centroidOf(part);
        EXPECT_FALSE(middle.x > -1.3 && middle.x < 0.7 && middle.z > -0.8 && middle.z < 1.2);
    }
}

// Between two mirrors the lamp-lit floor repeats, each image darker by their reflectance; --bounces counts them.
TEST(Beams, MirrorsFollowEachOther) {
    Scene scene;
    addInstance(scene, quadMesh({-1, 0, 5}, {2, 0, 0}, {0, 0, -10}), diffuseMaterial());
    addInstance(scene, quadMesh({-1, -1, 5}, {0, 0, -10}, {0, 9, 0}), mirror(0.8f));
    addInstance(scene, quadMesh({1, -1, -5}, {0, 0, 10}, {0, 9, 0}), mirror(0.8f));
    scene.materials[1].doubleSided = scene.materials[2].doubleSided = true;
    Camera camera;
    camera.eye = {0, 1, 4};
    camera.target = {1, 0.9f, 2.5f};
    const Lens lens(camera, 8, 8);
    const BeamScene polygons(scene, true, 4);
    BeamTreeSettings settings;
    for (const int most : {0, 1, 3}) {
        settings.mostMirrors = most;
        const BeamTree tree = beamTree(polygons, lens, settings);
        int deepest = 0;
        for (const Beam& beam : tree.beams) {
            deepest = std::max(deepest, beam.depth);
            if (beam.parent < 0) continue;
            const Beam& from = tree.beams[static_cast<std::size_t>(beam.parent)];
            // The apex behind each mirror is the image of the one before, 0.8 of the light or more is left.
            EXPECT_NEAR(std::fabs(beam.apex.place.x + from.apex.place.x), 2, 1e-9);
            EXPECT_GE(beam.share, 0.8 * from.share - 1e-6);
            // Unfolded, all apices are the eye.
            const glm::dvec3 eye(beam.unfolded * glm::dvec4(beam.apex.place, 1));
            EXPECT_NEAR(glm::length(eye - glm::dvec3(camera.eye)), 0, 1e-9);
        }
        EXPECT_EQ(deepest, most);
    }
}

// Sky over a mirror: what a beam ends on may be nothing.
TEST(Beams, MirrorsShowTheSky) {
    Scene scene;
    addInstance(scene, quadMesh({-50, 0, 50}, {100, 0, 0}, {0, 0, -100}), mirror(1));
    scene.sky = {0.2f, 0.4f, 0.8f};
    Camera camera;
    camera.eye = {0, 1, 0};
    camera.target = {0, 0.8f, -1};
    scene.cameras.push_back(camera);
    for (const PixelFilter filter : {PixelFilter::Center, PixelFilter::Box}) {
        const BeamPicture drawn = beams(scene, filter);
        for (const glm::vec4& pixel : drawn.full.pixels)
            EXPECT_LT(glm::length(glm::vec3(pixel) - scene.sky), 1e-5f);
        EXPECT_GT(meanOf(drawn.mirrored), 0.1);
        EXPECT_GT(meanOf(drawn.direct), 0.1);
    }
}

TEST(Beams, LampsWithAnAreaAreLatticesOfPoints) {
    const Scene scene = io::generateScene("cornell");
    const PathTracedPicture truth = paths(scene, PixelFilter::Center, 64);
    double before = 1;
    for (const int points : {1, 3, 8}) {
        BeamSettings settings;
        settings.lampPoints = points;
        const double error = relRmse(beams(scene, PixelFilter::Center, settings).full, truth.full);
        EXPECT_LT(error, 0.5 * before) << points;
        before = error;
    }
    EXPECT_LT(before, 0.01);
}

TEST(Beams, SameBitsForAnyNumberOfThreads) {
    BeamSettings one, four;
    one.threads = 1;
    four.threads = 4;
    EXPECT_EQ(beams(mirrorHall(), PixelFilter::Box, one).full.pixels,
              beams(mirrorHall(), PixelFilter::Box, four).full.pixels);
}

TEST(Beams, WhatTheyCannotShowIsRefused) {
    const auto refused = [](const Scene& scene) -> std::string {
        try {
            beams(scene);
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::BadInput);
            return error.what();
        }
        return "drawn";
    };
    EXPECT_NE(refused(io::generateScene("glass")).find("lets light through"), std::string::npos);
    EXPECT_NE(refused(io::generateScene("mirrors?roughness=0.02")).find("curved mirror"), std::string::npos);
    EXPECT_EQ(refused(io::generateScene("mirrors?roughness=0.05")), "drawn");
    Scene masked = mirrorHall();
    masked.materials[0].alphaMode = AlphaMode::Mask;
    EXPECT_NE(refused(masked).find("masked"), std::string::npos);
    Scene many;
    Mesh mesh = quadMesh({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    for (std::size_t i = 0; i <= BeamScene::kMostTriangles / 2; ++i)
        mesh.indices.insert(mesh.indices.end(), {0, 1, 2, 0, 2, 3});
    addInstance(many, mesh, diffuseMaterial());
    many.cameras.emplace_back();
    EXPECT_NE(refused(many).find("triangles"), std::string::npos);
}

}  // namespace
}  // namespace conelight::test

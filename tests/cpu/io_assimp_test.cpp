// SPDX-License-Identifier: MIT
// Formats read through Assimp: hierarchy, materials, textures, units, smoothing; isolation from importers
// that crash, hang or eat memory; every test file of Assimp itself.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <functional>

#include "cpu/io_test_support.h"
#include "io/child_process.h"
#include "io/image_file.h"
#include "io/scene_stream.h"

namespace conelight {
namespace {

using namespace test;

constexpr const char* kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

Scene loadObj(const std::string& name, const std::string& obj, const std::string& mtl = "") {
    const std::filesystem::path folder = folderOf("obj_" + name);
    if (!mtl.empty()) write(folder / "m.mtl", mtl);
    return io::loadScene(write(folder / (name + ".obj"), obj));
}

Material objMaterial(const std::string& name, const std::string& mtl) {
    const Scene scene = loadObj(
        name, std::string("mtllib m.mtl\n") + kTriangle + "vt 0 0\nvt 1 0\nvt 0 1\nusemtl m\nf 1/1 2/2 3/3\n",
        "newmtl m\n" + mtl);
    return scene.materials.at(std::size_t(scene.instances.at(0).material));
}

void savePng(const std::filesystem::path& path, int w, int h,
             const std::function<std::array<std::uint8_t, 4>(int, int)>& texel) {
    io::ByteImage image{w, h, 4, {}};
    for (int y = 0; y < h; ++y)
        for (int x = 0; x < w; ++x)
            for (const std::uint8_t value : texel(x, y)) image.pixels.push_back(value);
    std::filesystem::create_directories(path.parent_path());
    io::writePng(path, image);
}

TEST(Assimp, CoatsOfMaterialLibrariesAreKept) {
    const Material m = objMaterial("coat", "Kd 0.1 0.2 0.3\nPc 0.75\nPcr 0.25\n");
    EXPECT_FLOAT_EQ(m.coat, 0.75f);
    EXPECT_FLOAT_EQ(m.coatRoughness, 0.25f);
    EXPECT_FALSE(hasLayers(objMaterial("no coat", "Kd 0.1 0.2 0.3\n")));
}

TEST(Assimp, PhongMaterialsBecomeMetallicRoughness) {
    const Material m =
        objMaterial("phong", "Kd 0.1 0.2 0.3\nKs 0.5 0.25 0\nNs 126\nKe 3 2 1\nd 0.5\nillum 2\n");
    EXPECT_FLOAT_EQ(m.baseColor.g, 0.2f);
    EXPECT_FLOAT_EQ(m.baseColor.a, 0.5f);
    EXPECT_EQ(m.alphaMode, AlphaMode::Blend);
    EXPECT_EQ(m.emission, glm::vec3(3, 2, 1));
    EXPECT_EQ(m.metallic, 0.0f);
    // alpha = sqrt(2/128) = 1/8, roughness = sqrt(1/8); F0 = 0.04 * specularColor = 0.08 Ks.
    EXPECT_NEAR(m.roughness, std::sqrt(0.125f), 1e-5f);
    EXPECT_FLOAT_EQ(m.specular, 1.0f);
    EXPECT_NEAR(m.specularColor.r, 1.0f, 1e-5f);
    EXPECT_NEAR(m.specularColor.g, 0.5f, 1e-5f);
    EXPECT_EQ(objMaterial("dull", "Kd 0.5 0.5 0.5\nKs 0 0 0\nNs 10\n").specular, 0.0f);
}

TEST(Assimp, TexturesAreFoundByTheirBareName) {
    savePng(std::filesystem::path(scratchDir()) / "obj_map/wood.png", 2, 2, [](int x, int) {
        return std::array<std::uint8_t, 4>{std::uint8_t(x * 200), 1, 2, 255};
    });
    const Scene scene = loadObj(
        "map",
        std::string("mtllib m.mtl\n") + kTriangle + "vt 0 1\nvt 1 1\nvt 0 0\nusemtl m\nf 1/1 2/2 3/3\n",
        "newmtl m\nKd 1 1 1\nmap_Kd C:\\stuff\\wood.png\n");
    const Material& m = scene.materials.at(std::size_t(scene.instances.at(0).material));
    ASSERT_TRUE(m.baseColorTexture.used());
    EXPECT_TRUE(scene.textures.at(0).srgb);
    EXPECT_EQ(scene.textures[0].rgba[4], 200);
    // OBJ's v runs upward, ours downward: v = 1 is the first row.
    const Mesh& mesh = scene.meshes.at(0);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
        EXPECT_FLOAT_EQ(mesh.uvs[i].y, mesh.positions[i].y > 0.5f ? 1.0f : 0.0f);
    const Scene lost = loadObj("lost", std::string("mtllib m.mtl\n") + kTriangle + "usemtl m\nf 1 2 3\n",
                               "newmtl m\nmap_Kd nowhere.png\n");
    EXPECT_TRUE(hasNote(lost, "nowhere.png"));
}

TEST(Assimp, BumpMapsAreHeightsUnlessTheyLookLikeNormals) {
    const std::filesystem::path folder = std::filesystem::path(scratchDir());
    // Brightness grows to the right: the surface rises, its normals lean left.
    savePng(folder / "obj_bump/h.png", 8, 8, [](int x, int) {
        return std::array<std::uint8_t, 4>{std::uint8_t(20 * x), std::uint8_t(20 * x), std::uint8_t(20 * x),
                                           255};
    });
    savePng(folder / "obj_bump/n.png", 4, 4, [](int, int) {
        return std::array<std::uint8_t, 4>{128, 128, 255, 255};
    });
    const std::string obj = std::string("mtllib m.mtl\n") + kTriangle +
                            "vt 0 0\nvt 1 0\nvt 0 1\nusemtl a\nf 1/1 2/2 3/3\nusemtl b\nf 1/1 2/2 3/3\n";
    const Scene scene =
        loadObj("bump", obj, "newmtl a\nKd 1 1 1\nmap_bump h.png\nnewmtl b\nKd 1 1 1\nmap_bump n.png\n");
    int seen = 0;
    for (const Texture& t : scene.textures) {
        EXPECT_FALSE(t.srgb);
        const std::uint8_t* texel = &t.rgba[4 * (std::size_t(t.width) * 2 + 2)];
        if (t.width == 8) {
            ++seen;
            EXPECT_LT(texel[0], 120) << "leans left";
            EXPECT_EQ(texel[1], 128);
            EXPECT_GT(texel[2], 230);
        } else {
            ++seen;
            EXPECT_EQ(texel[0], 128) << "taken as it is";
            EXPECT_EQ(texel[2], 255);
        }
    }
    EXPECT_EQ(seen, 2);
    for (const Mesh& mesh : scene.meshes) EXPECT_EQ(mesh.tangents.size(), mesh.positions.size());
}

TEST(Assimp, OpacityMapsBecomeMasks) {
    savePng(std::filesystem::path(scratchDir()) / "obj_leaf/c.png", 4, 4, [](int, int) {
        return std::array<std::uint8_t, 4>{10, 20, 30, 255};
    });
    savePng(std::filesystem::path(scratchDir()) / "obj_leaf/o.png", 2, 2, [](int x, int) {
        const std::uint8_t v = x == 0 ? 0 : 255;
        return std::array<std::uint8_t, 4>{v, v, v, 255};
    });
    const Scene scene = loadObj(
        "leaf",
        std::string("mtllib m.mtl\n") + kTriangle + "vt 0 0\nvt 1 0\nvt 0 1\nusemtl m\nf 1/1 2/2 3/3\n",
        "newmtl m\nKd 1 1 1\nmap_Kd c.png\nmap_d o.png\n");
    const Material& m = scene.materials.at(std::size_t(scene.instances.at(0).material));
    EXPECT_EQ(m.alphaMode, AlphaMode::Mask);
    const Texture& t = scene.textures.at(std::size_t(m.baseColorTexture.texture));
    EXPECT_EQ(t.rgba[3], 0);
    EXPECT_EQ(t.rgba[4 * 3 + 3], 255);
    EXPECT_EQ(t.rgba[4 * 3 + 1], 20);
}

// Two faces meeting at 45 degrees share a smooth normal, at 90 degrees they do not.
TEST(Assimp, SmoothsUpTo60Degrees) {
    const auto normals = [](double degrees) {
        const double a = degrees * 3.14159265358979 / 180;
        const std::string obj = "v 0 0 0\nv 0 0 1\nv -1 0 0\nv " + std::to_string(std::cos(a)) + " " +
                                std::to_string(-std::sin(a)) + " 0\nf 1 3 2\nf 1 2 4\n";
        return loadObj("bend" + std::to_string(int(degrees)), obj).meshes.at(0);
    };
    EXPECT_EQ(normals(45).positions.size(), 4u) << "shared edge";
    EXPECT_EQ(normals(90).positions.size(), 6u) << "hard edge";
}

TEST(Assimp, PolygonsPointsAndLines) {
    const Scene scene =
        loadObj("mixed", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 5 5 5\nf 1 2 3 4\nl 1 5\np 5\n");
    EXPECT_EQ(scene.triangleCount(), 2u);
    EXPECT_FLOAT_EQ(scene.bounds().max.x, 1.0f);
    EXPECT_TRUE(contains(loadError(write(folderOf("obj_points") / "p.obj", "v 0 0 0\nv 1 0 0\nl 1 2\n")),
                         "no triangles"));
}

// All of these are valid, and the same triangle.
TEST(Assimp, ObjSpellings) {
    const char* const spellings[] = {
        "\xEF\xBB\xBFv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
        "  v 0 0 0\n\tv 1 0 0\n \tv 0 1 0\n  f 1 2 3\n",
        "v\t0\t0\t0\t\nv\t1\t0\t0\nv\t0\t1\t0\nf\t1\t2\t3\t\n",
        "v 0 0 0 # a\nv 1 0 0 #b\nv 0 1 0# c\nf 1 2 3 # f 9\n",
        "v .0 +.0 -.0\nv +.1e+1 0 0\nv .0e-3 10.E-001 0\nf 1 2 3\n",
        "v 0 0 \\\n  .0\nv 1 0 0 \nv 0 1 0\nf 1 2 \\\n\t3 # end\n",
        "v 0 0 0\r\nv 1 0 0 # x\r\nv 0 1 0\r\nf 1 2 3\r\n",
    };
    int number = 0;
    for (const char* obj : spellings) {
        const Scene scene = loadObj("spelling" + std::to_string(number++), obj);
        ASSERT_EQ(scene.triangleCount(), 1u) << obj;
        EXPECT_EQ(scene.bounds().min, glm::vec3(0)) << obj;
        EXPECT_EQ(scene.bounds().max, glm::vec3(1, 1, 0)) << obj;
    }
    EXPECT_EQ(objMaterial("mtl_spelling", "\tKd .25 +.5 1e+0 # grey\n  Ns .2e2 # n\n").baseColor,
              glm::vec4(0.25f, 0.5f, 1, 1));
    const Scene named = loadObj("hash", std::string("mtllib m.mtl\n") + kTriangle + "usemtl a#b\nf 1 2 3\n",
                                "newmtl a#b\nKd 0 1 0\n");
    EXPECT_EQ(named.materials.at(std::size_t(named.instances.at(0).material)).name, "a#b");
}

// A pyramid along `axis`, 3 high, as an STL.
std::string pyramidAlong(int axis) {
    std::string text = "solid pyramid\n";
    const auto triangle = [&](std::array<std::array<float, 3>, 3> corners) {
        text += "facet normal 0 0 0\nouter loop\n";
        for (const auto& c : corners) {
            const std::array<float, 3> p = axis == 2 ? c : std::array<float, 3>{c[1], c[2], c[0]};
            text += fmt::format("vertex {} {} {}\n", p[0], p[1], p[2]);
        }
        text += "endloop\nendfacet\n";
    };
    const std::array<std::array<float, 3>, 4> base{{{-2, -1, 0}, {2, -1, 0}, {2, 1, 0}, {-2, 1, 0}}};
    for (std::size_t i = 0; i < 4; ++i) triangle({base[i], base[(i + 1) % 4], {0, 0, 3}});
    triangle({base[0], base[2], base[1]});
    triangle({base[0], base[3], base[2]});
    return text + "endsolid pyramid\n";
}

TEST(Assimp, StlStandsUprightWhicheverAxisItWasMadeAlong) {
    for (const int up : {1, 2}) {
        const Scene scene =
            io::loadScene(write(folderOf("stl") / ("t" + std::to_string(up) + ".stl"), pyramidAlong(up)));
        EXPECT_NEAR(scene.bounds().extent().y, 3.0f, 1e-4f) << up;
        EXPECT_NEAR(scene.bounds().min.y, 0.0f, 1e-4f) << up;
        const bool said = std::any_of(scene.notes.begin(), scene.notes.end(), [](const std::string& note) {
            return note.find("up axis") != std::string::npos;
        });
        EXPECT_EQ(said, up == 2);
    }
}

// A house on a wide yard, as OBJ or PLY: z up, or y up.
std::string houseFile(const std::string& extension, bool zUp, const std::string& comment) {
    std::vector<std::array<float, 3>> corners;
    for (const float half : {5.0f, 1.0f})
        for (const auto& [u, v] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
            corners.push_back({half * float(u), half * float(v), 0});
    corners.push_back({0, 0, 4});
    const std::array<int, 3> faces[] = {{0, 1, 2}, {0, 2, 3}, {4, 5, 8}, {5, 6, 8}, {6, 7, 8}, {7, 4, 8}};
    const bool ply = extension == ".ply";
    std::string text = ply ? fmt::format(
                                 "ply\nformat ascii 1.0\ncomment {}\nelement vertex 9\nproperty float x\n"
                                 "property float y\nproperty float z\nelement face 6\n"
                                 "property list uchar int vertex_indices\nend_header\n",
                                 comment)
                           : "# " + comment + "\n";
    for (const auto& c : corners)
        text += fmt::format("{}{} {} {}\n", ply ? "" : "v ", c[0], zUp ? c[1] : c[2], zUp ? c[2] : -c[1]);
    for (const auto& f : faces)
        text += ply ? fmt::format("3 {} {} {}\n", f[0], f[1], f[2])
                    : fmt::format("f {} {} {}\n", f[0] + 1, f[1] + 1, f[2] + 1);
    return text;
}

float heightOf(const std::string& name, const std::string& extension, const std::string& text,
               io::UpAxis up = io::UpAxis::Auto) {
    io::LoadOptions options;
    options.up = up;
    return io::loadScene(write(folderOf("up") / (name + extension), text), options).bounds().extent().y;
}

TEST(Assimp, WhatLiesOnAGroundIsTurnedUpright) {
    for (const std::string extension : {".obj", ".ply"})
        for (const bool zUp : {true, false})
            EXPECT_NEAR(heightOf(zUp ? "z" : "y", extension, houseFile(extension, zUp, "made by hand")), 4,
                        1e-4f)
                << extension << zUp;
    // The back of a shelf is no ground: it stands along y.
    const std::string shelf =
        "v 0 0 0\nv 4 0 0\nv 4 6 0\nv 0 6 0\nv 0 0 2\nv 0.2 0 2\nv 0 3 2\nv 4 0 2\nv 3.8 0 2\nv 4 3 2\n"
        "f 1 2 3\nf 1 3 4\nf 5 6 7\nf 8 9 10\n";
    EXPECT_NEAR(heightOf("shelf", ".obj", shelf), 6, 1e-4f);
}

TEST(Assimp, CommentsAndTheUserSayWhatIsUp) {
    const std::string tall = std::string(kTriangle) + "v 0 0 3\nf 1 2 4\nf 1 2 3\n";
    EXPECT_NEAR(heightOf("plain", ".obj", tall), 1, 1e-4f);
    for (const char* comment :
         {"# FreeCAD v0.20 build29177 Arch module\n", "# Axes: Z-up\n", "# up axis = z\n"})
        EXPECT_NEAR(heightOf("said", ".obj", comment + tall), 3, 1e-4f) << comment;
    for (const char* comment : {"# Blender 3.4.1\n", "# jazz up\n", "# z-upper part\n", "# y-up\n"})
        EXPECT_NEAR(heightOf("not", ".obj", comment + tall), 1, 1e-4f) << comment;
    EXPECT_NEAR(heightOf("blender", ".ply", houseFile(".ply", false, "Created by Blender 2.93")), 10, 1e-4f)
        << "exporters come before shapes";
    EXPECT_NEAR(heightOf("told", ".obj", houseFile(".obj", true, "-"), io::UpAxis::Y), 10, 1e-4f);
    EXPECT_NEAR(heightOf("x", ".obj", "v 0 0 0\nv 7 0 0\nv 0 1 0\nf 1 2 3\n", io::UpAxis::X), 7, 1e-4f);
    io::LoadOptions options;
    options.up = io::UpAxis::Z;
    EXPECT_THROW(io::loadScene("builtin:cornell", options), Error);
}

const char* const kCollada =
    R"(<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit name="centimeter" meter="0.01"/><up_axis>Z_UP</up_axis></asset>
<library_lights><light id="L"><technique_common><point><color>1 0.5 0.25</color></point></technique_common></light></library_lights>
<library_cameras><camera id="C"><optics><technique_common><perspective><yfov>30</yfov><aspect_ratio>1</aspect_ratio><znear>1</znear><zfar>1000</zfar></perspective></technique_common></optics></camera></library_cameras>
<library_geometries><geometry id="G"><mesh><source id="p"><float_array id="pa" count="9">0 0 0 100 0 0 0 0 200</float_array><technique_common>
<accessor source="#pa" count="3" stride="3"><param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices><triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles></mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="S"><node id="g"><instance_geometry url="#G"/></node><node id="g2"><translate>0 300 0</translate><instance_geometry url="#G"/></node>
<node id="l"><translate>0 0 400</translate><instance_light url="#L"/></node><node id="c"><translate>0 -500 0</translate><rotate>1 0 0 90</rotate><instance_camera url="#C"/></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#S"/></scene></COLLADA>)";

TEST(Assimp, ColladaUnitsUpAxisLightAndCamera) {
    const Scene scene = io::loadScene(write(folderOf("dae") / "a.dae", kCollada));
    ASSERT_EQ(scene.instances.size(), 2u);
    EXPECT_EQ(scene.instances[0].mesh, scene.instances[1].mesh) << "instanced";
    const Aabb bounds = scene.bounds();
    EXPECT_NEAR(bounds.max.y, 2.0f, 1e-4f) << "z of the file is up, 200 cm are 2 m";
    EXPECT_NEAR(bounds.max.x, 1.0f, 1e-4f);
    EXPECT_NEAR(bounds.min.z, -3.0f, 1e-4f);
    ASSERT_EQ(scene.lights.size(), 1u);
    EXPECT_NEAR(scene.lights[0].position.y, 4.0f, 1e-4f);
    EXPECT_NEAR(scene.lights[0].intensity.g, 0.5f, 1e-5f);
    EXPECT_FALSE(scene.lights[0].customFalloff);
    ASSERT_EQ(scene.cameras.size(), 1u);
    EXPECT_NEAR(scene.cameras[0].eye.z, 5.0f, 1e-4f);
    EXPECT_NEAR((scene.cameras[0].target - scene.cameras[0].eye).z, -1.0f, 1e-4f) << "looks at the origin";
    // How bright a picture is to be, the file does not say.
    const std::vector<std::pair<std::string, std::string>> automatic{{"image.exposure", "auto"}};
    EXPECT_EQ(scene.settings, automatic);
}

TEST(Assimp, LargeScenesStartWithNestedGrids) {
    using Values = std::vector<std::pair<std::string, std::string>>;
    EXPECT_EQ(loadObj("large", "v 0 0 0\nv 30 0 0\nv 0 1 0\nf 1 2 3\n").settings,
              (Values{{"image.exposure", "auto"}, {"voxels.levels", "0"}}));
    EXPECT_EQ(loadObj("room", std::string(kTriangle) + "f 1 2 3\n").settings,
              (Values{{"image.exposure", "auto"}}));
}

TEST(Assimp, ACameraThatSeesNothingIsNotTheFirst) {
    std::string turned = kCollada;
    const std::string forward = "<rotate>1 0 0 90</rotate>";
    ASSERT_NE(turned.find(forward), std::string::npos);
    turned.replace(turned.find(forward), forward.size(), "<rotate>1 0 0 -90</rotate>");
    const Scene scene = io::loadScene(write(folderOf("dae_turned") / "a.dae", turned));
    ASSERT_EQ(scene.cameras.size(), 2u);
    EXPECT_EQ(scene.cameras[0].name, "framed");
    EXPECT_NEAR((scene.cameras[1].target - scene.cameras[1].eye).z, 1.0f, 1e-4f);
}

TEST(ChildProcess, HandsBytesBackAndReportsDeaths) {
    const io::ChildLimits limits{2.0, std::uint64_t(1) << 30};
    io::Bytes large(5'000'000);
    for (std::size_t i = 0; i < large.size(); ++i) large[i] = std::uint8_t(i * 7);
    const io::ChildResult good = io::runInChild([&] { return large; }, limits);
    EXPECT_EQ(good.failure, "");
    EXPECT_EQ(good.bytes, large);
    EXPECT_EQ(io::runInChild([]() -> io::Bytes { throw std::runtime_error("why"); }, limits).failure, "why");
    EXPECT_TRUE(contains(io::runInChild([]() -> io::Bytes { std::abort(); }, limits).failure, "crashed"));
    EXPECT_TRUE(contains(io::runInChild([]() -> io::Bytes { std::_Exit(7); }, limits).failure, "status 7"));
    const io::ChildResult endless = io::runInChild(
        []() -> io::Bytes {
            volatile bool forever = true;
            while (forever) {
            }
            return {};
        },
        {0.1, 0});
    EXPECT_TRUE(contains(endless.failure, "limit of 0.1 s")) << endless.failure;
    const io::ChildResult asleep = io::runInChild(
        []() -> io::Bytes {
            ::sleep(60);
            return {};
        },
        {0.02, 0});
    EXPECT_TRUE(contains(asleep.failure, "limit")) << asleep.failure;
}

TEST(SceneStream, KeepsEverythingAndRefusesCutBytes) {
    Scene scene = loadObj("stream", std::string(kTriangle) + "vn 0 0 1\nvt 0 0\nf 1/1/1 2/1/1 3/1/1\n");
    scene.lights.emplace_back().name = "light";
    scene.lights[0].customFalloff = true;
    scene.cameras.emplace_back().fovY = 0.5f;
    scene.textures.push_back(
        {"t", 1, 1, false, TextureWrap::Mirror, TextureWrap::Clamp, TextureFilter::Nearest, {1, 2, 3, 4}});
    scene.settings = {{"a", "b"}};
    scene.notes = {"note"};
    scene.sky = {1, 2, 3};
    const io::Bytes bytes = io::bytesFromScene(scene);
    const Scene back = io::sceneFromBytes(bytes);
    EXPECT_EQ(io::bytesFromScene(back), bytes);
    EXPECT_EQ(back.meshes[0].positions, scene.meshes[0].positions);
    EXPECT_EQ(back.textures[0].rgba, scene.textures[0].rgba);
    EXPECT_EQ(back.textures[0].wrapU, TextureWrap::Mirror);
    EXPECT_EQ(back.lights[0].name, "light");
    EXPECT_EQ(back.settings, scene.settings);
    for (std::size_t size = 0; size < bytes.size(); size += 13)
        EXPECT_THROW(io::sceneFromBytes({bytes.data(), size}), Error) << size;
}

// Loads damaged files in batches inside a child each, without isolation of their own (a fork per tiny file
// would cost more than the import); a batch that kills its child is repeated file by file with isolation,
// where each must load or throw.
FuzzCount fuzzInBatches(const std::string& original, const std::filesystem::path& path, int batches,
                        unsigned seed) {
    constexpr int kBatch = 50;
    io::LoadOptions bare, isolated;
    bare.isolate = false;
    isolated.timeLimitSeconds = 0.5;
    isolated.memoryLimitBytes = std::uint64_t(64) << 20;
    FuzzCount total;
    for (int batch = 0; batch < batches; ++batch) {
        const unsigned batchSeed = seed + unsigned(batch);
        const io::ChildResult result = io::runInChild(
            [&]() -> io::Bytes {
                const FuzzCount count = fuzz(original, path, kBatch, batchSeed, bare);
                if (::testing::Test::HasFailure()) throw std::runtime_error("an expectation failed");
                return {std::uint8_t(count.loaded), std::uint8_t(count.refused)};
            },
            {5.0, std::uint64_t(256) << 20});
        FuzzCount count;
        if (result.failure.empty())
            count = {result.bytes.at(0), result.bytes.at(1)};
        else
            count = fuzz(original, path, kBatch, batchSeed, isolated);
        EXPECT_EQ(count.loaded + count.refused, kBatch);
        total.loaded += count.loaded;
        total.refused += count.refused;
    }
    return total;
}

TEST(Assimp, SurvivesDamage) {
    const std::string obj =
        "mtllib m.mtl\no a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0.5\nvn 0 0 1\nvt 0 0\nvt 1 1\nusemtl m\ns 1\n"
        "f 1/1/1 2/2/1 3/1/1\nf 2/2/1 4/1/1 3/1/1\ng b\nf 1 2 4 3\n";
    const std::filesystem::path folder = folderOf("obj_damaged");
    write(folder / "m.mtl", "newmtl m\nKd 0.5 0.5 0.5\nNs 10\n");
    const FuzzCount count = fuzzInBatches(obj, folder / "damaged.obj", 20, 1000);
    EXPECT_GT(count.loaded, 100);
    EXPECT_GT(count.refused, 100);
    const std::string ply =
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float "
        "z\nelement face 1\n"
        "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    // Damaged counts make the PLY importer run away more often than not: the limits at work.
    io::LoadOptions tight;
    tight.timeLimitSeconds = 0.1;
    tight.memoryLimitBytes = std::uint64_t(64) << 20;
    EXPECT_GT(fuzz(ply, folder / "damaged.ply", 30, 5, tight).refused, 2);
}

// Every file of Debian's assimp-testmodels loads or fails with one line.
TEST(Assimp, ItsOwnTestFilesLoadOrFailWithOneLine) {
    const std::filesystem::path root = "/usr/share/assimp/models";
    if (!std::filesystem::exists(root)) GTEST_SKIP() << "package assimp-testmodels is not installed";
    int loaded = 0, refused = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
        if (!entry.is_regular_file()) continue;
        const std::string path = entry.path().string();
        try {
            io::loadScene(path);
            ++loaded;
        } catch (const Error& error) {
            const std::string what = error.what();
            EXPECT_EQ(what.rfind(path, 0), 0u) << what;
            EXPECT_EQ(what.find('\n'), std::string::npos) << what;
            ++refused;
        }
    }
    EXPECT_GE(loaded, 320) << "326 of 595 with Assimp 5.2.5; the rest are pictures, notes and broken files";
    RecordProperty("loaded", loaded);
    RecordProperty("refused", refused);
}

TEST(Assimp, ReadsTheSharedModels) {
    const auto box = testData("models/cornell_box.obj");
    if (!box) GTEST_SKIP() << "test data absent";
    const Scene scene = io::loadScene(*box);
    EXPECT_EQ(scene.instances.size(), 8u);
    EXPECT_EQ(scene.triangleCount(), 36u);
    EXPECT_EQ(io::loadScene(*testData("models/stanford-bunny.obj")).triangleCount(), 69451u);
    const Scene teapot = io::loadScene(*testData("models/teapot.obj"));
    EXPECT_EQ(teapot.triangleCount(), 6320u);
    EXPECT_EQ(teapot.meshes.at(0).normals.size(), teapot.meshes[0].positions.size());
}

}  // namespace
}  // namespace conelight

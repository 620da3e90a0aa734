// SPDX-License-Identifier: MIT
// LightField: meshes that stay in buffers of the host's and bend there; new texels; what a field tells of itself.
#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>

#include "conelight/error.h"
#include "gl/storage.h"
#include "scene/mip_levels.h"
#include "support/light_field_rig.h"
#include "support/scenes.h"

namespace conelight::test {
namespace {

// Stretches the vertices of a box, in the host's own buffer.
const char* const kStretch = R"(#version 450 core
layout(local_size_x = 8) in;
layout(std430, binding = 0) buffer Vertices { float numbers[]; };
void main() { numbers[3u * gl_GlobalInvocationID.x + 1u] *= 3.0; }
)";

class LightFieldHostMesh : public LightFieldRig {
  protected:
    void TearDown() override {
        glDeleteBuffers(2, buffers_);
        glDeleteProgram(program_);
        LightFieldRig::TearDown();
    }
    // The mesh of the last box.
    HostMesh hostBox() {
        const Mesh& mesh = scene_.meshes.back();
        glCreateBuffers(2, buffers_);
        glNamedBufferStorage(buffers_[0], static_cast<GLsizeiptr>(12 * mesh.positions.size()),
                             mesh.positions.data(), 0);
        glNamedBufferStorage(buffers_[1], static_cast<GLsizeiptr>(4 * mesh.indices.size()),
                             mesh.indices.data(), 0);
        HostMesh host;
        host.name = "box";
        host.vertexCount = static_cast<std::uint32_t>(mesh.positions.size());
        host.indexCount = static_cast<std::uint32_t>(mesh.indices.size());
        host.positions = {buffers_[0], 0, 12};
        host.indices = buffers_[1];
        host.bounds = mesh.bounds();
        return host;
    }
    // The scene without its last box, then with it.
    static void addBox(LightField& field, const Scene& scene, const HostMesh& mesh) {
        Scene without = scene;
        without.meshes.pop_back();
        without.instances.pop_back();
        field.setScene(without);
        Instance instance = scene.instances.back();
        instance.mesh = static_cast<int>(field.addMesh(mesh));
        field.addInstance(instance);
    }
    void stretch() {
        const char* const text = kStretch;
        program_ = glCreateShaderProgramv(GL_COMPUTE_SHADER, 1, &text);
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, buffers_[0]);
        glUseProgram(program_);
        glDispatchCompute(1, 1, 1);
    }
    std::vector<glm::vec4> ofScene(const Scene& scene, const Settings& settings, HostPicture& host) {
        LightField field;
        field.setScene(scene);
        field.setSettings(settings);
        field.update();
        return diffuseOf(field, host);
    }

    GLuint buffers_[2] = {}, program_ = 0;
};

// Right after the dispatch that bends it, without a barrier of the host's.
TEST_F(LightFieldHostMesh, AMeshThatTheHostBendsIsLitAsOneInArrays) {
    const Settings settings = hostSettings();
    scene_.materials.back().emission = glm::vec3(0.5f);  // its shape is what lights the room
    HostPicture host(scene_, lens());
    drawn(host);
    LightField field;
    field.setSettings(settings);
    HostMesh mesh = hostBox();
    addBox(field, scene_, mesh);
    field.update();
    EXPECT_LT(hostDifference(diffuseOf(field, host), ofScene(scene_, settings, host)), 1e-3);

    Scene bent = scene_;
    for (glm::vec3& p : bent.meshes.back().positions) p.y *= 3;
    HostPicture bentHost(scene_, lens());
    {
        const Scene kept = std::exchange(scene_, bent);
        drawn(bentHost);
        scene_ = kept;
    }
    const std::vector<glm::vec4> before = diffuseOf(field, bentHost);
    stretch();
    mesh.bounds = bent.meshes.back().bounds();
    field.setMesh(static_cast<std::size_t>(field.scene().instances.back().mesh), mesh);
    field.update();
    const std::vector<glm::vec4> expected = ofScene(bent, settings, bentHost);
    // Noise of few rays is left in both.
    EXPECT_LT(hostDifference(diffuseOf(field, bentHost), expected), 0.05);
    EXPECT_GT(hostDifference(before, expected), 0.07);
}

TEST_F(LightFieldHostMesh, OneKindOfMeshIsNotSetAsTheOther) {
    LightField field;
    const HostMesh mesh = hostBox();
    addBox(field, scene_, mesh);
    const auto index = static_cast<std::size_t>(field.scene().instances.back().mesh);
    EXPECT_THROW(field.setMesh(index, scene_.meshes.back()), Error);
    EXPECT_THROW(field.setMesh(0, mesh), Error);
    EXPECT_THROW(field.setMesh(index + 1, mesh), Error);
    HostMesh fewer = mesh;
    fewer.indexCount -= 3;
    EXPECT_THROW(field.setMesh(index, fewer), Error);
    HostMesh none = mesh;
    none.positions.buffer = 12345;
    EXPECT_THROW(field.addMesh(none), Error);
    field.setMesh(index, mesh);
    // Its place goes to one in arrays, and is no host's then.
    field.removeInstance(scene_.instances.size() - 1);
    field.removeMesh(index);
    EXPECT_EQ(field.addMesh(scene_.meshes.back()), index);
    EXPECT_THROW(field.setMesh(index, mesh), Error);
    field.setMesh(index, scene_.meshes.back());
}

// ---- Textures -------------------------------------------------------------------------------------------

Texture plainTexture(int edge, const glm::u8vec3& color) {
    Texture texture;
    texture.width = texture.height = edge;
    for (int i = 0; i < edge * edge; ++i)
        texture.rgba.insert(texture.rgba.end(), {color.r, color.g, color.b, 255});
    return texture;
}

// Drawn and voxelized: the bits of a scene that had the texels from the beginning.
TEST_F(LightFieldHostMesh, NewTexelsAreThoseOfANewScene) {
    Scene scene = scene_;
    for (Mesh& mesh : scene.meshes) mesh.uvs.assign(mesh.positions.size(), {0.5f, 0.5f});
    scene.textures.push_back(plainTexture(4, {250, 250, 250}));
    scene.textures.push_back(plainTexture(2, {10, 10, 10}));
    for (Material& material : scene.materials) material.baseColorTexture.texture = 0;
    Settings settings = hostSettings();
    settings.mode = Mode::Cones;  // which keeps no light
    settings.voxels.size = 16;
    Renderer renderer;
    renderer.setScene(scene);
    const auto draw = [&](Renderer& by) {
        by.render(scene.cameras[0], 24, 20, settings);
        return by.readImage().pixels;
    };
    std::vector<glm::vec4> last = draw(renderer);
    std::size_t objects = 0;
    for (const Texture& texels : {plainTexture(4, {200, 40, 40}), plainTexture(7, {40, 40, 200})}) {
        scene.textures[0] = texels;
        renderer.setTexture(0, texels);
        const std::vector<glm::vec4> changed = draw(renderer);
        if (objects > 0) {
            EXPECT_EQ(gl::liveObjectCount(), objects);
        }
        objects = gl::liveObjectCount();
        Renderer fresh;
        fresh.setScene(scene);
        EXPECT_EQ(changed, draw(fresh));
        EXPECT_NE(changed, last);
        last = changed;
    }
    // One that no material has changes nothing.
    renderer.setTexture(1, plainTexture(1, {0, 0, 255}));
    EXPECT_EQ(draw(renderer), last);
    EXPECT_THROW(renderer.setTexture(2, plainTexture(1, {})), Error);
    EXPECT_THROW(renderer.setTexture(0, Texture{}), Error);
}

struct TextureOfHost {
    GLuint name = 0;
    TextureOfHost(GLenum format, int edge, GLenum layout, GLenum type, const void* texels) {
        glCreateTextures(GL_TEXTURE_2D, 1, &name);
        int levels = 1;
        while (edge >> levels > 0) ++levels;
        glTextureStorage2D(name, levels, format, edge, edge);
        glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
        glTextureSubImage2D(name, 0, 0, 0, edge, edge, layout, type, texels);
        glGenerateTextureMipmap(name);
    }
    // With levels of the library's, which are not the driver's.
    void putLevels(const Texture& texels) const {
        int level = 0;
        for (const scene::MipLevel& one :
             scene::smallerLevels(texels.rgba, texels.width, texels.height, texels.srgb))
            glTextureSubImage2D(name, ++level, 0, 0, one.width, one.height, GL_RGBA, GL_UNSIGNED_BYTE,
                                one.rgba.data());
    }
    ~TextureOfHost() { glDeleteTextures(1, &name); }
    TextureOfHost(const TextureOfHost&) = delete;
    TextureOfHost& operator=(const TextureOfHost&) = delete;
};

// Every second texel of a row dark, green rising from row to row: which end is where shows, and how means are taken.
Texture stripedTexture(int edge) {
    Texture texture;
    texture.width = texture.height = edge;
    for (int i = 0; i < edge * edge; ++i) {
        const auto row = static_cast<std::uint8_t>(i / edge * 255 / edge);
        const auto stripe = static_cast<std::uint8_t>(i % 2 * 240);
        texture.rgba.insert(texture.rgba.end(), {stripe, row, 60, 255});
    }
    return texture;
}

// A room whose materials all have one texture.
Scene texturedRoom(Scene scene, const Texture& texture) {
    for (Mesh& mesh : scene.meshes) {
        mesh.uvs.clear();
        for (const glm::vec3& p : mesh.positions) mesh.uvs.emplace_back(0.5f * (p.x + p.y), 0.5f * p.z);
    }
    scene.textures.push_back(texture);
    for (Material& material : scene.materials) material.baseColorTexture.texture = 0;
    return scene;
}

// Smaller and larger than the copy that light sees; drawn, voxelized and lit as the same texels in an array.
TEST_F(LightFieldHostMesh, TexturesOfTheHostShowAsOnesInArrays) {
    Settings settings = hostSettings();
    settings.mode = Mode::Cones;  // which keeps no light
    settings.voxels.size = 16;
    const auto draw = [&](Renderer& by) {
        by.render(scene_.cameras[0], 24, 20, settings);
        return by.readImage().pixels;
    };
    for (const int edge : {6, 512}) {
        const Texture texels = stripedTexture(edge);
        const Scene scene = texturedRoom(scene_, texels);
        Renderer expected;
        expected.setScene(scene);
        const TextureOfHost own(GL_SRGB8_ALPHA8, edge, GL_RGBA, GL_UNSIGNED_BYTE, texels.rgba.data());
        own.putLevels(texels);
        Renderer renderer;
        renderer.setScene(texturedRoom(scene_, plainTexture(1, {255, 255, 255})));
        const std::vector<glm::vec4> white = draw(renderer);
        renderer.setTexture(0, HostTexture{.name = "stripes", .texture = own.name});
        EXPECT_EQ(renderer.scene().textures[0].rgba, std::vector<std::uint8_t>(4, 255));
        const std::vector<glm::vec4> truth = draw(expected), shown = draw(renderer);
        EXPECT_LT(hostDifference(shown, truth), 2e-3) << edge;
        EXPECT_GT(hostDifference(white, truth), 0.2) << edge;
        // An array again.
        renderer.setTexture(0, texels);
        EXPECT_TRUE(draw(renderer) == truth) << edge;
    }
}

// The field never draws with it: what bounces is what the copy holds, and new texels come with a new call.
TEST_F(LightFieldHostMesh, TexelsThatTheHostPaintsBounceAfterTheCall) {
    HostPicture host(scene_, lens());
    drawn(host);
    const Settings settings = hostSettings();
    const Texture red = plainTexture(4, {200, 30, 30}), green = plainTexture(4, {30, 200, 30});
    const std::vector<glm::vec4> ofRed = ofScene(texturedRoom(scene_, red), settings, host),
                                 ofGreen = ofScene(texturedRoom(scene_, green), settings, host);
    const TextureOfHost own(GL_SRGB8_ALPHA8, 4, GL_RGBA, GL_UNSIGNED_BYTE, red.rgba.data());
    Scene scene = texturedRoom(scene_, red);
    scene.textures.clear();
    for (Material& material : scene.materials) material.baseColorTexture.texture = -1;
    LightField field;
    field.setSettings(settings);
    field.setScene(scene);
    EXPECT_EQ(field.addTexture(HostTexture{.texture = own.name}), 0u);
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        scene.materials[i].baseColorTexture.texture = 0;
        field.setMaterial(i, scene.materials[i]);
    }
    field.update();
    EXPECT_LT(hostDifference(diffuseOf(field, host), ofRed), 2e-3);
    // By a draw or a dispatch of the host's, or as here.
    glTextureSubImage2D(own.name, 0, 0, 0, 4, 4, GL_RGBA, GL_UNSIGNED_BYTE, green.rgba.data());
    field.setTexture(0, HostTexture{.texture = own.name});
    field.update();
    // Noise of few rays is left in both.
    EXPECT_LT(hostDifference(diffuseOf(field, host), ofGreen), 0.05);
    EXPECT_GT(hostDifference(ofRed, ofGreen), 0.2);
}

// Half floats of linear light, without mipmaps, and one channel by swizzles: as samplers read them.
TEST_F(LightFieldHostMesh, TexturesOfTheHostAreReadAsSamplersReadThem) {
    HostPicture host(scene_, lens());
    drawn(host);
    const Settings settings = hostSettings();
    const std::vector<glm::vec4> expected =
        ofScene(texturedRoom(scene_, plainTexture(1, {188, 188, 188})), settings, host);  // 0.503 linear
    const std::vector<float> grey(4, 0.5029f);
    const TextureOfHost one(GL_R16F, 2, GL_RED, GL_FLOAT, grey.data());
    for (const GLenum channel : {GL_TEXTURE_SWIZZLE_G, GL_TEXTURE_SWIZZLE_B})
        glTextureParameteri(one.name, channel, GL_RED);
    GLuint changing = 0;  // without its smaller level
    glGenTextures(1, &changing);
    glBindTexture(GL_TEXTURE_2D, changing);
    std::vector<float> texels;
    for (int i = 0; i < 4; ++i) texels.insert(texels.end(), {0.5029f, 0.5029f, 0.5029f, 1});
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, 2, 2, 0, GL_RGBA, GL_FLOAT, texels.data());
    for (const GLuint name : {one.name, changing}) {
        LightField field;
        field.setSettings(settings);
        field.setScene(texturedRoom(scene_, plainTexture(1, {0, 0, 0})));
        field.setTexture(0, HostTexture{.texture = name});
        field.update();
        EXPECT_LT(hostDifference(diffuseOf(field, host), expected), 5e-3) << name;
    }
    // Drawn with, too.
    Settings pictures = settings;
    pictures.voxels.size = 16;
    std::vector<glm::vec4> shown[2];
    for (const bool ofHost : {false, true}) {
        Renderer renderer;
        renderer.setScene(texturedRoom(scene_, plainTexture(1, {188, 188, 188})));
        if (ofHost) renderer.setTexture(0, HostTexture{.texture = changing});
        renderer.render(scene_.cameras[0], 24, 20, pictures);
        shown[ofHost ? 1 : 0] = renderer.readImage().pixels;
    }
    EXPECT_LT(hostDifference(shown[1], shown[0]), 5e-3);
    glDeleteTextures(1, &changing);
}

TEST_F(LightFieldHostMesh, TexturesOfNoUseAreSaid) {
    LightField field;
    field.setScene(texturedRoom(scene_, plainTexture(1, {255, 255, 255})));
    const std::vector<std::uint32_t> ones(4, 1);
    const TextureOfHost depth(GL_DEPTH_COMPONENT32F, 2, GL_DEPTH_COMPONENT, GL_FLOAT, ones.data());
    GLuint others[3] = {};  // integers, an array, one without texels
    glCreateTextures(GL_TEXTURE_2D, 1, &others[0]);
    glTextureStorage2D(others[0], 1, GL_R32UI, 2, 2);
    glCreateTextures(GL_TEXTURE_2D_ARRAY, 1, &others[1]);
    glTextureStorage3D(others[1], 1, GL_RGBA8, 2, 2, 2);
    glCreateTextures(GL_TEXTURE_2D, 1, &others[2]);
    const std::pair<const char*, GLuint> cases[] = {
        {"is no GL_TEXTURE_2D", 0},         {"is no GL_TEXTURE_2D", 4711},
        {"integers or depths", depth.name}, {"integers or depths", others[0]},
        {"is no GL_TEXTURE_2D", others[1]}, {"is no GL_TEXTURE_2D with texels", others[2]}};
    for (const auto& [words, name] : cases) {
        try {
            field.setTexture(0, HostTexture{.name = "wood", .texture = name});
            ADD_FAILURE() << words;
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::BadInput);
            EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
            EXPECT_NE(std::string(error.what()).find("'wood'"), std::string::npos) << error.what();
        }
        EXPECT_THROW(field.addTexture(HostTexture{.texture = name}), Error);
    }
    EXPECT_EQ(field.scene().textures.size(), 1u);
    EXPECT_THROW(field.setTexture(1, HostTexture{.texture = depth.name}), Error);
    glDeleteTextures(3, others);
}

// ---- Statistics -----------------------------------------------------------------------------------------

std::size_t bytesOf(const std::vector<MemoryStats>& memory) {
    std::size_t bytes = 0;
    for (const MemoryStats& object : memory) bytes += object.bytes;
    return bytes;
}

// Two fields and a renderer in one process: together they have what there is beside the host's.
TEST_F(LightFieldHostMesh, EachCountsItsOwnMemory) {
    HostPicture host(scene_, lens());
    drawn(host);
    const std::size_t others = gl::liveBytes();
    Settings settings = hostSettings();
    LightField small, large;
    settings.voxels.size = 16;
    small.setSettings(settings);
    settings.voxels.size = 48;
    large.setSettings(settings);
    small.setScene(scene_);
    small.update();
    const std::size_t alone = bytesOf(small.stats().memory);
    EXPECT_EQ(alone, gl::liveBytes() - others - bytesOf(large.stats().memory));
    large.setScene(scene_);
    large.update();
    large.gather(large.addView(), host.surfaces());
    EXPECT_EQ(bytesOf(small.stats().memory), alone);
    EXPECT_GT(bytesOf(large.stats().memory), 2 * alone);
    Renderer renderer;
    renderer.setScene(scene_);
    renderer.render(scene_.cameras[0], 16, 16, settings);
    EXPECT_EQ(
        bytesOf(small.stats().memory) + bytesOf(large.stats().memory) + bytesOf(renderer.stats().memory),
        gl::liveBytes() - others);
    EXPECT_GE(small.stats().memory.front().bytes, small.stats().memory.back().bytes);
}

TEST_F(LightFieldHostMesh, AnUpdateSaysWhatItDid) {
    Settings settings = realtimeSettings();
    settings.voxels.size = 16;
    settings.traced.cacheUpdates = 5;
    LightField field;
    field.setSettings(settings);
    field.setScene(scene_);
    EXPECT_EQ(field.stats().faces, 0u);
    field.update({.updates = 1});
    const std::uint64_t round = field.stats().facesUpdated;
    EXPECT_GT(field.stats().voxels, 16u * 16u);
    EXPECT_GE(field.stats().faces, field.stats().voxels);
    EXPECT_GT(round, field.stats().faces / 4);
    EXPECT_LE(round, field.stats().faces);
    EXPECT_TRUE(field.stats().passes.empty());
    field.update({.updates = 1, .faces = 100});
    EXPECT_EQ(field.stats().facesUpdated, 100u);
    while (field.update({.updates = 3}) < 5) continue;
    field.update({.updates = 3});
    EXPECT_EQ(field.stats().facesUpdated, 0u);
    // By pass: the whole, and what is in it.
    field.setProfiling(true);
    HostPicture host(scene_, lens());
    drawn(host);
    Instance moved = scene_.instances.back();
    moved.worldFromObject[3].x -= 0.1f;
    field.setInstance(scene_.instances.size() - 1, moved);
    field.update();
    field.gather(field.addView(), host.surfaces());
    const std::vector<PassStats> passes = field.stats().passes;
    ASSERT_FALSE(passes.empty());
    EXPECT_EQ(passes.front().name, "update");
    double within = 0;
    for (const PassStats& pass : passes)
        if (pass.name.rfind("update/", 0) == 0 && pass.name.find('/', 7) == std::string::npos)
            within += pass.wallMs;
    EXPECT_GT(within, 0);
    EXPECT_LE(within, passes.front().wallMs);
    const auto has = [&](const char* name) {
        return std::any_of(passes.begin(), passes.end(),
                           [&](const PassStats& pass) { return pass.name == name; });
    };
    EXPECT_TRUE(has("update/irradiance: update"));
    EXPECT_TRUE(has("gather"));
    EXPECT_FALSE(field.stats().device.empty());
    field.setScene(scene_);
    EXPECT_EQ(field.stats().voxels, 0u);
}

}  // namespace
}  // namespace conelight::test

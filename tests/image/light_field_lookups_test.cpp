// SPDX-License-Identifier: MIT
// Lookups in shaders of a host (conelight/light_field.glsl): what they say is what the library shows.
#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <map>
#include <string>

#include "conelight/error.h"
#include "support/environments.h"
#include "support/light_field_rig.h"
#include "support/scenes.h"

namespace conelight::test {
namespace {

// Not those that a host would get by leaving them out.
constexpr LookupSlots kSlots{.firstBlock = 3, .firstTexture = 5};

constexpr const char* kVertex = R"(#version 450 core
void main() { gl_Position = vec4(4 * (gl_VertexID & 1) - 1, 2 * (gl_VertexID & 2) - 1, 0, 1); }
)";
// At the surfaces of a host's picture, from its depths and normals, main() says what.
constexpr const char* kFragment = R"(
layout(binding = 0) uniform sampler2D depths;
layout(binding = 1) uniform sampler2D normals;
layout(location = 0) uniform mat4 worldFromClip;
layout(location = 1) uniform vec3 eye;
layout(location = 0) out vec4 color;
vec3 position, normal, toEye;
vec4 shown();
void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec2 place = gl_FragCoord.xy / vec2(textureSize(depths, 0)) * 2 - 1;
    vec4 world = worldFromClip * vec4(place, texelFetch(depths, pixel, 0).x * 2 - 1, 1);
    position = world.xyz / world.w;
    normal = texelFetch(normals, pixel, 0).xyz;
    toEye = normalize(eye - position);
    color = shown();
}
)";

// With one grid, and with nested ones round a point, so that walls and boxes lie in all levels.
class LightFieldLookups : public LightFieldRig, public testing::WithParamInterface<int> {
  protected:
    static Settings settings();
    // A picture of what the function shown() of a host's shader says, on the surfaces of `host`.
    std::vector<glm::vec4> shown(const LightField& field, HostPicture& host, const std::string& function);
};

Settings LightFieldLookups::settings() {
    Settings settings = hostSettings();
    settings.voxels.levels = GetParam();
    settings.voxels.anchor = VoxelAnchor::at({0.3f, -0.4f, 0.2f});
    return settings;
}

GLuint linked(const std::string& fragment) {
    const GLuint program = glCreateProgram();
    for (const auto& [stage, text] : {std::pair(GLenum{GL_VERTEX_SHADER}, std::string(kVertex)),
                                      std::pair(GLenum{GL_FRAGMENT_SHADER}, fragment)}) {
        const GLuint shader = glCreateShader(stage);
        const char* const source = text.c_str();
        glShaderSource(shader, 1, &source, nullptr);
        glCompileShader(shader);
        char log[2000] = "";
        glGetShaderInfoLog(shader, sizeof log, nullptr, log);
        EXPECT_STREQ(log, "");
        glAttachShader(program, shader);
        glDeleteShader(shader);
    }
    glLinkProgram(program);
    GLint good = 0;
    glGetProgramiv(program, GL_LINK_STATUS, &good);
    EXPECT_NE(good, 0);
    return program;
}

std::vector<glm::vec4> LightFieldLookups::shown(const LightField& field, HostPicture& host,
                                                const std::string& function) {
    const GLuint program = linked("#version 450 core\n" + lookupsGlsl(kSlots) + kFragment + function);
    const gl::Texture picture({GL_TEXTURE_2D, GL_RGBA32F, kHostWidth, kHostHeight}, "host picture");
    const gl::Framebuffer target({&picture}, nullptr, "host picture");
    const gl::VertexArray array("no vertices");
    const gl::HostStateGuard guard;
    gl::RasterState state;
    state.framebuffer = &target;
    state.depthTest = state.depthWrite = false;
    state.cull = gl::Cull::None;
    gl::apply(state);
    glUseProgram(program);
    const HostSurfaces& s = host.surfaces();
    const glm::mat4 worldFromClip = glm::inverse(s.clipFromView * s.viewFromWorld);
    glUniformMatrix4fv(0, 1, GL_FALSE, glm::value_ptr(worldFromClip));
    glUniform3fv(1, 1, glm::value_ptr(scene_.cameras.front().eye));
    const GLuint maps[2] = {s.depth, s.normal};
    glBindTextures(0, 2, maps);
    const GLuint none[2] = {0, 0};
    glBindSamplers(0, 2, none);
    field.bindLookups(kSlots);
    gl::drawTriangle(array);
    glDeleteProgram(program);
    return pixelsOf(picture.name());
}

TEST_P(LightFieldLookups, IrradianceIsThatOfTheLibrary) {
    Settings settings = LightFieldLookups::settings();
    settings.traced.pixelRays = 0;
    LightField field;
    field.setScene(scene_);
    field.setSettings(settings);
    field.update();
    HostPicture host(scene_, lens());
    drawn(host);
    const std::vector<glm::vec4> image =
        shown(field, host, "vec4 shown() { return vec4(conelight_irradiance(position, normal), 1); }");
    const double error = hostDifference(image, diffuseOf(field, host));
    RecordProperty("irradiance", std::to_string(error));
    EXPECT_LT(error, 1e-3);
}

// Mirrors all over, whose rays meet faces as the lookups' rays do. Rays of both differ by rounding and by the least
// lobe that the library gives a mirror: few meet another face then.
TEST_P(LightFieldLookups, RaysShowWhatMirrorsShow) {
    Settings settings = LightFieldLookups::settings();
    settings.traced.exactHits = settings.traced.exactMirrors = false;
    settings.traced.filterLevels = 0;
    scene_.materials[kHostMetal] = scene_.materials.back();
    scene_.sky = {0.2f, 0.3f, 0.9f};
    scene_.instances[5].visible = false;  // a way out
    scene_.environment = Environment{"", sunnyEnvironment(32), 0.5f, 0.2f};
    LightField field;
    field.setScene(scene_);
    field.setSettings(settings);
    field.update();
    HostPicture host(scene_, lens());
    drawn(host);
    gl::Texture smooth({GL_TEXTURE_2D, GL_RGBA32F, kHostWidth, kHostHeight}, "host mirrors");
    const float mirror[4] = {1, 1, 1, 0};
    smooth.clear(0, GL_RGBA, GL_FLOAT, mirror);
    host.surfaces().roughness = host.surfaces().reflectance = smooth.name();
    const std::vector<glm::vec4> expected = pixelsOf(field.gather(field.addView(), host.surfaces()).specular);
    const std::vector<glm::vec4> image = shown(field, host, R"(
vec4 shown() {
    vec3 origin = position + 0.05 * conelight_voxelSize(position) * (normal + toEye);
    return vec4(conelight_trace(origin, reflect(-toEye, normal)), 1);
})");
    std::size_t others = 0;
    const auto alike = [&](std::size_t i) {
        const glm::vec3 apart = glm::abs(glm::vec3(image[i]) - glm::vec3(expected[i]));
        const bool same = apart.r + apart.g + apart.b < 0.02f;
        others += same ? 0 : 1;
        return same;
    };
    const double error = hostDifference(image, expected, alike);
    RecordProperty("radiance", std::to_string(error));
    RecordProperty("others", std::to_string(others));
    EXPECT_LT(error, 0.01);
    EXPECT_LT(others, image.size() / 10);
}

// A ray from the eye goes as far as the host's own picture says: half a voxel of 8 cm at most on the mean.
TEST_P(LightFieldLookups, RaysGoAsFarAsThePictureIsDeep) {
    LightField field;
    field.setScene(scene_);
    field.setSettings(settings());
    field.update();
    HostPicture host(scene_, lens());
    drawn(host);
    const std::vector<glm::vec4> image = shown(field, host, R"(
vec4 shown() {
    float far;
    conelight_trace(eye, -toEye, far);
    return vec4(abs(far - distance(eye, position)));
})");
    EXPECT_LT(hostMean(image), 0.02);
}

// Walls and boxes lie in all levels, each of which has voxels of twice the size of the one before.
TEST_P(LightFieldLookups, VoxelsAreAsLargeAsTheirLevelHasThem) {
    LightField field;
    field.setScene(scene_);
    field.setSettings(settings());
    field.update();
    HostPicture host(scene_, lens());
    drawn(host);
    std::map<float, std::size_t> pixels;
    for (const glm::vec4& pixel :
         shown(field, host, "vec4 shown() { return vec4(conelight_voxelSize(position)); }"))
        if (pixel.r > 0) ++pixels[pixel.r];
    ASSERT_EQ(pixels.size(), static_cast<std::size_t>(GetParam()));
    for (const auto& [edge, count] : pixels) {
        EXPECT_GT(count, 20u) << edge;
        EXPECT_FLOAT_EQ(std::exp2(std::round(std::log2(edge / pixels.begin()->first))),
                        edge / pixels.begin()->first);
    }
}

// Where all light is 1 it is 1 in the air as well, from all sides and from one. A ray in a thousand finds a gap between
// faces: 1 % of the pixels have one among theirs.
TEST_P(LightFieldLookups, DustIsLitByRays) {
    scene_ = closedBox(diffuseMaterial(glm::vec3(0.6f), glm::vec3(0.4f)));
    Settings settings = LightFieldLookups::settings();
    settings.traced.cacheUpdates = 64;
    LightField field;
    field.setScene(scene_);
    field.setSettings(settings);
    field.update();
    HostPicture host(scene_, lens());
    drawn(host);
    for (const char* normal : {"vec3(0)", "vec3(0, 1, 0)", "normal"}) {
        const std::vector<glm::vec4> image =
            shown(field, host,
                  std::string("vec4 shown() { return vec4(conelight_irradiance(0.4 * position, ") + normal +
                      "), 1); }");
        const auto wrong = std::count_if(
            image.begin(), image.end(), [](const glm::vec4& pixel) { return std::abs(pixel.g - 1) > 0.02f; });
        EXPECT_LT(wrong, 26) << normal;
    }
}

TEST_P(LightFieldLookups, SaysWhatIsWrong) {
    LightField field;
    EXPECT_THROW(field.bindLookups(), Error);
    field.setScene(scene_);
    field.setSettings(settings());
    field.update();
    EXPECT_THROW(field.bindLookups({.firstBlock = -1}), Error);
    EXPECT_THROW(field.bindLookups({.firstTexture = 100000}), Error);
    const gl::HostStateGuard guard;
    field.bindLookups();
    field.update();  // leaves the host's slots alone, which are ours now
}

INSTANTIATE_TEST_SUITE_P(Levels, LightFieldLookups, testing::Values(1, 2, 3));

}  // namespace
}  // namespace conelight::test

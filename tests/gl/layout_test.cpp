// SPDX-License-Identifier: MIT
// Structs of shaders/shared: asks the driver where each member lies in std430 and std140, of which type it is
// and how far elements are apart, and compares with C++. The table of members below is checked against the
// headers, so that a new struct or member cannot be forgotten.
#include <cstddef>
#include <regex>
#include <set>

#include "shared/baked_light.h"
#include "shared/caustics.h"
#include "shared/cones.h"
#include "shared/frame.h"
#include "shared/gbuffer.h"
#include "shared/glass.h"
#include "shared/host_mesh.h"
#include "shared/host_surfaces.h"
#include "shared/image.h"
#include "shared/inspect.h"
#include "shared/irradiance.h"
#include "shared/lamps.h"
#include "shared/lighting.h"
#include "shared/pixel_rays.h"
#include "shared/radiance_octree.h"
#include "shared/radiance_volume.h"
#include "shared/scene.h"
#include "shared/shadow_cascades.h"
#include "shared/shadow_map.h"
#include "shared/voxel_view.h"
#include "shared/voxels.h"
#include "support/gl_fixture.h"
#include "thesis/shaders/constants.h"

namespace conelight::test {
namespace {

struct Member {
    std::string name;
    std::size_t offset, bytes;
    GLenum type;
    std::size_t elements;  // 0: no array
};

struct Struct {
    std::string name;
    std::size_t bytes;
    std::vector<Member> members;
};

template <class T>
struct TypeOf;
template <>
struct TypeOf<float> {
    static constexpr GLenum value = GL_FLOAT;
};
template <>
struct TypeOf<std::int32_t> {
    static constexpr GLenum value = GL_INT;
};
template <>
struct TypeOf<std::uint32_t> {
    static constexpr GLenum value = GL_UNSIGNED_INT;
};
template <>
struct TypeOf<glm::vec2> {
    static constexpr GLenum value = GL_FLOAT_VEC2;
};
template <>
struct TypeOf<glm::vec3> {
    static constexpr GLenum value = GL_FLOAT_VEC3;
};
template <>
struct TypeOf<glm::vec4> {
    static constexpr GLenum value = GL_FLOAT_VEC4;
};
template <>
struct TypeOf<glm::ivec4> {
    static constexpr GLenum value = GL_INT_VEC4;
};
template <>
struct TypeOf<glm::uvec4> {
    static constexpr GLenum value = GL_UNSIGNED_INT_VEC4;
};
template <>
struct TypeOf<glm::mat4> {
    static constexpr GLenum value = GL_FLOAT_MAT4;
};

template <class T>
Member member(const char* name, std::size_t offset) {
    return {name, offset, sizeof(T), TypeOf<std::remove_extent_t<T>>::value, std::extent_v<T>};
}

// ROW(Struct, member, member ...): the members in the order of the header. The macros apply one to each name.
#define PARENTHESES ()
#define EXPAND(...) EXPAND3(EXPAND3(EXPAND3(EXPAND3(__VA_ARGS__))))
#define EXPAND3(...) EXPAND2(EXPAND2(EXPAND2(EXPAND2(__VA_ARGS__))))
#define EXPAND2(...) EXPAND1(EXPAND1(EXPAND1(EXPAND1(__VA_ARGS__))))
#define EXPAND1(...) __VA_ARGS__
#define EACH(S, m, ...) \
    member<decltype(gpu::S::m)>(#m, offsetof(gpu::S, m)), __VA_OPT__(EACH_AGAIN PARENTHESES(S, __VA_ARGS__))
#define EACH_AGAIN() EACH
#define ROW(S, ...)                                          \
    Struct {                                                 \
#S, sizeof(gpu::S), { EXPAND(EACH(S, __VA_ARGS__)) } \
    }

std::vector<Struct> glassStructs() {
    return {
        ROW(GlassNode, lower, skip, upper, triangles),
        ROW(GlassTriangle, corner0, normal0, corner1, normal1, corner2, normal2, uv0, uv1, uv2, instance,
            solid),
        ROW(GlassConstants, pass, passes, inverseVoxelSize, fireflyClamp, firstPass, reflections, direct,
            specular),
        ROW(CausticConstants, count, edge, voxelSize, turnsAll, middle),
        ROW(CausticPass, middle, radius, solid, light, grid, lampGrid, scale, far, edge, level),
        ROW(CausticEnd, place, distance, history, flux, entry),
    };
}

// Of the view and image stages.
std::vector<Struct> structsOfPictures() {
    return {
        ROW(Exposure, scale, pad0, pad1, pad2),
        ROW(DisplayConstants, curve, srgb, kept, spread, check, topFirst, pad0, pad1, balance, falseColors),
        ROW(HeadlightConstants, irradiance, pad0, pad1, pad2),
        ROW(HostMeshConstants, low, vertexCount, high, indexCount, firstVertex, firstIndex, indexOffset,
            indexKind, positions, normals, uvs, tangents, colors, noTangent, pad0, pad1, pad2),
        ROW(ViewMeanConstants, views, pad0, pad1, pad2),
        ROW(TemporalPictureConstants, oldClipFromWorld, oldDepth, longest, fresh, oldParallel, pad0),
        ROW(BloomConstants, weight, coarser, fromLevel, pad0),
        ROW(ShrinkConstants, kept, pad0, pad1, pad2),
        ROW(InstanceMotion, worldFromObject, firstVertex, pad0, pad1, pad2),
        ROW(WireframeConstants, color, opacity, halfWidth, pad0, pad1, pad2),
        ROW(ShadowViewConstants, light, tiles, tilesPerEdge, columns, rows, pad0, pad1, pad2),
        ROW(VoxelViewConstants, origin, voxelSize, sizeX, sizeY, sizeZ, data, level, spread, maxLevel,
            density, pixelSize, inside, pad1, pad2, filledMin, filledSize),
    };
}

std::vector<Struct> cacheStructs() {
    return {
        ROW(LitFace, albedo, radiance, irradiance0, irradiance1),
        ROW(FaceCache, irradiance, counts),
        ROW(CacheOrder, number, searches, binsPerChunk, chunkCount, firstBlock, binCount, lastSweep, pad0),
        ROW(CacheConstants, firstFace, faceCount, cosineRays, lightRays, update, seed, longestWindow,
            reflections, fireflyClamp, restartsNear, placeCount, draw, places, placeParts, lightEdits,
            editedEverywhere, editedEverywherePart, allLightEdits, lightScale, scaledEverywhere,
            scaledEverywherePart, pad0, pad1, pad2, dimmed, editedLights, editedAxes, editedLimits),
        ROW(CacheBalance, cached, pad0, fresh, pad1, returned, pad2, correction, pad3),
        ROW(CacheBalancing, groups, weight, cachedBefore, step, rounds, pad0, pad1, pad2),
        ROW(CacheRanges, part, parts, pad0, pad1),
        ROW(CacheReprojection, oldOrigin, oldInverseVoxelSize, oldSizeX, oldSizeY, oldSizeZ, pad0),
    };
}

std::vector<Struct> otherStructs() {
    return {
        ROW(ConeConstants, count, step, offset, maxDistance, specularMinTan, occlusionDistance, shadowTan,
            pad0, cone, aperture),
        ROW(RecordHeader, pixelX, pixelY, paths, steps, pathSteps, share, seen, pad0, position, depth, normal,
            pad1),
        ROW(RecordedPart, value, used, scale, pad0),
        ROW(RecordedPath, origin, kind, direction, tanHalf, weight, opacity, radiance, distance, firstStep,
            stepCount, end, face, faceNormal, facePlane, faceAlbedo, faceVoxel, faceRadiance, faceCoverage,
            faceIrradiance, faceUpdates),
        ROW(RecordedStep, position, size, radiance, opacity, distance, level, total, kind),
        ROW(PixelRayConstants, oldClipFromWorld, oldEye, planeTolerance, oldForward, pass, oldRight, rays,
            oldUp, longestMean, specularLimit, reach, inverseVoxelSize, reflections, fireflyClamp, lowestX,
            lowestY, oldParallel, motionScaleX, motionScaleY, motionStep, reuse, shortestMean,
            shortestLobeMean, placeCount, lightEdits, places, placeParts, editedEverywhere,
            editedEverywherePart, shortestLightMean, allLightEdits, lightScale, scaledEverywhere,
            scaledEverywherePart, pad0, pad1, pad2, dimmed, editedLights, editedAxes, editedLimits),
        ROW(FrameConstants, clipFromWorld, eye, width, viewForward, height, viewRight, footprint, viewUp,
            blending, parallel, pad0, pad1, pad2),
        ROW(LightingConstants, sky, environmentScale, lightEnds, environmentTurn, environmentInverseFlux,
            environmentLevel0, environmentCellLevel),
        ROW(LampNode, center, radius2, power, reach, next, firstSlot, slots, pad0, pad1, pad2),
        ROW(LampFaceConstants, firstFace, faceCount, round, restarts),
        ROW(CascadeConstants, middle, levels, inverseNearest, perDoubling, inverseDepth, pad0),
        ROW(Cascade, position, shadowNear, texel, layer, pad0, pad1),
        ROW(ShadowMapConstants, clipFromWorld, slopeUnit, middle, halfSize, pad0),
        ROW(RadianceOctree, inverseTextureSize, rootLevel, topLevel, maxLevel, rowBits, slots, slotsPerChunk,
            level, firstBrick, brickCount),
        ROW(RadianceVolume, origin, voxelSize, inverseExtent, inverseVoxelSize, extent, maxLevel, sizeX,
            sizeY, sizeZ, halfTexelX),
        ROW(Vertex, position, normalOct, u, v, tangentOct, color),
        ROW(BakedVertex, position, instance, irradiance, pad0),
        ROW(Instance, worldFromObject, normalColumn0, normalColumn1, normalColumn2, firstIndex, indexCount,
            firstVertex, material, flags, firstTriangle, pad0, pad1),
        ROW(Material, baseColor, emission, alphaCutoff, specularF0, metallic, roughness, normalScale, flags,
            evenLayers, layers, uvRow, phongColor, phongShininess, phongAmbient, phongDiffuse, phongSpecular,
            transmission, absorption, ior, transmissionUvRow, transmissionLayer, coatNormalMap,
            coatNormalScale, pad0, sheenColor, sheenRoughness, coat, coatRoughness, pad1, pad2, layerUvRow),
        ROW(Light, position, type, direction, shadow, intensity, range, halfU, cosInner, halfV, cosOuter,
            falloff, customFalloff, shadowNear, shadowTexel, flags, sampleGrid),
        ROW(ThesisGrid, origin, edge, voxelSize, size, maxLevel, sumScale, boxMin, boxSize, along),
        ROW(ThesisConstants, diffuseCone, specularCone, occlusionCone, originOffset, shininessFalloff,
            shadowStrength, minSpecular, switches, maxSamples, lightCount, parallelSpread),
        ROW(VoxelGrid, origin, voxelSize, sizeX, sizeY, sizeZ, voxelCount, bricksX, bricksY, bricksZ,
            faceCount, inverseVoxelSize, occupiedBricks, pad0, pad1),
        ROW(VoxelLevels, count, sizeX, sizeY, sizeZ, levels),
        ROW(VoxelScroll, shifts, finer),
        ROW(FaceRecord, normal, offsetWeight, bounds, voxel),
        ROW(FaceMaterial, albedo, emission, emissionBArea, lobe),
        ROW(SurfaceConstants, triangleCount, instanceCount, tileCapacity, fragmentCapacity, voxelCapacity,
            faceCapacity, brickCapacity, bricksPerChunk, voxelsPerChunk, emissionScale, editedBricks, pad0),
    };
}

const std::vector<Struct>& table() {
    static const std::vector<Struct> structs = [] {
        std::vector<Struct> all = otherStructs();
        for (Struct& one : cacheStructs()) all.push_back(std::move(one));
        for (Struct& glass : glassStructs()) all.push_back(std::move(glass));
        for (Struct& one : structsOfPictures()) all.push_back(std::move(one));
        all.push_back(ROW(HostSurfaceConstants, worldFromView, depthRow, depthOfEye, depthScale, depthOffset,
                          background, encoding, reduction, instances, roughnessChannel, pad0));
        return all;
    }();
    return structs;
}

struct Parsed {
    std::string header, name;
    std::vector<std::string> members;
};

// Headers are what C++ and GLSL share.
bool isShared(const gl::EmbeddedShader& file) {
    const std::string path = file.path;
    return path.size() > 2 && path.compare(path.size() - 2, 2, ".h") == 0;
}

// The structs that shared headers declare.
std::vector<Parsed> parsedStructs() {
    std::vector<Parsed> found;
    const std::regex comments(R"(//[^\n]*)"), structs(R"(struct\s+(\w+)\s*\{([^}]*)\})");
    const std::regex members(R"((\w+)\s*(\[\s*\w+\s*\])?\s*[;,])");
    for (const gl::EmbeddedShader& file : gl::embeddedShaders()) {
        if (!isShared(file)) continue;
        EXPECT_EQ(std::string(file.text).find("/*"), std::string::npos)
            << file.path << ": this test reads // comments only";
        const std::string text = std::regex_replace(std::string(file.text), comments, " ");
        for (std::sregex_iterator s(text.begin(), text.end(), structs), end; s != end; ++s) {
            Parsed parsed{file.path, (*s)[1], {}};
            const std::string body = (*s)[2];
            for (std::sregex_iterator m(body.begin(), body.end(), members); m != end; ++m)
                parsed.members.push_back((*m)[1]);
            found.push_back(parsed);
        }
    }
    return found;
}

std::string includesOfShared() {
    std::string text;
    for (const gl::EmbeddedShader& file : gl::embeddedShaders())
        if (isShared(file)) text += "#include \"" + std::string(file.path) + "\"\n";
    return text;
}

// One property of a block member; -1 when the driver does not know the name.
GLint property(GLuint program, GLenum interface, const std::string& name, GLenum which) {
    const GLuint index = glGetProgramResourceIndex(program, interface, name.c_str());
    if (index == GL_INVALID_INDEX) return -1;
    GLint value = -1;
    glGetProgramResourceiv(program, interface, index, 1, &which, 1, nullptr, &value);
    return value;
}

class LayoutTest : public GlTest {
  protected:
    // A program whose block `Block` holds `Struct items[2]` in the given layout.
    const gl::Program& blockProgram(const std::string& structName, const std::string& firstMember,
                                    bool storage) {
        const std::string path = "test/layout_" + structName + (storage ? "_430" : "_140") + ".comp.glsl";
        addShader(path, "#version 450 core\nlayout(local_size_x = 8) in;\n" + includesOfShared() +
                            (storage ? "layout(std430) buffer Block { " : "layout(std140) uniform Block { ") +
                            structName + (storage ? " items[]; };\n" : " items[2]; };\n") +
                            "layout(std430) buffer Sink { uint sink; };\n"
                            "void main() { if (items[1]." +
                            firstMember + " == items[0]." + firstMember + ") sink = 1u; }\n");
        return programs().compute(path);
    }

    void compare(const Struct& expected, bool storage) {
        const gl::Program& program = blockProgram(expected.name, expected.members.front().name, storage);
        const GLenum interface = storage ? GL_BUFFER_VARIABLE : GL_UNIFORM;
        for (const Member& m : expected.members) {
            const std::string suffix = "." + m.name + (m.elements != 0 ? "[0]" : "");
            const std::string first = "items[0]" + suffix;
            EXPECT_EQ(property(program.name(), interface, first, GL_OFFSET), static_cast<GLint>(m.offset))
                << first;
            EXPECT_EQ(property(program.name(), interface, first, GL_TYPE), static_cast<GLint>(m.type))
                << first;
            EXPECT_EQ(property(program.name(), interface, first, GL_ARRAY_STRIDE),
                      m.elements != 0 ? static_cast<GLint>(m.bytes / m.elements) : 0)
                << first;
            if (m.elements != 0) {
                EXPECT_EQ(property(program.name(), interface, first, GL_ARRAY_SIZE),
                          static_cast<GLint>(m.elements))
                    << first;
            }
            if (m.type == GL_FLOAT_MAT4) {
                EXPECT_EQ(property(program.name(), interface, first, GL_MATRIX_STRIDE), 16) << first;
                EXPECT_EQ(property(program.name(), interface, first, GL_IS_ROW_MAJOR), 0) << first;
            }
            // Elements of the table are sizeof apart.
            if (storage) {
                EXPECT_EQ(property(program.name(), interface, first, GL_TOP_LEVEL_ARRAY_STRIDE),
                          static_cast<GLint>(expected.bytes))
                    << first;
            } else {
                const std::string second = "items[1]" + suffix;
                EXPECT_EQ(property(program.name(), interface, second, GL_OFFSET),
                          static_cast<GLint>(expected.bytes + m.offset))
                    << second;
            }
        }
    }
};

}  // namespace

TEST_F(LayoutTest, EveryStructOfTheHeadersIsInTheTable) {
    const std::vector<Parsed> parsed = parsedStructs();
    EXPECT_GE(parsed.size(), 7u);
    std::set<std::string> seen;
    for (const Parsed& found : parsed) {
        seen.insert(found.name);
        std::string row = "ROW(" + found.name;
        for (const std::string& name : found.members) row += ", " + name;
        row += "),";
        const Struct* entry = nullptr;
        for (const Struct& one : table())
            if (one.name == found.name) entry = &one;
        if (entry == nullptr) {
            ADD_FAILURE() << found.header << ": struct " << found.name
                          << " is not in the table of layout_test.cpp; add\n    " << row;
            continue;
        }
        std::vector<std::string> names;
        for (const Member& m : entry->members) names.push_back(m.name);
        EXPECT_EQ(names, found.members)
            << found.header << ": the row of " << found.name << " should be\n    " << row;
    }
    for (const Struct& one : table())
        EXPECT_TRUE(seen.count(one.name)) << one.name << " is in no header any more";
}

TEST_F(LayoutTest, RowsOfSixteenBytesAreFull) {
    for (const Struct& one : table()) {
        EXPECT_EQ(one.bytes % 16, 0u) << one.name;
        std::size_t end = 0;
        for (const Member& m : one.members) {
            EXPECT_EQ(m.offset, end) << one.name << "::" << m.name << ": hidden padding before it";
            end = m.offset + m.bytes;
        }
        EXPECT_EQ(end, one.bytes) << one.name << ": hidden padding at its end";
    }
}

TEST_F(LayoutTest, StorageBlocksAgreeWithCpp) {
    for (const Struct& one : table()) compare(one, true);
}

TEST_F(LayoutTest, UniformBlocksAgreeWithCpp) {
    for (const Struct& one : table()) compare(one, false);
}

}  // namespace conelight::test

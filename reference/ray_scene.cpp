// SPDX-License-Identifier: MIT
// Up to three Embree scenes share the same geometries, one per set of instances that a kind of ray can hit;
// kinds with the same set share a scene. A filter function drops what is not there: masked texels, and backs
// of single-sided surfaces for camera rays.
#include "reference/ray_scene.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <string>
#include <vector>

#include "base/log.h"
#include "reference/materials.h"
#include "reference/surface.h"

#if CONELIGHT_EMBREE >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace conelight::reference {
namespace {

constexpr int kKinds = 3;

// What the filter function needs to know of one geometry.
struct GeometryInfo {
    const Scene* scene = nullptr;
    std::uint32_t instance = 0;
    bool mirrored = false;  // the instance turns its triangles inside out
    bool cullable = false;  // single-sided
    bool masked = false;
    bool blended = false;
    bool transmissive = false;
};

// The context that travels with a query; Embree's own part comes first.
struct QueryContext {
#if CONELIGHT_EMBREE >= 4
    RTCRayQueryContext embree;
#else
    RTCIntersectContext embree;
#endif
    bool cullsBacks = false;
    Blended blended = Blended::Cut;
    // Of RayScene::transmittance.
    const Ray* passing = nullptr;  // null: transmissive surfaces occlude
    bool unbent = false;
    glm::vec3 passed{1};
    glm::vec3 depth{0};  // optical, of solids; ways between two sides, each counted where it ends
};

QueryContext makeContext(RayKind kind) {
    QueryContext context;
#if CONELIGHT_EMBREE >= 4
    rtcInitRayQueryContext(&context.embree);
#else
    rtcInitIntersectContext(&context.embree);
#endif
    context.cullsBacks = kind == RayKind::Camera;
    return context;
}

void filterHit(const RTCFilterFunctionNArguments* arguments) {
    if (arguments->valid[0] != -1) return;
    const auto& info = *static_cast<const GeometryInfo*>(arguments->geometryUserPtr);
    const auto& context = *reinterpret_cast<const QueryContext*>(arguments->context);
    const auto& ray = *reinterpret_cast<const RTCRay*>(arguments->ray);
    const auto& hit = *reinterpret_cast<const RTCHit*>(arguments->hit);
    if (context.cullsBacks && info.cullable) {
        const float along = ray.dir_x * hit.Ng_x + ray.dir_y * hit.Ng_y + ray.dir_z * hit.Ng_z;
        if (info.mirrored ? along < 0 : along > 0) {
            arguments->valid[0] = 0;
            return;
        }
    }
    const bool cut = info.masked && !(info.blended && context.blended == Blended::Met);
    if (cut && !coversAt(*info.scene, info.instance, hit.primID, {hit.u, hit.v})) arguments->valid[0] = 0;
}

// Of shadow rays: what they go on through is no hit.
void filterOcclusion(const RTCFilterFunctionNArguments* arguments) {
    filterHit(arguments);
    if (arguments->valid[0] != -1) return;
    const auto& info = *static_cast<const GeometryInfo*>(arguments->geometryUserPtr);
    auto& context = *reinterpret_cast<QueryContext*>(arguments->context);
    if (context.passing == nullptr || (!info.transmissive && !info.blended)) return;
    const auto& hit = *reinterpret_cast<const RTCHit*>(arguments->hit);
    const glm::vec3 normal(glm::normalize(glm::dvec3(hit.Ng_x, hit.Ng_y, hit.Ng_z)));
    RayHit found;
    found.t = reinterpret_cast<const RTCRay*>(arguments->ray)->tfar;
    found.instance = info.instance;
    found.triangle = hit.primID;
    found.barycentric = {hit.u, hit.v};
    found.geometricNormal = info.mirrored ? -normal : normal;
    const Surface surface = surfaceAt(*info.scene, *context.passing, found);
    const bool through = passesStraight(surface) || (context.unbent && surface.transmission > 0);
    glm::vec3 passed(1 - surface.opacity);
    if (through) passed += surface.opacity * straightPass(surface, -context.passing->direction).transmittance;
    if (passed == glm::vec3(0)) return;
    context.passed *= passed;
    if (surface.solid)
        context.depth += absorption(*surface.material) * (surface.frontFace ? -found.t : found.t);
    arguments->valid[0] = 0;
}

bool participates(const Instance& instance, RayKind kind) {
    if (!instance.visible || instance.mesh < 0) return false;
    switch (kind) {
        case RayKind::Camera:
            return true;
        case RayKind::Bounce:
            return instance.voxelized;
        case RayKind::Shadow:
            return instance.castsShadow;
    }
    return false;
}

RTCRay makeRay(const Ray& ray) {
    RTCRay r;
    r.org_x = ray.origin.x;
    r.org_y = ray.origin.y;
    r.org_z = ray.origin.z;
    r.dir_x = ray.direction.x;
    r.dir_y = ray.direction.y;
    r.dir_z = ray.direction.z;
    r.tnear = ray.tMin;
    r.tfar = ray.tMax;
    r.time = 0;
    r.mask = 0xffffffffu;
    r.id = 0;
    r.flags = 0;
    return r;
}

[[noreturn]] void failed(RTCDevice device) {
    const RTCError error = rtcGetDeviceError(device);
    if (error == RTC_ERROR_UNSUPPORTED_CPU)
        base::fail(ErrorKind::Runtime, "ray structure: Embree does not start on this processor");
    base::fail(ErrorKind::Runtime, "ray structure: Embree reports error %d%s", static_cast<int>(error),
               error == RTC_ERROR_OUT_OF_MEMORY ? " (out of memory); a smaller scene would be right" : "");
}

}  // namespace

struct RayScene::Impl {
    const Scene& source;
    RTCDevice device = nullptr;
    std::vector<GeometryInfo> infos;
    std::vector<RTCScene> scenes;
    std::array<RTCScene, kKinds> sceneOf{};

    explicit Impl(const Scene& scene) : source(scene), infos(scene.instances.size()) {}
    ~Impl() {
        for (RTCScene scene : scenes) rtcReleaseScene(scene);
        if (device) rtcReleaseDevice(device);
    }
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;

    RTCGeometry makeGeometry(std::size_t instance);
    void build();
    bool occluded(RayKind kind, const Ray& ray, QueryContext& context) const;
};

RTCGeometry RayScene::Impl::makeGeometry(std::size_t index) {
    const Instance& instance = source.instances[index];
    const Mesh& mesh = source.meshes[static_cast<std::size_t>(instance.mesh)];
    const Material fallback;
    const Material& material =
        instance.material < 0 ? fallback : source.materials[static_cast<std::size_t>(instance.material)];
    GeometryInfo& info = infos[index];
    info = {&source,
            static_cast<std::uint32_t>(index),
            glm::determinant(glm::mat3(instance.worldFromObject)) < 0,
            !material.doubleSided,
            material.alphaMode != AlphaMode::Opaque,
            material.alphaMode == AlphaMode::Blend,
            isTransmissive(material)};

    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* positions = static_cast<glm::vec3*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3),
                                std::max<std::size_t>(mesh.positions.size(), 1)));
    auto* indices = static_cast<std::uint32_t*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                3 * sizeof(std::uint32_t), std::max<std::size_t>(mesh.triangleCount(), 1)));
    if (!positions || !indices) failed(device);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
        positions[i] = glm::vec3(instance.worldFromObject * glm::vec4(mesh.positions[i], 1));
    if (mesh.positions.empty()) positions[0] = glm::vec3(0);
    std::copy(mesh.indices.begin(), mesh.indices.end(), indices);
    if (mesh.indices.empty()) std::fill(indices, indices + 3, 0u);
    rtcSetGeometryUserData(geometry, &info);
    if (info.cullable || info.masked) rtcSetGeometryIntersectFilterFunction(geometry, filterHit);
    if (info.masked || info.transmissive) rtcSetGeometryOccludedFilterFunction(geometry, filterOcclusion);
    rtcCommitGeometry(geometry);
    return geometry;
}

void RayScene::Impl::build() {
    // One builder thread: the order of the tree, and with it which of two equally near hits wins, must not
    // depend on the machine's load.
    device = rtcNewDevice("threads=1");
    if (!device) failed(nullptr);

    std::vector<RTCGeometry> geometries(source.instances.size(), nullptr);
    for (std::size_t i = 0; i < geometries.size(); ++i)
        if (participates(source.instances[i], RayKind::Camera)) geometries[i] = makeGeometry(i);

    std::array<std::vector<bool>, kKinds> members;
    for (int kind = 0; kind < kKinds; ++kind) {
        for (const Instance& instance : source.instances)
            members[static_cast<std::size_t>(kind)].push_back(
                participates(instance, static_cast<RayKind>(kind)));
        for (int other = 0; other < kind && !sceneOf[static_cast<std::size_t>(kind)]; ++other)
            if (members[static_cast<std::size_t>(other)] == members[static_cast<std::size_t>(kind)])
                sceneOf[static_cast<std::size_t>(kind)] = sceneOf[static_cast<std::size_t>(other)];
        if (sceneOf[static_cast<std::size_t>(kind)]) continue;
        RTCScene scene = rtcNewScene(device);
        scenes.push_back(scene);
        sceneOf[static_cast<std::size_t>(kind)] = scene;
        // Robust: no ray slips through an edge that two triangles share.
        rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
        rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_MEDIUM);
        for (std::size_t i = 0; i < geometries.size(); ++i)
            if (members[static_cast<std::size_t>(kind)][i])
                rtcAttachGeometryByID(scene, geometries[i], static_cast<unsigned>(i));
        rtcCommitScene(scene);
    }
    for (RTCGeometry geometry : geometries)
        if (geometry) rtcReleaseGeometry(geometry);
    if (const RTCError error = rtcGetDeviceError(device); error != RTC_ERROR_NONE)
        base::fail(
            ErrorKind::Runtime, "ray structure: Embree reports error %d%s", static_cast<int>(error),
            error == RTC_ERROR_OUT_OF_MEMORY ? " (out of memory); a smaller scene would be right" : "");
}

RayScene::RayScene(const Scene& scene) : impl_(std::make_unique<Impl>(scene)) {
    scene.validate();
    impl_->build();
}
RayScene::~RayScene() = default;
RayScene::RayScene(RayScene&&) noexcept = default;
RayScene& RayScene::operator=(RayScene&&) noexcept = default;

bool RayScene::intersect(RayKind kind, const Ray& ray, RayHit& hit, Blended blended) const {
    RTCRayHit query;
    query.ray = makeRay(ray);
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    QueryContext context = makeContext(kind);
    context.blended = blended;
    RTCScene scene = impl_->sceneOf[static_cast<std::size_t>(kind)];
#if CONELIGHT_EMBREE >= 4
    RTCIntersectArguments arguments;
    rtcInitIntersectArguments(&arguments);
    arguments.context = &context.embree;
    rtcIntersect1(scene, &query, &arguments);
#else
    rtcIntersect1(scene, &context.embree, &query);
#endif
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;
    hit.t = query.ray.tfar;
    hit.instance = query.hit.geomID;
    hit.triangle = query.hit.primID;
    hit.barycentric = {query.hit.u, query.hit.v};
    // In double: twice the area of a triangle of a micrometre, squared, is no float.
    const glm::vec3 normal(glm::normalize(glm::dvec3(query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z)));
    hit.geometricNormal = impl_->infos[hit.instance].mirrored ? -normal : normal;
    return true;
}

bool RayScene::Impl::occluded(RayKind kind, const Ray& ray, QueryContext& context) const {
    RTCRay query = makeRay(ray);
    context.cullsBacks = false;
    RTCScene scene = sceneOf[static_cast<std::size_t>(kind)];
#if CONELIGHT_EMBREE >= 4
    RTCOccludedArguments arguments;
    rtcInitOccludedArguments(&arguments);
    arguments.context = &context.embree;
    rtcOccluded1(scene, &query, &arguments);
#else
    rtcOccluded1(scene, &context.embree, &query);
#endif
    return query.tfar < 0;
}

bool RayScene::occluded(RayKind kind, const Ray& ray) const {
    QueryContext context = makeContext(kind);
    return impl_->occluded(kind, ray, context);
}

glm::vec3 RayScene::transmittance(RayKind kind, const Ray& ray, bool unbent) const {
    QueryContext context = makeContext(kind);
    context.passing = &ray;
    context.blended = Blended::Met;
    context.unbent = unbent;
    if (impl_->occluded(kind, ray, context)) return glm::vec3(0);
    return context.passed * glm::exp(-glm::max(context.depth, glm::vec3(0)));
}

glm::vec3 RayScene::offsetOrigin(const glm::vec3& point, const glm::vec3& n) {
    // Waechter and Binder 2019 ("A fast and robust method for avoiding self-intersection"): steps in units of
    // the last place, but of 1/65536 m close to zero.
    constexpr float kNearZero = 1.0f / 32.0f;
    constexpr float kFloatStep = 1.0f / 65536.0f;
    constexpr float kIntStep = 256.0f;
    glm::vec3 moved;
    for (int i = 0; i < 3; ++i) {
        const auto step = static_cast<std::int32_t>(kIntStep * n[i]);
        const float lastPlaces =
            std::bit_cast<float>(std::bit_cast<std::int32_t>(point[i]) + (point[i] < 0 ? -step : step));
        moved[i] = std::fabs(point[i]) < kNearZero ? point[i] + kFloatStep * n[i] : lastPlaces;
    }
    return moved;
}

}  // namespace conelight::reference

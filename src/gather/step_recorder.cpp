// SPDX-License-Identifier: MIT
#include "gather/step_recorder.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "gl/gl.h"
#include "gl/pass.h"
#include "shared/inspect.h"
#include "shared/irradiance.h"

namespace conelight {

const char* nameOf(PathKind kind) {
    static constexpr const char* kNames[] = {"diffuse cone", "specular cone", "occlusion cone", "cosine ray",
                                             "light ray",    "specular ray",  "occlusion ray",  "cache face"};
    return kNames[static_cast<int>(kind)];
}

const char* nameOf(PathEnd end) {
    static constexpr const char* kNames[] = {"open", "full", "face", "back face", "unused"};
    return kNames[static_cast<int>(end)];
}

const char* nameOf(StepKind kind) {
    static constexpr const char* kNames[] = {"sample", "empty", "voxel", "tested", "hit"};
    return kNames[static_cast<int>(kind)];
}

PathPart partOf(PathKind kind) {
    switch (kind) {
        case PathKind::SpecularCone:
        case PathKind::SpecularRay:
            return PathPart::Specular;
        case PathKind::OcclusionCone:
        case PathKind::OcclusionRay:
            return PathPart::Occlusion;
        default:
            return PathPart::Diffuse;
    }
}

namespace gather {
namespace {

constexpr std::size_t kPartsAt = sizeof(gpu::RecordHeader);
constexpr std::size_t kPathsAt = kPartsAt + RECORD_PARTS * sizeof(gpu::RecordedPart);
constexpr std::size_t kStepsAt = kPathsAt + RECORD_MAX_PATHS * sizeof(gpu::RecordedPath);
constexpr std::size_t kBytes = kStepsAt + RECORD_MAX_STEPS * sizeof(gpu::RecordedStep);

InspectedStep stepOf(const gpu::RecordedStep& s) {
    return {static_cast<StepKind>(s.kind),
            s.position,
            s.distance,
            s.size,
            s.level,
            s.opacity,
            s.total,
            s.radiance};
}

InspectedFace faceOf(const gpu::RecordedPath& p) {
    InspectedFace face;
    const std::uint32_t v = p.faceVoxel;
    face.voxel = {v & 1023u, (v >> 10) & 1023u, (v >> 20) & 1023u};
    const int axis = static_cast<int>(v >> 30);
    face.direction = 2 * axis + (p.faceNormal[axis] < 0 ? 1 : 0);
    face.normal = p.faceNormal;
    face.plane = p.facePlane;
    face.coverage = p.faceCoverage;
    face.albedo = p.faceAlbedo;
    face.radiance = p.faceRadiance;
    face.irradiance = p.faceIrradiance;
    face.updates = p.faceUpdates == FACE_UPDATES_INTERIOR ? -1 : static_cast<int>(p.faceUpdates);
    return face;
}

InspectedPart partOf(const gpu::RecordedPart& part) { return {part.used != 0, part.value, part.scale}; }

// Faces of the cache are recorded with the weights as they come; the lookup divides by their sum.
void normalizeCacheWeights(std::vector<InspectedPath>& paths) {
    float sum = 0;
    for (const InspectedPath& path : paths)
        if (path.kind == PathKind::CacheFace) sum += path.weight.x;
    for (InspectedPath& path : paths)
        if (path.kind == PathKind::CacheFace) path.weight /= std::max(sum, 1e-12f);
}

}  // namespace

StepRecorder::StepRecorder(const glm::ivec2& pixel) : buffer_(kBytes, "recorded steps") {
    buffer_.clear();
    gpu::RecordHeader header{};
    header.pixelX = pixel.x;
    header.pixelY = pixel.y;
    header.share = 1;
    buffer_.update(header);
}

gl::ProgramDesc StepRecorder::variant(gl::ProgramDesc desc) {
    desc.defines.emplace_back("RECORD_STEPS", "1");
    return desc;
}

void StepRecorder::record(const gl::Device& device, const gl::ProgramDesc& desc, gl::Inputs inputs,
                          float share) {
    gl::barrier(gl::Access::Update);
    buffer_.update(offsetof(gpu::RecordHeader, share), &share, sizeof(share));
    device.get(desc).dispatch(inputs.storage("RecordBuffer", buffer_), 1, 1);
    gl::barrier(gl::Access::ShaderStorage);
}

PixelInspection StepRecorder::read() const {
    const gpu::RecordHeader header = buffer_.read<gpu::RecordHeader>(1).front();
    const auto parts = buffer_.read<gpu::RecordedPart>(RECORD_PARTS, kPartsAt);
    const std::size_t pathCount = std::min<std::size_t>(header.paths, RECORD_MAX_PATHS);
    const std::size_t stepCount = std::min<std::size_t>(header.steps, RECORD_MAX_STEPS);
    const auto paths = buffer_.read<gpu::RecordedPath>(pathCount, kPathsAt);
    const auto steps = buffer_.read<gpu::RecordedStep>(stepCount, kStepsAt);

    PixelInspection found;
    found.seen = header.seen != 0;
    found.position = header.position;
    found.normal = header.normal;
    found.depth = header.depth;
    found.diffuse = partOf(parts[PART_DIFFUSE]);
    found.specular = partOf(parts[PART_SPECULAR]);
    found.occlusion = partOf(parts[PART_OCCLUSION]);
    found.complete = header.paths <= RECORD_MAX_PATHS && header.steps <= RECORD_MAX_STEPS;
    for (const gpu::RecordedPath& p : paths) {
        InspectedPath path;
        path.kind = static_cast<PathKind>(p.kind);
        path.end = static_cast<PathEnd>(p.end);
        path.origin = p.origin;
        path.direction = p.direction;
        path.aperture = 2 * std::atan(p.tanHalf);
        // What was not traced has no end: its start may lie before the surface, by rounding.
        path.distance = path.end == PathEnd::Unused ? 0 : p.distance;
        path.weight = p.weight;
        path.radiance = p.radiance;
        path.opacity = p.opacity;
        if (p.face >= 0) path.face = faceOf(p);
        const std::size_t end = std::min<std::size_t>(p.firstStep + p.stepCount, stepCount);
        for (std::size_t i = p.firstStep; i < end; ++i) path.steps.push_back(stepOf(steps[i]));
        found.paths.push_back(std::move(path));
    }
    normalizeCacheWeights(found.paths);
    return found;
}

}  // namespace gather
}  // namespace conelight

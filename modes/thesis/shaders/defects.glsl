// SPDX-License-Identifier: MIT
// The defects of the original program as compile-time switches, all off unless defined by the variant
// (ThesisDefects in include/conelight/settings.h; docs/guide/thesis_mode.md says what each one does).
#ifndef RACING_STORES
#define RACING_STORES 0
#endif
#ifndef CENTER_COVERAGE
#define CENTER_COVERAGE 0
#endif
#ifndef BINARY_OPACITY
#define BINARY_OPACITY 0
#endif
#ifndef FACE_ROUNDING
#define FACE_ROUNDING 0
#endif
#ifndef UNATTENUATED_VOXELS
#define UNATTENUATED_VOXELS 0
#endif
#ifndef UNSHADOWED_VOXELS
#define UNSHADOWED_VOXELS 0
#endif
#ifndef CLIPPED_RADIANCE
#define CLIPPED_RADIANCE 0
#endif
#ifndef DARK_EMITTERS
#define DARK_EMITTERS 0
#endif
#ifndef VOLUME_MIPS
#define VOLUME_MIPS 0
#endif
#ifndef ISOTROPIC_OPACITY
#define ISOTROPIC_OPACITY 0
#endif
#ifndef COARSE_LOD
#define COARSE_LOD 0
#endif
#ifndef NO_STEP_CORRECTION
#define NO_STEP_CORRECTION 0
#endif
#ifndef FORGET_NEAR_COLOR
#define FORGET_NEAR_COLOR 0
#endif
#ifndef DOUBLE_ALPHA
#define DOUBLE_ALPHA 0
#endif
#ifndef LAST_STEP
#define LAST_STEP 0
#endif
#ifndef PREMULTIPLIED_FIRST_HIT
#define PREMULTIPLIED_FIRST_HIT 0
#endif
#ifndef HARD_FIRST_HIT
#define HARD_FIRST_HIT 0
#endif
#ifndef FIXED_OFFSETS
#define FIXED_OFFSETS 0
#endif
#ifndef SHORT_REACH
#define SHORT_REACH 0
#endif
#ifndef NAN_AXES
#define NAN_AXES 0
#endif
#ifndef SHORT_SIDE_AXIS
#define SHORT_SIDE_AXIS 0
#endif
#ifndef GRAZING_SIDE_CONES
#define GRAZING_SIDE_CONES 0
#endif
#ifndef NO_COSINE_WEIGHTS
#define NO_COSINE_WEIGHTS 0
#endif
#ifndef NO_ALBEDO
#define NO_ALBEDO 0
#endif
#ifndef OCCLUSION_FUDGE
#define OCCLUSION_FUDGE 0
#endif
#ifndef OCCLUDED_INDIRECT
#define OCCLUDED_INDIRECT 0
#endif
#ifndef SPECULAR_PER_LIGHT
#define SPECULAR_PER_LIGHT 0
#endif
#ifndef OCCLUDED_SPECULAR
#define OCCLUDED_SPECULAR 0
#endif
#ifndef SHININESS_SATURATION
#define SHININESS_SATURATION 0
#endif
#ifndef FIXED_SPECULAR_APERTURE
#define FIXED_SPECULAR_APERTURE 0
#endif
#ifndef AMBIENT_TWICE
#define AMBIENT_TWICE 0
#endif
#ifndef UNBOUNDED_SPECULAR
#define UNBOUNDED_SPECULAR 0
#endif
#ifndef FINE_STEPS
#define FINE_STEPS 0
#endif

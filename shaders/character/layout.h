// Constants that the shader passes over characters share with the C++ code that runs them: bindings of
// buffers, locations of uniforms and layouts of arrays. Both C++ and GLSL include this file.
#ifndef NOOK_CHARACTER_LAYOUT_H
#define NOOK_CHARACTER_LAYOUT_H

// Bindings of shader storage blocks. A pass uses at most four of them, because OpenGL ES 3.1 does not
// guarantee more.
#define NOOK_BINDING_STREAM 0
#define NOOK_BINDING_MODEL 1
#define NOOK_BINDING_SPHERES 2
// Shadows or colours at key points. Passes over key points write them to this binding, and vertices.comp
// reads them from it.
#define NOOK_BINDING_KEY_POINTS 3
#define NOOK_BINDING_VERTEX_INPUT 2
#define NOOK_BINDING_AO 3
#define NOOK_BINDING_COUNT 4

// Number of threads in a group. Passes over key points copy this many spheres at a time to shared memory.
#define NOOK_GROUP_SIZE 64
#define NOOK_VERTEX_GROUP_SIZE 128

// Uniform locations of spheres.comp.
#define NOOK_LOCATION_SPHERES_COUNT 0
// Uniform locations of the passes over key points (shadows.comp, colours.comp).
#define NOOK_LOCATION_FIRST_RECORD 0
#define NOOK_LOCATION_FIRST_SPHERE 1
#define NOOK_LOCATION_SPHERE_COUNT 2
#define NOOK_LOCATION_FIRST_KEY_POINT 3
#define NOOK_LOCATION_KEY_POINT_COUNT 4
#define NOOK_LOCATION_GAMMA 5
#define NOOK_LOCATION_COMPOSED 6
#define NOOK_LOCATION_SHADOW_STRIDE 7
#define NOOK_LOCATION_SHADOW_OFFSET 8
// Uniform locations of the passes that compute all key points from the evaluated key points of a coarser
// level (spread.comp, colours_spread.comp).
#define NOOK_LOCATION_SPREAD_FIRST_RECORD 0
#define NOOK_LOCATION_SPREAD_KEY_POINT_COUNT 1
#define NOOK_LOCATION_SPREAD_SHADOW_STRIDE 2
#define NOOK_LOCATION_SPREAD_LEVEL 3
// Uniform locations of vertices.comp.
#define NOOK_LOCATION_FILE_VERTEX_COUNT 0
#define NOOK_LOCATION_VERTEX_COUNT 1
#define NOOK_LOCATION_INFLUENCE_PAIRS 2
#define NOOK_LOCATION_VERTEX_SHADOW_STRIDE 3
// Uniform locations of pose_convert.comp, for poses that are on the GPU.
#define NOOK_LOCATION_POSE_BONE_COUNT 0
#define NOOK_LOCATION_POSE_LAYOUT 1
#define NOOK_LOCATION_POSE_IS_HALF 2
#define NOOK_LOCATION_POSE_STRIDE_WORDS 3
#define NOOK_LOCATION_POSE_WINDOW 4
// Uniform locations of pose_place.comp.
#define NOOK_LOCATION_PLACED_BONE_COUNT 0
// Uniform locations of clip_bones.comp.
#define NOOK_LOCATION_CLIP_NUMBER 0
#define NOOK_LOCATION_CLIP_BONE_COUNT 1
#define NOOK_LOCATION_CLIP_MODE_COUNT 2
#define NOOK_LOCATION_CLIP_FIRST_WEIGHT 3
#define NOOK_LOCATION_CLIP_FIRST_MODE 4

// Attributes of vertices.vert: a bias, then for each quad of influences its key points, alphas and blend
// weights. OpenGL 3.3 requires a literal for each location.
#define NOOK_ATTRIBUTE_BIAS 0
#define NOOK_ATTRIBUTE_KEY_POINTS_0 1
#define NOOK_ATTRIBUTE_ALPHA_0 2
#define NOOK_ATTRIBUTE_BLEND_0 3
#define NOOK_ATTRIBUTE_KEY_POINTS_1 4
#define NOOK_ATTRIBUTE_ALPHA_1 5
#define NOOK_ATTRIBUTE_BLEND_1 6

#define NOOK_OUTPUT_AO 0
#define NOOK_OUTPUT_COLOUR 1
#define NOOK_OUTPUT_GREY 2

// A word of the record contains the place of the instance and flags. This flag is set if the instance's own
// spheres darken it.
#define NOOK_RECORD_SELF 0x80000000u
// This flag is set if the instance's pose is on the GPU. pose_place.comp then writes its bones.
#define NOOK_RECORD_POSED 0x40000000u
// If clip_bones.comp decodes the bones of the instance, these bits contain the number that identifies its
// clips. Numbers start at 1 for each model.
#define NOOK_RECORD_CLIPS_SHIFT 20
#define NOOK_RECORD_CLIPS_MASK 0x3ffu
#define NOOK_RECORD_PLACE 0xfffffu
// Another word contains the number of exact spheres. Its upper bits tell how much of the AO is hidden while
// the instance fades in, from 0 to NOOK_HIDDEN_STEPS.
#define NOOK_RECORD_HIDDEN_SHIFT 21
#define NOOK_RECORD_EXACT_COUNT 0x1fffffu
#define NOOK_HIDDEN_STEPS 2047u

// Marks a bone without a transform. Such a bone keeps its matrix.
#define NOOK_POSE_NO_TRANSFORM 0xffffffffu
// Limits for a pose: positions in metres, and the scale of a bone (sdk/src/core/geometry.h).
#define NOOK_POSE_MAX_METRES 1e9
#define NOOK_POSE_MAX_SCALE 1e6

// The maximum of ClipSet::pose.modes (sdk/src/character/clip_set.h).
#define NOOK_MAX_POSE_MODES 512

// Number of array elements per item in storage buffers.
#define NOOK_RECORD_UVEC4S 2      // the record of an instance
#define NOOK_SPHERE_VEC4S 2       // centre, 1 / radius; caster weight
#define NOOK_BONE_ROWS 3          // of a 3x4 matrix
#define NOOK_REST_SPHERE_VEC4S 2  // centre, radius; bone, caster weight
#define NOOK_KEY_POINT_VEC4S 6    // position, normal, surface position, surface normal, bones, weights
#define NOOK_CASTER_UVEC4S 2      // caster's origin minus receiver's origin, first sphere; number of spheres
#define NOOK_SPREAD_WORDS 3       // evaluated key point, scale, offset
#define NOOK_POSE_BIND_UVEC4S 4   // for each bone: three matrix rows; joint position, index of transform
#define NOOK_POSE_JOB_UVEC4S 5    // for each instance: three rows of its place; indices; move of its origin
#define NOOK_CLIP_JOB_UVEC4S 4  // for each instance: three rows of its place; two frames, share of the second
#define NOOK_CLIP_SPAN_WORDS 4  // for each bone: centre, radius
#define NOOK_CLIP_BONE_WORDS 6  // for each bone and mode: twelve 16-bit numbers
#define NOOK_COLOUR_VEC4S 2     // colour that multiplies the shadow, shadow; added occlusion

#endif

#include <nook/experimental/nook_world_sample.h>
#include <nook/nook_world.h>

#include "tests/abi/layout/layout.h"

NOOK_SIZE(nook_capsule, 32);
NOOK_AT(nook_capsule, a, 0);
NOOK_AT(nook_capsule, radius_a, 12);
NOOK_AT(nook_capsule, b, 16);
NOOK_AT(nook_capsule, radius_b, 28);

NOOK_SIZE(nook_model_capsule, 40);
NOOK_AT(nook_model_capsule, capsule, 0);
NOOK_AT(nook_model_capsule, bone, 32);
NOOK_AT(nook_model_capsule, ao_scale, 36);

NOOK_SIZE(nook_world_sample_desc, 96);
NOOK_AT(nook_world_sample_desc, struct_size, 0);
NOOK_AT(nook_world_sample_desc, type, 4);
NOOK_AT(nook_world_sample_desc, next, 8);
NOOK_AT(nook_world_sample_desc, positions, 16);
NOOK_AT(nook_world_sample_desc, normals, 24);
NOOK_AT(nook_world_sample_desc, point_count, 32);
NOOK_AT(nook_world_sample_desc, stride, 36);
NOOK_AT(nook_world_sample_desc, capsules, 40);
NOOK_AT(nook_world_sample_desc, capsule_count, 48);
NOOK_AT(nook_world_sample_desc, receiver, 52);
NOOK_AT(nook_world_sample_desc, light_axis, 56);
NOOK_AT(nook_world_sample_desc, light_degrees, 68);
NOOK_AT(nook_world_sample_desc, lobes, 72);
NOOK_AT(nook_world_sample_desc, lobe_count, 80);
NOOK_AT(nook_world_sample_desc, directional_ao, 88);

#include <nook/nook_world.h>

#include "tests/abi/layout/layout.h"

NOOK_SIZE(nook_world_capsule, 32);
NOOK_AT(nook_world_capsule, a, 0);
NOOK_AT(nook_world_capsule, radius_a, 12);
NOOK_AT(nook_world_capsule, b, 16);
NOOK_AT(nook_world_capsule, radius_b, 28);

NOOK_SIZE(nook_world_caster, 40);
NOOK_AT(nook_world_caster, capsule, 0);
NOOK_AT(nook_world_caster, bone, 32);
NOOK_AT(nook_world_caster, ao_scale, 36);

NOOK_SIZE(nook_world_sample_desc, 96);
NOOK_AT(nook_world_sample_desc, struct_size, 0);
NOOK_AT(nook_world_sample_desc, header_version, 4);
NOOK_AT(nook_world_sample_desc, next, 8);
NOOK_AT(nook_world_sample_desc, positions, 16);
NOOK_AT(nook_world_sample_desc, normals, 24);
NOOK_AT(nook_world_sample_desc, point_count, 32);
NOOK_AT(nook_world_sample_desc, stride, 36);
NOOK_AT(nook_world_sample_desc, props, 40);
NOOK_AT(nook_world_sample_desc, prop_count, 48);
NOOK_AT(nook_world_sample_desc, receiver, 52);
NOOK_AT(nook_world_sample_desc, light_axis, 56);
NOOK_AT(nook_world_sample_desc, light_degrees, 68);
NOOK_AT(nook_world_sample_desc, lobes, 72);
NOOK_AT(nook_world_sample_desc, lobe_count, 80);
NOOK_AT(nook_world_sample_desc, directional_ao, 88);

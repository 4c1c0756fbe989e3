// Sizes and offsets of the public structs on 64-bit systems: what a host was compiled with stays true.
#include <nook/nook_character.h>

#include <cstddef>

#include "catch.h"

extern "C" int nook_call_everything(const void* bytes, size_t size);

#define NOOK_SIZE(type, size) static_assert(sizeof(void*) != 8 || sizeof(type) == (size), #type)
#define NOOK_AT(type, field, offset) \
  static_assert(sizeof(void*) != 8 || offsetof(type, field) == (offset), #type "." #field)

NOOK_SIZE(nook_allocator, 24);
NOOK_AT(nook_allocator, user, 0);
NOOK_AT(nook_allocator, allocate, 8);
NOOK_AT(nook_allocator, release, 16);

NOOK_SIZE(nook_context_desc, 72);
NOOK_AT(nook_context_desc, struct_size, 0);
NOOK_AT(nook_context_desc, header_version, 4);
NOOK_AT(nook_context_desc, next, 8);
NOOK_AT(nook_context_desc, allocator, 16);
NOOK_AT(nook_context_desc, log, 40);
NOOK_AT(nook_context_desc, log_user, 48);
NOOK_AT(nook_context_desc, parallel_for, 56);
NOOK_AT(nook_context_desc, parallel_for_user, 64);

NOOK_SIZE(nook_character_model_info, 40);
NOOK_AT(nook_character_model_info, bone_count, 4);
NOOK_AT(nook_character_model_info, sphere_count, 8);
NOOK_AT(nook_character_model_info, key_point_count, 12);
NOOK_AT(nook_character_model_info, vertex_count, 16);
NOOK_AT(nook_character_model_info, file_vertex_count, 20);
NOOK_AT(nook_character_model_info, primitive_count, 24);
NOOK_AT(nook_character_model_info, lod_count, 28);
NOOK_AT(nook_character_model_info, bounding_radius, 32);
NOOK_AT(nook_character_model_info, gamma, 36);

NOOK_SIZE(nook_scene_desc, 48);
NOOK_AT(nook_scene_desc, struct_size, 0);
NOOK_AT(nook_scene_desc, header_version, 4);
NOOK_AT(nook_scene_desc, next, 8);
NOOK_AT(nook_scene_desc, combine, 16);
NOOK_AT(nook_scene_desc, isa, 20);
NOOK_AT(nook_scene_desc, cutoff_error, 24);
NOOK_AT(nook_scene_desc, lod_error, 28);
NOOK_AT(nook_scene_desc, lod_distance, 32);
NOOK_AT(nook_scene_desc, lod_max_interval, 36);
NOOK_AT(nook_scene_desc, ground_radius, 40);
NOOK_AT(nook_scene_desc, reserved, 44);

NOOK_SIZE(nook_scene_stats, 32);
NOOK_AT(nook_scene_stats, instances, 4);
NOOK_AT(nook_scene_stats, instances_updated, 8);
NOOK_AT(nook_scene_stats, links, 12);
NOOK_AT(nook_scene_stats, links_culled, 16);
NOOK_AT(nook_scene_stats, evaluations, 24);

#include "host.h"

std::vector<std::byte> nook_test_model_bytes() {
  return nook::test::Host().bytes;
}

TEST_CASE("a C program calls every function") {
  const nook::test::Host host;
  CHECK(nook_call_everything(host.bytes.data(), host.bytes.size()) == 0);
}

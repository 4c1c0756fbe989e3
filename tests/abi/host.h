// A host in miniature: an allocator that counts and can refuse, a model's bytes, handles.
#pragma once

#include <nook/nook_character.h>

#include <atomic>
#include <cstdlib>
#include <vector>

#include "sdk/src/character/model_file.h"
#include "tests/character/model_sample.h"
#include "tests/pose_of_rows.h"

namespace nook::test {

struct Host {
  std::atomic<int> blocks{0};       // now held
  std::atomic<int> allocations{0};  // so far
  int refuse_at = -1;               // the allocation, counted from 0, that gets NULL
  std::vector<std::byte> bytes = write_character_model(sample_model());

  static void* allocate(void* user, std::size_t size, std::size_t alignment) {
    Host& host = *static_cast<Host*>(user);
    if (host.allocations++ == host.refuse_at) return nullptr;
    ++host.blocks;
    return std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
  }
  static void release(void* user, void* memory, std::size_t, std::size_t) {
    --static_cast<Host*>(user)->blocks;
    std::free(memory);
  }

  nook_context_desc context_desc() {
    nook_context_desc desc;
    nook_context_desc_init(&desc);
    desc.allocator = {this, allocate, release};
    return desc;
  }
  static nook_scene_desc scene_desc() {
    nook_scene_desc desc;
    nook_scene_desc_init(&desc);
    return desc;
  }
};

// A context, a model, a scene and two instances.
struct Stage {
  Host host;
  nook_context context = nullptr;
  nook_model model = nullptr;
  nook_scene scene = nullptr;
  nook_instance_id first = 0, second = 0;
  nook_model_info info{};
  std::vector<float> pose, ao;

  Stage() {
    const nook_context_desc desc = host.context_desc();
    nook_context_create(&desc, &context);
    nook_model_load(context, host.bytes.data(), host.bytes.size(), &model);
    const nook_scene_desc scene_desc = Host::scene_desc();
    nook_scene_create(context, &scene_desc, &scene);
    nook_scene_add_instance(scene, model, &first);
    nook_scene_add_instance(scene, model, &second);
    info.struct_size = sizeof info;
    nook_model_describe(model, &info);
    ao.resize(info.file_vertex_count);
    const float moved[12] = {1, 0, 0, 0.1f, 0, 1, 0, 0, 0, 0, 1, 0};
    for (std::uint32_t bone = 0; bone < info.bone_count; ++bone)
      pose.insert(pose.end(), std::begin(moved), std::end(moved));
  }
  ~Stage() {
    nook_scene_destroy(&scene);
    nook_model_destroy(&model);
    nook_context_destroy(&context);
  }
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;
};

}  // namespace nook::test

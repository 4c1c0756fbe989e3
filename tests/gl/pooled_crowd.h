// Crowds with a pool, for tests.
#pragma once

#include <nook/experimental/nook_clip_crowds.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "sdk/src/character/clip_set.h"
#include "sdk/src/character/model_file.h"
#include "tests/character/clip_sample.h"
#include "tests/gl/gpu_poses.h"

namespace nook::test {

using Clips = std::vector<nook_instance_clip>;

// A character with clips, and a nook_gl.
struct Stage {
  explicit Stage(platform::Context& of, nook_gl_state_mode mode = NOOK_GL_STATE_PRESERVE,
                 nook_gl_proc_fn loader = platform::Context::loader, void* user = nullptr,
                 const CharacterModel& character = sample_model(31))
      : model(load_model(host.handle, character)),
        gl(create_gl(host.handle, loader, user ? user : &of, 0, mode)),
        bones(static_cast<std::uint32_t>(character.bone_count())) {
    const std::vector<std::byte> bytes = write_clip_set(sample_clips(character).set);
    NOOK_OK_OR_FAIL(nook_clips_load(host.handle, model, bytes.data(), bytes.size(), &clips));
  }
  ~Stage() {
    nook_gl_destroy(&gl);
    nook_clips_destroy(&clips);
    nook_model_destroy(&model);
  }
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;

  CountedContext host;
  nook_model model;
  nook_gl gl;
  nook_clips clips = nullptr;
  std::uint32_t bones;
};

struct PoolOptions {
  std::uint32_t places = 0;  // 0: without a pool
  float distance = 10;
  std::uint32_t nearest = 0, reserved = 0;
  float cutoff_error = 0, lod_error = 0;
};

inline nook_result set_pool(nook_gl gl, nook_scene scene, std::uint32_t places, float distance,
                            std::uint32_t reserved = 0) {
  const nook_gl_pool_desc desc{sizeof desc, places, distance, reserved};
  return nook_gl_scene_set_pool(gl, scene, &desc);
}

// A crowd whose camera stands at the origin.
struct PooledCrowd {
  PooledCrowd(const Stage& on, std::size_t instances, const PoolOptions& options) : stage(on) {
    nook_scene_desc desc;
    NOOK_OK_OR_FAIL(nook_scene_desc_init(&desc));
    desc.cutoff_error = options.cutoff_error;
    desc.far_error = 0;
    desc.lod_error = options.lod_error;
    desc.lod_distance = 1;
    NOOK_OK_OR_FAIL(nook_scene_create(stage.host.handle, &desc, &scene));
    if (options.places)
      NOOK_OK_OR_FAIL(set_pool(stage.gl, scene, options.places, options.distance, options.reserved));
    look_from({});
    for (std::size_t i = 0; i < instances; ++i) add();
    if (options.nearest) NOOK_OK_OR_FAIL(nook_scene_link_nearest(scene, options.nearest, 3));
  }
  ~PooledCrowd() { nook_scene_destroy(&scene); }
  PooledCrowd(const PooledCrowd&) = delete;
  PooledCrowd& operator=(const PooledCrowd&) = delete;

  void add() {
    nook_instance_id id = 0;
    NOOK_OK_OR_FAIL(nook_scene_add_instance(scene, stage.model, &id));
    const float plane[4] = {0, 1, 0, -0.6f};
    if (ids.size() % 3 != 2) NOOK_OK_OR_FAIL(nook_scene_set_ground(scene, id, plane));
    ids.push_back(id);
  }
  void look_from(Vec3 eye) const {
    const float at[3] = {eye.x, eye.y, eye.z};
    NOOK_OK_OR_FAIL(nook_scene_set_camera(scene, at));
  }
  // Plays clips, each instance at its place on the x axis.
  void play(const std::vector<float>& x, double seconds) const {
    Clips all;
    for (std::size_t i = 0; i < ids.size(); ++i) {
      const float s = 1 + 0.1f * float(i % 2);
      all.push_back({ids[i],
                     0,
                     {1, NOOK_CLIP_LOOP, seconds + 0.13 * double(i)},
                     {0, 0, s, x[i], 0, s, 0, 0, -s, 0, 0, 0.3f * float(i % 4)}});
    }
    NOOK_OK_OR_FAIL(
        nook_scene_set_clips(scene, stage.clips, all.data(), static_cast<std::uint32_t>(all.size())));
  }
  void update() const { NOOK_OK_OR_FAIL(nook_gl_scene_update(stage.gl, scene)); }
  std::vector<float> ao(std::size_t i) const {
    std::vector<float> out(file_vertices(stage.model), -1.0f);
    NOOK_OK_OR_FAIL(nook_gl_scene_read(stage.gl, scene, ids[i], NOOK_CHANNEL_AO, out.data(),
                                       static_cast<std::uint32_t>(out.size())));
    return out;
  }
  std::vector<nook_gl_pool_view> views() const {
    std::vector<nook_gl_pool_view> out(ids.size());
    NOOK_OK_OR_FAIL(nook_gl_scene_read_pool(stage.gl, scene, ids.data(),
                                            static_cast<std::uint32_t>(ids.size()), out.data(), nullptr));
    return out;
  }
  nook_gl_pool_info info() const {
    nook_gl_pool_info out{};
    out.struct_size = sizeof out;
    NOOK_OK_OR_FAIL(nook_gl_scene_read_pool(stage.gl, scene, nullptr, 0, nullptr, &out));
    return out;
  }
  // The indices of the instances in a place.
  std::vector<std::size_t> near() const {
    const auto all = views();
    std::vector<std::size_t> out;
    for (std::size_t i = 0; i < all.size(); ++i)
      if (all[i].is_near) out.push_back(i);
    return out;
  }

  const Stage& stage;
  nook_scene scene = nullptr;
  std::vector<nook_instance_id> ids;
};

inline bool is_open(const std::vector<float>& ao) {
  return std::all_of(ao.begin(), ao.end(), [](float value) { return value == 1; });
}

// Near instances have the bits of the other scene, and far ones are open.
inline void check_same(const PooledCrowd& pooled, const PooledCrowd& plain) {
  const auto views = pooled.views();
  for (std::size_t i = 0; i < views.size(); ++i) {
    CAPTURE(i, views[i].is_near);
    if (views[i].is_near)
      CHECK(pooled.ao(i) == plain.ao(i));
    else
      CHECK(is_open(pooled.ao(i)));
  }
}

// Some stand near the camera and some a kilometre away, where they darken none of the near ones.
inline std::vector<float> two_groups(std::size_t count, std::size_t shift = 0) {
  std::vector<float> x;
  for (std::size_t i = 0; i < count; ++i)
    x.push_back((i + shift) % 4 < 2 ? 0.9f * float((i + shift) % 8) : 1000.0f + float(i));
  return x;
}

}  // namespace nook::test

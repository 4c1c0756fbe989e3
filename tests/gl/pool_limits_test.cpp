// What a scene with a pool refuses, what it does when memory is short, and how little memory a far instance
// takes.
#include <nook/experimental/nook_world_sample.h>

#include <cstdio>

#include "platform/file_bytes.h"
#include "tests/gl/pooled_crowd.h"
#include "tests/gl/traced_loader.h"

using namespace nook;
using namespace nook::test;

TEST_CASE("a scene with a pool refuses what it cannot do, and says why") {
  NOOK_NEED_COMPUTE(context);
  const Stage stage(context);
  const PooledCrowd plain(stage, 2, {}), pooled(stage, 4, {2});
  pooled.play({0, 1, 50, 50}, 0);
  pooled.update();
  const nook_scene scene = pooled.scene;
  const nook_instance_id far = pooled.ids[3];
  const auto refused = [](nook_result got, nook_result need, const char* text) {
    CHECK(got == need);
    INFO(nook_last_message());
    CHECK(says(text));
  };
  constexpr nook_result unsupported = NOOK_ERROR_UNSUPPORTED, invalid = NOOK_ERROR_INVALID_ARGUMENT;
  refused(nook_scene_update(scene), unsupported, "has a pool");
  const nook_lobe lobe{{0, 1, 0}, 6, {1, 2, 3}, 0};
  refused(nook_scene_set_light(scene, far, &lobe, 1), unsupported, "has a pool");
  NOOK_OK_OR_FAIL(nook_scene_set_light(scene, far, nullptr, 0));
  std::vector<float> out(file_vertices(stage.model));
  const auto vertices = static_cast<std::uint32_t>(out.size());
  refused(nook_scene_read(scene, far, NOOK_CHANNEL_AO, NOOK_FORMAT_FLOAT, out.data(), vertices, 0),
          unsupported, "has no bones on the CPU");
  std::uint32_t count = 0;
  refused(nook_scene_read_spheres(scene, far, nullptr, &count), unsupported, "has no bones on the CPU");
  refused(nook_scene_read_key_points(scene, far, nullptr, &count), unsupported, "has no bones on the CPU");
  refused(nook_scene_set_model(scene, far, stage.model), unsupported, "has no bones on the CPU");
  std::size_t size = 0;
  refused(nook_scene_record_pose(scene, far, nullptr, &size), unsupported, "has no bones on the CPU");
  nook_gl_view view{};
  view.struct_size = sizeof view;
  refused(nook_gl_scene_view(stage.gl, scene, far, NOOK_CHANNEL_DIRECTIONAL_AO, &view),
          NOOK_ERROR_INVALID_HANDLE, "no light");
  NOOK_OK_OR_FAIL(nook_gl_scene_view(stage.gl, scene, far, NOOK_CHANNEL_AO, &view));
  CHECK(view.count == vertices);
  CHECK(view.buffer == pooled.views()[3].buffer);
  // Descriptors.
  refused(set_pool(stage.gl, scene, 3, 10), invalid, "only the distance of its pool may change");
  refused(set_pool(stage.gl, plain.scene, 3, 10), invalid, "only the distance of its pool may change");
  refused(set_pool(stage.gl, scene, 0, 10), invalid, "desc.places");
  for (const float distance : {0.0f, -1.0f, INFINITY, NAN})
    refused(set_pool(stage.gl, scene, 2, distance), invalid, "desc.distance");
  refused(set_pool(stage.gl, scene, 2, 10, 1u << 20), invalid, "desc.instance_count");
  nook_gl_pool_desc small{sizeof small - 4, 2, 10, 0};
  refused(nook_gl_scene_set_pool(stage.gl, scene, &small), invalid, "desc.struct_size");
  nook_gl_pool_view views[2];
  refused(nook_gl_scene_read_pool(stage.gl, plain.scene, nullptr, 0, nullptr, nullptr), invalid,
          "the scene has no pool");
  const nook_instance_id unknown[2] = {pooled.ids[0], 0};
  refused(nook_gl_scene_read_pool(stage.gl, scene, unknown, 2, views, nullptr), NOOK_ERROR_INVALID_HANDLE,
          "no instance 0");
  // A tier without compute shaders.
  nook_gl without =
      create_gl(stage.host.handle, platform::Context::loader, &context, tiers_of(context).back());
  if (!computes(info_of(without).tier)) {
    nook_scene empty = nullptr;
    nook_scene_desc desc;
    NOOK_OK_OR_FAIL(nook_scene_desc_init(&desc));
    NOOK_OK_OR_FAIL(nook_scene_create(stage.host.handle, &desc, &empty));
    refused(set_pool(without, empty, 2, 10), unsupported, "a pool needs compute shaders");
    nook_scene_destroy(&empty);
    refused(nook_gl_scene_update(without, scene), unsupported, "has a pool");
    refused(nook_gl_scene_read_pool(without, scene, pooled.ids.data(), 1, views, nullptr),
            NOOK_ERROR_INVALID_HANDLE, "has no AO buffer yet");
  }
  nook_gl_destroy(&without);
  pooled.update();
  CHECK(pooled.info().near_count == 2);
}

TEST_CASE("every refused allocation of a pool gives an error and leaves everything usable") {
  NOOK_NEED_COMPUTE(context);
  const Stage stage(context);
  const PooledCrowd plain(stage, 8, {});
  plain.play(two_groups(8), 0.2);
  plain.update();
  auto& host = const_cast<CountedContext&>(stage.host);
  const long long bytes = host.bytes;
  const std::uint64_t gl_bytes = info_of(stage.gl).buffer_bytes;
  int refusals = 0;
  for (long n = 0;; ++n) {
    INFO("allocation " << n);
    nook_result result = NOOK_OK;
    {
      const PooledCrowd pooled(stage, 8, {4});
      pooled.play(two_groups(8), 0.2);
      host.refuse_after = n;
      result = nook_gl_scene_update(stage.gl, pooled.scene);
      host.refuse_after = -1;
      if (result != NOOK_OK) CHECK(result == NOOK_ERROR_OUT_OF_MEMORY);
      pooled.update();
      CHECK(pooled.info().near_count == 4);
      check_same(pooled, plain);
      NOOK_OK_OR_FAIL(nook_gl_scene_release(stage.gl, pooled.scene));
    }
    CHECK(host.bytes == bytes);
    CHECK(info_of(stage.gl).buffer_bytes <= gl_bytes + file_vertices(stage.model) * sizeof(float));
    if (result == NOOK_OK) break;
    ++refusals;
  }
  CHECK(refusals >= 10);  // the parts of four places, their casters, lists of places and chunks
}

TEST_CASE("an update of a pool that OpenGL gives no memory leaves no AO of another instance") {
  NOOK_NEED_COMPUTE(context);
  Trace trace(context);
  const Stage stage(context, NOOK_GL_STATE_PRESERVE, Trace::loader, &trace);
  const PooledCrowd plain(stage, 4, {}), pooled(stage, 4, {2});
  const auto play = [&](const std::vector<float>& x) {
    for (const PooledCrowd* crowd : {&plain, &pooled}) crowd->play(x, 0.2);
    plain.update();
  };
  play({0, 1, 50, 50});
  pooled.update();
  play({50, 50, 0, 1});
  trace.mapping_fails = true;
  CHECK(nook_gl_scene_update(stage.gl, pooled.scene) == NOOK_ERROR_GL);
  trace.mapping_fails = false;
  for (std::size_t i = 0; i < 4; ++i) CHECK(is_open(pooled.ao(i)));
  pooled.update();
  CHECK(pooled.near() == std::vector<std::size_t>{2, 3});
  check_same(pooled, plain);
}

TEST_CASE("the memory of an instance that is far in a pool is at most 512 bytes") {
  NOOK_NEED_COMPUTE(context);
  const std::vector<unsigned char> file = platform::read_file(NOOK_MANNEQUIN);
  const CharacterModel body =
      read_character_model({reinterpret_cast<const std::byte*>(file.data()), file.size()});
  const Stage stage(context, NOOK_GL_STATE_PRESERVE, platform::Context::loader, nullptr, body);
  constexpr std::size_t count = 10'000, places = 200;
  PoolOptions options;
  options.places = places;
  options.distance = 30;
  options.reserved = count;
  options.nearest = 4;
  options.cutoff_error = 1.0f / 1024;
  options.lod_error = 1e-2f;
  const auto x = [](std::size_t instances) {
    std::vector<float> out;
    for (std::size_t i = 0; i < instances; ++i)
      out.push_back(i % 50 == 0 ? 0.1f * float(i / 50) : 100 + 0.1f * float(i));
    return out;
  };
  // The memory of the same places with only their own instances.
  const auto bytes_of = [&] {
    return stage.host.bytes + static_cast<long long>(info_of(stage.gl).buffer_bytes);
  };
  const auto held = [&](std::size_t instances) {
    PoolOptions exact = options;
    exact.reserved = static_cast<std::uint32_t>(instances);
    const long long before = bytes_of();
    const PooledCrowd crowd(stage, instances, exact);
    std::vector<float> near(instances, 500.0f);
    for (std::size_t i = 0; i < places; ++i) near[i] = 0.1f * float(i);
    crowd.play(near, 0.2);
    crowd.update();
    CHECK(crowd.info().near_count == places);
    const long long bytes = bytes_of() - before;
    NOOK_OK_OR_FAIL(nook_gl_scene_release(stage.gl, crowd.scene));
    return bytes;
  };
  const double each = double(held(count) - held(places)) / double(count - places);
  std::printf(
      "memory of a far instance of a pool: %.0f bytes in all, host and OpenGL, with four neighbours\n", each);
  CHECK(each <= 512);

  // Culling, levels and neighbours among 10,000: as if only the near ones were there.
  const PooledCrowd pooled(stage, count, options);
  pooled.play(x(count), 0.2);
  pooled.update();
  CHECK(pooled.info().near_count == places);
  options.places = 0;
  const PooledCrowd plain(stage, places, options);
  Clips all;
  for (std::size_t i = 0; i < places; ++i)
    all.push_back({plain.ids[i],
                   0,
                   {1, NOOK_CLIP_LOOP, 0.2 + 0.13 * double(50 * i)},
                   {0, 0, 1, 0.1f * float(i), 0, 1, 0, 0, -1, 0, 0, 0.3f * float(50 * i % 4)}});
  // The grounds of the crowd, which depend on the index.
  const float plane[4] = {0, 1, 0, -0.6f};
  for (std::size_t i = 0; i < places; ++i)
    NOOK_OK_OR_FAIL(nook_scene_set_ground(plain.scene, plain.ids[i], 50 * i % 3 != 2 ? plane : nullptr));
  NOOK_OK_OR_FAIL(nook_scene_set_clips(plain.scene, stage.clips, all.data(), places));
  plain.update();
  std::size_t different = 0;
  for (std::size_t i = 0; i < places; ++i) different += pooled.ao(50 * i) != plain.ao(i);
  CHECK(different == 0);
  std::uint32_t levels = 0;
  for (std::size_t i = 0; i < places; i += 50) {
    nook_scene_instance_info info{};
    info.struct_size = sizeof info;
    NOOK_OK_OR_FAIL(nook_scene_describe_instance(pooled.scene, pooled.ids[50 * i], &info));
    levels |= 1u << info.level;
  }
  CHECK(levels != 1);
}

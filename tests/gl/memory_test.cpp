// An update must not allocate host memory, read back, wait, or query state outside PRESERVE.
#include <nook/experimental/nook_debug.h>
#include <cstdio>

#include "tests/gl/crowd.h"
#include "tests/gl/test_context.h"
#include "tests/gl/traced_loader.h"

using namespace nook;
using namespace nook::test;

namespace {

// Uploads of the compute tiers go through mapped buffers, whose maps can fail.
bool maps_uploads(int tier) {
  if (computes(tier)) return true;
  std::printf("tier %d maps nothing for uploads: its tables are sent from host memory\n", tier);
  return false;
}

}  // namespace

TEST_CASE("an update allocates nothing, reads nothing back and queries only to preserve") {
  NOOK_NEED_CONTEXT(context);
  CountedContext host;
  nook_model model = load_model(host.handle, sample_model(11));
  for (const int tier : tiers_of(context))
    for (const nook_gl_state_mode mode :
         {NOOK_GL_STATE_PRESERVE, NOOK_GL_STATE_DEFAULTS, NOOK_GL_STATE_HOST}) {
      INFO("tier " << tier << ", mode " << mode);
      Trace trace(context);
      CrowdOptions options;
      options.camera = true;
      options.lod_max_interval = 3;
      Crowd crowd(host.handle, {model}, {5}, options);
      const nook_lobe lobe{{0, 1, 0}, 6, {1, 2, 3}, 0};
      NOOK_OK_OR_FAIL(nook_scene_set_light(crowd.scene, crowd.ids[1], &lobe, 1));
      nook_gl gl = create_gl(host.handle, Trace::loader, &trace, tier, mode);
      NOOK_OK_OR_FAIL(nook_gl_scene_prepare(gl, crowd.scene));
      NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, crowd.scene));
      trace.reset();
      const long allocations = host.allocations;
      for (std::uint32_t frame = 1; frame < 8; ++frame) {
        crowd.pose(frame);
        NOOK_OK_OR_FAIL(nook_scene_set_light(crowd.scene, crowd.ids[1], &lobe, 1));
        NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, crowd.scene));
      }
      CHECK(host.allocations == allocations);
      CHECK(trace.calls_that_begin(computes(tier) ? "glDispatchCompute" : "glDraw") > 0);
      CHECK(trace.calls_that_begin("glGetBufferSubData") == 0);
      CHECK(trace.calls_that_begin("glGetError") == 0);
      CHECK(trace.calls_that_begin("glGen") == 0);
      CHECK_FALSE(trace.mapped_for_reading());
      // NVIDIA's driver waits for the GPU when a buffer that a texture reads is mapped.
      if (!computes(tier)) CHECK(trace.calls("glMapBufferRange") == 0);
      const int queries = trace.calls_that_begin("glGet") + trace.calls_that_begin("glIs");
      if (mode == NOOK_GL_STATE_PRESERVE)
        CHECK(queries > 0);
      else
        CHECK(queries == 0);
      nook_gl_destroy(&gl);
    }
  nook_model_destroy(&model);
}

TEST_CASE("the first update after a prepare allocates nothing") {
  NOOK_NEED_CONTEXT(context);
  CountedContext host;
  nook_model model = load_model(host.handle, sample_model(12));
  for (const int tier : tiers_of(context)) {
    Crowd crowd(host.handle, {model}, {5}, {});
    nook_gl gl = create_gl(host.handle, platform::Context::loader, &context, tier);
    NOOK_OK_OR_FAIL(nook_gl_scene_prepare(gl, crowd.scene));
    const long allocations = host.allocations;
    NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, crowd.scene));
    CHECK(host.allocations == allocations);
    nook_gl_destroy(&gl);
  }
  nook_model_destroy(&model);
}

TEST_CASE("every allocation that is refused gives one error and leaves everything usable") {
  NOOK_NEED_CONTEXT(context);
  CountedContext host;
  nook_model model = load_model(host.handle, sample_model(13));
  for (const int tier : tiers_of(context)) {
    Crowd crowd(host.handle, {model}, {5}, {});
    nook_gl_desc desc;
    NOOK_OK_OR_FAIL(nook_gl_desc_init(&desc));
    desc.get_proc = platform::Context::loader;
    desc.get_proc_user = &context;
    desc.max_tier = tier;
    const long long bytes = host.bytes;
    int refusals = 0;
    for (long n = 0;; ++n) {
      host.refuse_after = n;
      nook_gl gl = nullptr;
      nook_result result = nook_gl_create(host.handle, &desc, &gl);
      if (result == NOOK_OK) result = nook_gl_scene_update(gl, crowd.scene);
      host.refuse_after = -1;
      if (result == NOOK_OK) {
        nook_gl_destroy(&gl);
        break;
      }
      ++refusals;
      INFO("allocation " << n);
      REQUIRE(result == NOOK_ERROR_OUT_OF_MEMORY);
      if (gl) {
        NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, crowd.scene));
        CHECK(difference_to_cpu(gl, crowd, model, 1) < promised_difference);
      }
      nook_gl_destroy(&gl);
      CHECK(host.bytes == bytes);
    }
    // The object, its texts, a model, a chunk and the placements are separate allocations.
    CHECK(refusals >= 5);
  }
  nook_model_destroy(&model);
}

TEST_CASE("an update that OpenGL gives no memory fails, and the next one makes up for it") {
  NOOK_NEED_CONTEXT(context);
  CountedContext host;
  nook_model model = load_model(host.handle, sample_model(14));
  for (const int tier : tiers_of(context)) {
    if (!maps_uploads(tier)) continue;
    Trace trace(context);
    CrowdOptions options;
    options.camera = true;
    options.lod_max_interval = 50;  // so that most instances are not due again in the next frame
    options.links = options.nearest = false;
    Crowd crowd(host.handle, {model}, {5}, options);
    nook_gl gl = create_gl(host.handle, Trace::loader, &trace, tier);
    NOOK_OK_OR_FAIL(nook_gl_scene_prepare(gl, crowd.scene));
    trace.mapping_fails = true;
    CHECK(nook_gl_scene_update(gl, crowd.scene) == NOOK_ERROR_GL);
    CHECK_FALSE(context.gl().IsEnabled(GL_RASTERIZER_DISCARD));
    trace.mapping_fails = false;
    NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, crowd.scene));
    std::vector<std::vector<float>> gpu;
    for (std::size_t i = 0; i < crowd.ids.size(); ++i) gpu.push_back(gpu_ao(gl, crowd, model, i));
    NOOK_OK_OR_FAIL(nook_scene_update(crowd.scene));
    for (std::size_t i = 0; i < crowd.ids.size(); ++i)
      CHECK(largest_difference(gpu[i], cpu_ao(crowd, model, i)) < promised_difference);
    nook_gl_destroy(&gl);
  }
  nook_model_destroy(&model);
}

TEST_CASE("an upload whose contents OpenGL loses is repeated, and fails with a reason if they stay lost") {
  NOOK_NEED_CONTEXT(context);
  CountedContext host;
  nook_model model = load_model(host.handle, sample_model(16));
  const nook_lobe lobe{{0, 1, 0}, 4, {1, 0.5f, 0.2f}, 0};
  for (const int tier : tiers_of(context)) {
    if (!maps_uploads(tier)) continue;
    Trace trace(context);
    Crowd crowd(host.handle, {model}, {5}, {});
    for (const nook_instance_id id : crowd.ids)
      NOOK_OK_OR_FAIL(nook_scene_set_light(crowd.scene, id, &lobe, 1));
    nook_gl gl = create_gl(host.handle, Trace::loader, &trace, tier);
    const auto check = [&] {
      std::vector<std::vector<float>> gpu;
      for (std::size_t i = 0; i < crowd.ids.size(); ++i) gpu.push_back(gpu_ao(gl, crowd, model, i));
      NOOK_OK_OR_FAIL(nook_scene_update(crowd.scene));
      for (std::size_t i = 0; i < crowd.ids.size(); ++i)
        CHECK(largest_difference(gpu[i], cpu_ao(crowd, model, i)) < promised_difference);
    };
    // Every upload counts, the uploads of the preparation too.
    for (const int failures : {2, 0, 1, 2}) {
      crowd.pose(static_cast<std::uint32_t>(failures));
      trace.unmapping_failures = failures;
      NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, crowd.scene));
      check();
    }
    crowd.pose(7);
    trace.unmapping_failures = 1000;
    CHECK(nook_gl_scene_update(gl, crowd.scene) == NOOK_ERROR_GL);
    CHECK(std::string(nook_last_message()).find("glUnmapBuffer reported lost contents") != std::string::npos);
    trace.unmapping_failures = 0;
    NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, crowd.scene));
    check();
    nook_gl_destroy(&gl);
  }
  nook_model_destroy(&model);
}

TEST_CASE("a crowd beyond the limits of the context is refused, and evaluated once it fits") {
  NOOK_NEED_CONTEXT(context);
  if (!computes(tiers_of(context).front())) return;
  CountedContext host;
  Trace trace(context);
  trace.limits[GL_MAX_SHADER_STORAGE_BLOCK_SIZE] = 1 << 24;
  // 30,000 spheres of 32 bytes: seventeen instances fit in 16 MiB, eighteen do not.
  nook_model model = load_model(host.handle, sample_model(15, {2, 30000, 4, 10, 0, 2}));
  CrowdOptions options;
  options.instances = 18;
  options.links = options.nearest = false;
  Crowd crowd(host.handle, {model}, {2}, options);
  nook_gl gl = create_gl(host.handle, Trace::loader, &trace, 0);
  CHECK(nook_gl_scene_update(gl, crowd.scene) == NOOK_ERROR_UNSUPPORTED);
  CHECK(std::string(nook_last_message()).find("the scene has 540000 proxy spheres") != std::string::npos);
  nook_gl_scene_release(gl, crowd.scene);
  NOOK_OK_OR_FAIL(nook_scene_remove_instance(crowd.scene, crowd.ids.back()));
  NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, crowd.scene));
  nook_gl_destroy(&gl);
  nook_model_destroy(&model);
}

TEST_CASE("memory of models and scenes is what the allocator and OpenGL count") {
  NOOK_NEED_CONTEXT(context);
  CountedContext host;
  const long long before = host.bytes;
  nook_model model = load_model(host.handle, sample_model(16, {20, 130, 300, 5000, 200, 4}));
  nook_model_info told{};
  told.struct_size = sizeof told;
  NOOK_OK_OR_FAIL(nook_model_describe(model, &told));
  // A few bytes are the handle's own, which the two count apart.
  CHECK(std::abs(static_cast<long long>(told.model_bytes) - (host.bytes - before)) <= 256);

  constexpr std::uint32_t count = 40;
  CrowdOptions options;
  options.instances = count;
  options.links = options.nearest = options.occluders = false;
  const long long without_scene = host.bytes;
  Crowd crowd(host.handle, {model}, {20}, options);
  std::uint64_t scene_bytes = stats_of(crowd).memory_bytes;
  CHECK(std::abs(static_cast<long long>(scene_bytes) - (host.bytes - without_scene)) <= 256);
  const double told_before = double(count) * double(told.instance_bytes);
  // Lists of slots, and the room that arrays keep to grow.
  CHECK(double(scene_bytes) > told_before);
  CHECK(double(scene_bytes) < 1.15 * told_before);

  const nook_lobe lobe{{0, 1, 0}, 6, {1, 2, 3}, 0};
  for (const nook_instance_id id : crowd.ids)
    NOOK_OK_OR_FAIL(nook_scene_set_light(crowd.scene, id, &lobe, 1));
  scene_bytes = stats_of(crowd).memory_bytes;
  CHECK(double(scene_bytes) < 1.15 * count * double(told.lit_instance_bytes));

  for (const int tier : tiers_of(context)) {
    INFO("tier " << tier);
    nook_gl gl = create_gl(host.handle, platform::Context::loader, &context, tier);
    nook_gl_memory memory{};
    memory.struct_size = sizeof memory;
    NOOK_OK_OR_FAIL(nook_gl_model_memory(gl, model, &memory));
    const std::uint64_t empty = info_of(gl).buffer_bytes;
    NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, crowd.scene));
    const double told_gl = double(memory.model_bytes) + count * double(memory.lit_instance_bytes);
    const double held = double(info_of(gl).buffer_bytes - empty);
    // Buffers that grow keep room for half as much again; 2D textures are not among the buffers.
    CHECK(held < 1.5 * told_gl + 65536);
    CHECK(held > (context.is_es() ? 0.5 : 0.95) * told_gl);
    nook_gl_destroy(&gl);
  }
  nook_model_destroy(&model);
}

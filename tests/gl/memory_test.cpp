// An update must not allocate host memory, read back, wait, or query state outside PRESERVE.
#include <nook/experimental/nook_debug.h>
#include <cstdio>
#include <cstring>

#include "platform/file_bytes.h"
#include "sdk/src/character/instance_light.h"
#include "sdk/src/character/loaded_model.h"
#include "sdk/src/character/model_file.h"
#include "sdk/src/character/scene.h"
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

// The bytes of the arrays in which an update on the CPU computes an instance, and what a light adds to them.
// A sphere has a place and a radius. A key point has 17 numbers, and two of them encoded twice.
struct ArrayBytes {
  long long instance = 0, light = 0;
};

ArrayBytes array_bytes(const CharacterModel& model) {
  const auto padded = [](std::size_t count) { return static_cast<long long>((count + 15) / 16 * 16); };
  const long long key_points = padded(model.key_points.size());
  long long numbers = 4 * padded(model.spheres.size()) + 21 * key_points;
  for (const CharacterLevel& level : model.levels) numbers += 4 * padded(level.spheres.size());
  const SphereGroups groups(model);
  for (std::uint32_t t = 0; t < group_tiers; ++t) numbers += 6 * padded(groups.tier(t).count());
  // Three channels of a shadow, of added occlusion, and of three sums.
  return {4 * numbers, 4 * 15 * key_points};
}

// Everything that the CPU tells about an instance after an update.
struct CpuResults {
  std::vector<float> ao, directional;
  std::vector<nook_scene_key_point> key_points;

  CpuResults(const Crowd& crowd, nook_model model, std::size_t index) : ao(cpu_ao(crowd, model, index)) {
    const nook_instance_id id = crowd.ids[index];
    directional.resize(3 * ao.size());
    NOOK_OK_OR_FAIL(nook_scene_read(crowd.scene, id, NOOK_CHANNEL_DIRECTIONAL_AO, NOOK_FORMAT_FLOAT,
                                    directional.data(), static_cast<std::uint32_t>(ao.size()), 0));
    std::uint32_t count = 0;
    NOOK_OK_OR_FAIL(nook_scene_read_key_points(crowd.scene, id, nullptr, &count));
    key_points.resize(count);
    NOOK_OK_OR_FAIL(nook_scene_read_key_points(crowd.scene, id, key_points.data(), &count));
  }
  bool operator==(const CpuResults& other) const {
    return ao == other.ao && directional == other.directional &&
           key_points.size() == other.key_points.size() &&
           std::memcmp(key_points.data(), other.key_points.data(),
                       key_points.size() * sizeof(nook_scene_key_point)) == 0;
  }
};

// A crowd of two models with all levels. Each third instance has a light, the rest have none.
struct LitCrowd : Crowd {
  explicit LitCrowd(const Cast& cast) : Crowd(cast.context.handle, cast.models, cast.bone_counts, of(cast)) {
    for (std::size_t i = 0; i < ids.size(); i += 3) light(i);
  }
  void light(std::size_t index) const {
    const nook_lobe lobe{{0, 1, 0}, 6, {1, 2, 3}, 0};
    NOOK_OK_OR_FAIL(nook_scene_set_light(scene, ids[index], &lobe, 1));
  }
  static CrowdOptions of(const Cast& cast) {
    CrowdOptions options;
    options.camera = true;
    options.lod_error = cast.coarsest_error;
    return options;
  }
};

// The same crowd, once updated on the CPU from the start and once left to shaders before.
void check_same_results(const LitCrowd& first, const LitCrowd& second, const Cast& cast) {
  for (std::size_t i = 0; i < first.ids.size(); ++i) {
    INFO("instance " << i);
    CHECK(CpuResults(first, cast.model_of(i), i) == CpuResults(second, cast.model_of(i), i));
  }
}

long long bytes_of(const Crowd& crowd) {
  return static_cast<long long>(stats_of(crowd).memory_bytes);
}

}  // namespace

TEST_CASE("a scene that only shaders update has no arrays for the CPU") {
  NOOK_NEED_CONTEXT(context);
  CountedContext host;
  const CharacterModel body = sample_model(16, {20, 130, 300, 5000, 200, 4});
  nook_model model = load_model(host.handle, body);
  const ArrayBytes arrays = array_bytes(body);
  for (const int tier : tiers_of(context)) {
    INFO("tier " << tier);
    CrowdOptions options;
    options.instances = 12;
    options.links = options.nearest = options.occluders = false;
    Crowd crowd(host.handle, {model}, {20}, options);
    const nook_lobe lobe{{0, 1, 0}, 6, {1, 2, 3}, 0};
    NOOK_OK_OR_FAIL(nook_scene_set_light(crowd.scene, crowd.ids[0], &lobe, 1));
    const long long full = bytes_of(crowd);
    nook_gl gl = create_gl(host.handle, platform::Context::loader, &context, tier);
    NOOK_OK_OR_FAIL(nook_gl_scene_prepare(gl, crowd.scene));
    const long long left_out = computes(tier) ? 12 * arrays.instance + arrays.light : 0;
    CHECK(full - bytes_of(crowd) == left_out);
    // A new instance, a first light and another model bring no arrays either.
    const long long before = bytes_of(crowd);
    if (computes(tier)) {
      CHECK(nook_scene_remove_instance(crowd.scene, crowd.ids[11]) == NOOK_OK);
      crowd.ids.pop_back();
      crowd.add(11);
      CHECK(nook_scene_set_model(crowd.scene, crowd.ids[2], model) == NOOK_OK);
      CHECK(bytes_of(crowd) == before);
      NOOK_OK_OR_FAIL(nook_scene_set_light(crowd.scene, crowd.ids[1], &lobe, 1));
      CHECK(bytes_of(crowd) - before ==
            static_cast<long long>(max_light_lobes * (sizeof(LightLobe) + sizeof(LobeBands))));
    }
    // An update on the CPU gets all of them, and the next ones allocate nothing. Its results stay readable.
    const long long without = bytes_of(crowd);
    NOOK_OK_OR_FAIL(nook_scene_update(crowd.scene));
    CHECK(bytes_of(crowd) - without == (computes(tier) ? 12 * arrays.instance + 2 * arrays.light : 0));
    const std::vector<float> ao = cpu_ao(crowd, model, 3);
    NOOK_OK_OR_FAIL(nook_gl_scene_prepare(gl, crowd.scene));
    CHECK(cpu_ao(crowd, model, 3) == ao);
    const long allocations = host.allocations;
    for (std::uint32_t frame = 1; frame < 4; ++frame) {
      crowd.pose(frame);
      NOOK_OK_OR_FAIL(nook_scene_update(crowd.scene));
    }
    CHECK(host.allocations == allocations);
    nook_gl_destroy(&gl);
  }
  nook_model_destroy(&model);
}

TEST_CASE("an update on the CPU after updates in shaders has the bits of a scene without OpenGL") {
  NOOK_NEED_CONTEXT(context);
  for (const int tier : tiers_of(context)) {
    INFO("tier " << tier);
    const Cast cast(KernelForm::nook, 1, true);
    LitCrowd plain(cast), left(cast);
    nook_gl gl = create_gl(cast.context.handle, platform::Context::loader, &context, tier);
    const auto pose = [&](std::uint32_t frame) {
      plain.pose(frame);
      left.pose(frame);
    };
    NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, left.scene));
    pose(1);
    NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, left.scene));
    // The scene changes while it has no arrays.
    for (LitCrowd* crowd : {&plain, &left}) {
      NOOK_OK_OR_FAIL(nook_scene_remove_instance(crowd->scene, crowd->ids.back()));
      crowd->ids.pop_back();
      crowd->add(8);
      crowd->light(4);
      NOOK_OK_OR_FAIL(nook_scene_set_model(crowd->scene, crowd->ids[3], cast.model_of(3)));
    }
    for (std::uint32_t frame = 2; frame < 5; ++frame) {
      pose(frame);
      NOOK_OK_OR_FAIL(nook_scene_update(plain.scene));
      NOOK_OK_OR_FAIL(nook_scene_update(left.scene));
      check_same_results(plain, left, cast);
      NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, left.scene));
      check_same_results(plain, left, cast);
    }
    nook_gl_destroy(&gl);
  }
}

TEST_CASE("a refused allocation of the CPU's arrays is one error, and the scene goes on without them") {
  NOOK_NEED_CONTEXT(context);
  if (!computes(tiers_of(context).front())) return;
  Cast cast(KernelForm::nook, 1.5f, true);
  LitCrowd plain(cast), left(cast);
  NOOK_OK_OR_FAIL(nook_scene_update(plain.scene));
  nook_gl gl = create_gl(cast.context.handle, platform::Context::loader, &context, tiers_of(context).front());
  NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, left.scene));
  const long long bytes = cast.context.bytes;
  int refusals = 0;
  for (long n = 0;; ++n) {
    cast.context.refuse_after = n;
    const nook_result result = nook_scene_update(left.scene);
    cast.context.refuse_after = -1;
    if (result == NOOK_OK) break;
    ++refusals;
    INFO("allocation " << n);
    REQUIRE(result == NOOK_ERROR_OUT_OF_MEMORY);
    CHECK(cast.context.bytes == bytes);
    // As before the first update on the CPU.
    for (const float ao : cpu_ao(left, cast.model_of(1), 1)) REQUIRE(ao == 1);
    NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, left.scene));
  }
  // Two arrays of each of nine instances, and one of each of three lights.
  CHECK(refusals == 2 * 9 + 3);
  check_same_results(plain, left, cast);
  nook_gl_destroy(&gl);

  // A tier without compute shaders needs the arrays too, and asks for them when it prepares.
  LitCrowd moving(cast);
  gl = create_gl(cast.context.handle, platform::Context::loader, &context, tiers_of(context).front());
  NOOK_OK_OR_FAIL(nook_gl_scene_prepare(gl, moving.scene));
  nook_gl_destroy(&gl);
  gl = create_gl(cast.context.handle, platform::Context::loader, &context, tiers_of(context).back());
  const long long without = bytes_of(moving);
  cast.context.refuse_after = 2 * 9 + 2;
  CHECK(nook_gl_scene_prepare(gl, moving.scene) == NOOK_ERROR_OUT_OF_MEMORY);
  cast.context.refuse_after = -1;
  CHECK(bytes_of(moving) == without);
  NOOK_OK_OR_FAIL(nook_gl_scene_prepare(gl, moving.scene));
  const long allocations = cast.context.allocations;
  NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, moving.scene));
  CHECK(cast.context.allocations == allocations);
  CHECK(difference_to_cpu(gl, moving, cast.model_of(0), 0) < promised_difference);
  nook_gl_destroy(&gl);
}

TEST_CASE("the memory of an instance is what the documents say") {
  NOOK_NEED_CONTEXT(context);
  CountedContext host;
  const std::vector<unsigned char> file = platform::read_file(NOOK_MANNEQUIN);
  const CharacterModel body =
      read_character_model({reinterpret_cast<const std::byte*>(file.data()), file.size()});
  nook_model model = load_model(host.handle, body);
  constexpr std::uint32_t count = 256;
  CrowdOptions options;
  options.instances = count;
  options.links = options.nearest = options.occluders = false;
  for (const int tier : tiers_of(context)) {
    Crowd crowd(host.handle, {model}, {static_cast<std::uint32_t>(body.bone_count())}, options);
    nook_gl gl = create_gl(host.handle, platform::Context::loader, &context, tier);
    nook_gl_memory memory{};
    memory.struct_size = sizeof memory;
    NOOK_OK_OR_FAIL(nook_gl_model_memory(gl, model, &memory));
    const double full = double(bytes_of(crowd)) / count;
    const long long before = host.bytes - bytes_of(crowd);
    NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, crowd.scene));
    const double held = double(bytes_of(crowd)) / count;
    const double places = double(host.bytes - bytes_of(crowd) - before) / count;
    const double lit = max_light_lobes * (sizeof(LightLobe) + sizeof(LobeBands)) +
                       (computes(tier) ? 0.0 : double(array_bytes(body).light));
    const std::size_t bones = body.bone_count() * sizeof(Mat3x4),
                      casters = body.world_casters.size() * sizeof(PosedCaster);
    std::printf(
        "memory of an instance, tier %d: %.0f bytes in the scene (%.0f for an update on the CPU: %zu of the "
        "struct, %zu of bones, %zu of world casters, %lld of arrays), %.0f with a light; %.0f of places in "
        "nook_gl\n",
        tier, held, full, sizeof(Instance) + sizeof(InstanceParts), bones, casters,
        array_bytes(body).instance, held + lit, places);
    // What compute shaders keep of an instance: AO, two numbers for each key point and for each point of the
    // largest coarse level, two vectors for each sphere of each level, and in the stream a record and bones.
    std::size_t spheres = body.spheres.size(), coarse = 0;
    for (const CharacterLevel& level : body.levels) {
      spheres += level.spheres.size();
      coarse = std::max(coarse, level.evaluated.size());
    }
    const std::size_t ao = sizeof(float) * file_vertices(model),
                      shadows = 2 * sizeof(float) * (body.key_points.size() + coarse), posed = 32 * spheres,
                      stream = 32 + bones;
    if (computes(tier)) {
      std::printf(
          "OpenGL memory of an instance, tier %d: %zu bytes of AO, %zu of shadows, %zu of "
          "spheres, %zu of the stream\n",
          tier, ao, shadows, posed, stream);
      CHECK(memory.instance_bytes == ao + shadows + posed + stream);
    }
    // docs/conventions.md: 55 KB with the arrays, and 6 KB without.
    CHECK(full < 1.1 * 55e3);
    CHECK(held < (computes(tier) ? 6e3 : 1.1 * 55e3));
    nook_gl_destroy(&gl);
  }
  nook_model_destroy(&model);
}

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
      CHECK(trace.forbidden_in_frame(mode == NOOK_GL_STATE_PRESERVE) == std::set<std::string>());
      // NVIDIA's driver waits for the GPU when a buffer that a texture reads is mapped.
      if (!computes(tier)) CHECK(trace.calls("glMapBufferRange") == 0);
      if (mode == NOOK_GL_STATE_PRESERVE)
        CHECK(trace.calls_that_begin("glGet") + trace.calls_that_begin("glIs") > 0);
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

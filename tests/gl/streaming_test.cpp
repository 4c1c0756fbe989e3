// Streaming: a scene whose models are uploaded in pieces ends with the AO of a scene that is prepared at
// once, to the bit. Until then, pending instances have AO 1.
#include <nook/experimental/nook_streaming.h>

#include <algorithm>
#include <mutex>
#include <thread>

#include "tests/gl/crowd.h"
#include "tests/gl/pooled_crowd.h"
#include "tests/gl/test_context.h"
#include "tests/gl/traced_loader.h"

using namespace nook;
using namespace nook::test;

namespace {

nook_result set_streaming(nook_gl gl, nook_scene scene, std::uint32_t fade_updates = 0,
                          std::uint32_t instances = 0) {
  const nook_gl_stream_desc desc{sizeof desc, fade_updates, instances};
  return nook_gl_scene_set_streaming(gl, scene, &desc);
}

nook_gl_stream_info prepare_within(nook_gl gl, nook_scene scene, std::uint32_t budget_us = 0) {
  nook_gl_stream_info info{};
  info.struct_size = sizeof info;
  NOOK_OK_OR_FAIL(nook_gl_scene_prepare_within(gl, scene, budget_us, &info));
  return info;
}

// Returns the number of calls until nothing is pending.
int prepare_all(nook_gl gl, nook_scene scene) {
  int calls = 1;
  for (; prepare_within(gl, scene).pending_count > 0; ++calls) REQUIRE(calls < 10'000);
  return calls;
}

std::vector<nook_gl_pool_view> views_of(nook_gl gl, const Crowd& crowd) {
  std::vector<nook_gl_pool_view> views(crowd.ids.size());
  NOOK_OK_OR_FAIL(nook_gl_scene_read_pool(gl, crowd.scene, crowd.ids.data(),
                                          static_cast<std::uint32_t>(crowd.ids.size()), views.data(),
                                          nullptr));
  return views;
}

std::vector<float> directional_ao(nook_gl gl, const Crowd& crowd, nook_model model, std::size_t index) {
  std::vector<float> out(3 * std::size_t{file_vertices(model)});
  NOOK_OK_OR_FAIL(nook_gl_scene_read(gl, crowd.scene, crowd.ids[index], NOOK_CHANNEL_DIRECTIONAL_AO,
                                     out.data(), file_vertices(model)));
  return out;
}

bool all_ones(const std::vector<float>& ao) {
  return std::all_of(ao.begin(), ao.end(), [](float value) { return value == 1; });
}

CrowdOptions with_levels(const Cast& cast) {
  CrowdOptions options;
  options.camera = true;
  options.lod_error = cast.coarsest_error;
  return options;
}

void light(const Crowd& crowd, std::size_t index) {
  const nook_lobe lobe{{0, 1, 0}, 6, {1, 2, 3}, 0};
  NOOK_OK_OR_FAIL(nook_scene_set_light(crowd.scene, crowd.ids[index], &lobe, 1));
}

void check_no_errors(platform::Context& context) {
  CHECK(context.gl().GetError() == GL_NO_ERROR);
  for (const std::string& message : take_debug_messages()) FAIL_CHECK(message);
}

}  // namespace

TEST_CASE("a streamed scene has ones first, and then the AO of a scene prepared at once, to the bit") {
  NOOK_NEED_CONTEXT(context);
  for (const int tier : tiers_of(context)) {
    INFO("tier " << tier);
    const Cast cast(KernelForm::nook, 1.5f, true);
    Crowd plain(cast.context.handle, cast.models, cast.bone_counts, with_levels(cast));
    Crowd streamed(cast.context.handle, cast.models, cast.bone_counts, with_levels(cast));
    for (const std::size_t i : {std::size_t{0}, std::size_t{3}, std::size_t{4}}) {
      light(plain, i);
      light(streamed, i);
    }
    nook_gl gl = create_gl(cast.context.handle, platform::Context::loader, &context, tier);
    NOOK_OK_OR_FAIL(set_streaming(gl, streamed.scene));
    // Without a preparation, everything is pending.
    NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, streamed.scene));
    for (std::size_t i = 0; i < streamed.ids.size(); ++i) {
      CHECK(all_ones(gpu_ao(gl, streamed, cast.model_of(i), i)));
      nook_gl_view view{};
      view.struct_size = sizeof view;
      NOOK_OK_OR_FAIL(nook_gl_scene_view(gl, streamed.scene, streamed.ids[i], NOOK_CHANNEL_AO, &view));
      CHECK(view.count == file_vertices(cast.model_of(i)));
      CHECK(context.gl().IsBuffer(view.buffer));
    }
    int calls = 0, partly = 0;
    nook_gl_stream_info info{};
    do {
      info = prepare_within(gl, streamed.scene);
      REQUIRE(++calls < 1000);
      NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, streamed.scene));
      const auto views = views_of(gl, streamed);
      const auto ready =
          std::count_if(views.begin(), views.end(), [](auto& view) { return view.is_near == 1; });
      CHECK(static_cast<std::size_t>(ready) + info.pending_count == views.size());
      partly += ready > 0 && info.pending_count > 0;
      for (std::size_t i = 0; i < views.size(); ++i)
        CHECK(all_ones(gpu_ao(gl, streamed, cast.model_of(i), i)) == (views[i].is_near == 0));
    } while (info.pending_count > 0);
    CHECK(calls > 9);
    CHECK(partly > 0);
    for (std::uint32_t frame = 1; frame < 3; ++frame) {
      for (Crowd* crowd : {&plain, &streamed}) {
        crowd->pose(frame);
        prepare_all(gl, streamed.scene);
        NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, crowd->scene));
      }
      for (std::size_t i = 0; i < plain.ids.size(); ++i) {
        INFO("instance " << i);
        CHECK(gpu_ao(gl, streamed, cast.model_of(i), i) == gpu_ao(gl, plain, cast.model_of(i), i));
      }
      for (const std::size_t i : {std::size_t{0}, std::size_t{3}, std::size_t{4}})
        CHECK(directional_ao(gl, streamed, cast.model_of(i), i) ==
              directional_ao(gl, plain, cast.model_of(i), i));
    }
    // The CPU evaluates pending instances too.
    NOOK_OK_OR_FAIL(nook_gl_scene_release(gl, streamed.scene));
    NOOK_OK_OR_FAIL(set_streaming(gl, streamed.scene));
    NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, streamed.scene));
    CHECK(all_ones(directional_ao(gl, streamed, cast.model_of(3), 3)));
    NOOK_OK_OR_FAIL(nook_scene_update(plain.scene));
    NOOK_OK_OR_FAIL(nook_scene_update(streamed.scene));
    CHECK(cpu_ao(streamed, cast.model_of(1), 1) == cpu_ao(plain, cast.model_of(1), 1));
    // A preparation without a budget uploads everything.
    NOOK_OK_OR_FAIL(nook_gl_scene_prepare(gl, streamed.scene));
    CHECK(prepare_within(gl, streamed.scene).pending_count == 0);
    nook_gl_destroy(&gl);
  }
  check_no_errors(context);
}

TEST_CASE("the AO of a new instance fades in over the stated number of updates") {
  NOOK_NEED_CONTEXT(context);
  CountedContext host;
  nook_model model = load_model(host.handle, sample_model(31));
  for (const int tier : tiers_of(context)) {
    INFO("tier " << tier);
    CrowdOptions options;
    options.camera = true;
    options.lod_max_interval = 50;  // an instance that fades is evaluated all the same
    options.spacing = 40;           // metres; far from the camera, instances wait for their turn
    Crowd crowd(host.handle, {model}, {5}, options);
    light(crowd, 2);
    nook_gl gl = create_gl(host.handle, platform::Context::loader, &context, tier);
    constexpr std::uint32_t fade = 4;
    NOOK_OK_OR_FAIL(set_streaming(gl, crowd.scene, fade));
    prepare_all(gl, crowd.scene);
    std::vector<std::vector<float>> ao, directional, far;
    for (std::uint32_t update = 0; update <= fade; ++update) {
      NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, crowd.scene));
      ao.push_back(gpu_ao(gl, crowd, model, 1));
      directional.push_back(directional_ao(gl, crowd, model, 2));
      far.push_back(gpu_ao(gl, crowd, model, crowd.ids.size() - 1));
    }
    CHECK(ao[fade - 1] == ao[fade]);
    CHECK_FALSE(all_ones(ao[fade]));
    for (std::uint32_t update = 0; update < fade; ++update) {
      // Shares have steps of 1 / 2047.
      const float hidden = 1 - float(update + 1) / fade;
      for (const auto* values : {&ao, &directional, &far})
        for (std::size_t v = 0; v < (*values)[update].size(); ++v) {
          const float open = (*values)[fade][v];
          REQUIRE(std::abs((*values)[update][v] - (open + hidden * (1 - open))) < 1.0f / 2047 + 1e-6f);
        }
    }
    // Instances that are there keep their AO while another one fades in.
    const auto before = views_of(gl, crowd);
    crowd.add(crowd.ids.size());
    prepare_all(gl, crowd.scene);
    NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, crowd.scene));
    const auto after = views_of(gl, crowd);
    for (std::size_t i = 0; i < before.size(); ++i) {
      CHECK(after[i].buffer == before[i].buffer);
      CHECK(after[i].offset == before[i].offset);
      CHECK(after[i].generation == before[i].generation);
    }
    CHECK(after.back().is_near == 1);
    nook_gl_destroy(&gl);
  }
  nook_model_destroy(&model);
  check_no_errors(context);
}

TEST_CASE("streamed clips and poses on the GPU have the AO of a scene prepared at once, to the bit") {
  NOOK_NEED_COMPUTE(context);
  const Stage stage(context);
  PoolOptions options;
  options.nearest = 3;
  const PooledCrowd plain(stage, 8, options), streamed(stage, 8, options);
  NOOK_OK_OR_FAIL(set_streaming(stage.gl, streamed.scene));
  const std::vector<float> x = {0, 1, 2, 3, 4, 5, 6, 7};
  for (const PooledCrowd* crowd : {&plain, &streamed}) crowd->play(x, 0.3);
  // The models are there before the clips.
  NOOK_OK_OR_FAIL(nook_gl_scene_update(stage.gl, plain.scene));
  std::uint32_t pending = 8;
  while (pending > 0) {
    pending = prepare_within(stage.gl, streamed.scene).pending_count;
    streamed.update();
    const auto views = streamed.views();
    for (std::size_t i = 0; i < 8; ++i) CHECK(is_open(streamed.ao(i)) == (views[i].is_near == 0));
  }
  streamed.update();
  for (std::size_t i = 0; i < 8; ++i) CHECK(streamed.ao(i) == plain.ao(i));

  // A pose on the GPU that came before the instance was ready is lost, and the instance waits for the next
  // one.
  const Twins twins(context);
  CHECK(set_streaming(twins.gl, twins.on_gpu.scene) == NOOK_OK);
  const Transforms transforms;
  const CrowdPoses poses = random_poses(transforms, twins.on_gpu.ids.size());
  pose_on_cpu(twins.on_cpu, poses);
  const_cast<Twins&>(twins).set(poses);
  prepare_all(twins.gl, twins.on_gpu.scene);
  NOOK_OK_OR_FAIL(nook_gl_scene_update(twins.gl, twins.on_gpu.scene));
  CHECK(all_ones(gpu_ao(twins.gl, twins.on_gpu, twins.model, 1)));
  const_cast<Twins&>(twins).set(poses);
  NOOK_OK_OR_FAIL(nook_gl_scene_update(twins.gl, twins.on_gpu.scene));
  NOOK_OK_OR_FAIL(nook_gl_scene_update(twins.gl, twins.on_cpu.scene));
  for (std::size_t i = 0; i < twins.on_gpu.ids.size(); ++i)
    CHECK(largest_difference(gpu_ao(twins.gl, twins.on_gpu, twins.model, i),
                             gpu_ao(twins.gl, twins.on_cpu, twins.model, i)) < promised_difference);
  check_no_errors(context);
}

TEST_CASE("a thousand frames of models that come and go wait for nothing and leave nothing", "[one-driver]") {
  NOOK_NEED_CONTEXT(context);
  for (const int tier : tiers_of(context))
    for (const nook_gl_state_mode mode : {NOOK_GL_STATE_DEFAULTS, NOOK_GL_STATE_HOST}) {
      INFO("tier " << tier << ", mode " << mode);
      Trace trace(context);
      CountedContext host;
      nook_model base = load_model(host.handle, sample_model(5));
      {
        Crowd crowd(host.handle, {base}, {5}, {});
        nook_gl gl = create_gl(host.handle, Trace::loader, &trace, tier, mode);
        NOOK_OK_OR_FAIL(set_streaming(gl, crowd.scene, 3, 40));
        prepare_all(gl, crowd.scene);
        NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, crowd.scene));
        const std::uint64_t gl_bytes = info_of(gl).buffer_bytes;
        std::vector<std::pair<nook_model, nook_instance_id>> guests;
        std::uint64_t most = 0;
        trace.reset();
        for (std::uint32_t frame = 0; frame < 1000; ++frame) {
          if (frame % 2 == 0) {
            nook_model model = load_model(host.handle, sample_model(100 + frame % 8));
            nook_instance_id id = 0;
            NOOK_OK_OR_FAIL(nook_scene_add_instance(crowd.scene, model, &id));
            guests.emplace_back(model, id);
          }
          if (guests.size() > 5) {
            NOOK_OK_OR_FAIL(nook_scene_remove_instance(crowd.scene, guests.front().second));
            nook_model_destroy(&guests.front().first);
            guests.erase(guests.begin());
          }
          crowd.pose(frame % 4);
          prepare_within(gl, crowd.scene, 50);
          NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, crowd.scene));
          if (frame == 100) most = info_of(gl).buffer_bytes;
        }
        // Making objects is allowed here.
        std::set<std::string> forbidden = trace.forbidden_in_frame(false);
        std::erase_if(forbidden, [](const std::string& name) { return name.starts_with("glGen"); });
        CHECK(forbidden == std::set<std::string>());
        CHECK(info_of(gl).buffer_bytes < 2 * most);
        for (auto& [model, id] : guests) {
          NOOK_OK_OR_FAIL(nook_scene_remove_instance(crowd.scene, id));
          nook_model_destroy(&model);
        }
        prepare_within(gl, crowd.scene, 1'000'000);
        // The spheres and the buffers that are filled in each frame stay as large as they were.
        CHECK(info_of(gl).buffer_bytes < gl_bytes + most);
        nook_gl_destroy(&gl);
      }
      nook_model_destroy(&base);
      nook_context_destroy(&host.handle);
      CHECK(host.bytes == 0);
      check_no_errors(context);
    }
}

TEST_CASE("models load on another thread while frames run") {
  NOOK_NEED_CONTEXT(context);
  nook_context_desc desc;
  NOOK_OK_OR_FAIL(nook_context_desc_init(&desc));
  nook_context host = nullptr;
  NOOK_OK_OR_FAIL(nook_context_create(&desc, &host));
  nook_model base = load_model(host, sample_model(5));
  {
    Crowd crowd(host, {base}, {5}, {});
    nook_gl gl = create_gl(host, platform::Context::loader, &context, tiers_of(context).front());
    NOOK_OK_OR_FAIL(set_streaming(gl, crowd.scene));
    constexpr std::size_t count = 20;
    std::mutex mutex;
    std::vector<nook_model> loaded;
    std::vector<std::vector<std::byte>> files;
    for (std::uint32_t i = 0; i < count; ++i) files.push_back(write_character_model(sample_model(50 + i)));
    std::thread loader([&] {
      for (const std::vector<std::byte>& file : files) {
        nook_model model = nullptr;
        if (nook_model_load(host, file.data(), file.size(), &model) != NOOK_OK) return;
        const std::lock_guard lock(mutex);
        loaded.push_back(model);
      }
    });
    std::vector<nook_model> models;
    while (models.size() < count) {
      {
        const std::lock_guard lock(mutex);
        for (; models.size() < loaded.size(); crowd.ids.emplace_back()) {
          models.push_back(loaded[models.size()]);
          nook_instance_id id = 0;
          NOOK_OK_OR_FAIL(nook_scene_add_instance(crowd.scene, models.back(), &id));
        }
      }
      prepare_within(gl, crowd.scene, 100);
      NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, crowd.scene));
    }
    loader.join();
    prepare_all(gl, crowd.scene);
    NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, crowd.scene));
    for (nook_model& model : models) nook_model_destroy(&model);
    nook_gl_destroy(&gl);
  }
  nook_model_destroy(&base);
  nook_context_destroy(&host);
  check_no_errors(context);
}

TEST_CASE("every allocation that streaming is refused gives one error, and the next call goes on") {
  NOOK_NEED_CONTEXT(context);
  CountedContext host;
  nook_model model = load_model(host.handle, sample_model(13));
  for (const int tier : tiers_of(context)) {
    nook_gl gl = create_gl(host.handle, platform::Context::loader, &context, tier);
    Crowd plain(host.handle, {model}, {5}, {});
    NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, plain.scene));
    int refusals = 0;
    for (long n = 0;; ++n) {
      Crowd crowd(host.handle, {model}, {5}, {});
      light(crowd, 0);
      INFO("tier " << tier << ", allocation " << n);
      host.refuse_after = n;
      nook_result result = set_streaming(gl, crowd.scene, 0, 20);
      nook_gl_stream_info info{};
      info.struct_size = sizeof info;
      info.pending_count = 1;
      while (result == NOOK_OK && info.pending_count > 0)
        result = nook_gl_scene_prepare_within(gl, crowd.scene, 0, &info);
      if (result == NOOK_OK) result = nook_gl_scene_update(gl, crowd.scene);
      host.refuse_after = -1;
      if (result != NOOK_OK) CHECK(result == NOOK_ERROR_OUT_OF_MEMORY);
      NOOK_OK_OR_FAIL(set_streaming(gl, crowd.scene));
      prepare_all(gl, crowd.scene);
      NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, crowd.scene));
      for (std::size_t i = 0; i < crowd.ids.size(); ++i)
        CHECK(gpu_ao(gl, crowd, model, i) == gpu_ao(gl, plain, model, i));
      if (result == NOOK_OK) break;
      ++refusals;
    }
    CHECK(refusals >= 5);
    nook_gl_destroy(&gl);
  }
  nook_model_destroy(&model);
  CHECK(context.gl().GetError() == GL_NO_ERROR);
}

TEST_CASE("a context that is lost while models stream ends the mode, and a new one begins it again") {
  NOOK_NEED_CONTEXT(context);
  CountedContext host;
  nook_model model = load_model(host.handle, sample_model(7));
  Crowd crowd(host.handle, {model}, {5}, {});
  for (const int tier : tiers_of(context)) {
    nook_gl gl = create_gl(host.handle, platform::Context::loader, &context, tier);
    NOOK_OK_OR_FAIL(set_streaming(gl, crowd.scene));
    CHECK(prepare_within(gl, crowd.scene).pending_count > 0);
    context.clear_current();
    CHECK(nook_gl_context_lost(gl) == NOOK_OK);
    CHECK(nook_gl_scene_prepare_within(gl, crowd.scene, 100, nullptr) == NOOK_ERROR_GL);
    CHECK(set_streaming(gl, crowd.scene) == NOOK_ERROR_GL);
    nook_gl_destroy(&gl);
    context.make_current();
    gl = create_gl(host.handle, platform::Context::loader, &context, tier);
    CHECK(nook_gl_scene_prepare_within(gl, crowd.scene, 100, nullptr) == NOOK_ERROR_INVALID_ARGUMENT);
    NOOK_OK_OR_FAIL(set_streaming(gl, crowd.scene));
    prepare_all(gl, crowd.scene);
    NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, crowd.scene));
    CHECK(difference_to_cpu(gl, crowd, model, 2) < promised_difference);
    nook_gl_destroy(&gl);
  }
  nook_model_destroy(&model);
}

TEST_CASE("streaming refuses what it cannot do") {
  NOOK_NEED_CONTEXT(context);
  CountedContext host;
  nook_model model = load_model(host.handle, sample_model(7));
  {
    Crowd crowd(host.handle, {model}, {5}, {});
    nook_gl gl = create_gl(host.handle, platform::Context::loader, &context, 0);
    CHECK(nook_gl_scene_prepare_within(gl, crowd.scene, 100, nullptr) == NOOK_ERROR_INVALID_ARGUMENT);
    CHECK(says("not in streaming mode"));
    CHECK(nook_gl_scene_set_streaming(gl, crowd.scene, nullptr) == NOOK_ERROR_INVALID_ARGUMENT);
    CHECK(set_streaming(gl, crowd.scene, 2048) == NOOK_ERROR_INVALID_ARGUMENT);
    CHECK(says("desc.fade_updates"));
    CHECK(set_streaming(gl, crowd.scene, 0, 1u << 20) == NOOK_ERROR_INVALID_ARGUMENT);
    CHECK(says("desc.instance_count"));
    const nook_gl_stream_desc small{8, 0, 0};
    CHECK(nook_gl_scene_set_streaming(gl, crowd.scene, &small) == NOOK_ERROR_INVALID_ARGUMENT);
    CHECK(says("desc.struct_size"));
    NOOK_OK_OR_FAIL(set_streaming(gl, crowd.scene, 10));
    NOOK_OK_OR_FAIL(set_streaming(gl, crowd.scene, 2047));
    // Another nook_gl of the same scene is not in the mode.
    nook_gl other = create_gl(host.handle, platform::Context::loader, &context, 0);
    NOOK_OK_OR_FAIL(nook_gl_scene_update(other, crowd.scene));
    CHECK_FALSE(all_ones(gpu_ao(other, crowd, model, 1)));
    nook_gl_destroy(&other);
    if (computes(tiers_of(context).front())) {
      CrowdOptions no_instances;
      no_instances.instances = 0;
      Crowd empty(host.handle, {model}, {5}, no_instances);
      NOOK_OK_OR_FAIL(set_streaming(gl, empty.scene));
      NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, empty.scene));
      CHECK(set_pool(gl, empty.scene, 4, 10) == NOOK_ERROR_UNSUPPORTED);
      Crowd pooled(host.handle, {model}, {5}, no_instances);
      NOOK_OK_OR_FAIL(set_pool(gl, pooled.scene, 4, 10));
      CHECK(set_streaming(gl, pooled.scene) == NOOK_ERROR_UNSUPPORTED);
    }
    nook_gl_destroy(&gl);
  }
  nook_model_destroy(&model);
}

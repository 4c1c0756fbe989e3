// The CPU and the tiers of OpenGL give the same AO, whatever a scene is made of.
#include <nook/experimental/nook_debug.h>
#include "tests/gl/crowd.h"
#include "tests/gl/test_context.h"
#include "tests/gl/traced_loader.h"

using namespace nook;
using namespace nook::test;

namespace {

float difference(nook_gl gl, const Crowd& on_gpu, const Crowd& on_cpu, const Cast& cast) {
  float largest = 0;
  for (std::size_t i = 0; i < on_cpu.ids.size(); ++i)
    largest = std::max(largest, largest_difference(gpu_ao(gl, on_gpu, cast.model_of(i), i),
                                                   cpu_ao(on_cpu, cast.model_of(i), i)));
  return largest;
}

// The largest difference over some frames of a crowd that moves.
float difference_of_tier(platform::Context& context, const Cast& cast, int tier, const CrowdOptions& options,
                         std::uint32_t terms = NOOK_TERM_ALL) {
  Crowd on_cpu(cast.context.handle, cast.models, cast.bone_counts, options);
  Crowd on_gpu(cast.context.handle, cast.models, cast.bone_counts, options);
  NOOK_OK_OR_FAIL(nook_scene_set_terms(on_cpu.scene, terms));
  NOOK_OK_OR_FAIL(nook_scene_set_terms(on_gpu.scene, terms));
  nook_gl gl = create_gl(cast.context.handle, platform::Context::loader, &context, tier);
  float largest = 0;
  const std::uint32_t frames = options.lod_max_interval + 2;
  for (std::uint32_t frame = 0; frame < frames; ++frame) {
    on_cpu.pose(frame);
    on_gpu.pose(frame);
    NOOK_OK_OR_FAIL(nook_scene_update(on_cpu.scene));
    NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, on_gpu.scene));
    largest = std::max(largest, difference(gl, on_gpu, on_cpu, cast));
    const nook_scene_info cpu = stats_of(on_cpu), gpu = stats_of(on_gpu);
    CHECK(gpu.instances_updated == cpu.instances_updated);
    CHECK(gpu.links == cpu.links);
    CHECK(gpu.links_culled == cpu.links_culled);
    CHECK(gpu.evaluations == cpu.evaluations);
  }
  nook_gl_destroy(&gl);
  CHECK(take_debug_messages().empty());
  CHECK(context.gl().GetError() == GL_NO_ERROR);
  return largest;
}

void check_all_tiers(platform::Context& context, const Cast& cast, const CrowdOptions& options,
                     std::uint32_t terms = NOOK_TERM_ALL) {
  for (const int tier : tiers_of(context)) {
    INFO("tier " << tier);
    const float largest = difference_of_tier(context, cast, tier, options, terms);
    CHECK(largest < promised_difference);
  }
}

}  // namespace

TEST_CASE("GPU and CPU agree for every kernel, exponent and way to combine") {
  NOOK_NEED_CONTEXT(context);
  for (const KernelForm form : {KernelForm::paper, KernelForm::nook, KernelForm::rational})
    for (const float gamma : {1.0f, 1.5f, 2.0f, 1.7f}) {
      const Cast cast(form, gamma);
      for (const nook_form combine : {NOOK_FORM_DEFAULT, NOOK_FORM_PAPER}) {
        INFO("form " << static_cast<int>(form) << ", gamma " << gamma << ", combine " << combine);
        CrowdOptions options;
        options.form = combine;
        check_all_tiers(context, cast, options);
      }
    }
}

TEST_CASE("GPU and CPU agree for each kind of caster, and each of them matters") {
  NOOK_NEED_CONTEXT(context);
  const Cast cast;
  const std::uint32_t terms[] = {NOOK_TERM_SELF, NOOK_TERM_LINKS, NOOK_TERM_GROUND, NOOK_TERM_OCCLUDERS,
                                 NOOK_TERM_ALL};
  std::vector<std::vector<float>> results;
  for (const std::uint32_t term : terms) {
    INFO("terms " << term);
    check_all_tiers(context, cast, {}, term);
    Crowd crowd(cast.context.handle, cast.models, cast.bone_counts, {});
    NOOK_OK_OR_FAIL(nook_scene_set_terms(crowd.scene, term));
    nook_gl gl = create_gl(cast.context.handle, platform::Context::loader, &context, 0);
    NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, crowd.scene));
    results.push_back(gpu_ao(gl, crowd, cast.model_of(4), 4));
    nook_gl_destroy(&gl);
  }
  // Were a term ignored, two of these would be the same picture; 0.05 is far above every rounding.
  for (std::size_t a = 0; a < results.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) CHECK(largest_difference(results[a], results[b]) > 0.05f);
}

TEST_CASE("GPU and CPU agree under uniform scale, cut-off, and turns of update") {
  NOOK_NEED_CONTEXT(context);
  const Cast cast;
  CrowdOptions options;
  SECTION("twice as large") {
    options.scale = 2;
  }
  SECTION("half as large") {
    options.scale = 0.5f;
  }
  SECTION("cut-off") {
    options.cutoff_error = 0.02f;
    options.spacing = 3;
  }
  SECTION("distant instances take turns") {
    options.camera = true;
    options.lod_max_interval = 4;
  }
  check_all_tiers(context, cast, options);
}

TEST_CASE("GPU and CPU agree at every level of detail") {
  NOOK_NEED_CONTEXT(context);
  const Cast cast(KernelForm::nook, 1.5f, true);
  CrowdOptions options;
  options.camera = true;
  options.instances = 16;
  // The coarsest level from about 2.5 m on; the crowd reaches to 5 m.
  options.lod_error = cast.coarsest_error / 2.5f;
  for (const nook_form combine : {NOOK_FORM_DEFAULT, NOOK_FORM_PAPER})
    for (const std::uint32_t terms : {15u, 15u - NOOK_TERM_SELF}) {
      INFO("combine " << combine << ", terms " << terms);
      options.form = combine;
      check_all_tiers(context, cast, options, terms);
    }
  Crowd coarse(cast.context.handle, cast.models, cast.bone_counts, options);
  options.lod_error = 0;
  Crowd fine(cast.context.handle, cast.models, cast.bone_counts, options);
  NOOK_OK_OR_FAIL(nook_scene_update(coarse.scene));
  NOOK_OK_OR_FAIL(nook_scene_update(fine.scene));
  // 0.80 to 0.83: compilers draw the random places of the crowd in different orders.
  CHECK(stats_of(coarse).evaluations < 0.9 * static_cast<double>(stats_of(fine).evaluations));
}

TEST_CASE("a crowd far from the world's origin keeps its AO") {
  NOOK_NEED_CONTEXT(context);
  const Cast cast;
  for (const int tier : tiers_of(context)) {
    std::vector<std::vector<float>> results;
    // A float at 1,000 m has steps of 0.06 mm, a thousandth of the smallest radius.
    for (const Vec3 offset : {Vec3{}, Vec3{1000, -50, 700}}) {
      CrowdOptions options;
      options.offset = offset;
      Crowd crowd(cast.context.handle, cast.models, cast.bone_counts, options);
      nook_gl gl = create_gl(cast.context.handle, platform::Context::loader, &context, tier);
      NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, crowd.scene));
      results.push_back(gpu_ao(gl, crowd, cast.model_of(4), 4));
      nook_gl_destroy(&gl);
    }
    INFO("tier " << tier);
    CHECK(largest_difference(results[0], results[1]) < promised_difference);
  }
}

TEST_CASE("instances come and go without disturbing the others") {
  NOOK_NEED_CONTEXT(context);
  const Cast cast;
  for (const int tier : tiers_of(context)) {
    INFO("tier " << tier);
    CrowdOptions options;
    options.instances = 6;
    options.links = false;
    Crowd on_cpu(cast.context.handle, cast.models, cast.bone_counts, options);
    Crowd on_gpu(cast.context.handle, cast.models, cast.bone_counts, options);
    nook_gl gl = create_gl(cast.context.handle, platform::Context::loader, &context, tier);
    NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, on_gpu.scene));
    nook_gl_view before{}, after{};
    before.struct_size = after.struct_size = sizeof before;
    NOOK_OK_OR_FAIL(nook_gl_scene_view(gl, on_gpu.scene, on_gpu.ids[3], NOOK_CHANNEL_AO, &before));

    for (Crowd* crowd : {&on_cpu, &on_gpu}) {
      // The first model's instances are 0, 2 and 4; the last one to go takes its chunk along.
      for (const std::size_t gone : {4, 2, 0}) {
        NOOK_OK_OR_FAIL(nook_scene_remove_instance(crowd->scene, crowd->ids[gone]));
        crowd->ids.erase(crowd->ids.begin() + static_cast<long>(gone));
      }
      for (std::size_t i = 3; i < 12; ++i) crowd->add(i);
    }
    NOOK_OK_OR_FAIL(nook_scene_update(on_cpu.scene));
    NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, on_gpu.scene));
    NOOK_OK_OR_FAIL(nook_gl_scene_view(gl, on_gpu.scene, on_gpu.ids[1], NOOK_CHANNEL_AO, &after));
    CHECK(after.buffer == before.buffer);
    CHECK(after.offset == before.offset);
    for (std::size_t i = 0; i < on_cpu.ids.size(); ++i) {
      const nook_model model = i < 3 ? cast.models[1] : cast.model_of(i);
      INFO("instance " << i);
      CHECK(largest_difference(gpu_ao(gl, on_gpu, model, i), cpu_ao(on_cpu, model, i)) < promised_difference);
    }
    nook_gl_destroy(&gl);
  }
}

TEST_CASE("crowds beyond one chunk of AO and one page of shadows agree too") {
  NOOK_NEED_CONTEXT(context);
  // The minimum that the specifications guarantee: 16 MiB of storage block, 65,536 texels.
  Trace trace(context);
  trace.limits[GL_MAX_SHADER_STORAGE_BLOCK_SIZE] = 1 << 24;
  trace.limits[GL_MAX_TEXTURE_BUFFER_SIZE] = 65536;
  CountedContext host;
  struct Shape {
    SampleSize size;
    std::uint32_t instances;
  };
  const Shape wide{{3, 4, 20, 70000, 10, 2}, 70};  // 280 KB of AO each, 59 in a chunk of 16 MiB
  const Shape dense{{3, 4, 2500, 40, 0, 2}, 40};   // 2,500 texels each, 26 in a page
  for (const Shape& shape : {wide, dense}) {
    nook_model model = load_model(host.handle, sample_model(9, shape.size));
    CrowdOptions options;
    options.instances = shape.instances;
    options.links = false;
    Crowd on_cpu(host.handle, {model}, {3}, options);
    Crowd on_gpu(host.handle, {model}, {3}, options);
    NOOK_OK_OR_FAIL(nook_scene_update(on_cpu.scene));
    for (const int tier : tiers_of(context)) {
      nook_gl gl = create_gl(host.handle, Trace::loader, &trace, tier);
      NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, on_gpu.scene));
      INFO("tier " << tier << ", " << shape.instances << " instances");
      float largest = 0;
      for (std::size_t i = 0; i < on_cpu.ids.size(); i += 3)
        largest =
            std::max(largest, largest_difference(gpu_ao(gl, on_gpu, model, i), cpu_ao(on_cpu, model, i)));
      CHECK(largest < promised_difference);
      nook_gl_view first{}, last{};
      first.struct_size = last.struct_size = sizeof first;
      NOOK_OK_OR_FAIL(nook_gl_scene_view(gl, on_gpu.scene, on_gpu.ids.front(), NOOK_CHANNEL_AO, &first));
      NOOK_OK_OR_FAIL(nook_gl_scene_view(gl, on_gpu.scene, on_gpu.ids.back(), NOOK_CHANNEL_AO, &last));
      const bool expect_chunks = computes(tier) && shape.size.vertices == wide.size.vertices;
      CHECK((first.buffer != last.buffer) == expect_chunks);
      nook_gl_destroy(&gl);
    }
    nook_model_destroy(&model);
  }
}

TEST_CASE("the GPU follows a new model under a living instance") {
  NOOK_NEED_CONTEXT(context);
  for (const int tier : tiers_of(context)) {
    INFO("tier " << tier);
    CountedContext host;
    nook_model before = load_model(host.handle, sample_model(21));
    nook_model after = load_model(host.handle, sample_model(22));
    Crowd crowd(host.handle, {before}, {5}, {});
    nook_gl gl = create_gl(host.handle, platform::Context::loader, &context, tier);
    NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, crowd.scene));
    NOOK_OK_OR_FAIL(nook_scene_set_model(crowd.scene, crowd.ids[2], after));
    NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, crowd.scene));
    CHECK(difference_to_cpu(gl, crowd, after, 2) < promised_difference);
    CHECK(difference_to_cpu(gl, crowd, before, 1) < promised_difference);
    nook_gl_destroy(&gl);
    nook_model_destroy(&before);
    nook_model_destroy(&after);
  }
}

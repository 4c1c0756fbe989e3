// The cost of an instance against the size of the crowd, through the C ABI on one thread: constant
// density, four nearest neighbours linked, ground, no level of detail, no cut-off.
#include <benchmark/benchmark.h>
#include <nook/experimental/nook_debug.h>
#include <nook/nook_character.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <random>
#include <stdexcept>
#include <vector>

#include "sdk/src/character/model_file.h"
#include "sdk/src/core/isa.h"
#include "tests/bench/sample_character.h"
#include "tests/pose_of_rows.h"

namespace {

using namespace nook;
using namespace nook::bench;

void require(nook_result result) {
  if (result != NOOK_OK) throw std::runtime_error(nook_last_message());
}

// Characters on a jittered grid, one to two square metres.
class Crowd {
 public:
  // spacing: of the grid, in metres. far_error: of nook_scene_desc.
  explicit Crowd(std::uint32_t count, nook_isa isa = NOOK_ISA_AUTO, float spacing = 1.4142f,
                 float far_error = 0) {
    nook_context_desc context_desc;
    require(nook_context_desc_init(&context_desc));
    context_desc.isa = isa;
    require(nook_context_create(&context_desc, &context_));
    const CharacterModel model = sample_model();
    const std::vector<std::byte> file = write_character_model(model);
    require(nook_model_load(context_, file.data(), file.size(), &model_));
    nook_scene_desc scene_desc;
    require(nook_scene_desc_init(&scene_desc));
    scene_desc.cutoff_error = 0;
    scene_desc.far_error = far_error;
    require(nook_scene_create(context_, &scene_desc, &scene_));
    require(nook_scene_link_nearest(scene_, 4, 10));

    bones_ = model.bone_count();
    for (unsigned seed = 0; seed < 16; ++seed) poses_.push_back(sample_pose(bones_, seed));
    ao_.resize(model.file_to_welded.size());
    const auto side = static_cast<std::uint32_t>(std::ceil(std::sqrt(double(count))));
    std::mt19937 random(3);
    std::uniform_real_distribution<float> jitter(-0.4f, 0.4f);
    const float ground[4] = {0, 1, 0, 0};
    for (std::uint32_t i = 0; i < count; ++i) {
      nook_instance_id id = 0;
      require(nook_scene_add_instance(scene_, model_, &id));
      require(nook_scene_set_ground(scene_, id, ground));
      ids_.push_back(id);
      const float x = spacing * float(i % side) + jitter(random),
                  z = spacing * float(i / side) + jitter(random);
      places_.push_back({x, 0, z});
    }
  }
  ~Crowd() {
    nook_scene_destroy(&scene_);
    nook_model_destroy(&model_);
    nook_context_destroy(&context_);
  }
  Crowd(const Crowd&) = delete;
  Crowd& operator=(const Crowd&) = delete;

  // Twelve lobes round the crowd, each of another colour, as a probe has them.
  void set_light() {
    std::vector<nook_lobe> lobes(12);
    for (std::size_t i = 0; i < lobes.size(); ++i) {
      const float y = 1 - (2 * float(i) + 1) / float(lobes.size()), r = std::sqrt(1 - y * y),
                  turn = 2.3999632f * float(i);
      lobes[i] = {{r * std::cos(turn), y, r * std::sin(turn)},
                  6,
                  {0.1f * float(i % 5), 0.3f, 0.2f * float(i % 3)},
                  0};
    }
    for (const nook_instance_id id : ids_)
      require(nook_scene_set_light(scene_, id, lobes.data(), static_cast<std::uint32_t>(lobes.size())));
  }
  void only(std::uint32_t terms) { require(nook_scene_set_terms(scene_, terms)); }
  void set_poses() {
    ++frame_;
    std::vector<Mat3x4> pose(bones_);
    for (std::size_t i = 0; i < ids_.size(); ++i) {
      pose = poses_[(i + frame_) % poses_.size()];
      for (Mat3x4& bone : pose) bone.m[3] += places_[i].x, bone.m[11] += places_[i].z;
      require(nook::test::set_rows(scene_, ids_[i], pose.data()->m, bones_));
    }
  }
  void update() { require(nook_scene_update(scene_)); }
  void read() {
    for (const nook_instance_id id : ids_)
      require(nook_scene_read(scene_, id, NOOK_CHANNEL_AO, NOOK_FORMAT_FLOAT, ao_.data(),
                              static_cast<std::uint32_t>(ao_.size()), 0));
  }
  nook_scene_info stats() {
    nook_scene_info stats{};
    stats.struct_size = sizeof stats;
    require(nook_scene_describe(scene_, &stats));
    return stats;
  }

 private:
  nook_context context_ = nullptr;
  nook_model model_ = nullptr;
  nook_scene scene_ = nullptr;
  std::size_t bones_ = 0, frame_ = 0;
  std::vector<std::vector<Mat3x4>> poses_;
  std::vector<nook_instance_id> ids_;
  std::vector<Vec3> places_;
  std::vector<float> ao_;
};

template <class Work>
double seconds(Work&& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void scene(benchmark::State& state) {
  const auto count = static_cast<std::uint32_t>(state.range(0));
  Crowd crowd(count);
  // The fastest of the frames: other processes can only add to it.
  double pose = 1e9, update = 1e9, read = 1e9;
  for (auto _ : state) {
    pose = std::min(pose, seconds([&] { crowd.set_poses(); }));
    update = std::min(update, seconds([&] { crowd.update(); }));
    read = std::min(read, seconds([&] { crowd.read(); }));
  }
  const nook_scene_info stats = crowd.stats();
  state.counters["us_per_instance"] = 1e6 * (pose + update + read) / count;
  state.counters["set_pose_us"] = 1e6 * pose / count;
  state.counters["update_us"] = 1e6 * update / count;
  state.counters["read_ao_us"] = 1e6 * read / count;
  state.counters["links_per_instance"] = double(stats.links) / count;
  state.counters["G_evals_per_s"] = 1e-9 * double(stats.evaluations) / update;
}
BENCHMARK(scene)->Arg(100)->Arg(1000)->Arg(10000)->MinTime(2)->Unit(benchmark::kMillisecond);

// The whole of one character's self AO as a host gets it, beside skinning the same vertices; see
// one_character for the kernels alone. The argument is the nook_isa of both.
void one_character_through_the_abi(benchmark::State& state) {
  const auto isa = static_cast<nook_isa>(state.range(0));
  const SkinFunction skin = isa == NOOK_ISA_AVX512 ? skin_avx512() : skin_avx2();
  if (!skin) {
    state.SkipWithError("this processor lacks the instruction set");
    return;
  }
  Crowd crowd(1, isa);
  crowd.only(NOOK_TERM_SELF);
  const CharacterModel model = sample_model();
  const SampleSkin vertices = sample_skin(model);
  AlignedArray<SkinningMatrix> bones(model.bone_count(), nook::default_memory());
  const std::vector<Mat3x4> pose = sample_pose(bones.size(), 5);
  for (std::size_t b = 0; b < bones.size(); ++b) bones[b] = skinning_matrix(pose[b]);
  AlignedArray<float> posed(6 * vertices.view.count + 16, nook::default_memory());

  double ao = 1e9, skinning = 1e9;
  for (auto _ : state) {
    skinning = std::min(skinning, seconds([&] { skin(vertices.view, bones.data(), posed.data()); }));
    ao = std::min(ao, seconds([&] {
                    crowd.set_poses();
                    crowd.update();
                    crowd.read();
                  }));
  }
  state.counters["ao_us"] = 1e6 * ao;
  state.counters["skinning_us"] = 1e6 * skinning;
  state.counters["times_skinning"] = ao / skinning;
}
BENCHMARK(one_character_through_the_abi)
    ->Arg(NOOK_ISA_AVX2)
    ->Arg(NOOK_ISA_AVX512)
    ->Unit(benchmark::kMicrosecond);

// An update of an instance with four neighbours at 2 m and beyond, beside skinning the same vertices: with
// the default far_error, and with all spheres. The argument is the nook_isa.
void far_neighbours(benchmark::State& state) {
  const auto isa = static_cast<nook_isa>(state.range(0));
  const SkinFunction skin = isa == NOOK_ISA_AVX512 ? skin_avx512() : skin_avx2();
  if (!skin) {
    state.SkipWithError("this processor lacks the instruction set");
    return;
  }
  constexpr std::uint32_t count = 25;
  constexpr float spacing = 2.8f;  // less the jitter of both ends
  nook_scene_desc defaults;
  require(nook_scene_desc_init(&defaults));
  Crowd grouped(count, isa, spacing, defaults.far_error), whole(count, isa, spacing, 0), alone(count, isa);
  for (Crowd* crowd : {&grouped, &whole}) crowd->only(NOOK_TERM_SELF | NOOK_TERM_LINKS);
  alone.only(NOOK_TERM_SELF);
  const CharacterModel model = sample_model();
  const SampleSkin vertices = sample_skin(model);
  AlignedArray<SkinningMatrix> bones(model.bone_count(), nook::default_memory());
  const std::vector<Mat3x4> pose = sample_pose(bones.size(), 5);
  for (std::size_t b = 0; b < bones.size(); ++b) bones[b] = skinning_matrix(pose[b]);
  AlignedArray<float> posed(6 * vertices.view.count + 16, nook::default_memory());

  double by_groups = 1e9, by_spheres = 1e9, by_none = 1e9, skinning = 1e9;
  for (auto _ : state) {
    for (Crowd* crowd : {&grouped, &whole, &alone}) crowd->set_poses();
    skinning = std::min(skinning, seconds([&] { skin(vertices.view, bones.data(), posed.data()); }));
    by_groups = std::min(by_groups, seconds([&] { grouped.update(); }));
    by_spheres = std::min(by_spheres, seconds([&] { whole.update(); }));
    by_none = std::min(by_none, seconds([&] { alone.update(); }));
  }
  state.counters["groups_us"] = 1e6 * by_groups / count;
  state.counters["spheres_us"] = 1e6 * by_spheres / count;
  state.counters["alone_us"] = 1e6 * by_none / count;
  state.counters["skinning_us"] = 1e6 * skinning;
  state.counters["times_skinning"] = by_groups / count / skinning;
  state.counters["links_per_instance"] = double(grouped.stats().links) / count;
}
BENCHMARK(far_neighbours)->Arg(NOOK_ISA_AVX2)->Arg(NOOK_ISA_AVX512)->Unit(benchmark::kMicrosecond);

// Directional occlusion under 12 lobes beside plain AO: an update of an instance, alone on the ground and in
// a crowd of five with four neighbours each. Arguments: nook_isa, instances.
void under_a_light(benchmark::State& state) {
  const auto count = static_cast<std::uint32_t>(state.range(1));
  Crowd plain(count, static_cast<nook_isa>(state.range(0))),
      lit(count, static_cast<nook_isa>(state.range(0)));
  lit.set_light();
  plain.set_poses();
  lit.set_poses();
  double without = 1e9, with = 1e9;
  for (auto _ : state) {
    without = std::min(without, seconds([&] { plain.update(); }));
    with = std::min(with, seconds([&] { lit.update(); }));
  }
  state.counters["plain_us"] = 1e6 * without / count;
  state.counters["lit_us"] = 1e6 * with / count;
}
void every_isa_alone_and_in_a_crowd(benchmark::internal::Benchmark* all) {
  for (const Isa isa : all_isas)
    for (const int instances : {1, 5})
      if (isa_available(isa)) all->Args({static_cast<nook_isa>(isa), instances});
}
BENCHMARK(under_a_light)->Apply(every_isa_alone_and_in_a_crowd)->Unit(benchmark::kMicrosecond);

}  // namespace

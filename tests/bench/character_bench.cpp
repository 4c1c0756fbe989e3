// The cost of one character on one core: the shadow kernels against a plain loop, and the whole AO against
// skinning. Ratios come from turns taken side by side, because a shared machine changes its speed between one
// row and the next.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <vector>

#include "sdk/src/character/linear_layer.h"
#include "sdk/src/character/shadow_kernels_rest.h"
#include "tests/bench/plain_loop.h"
#include "tests/bench/sample_character.h"
#include "tests/bench/skinning.h"

namespace {

using namespace nook;
using namespace nook::bench;

// The fastest of its turns: other processes can only add to it.
class Stopwatch {
 public:
  template <class Work>
  void run(Work&& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    best_ = std::min(best_, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  double seconds() const { return best_; }

 private:
  double best_ = 1e9;
};

// A posed character's arrays and every step of its self AO.
class Character {
 public:
  explicit Character(const ShadowKernels& kernels)
      : kernels_(kernels),
        model_(sample_model()),
        pose_(sample_pose(model_.bone_count(), 5)),
        rest_spheres_(model_),
        rest_points_(model_),
        linear_(model_),
        sphere_numbers_(array(4 * sphere_stride())),
        point_numbers_(array(6 * points_count())),
        sum_(array(points_count())),
        depth_(array(points_count())),
        shadow_(array(points_count())),
        slots_(array(linear_.padded_slots())) {
    float* s = sphere_numbers_.data();
    float* p = point_numbers_.data();
    const std::size_t n = sphere_stride(), k = points_count();
    sphere_target_ = {s, s + n, s + 2 * n, s + 3 * n};
    point_target_ = {p, p + k, p + 2 * k, p + 3 * k, p + 4 * k, p + 5 * k};
    pose();
    shadow();
    blend();
  }

  void pose() {
    kernels_.pose_spheres(rest_spheres_.view(), pose_.data(), {}, sphere_target_);
    kernels_.pose_key_points(rest_points_.view(), pose_.data(), {}, point_target_, nullptr);
  }
  void norm_sum(const Kernel& kernel) { kernels_.self_norm_sum(spheres(), points(), kernel, sum_.data()); }
  void plain_sum(float gamma) { plain_norm_sum(spheres(), points(), gamma, sum_.data()); }
  void casters() { kernels_.composed_depth(spheres(), points(), depth_.data()); }
  void ground() { kernels_.exact_open(spheres(), points(), depth_.data()); }
  void shadow() {
    clear();
    norm_sum(model_.kernel);
    kernels_.norm_root(sum_.data(), rest_points_.view().saturation, points().padded_count,
                       model_.kernel.gamma, shadow_.data());
  }
  void blend() { kernels_.linear_layer(linear_.view(), encoded(), nullptr, slots_.data()); }
  void blend_added() {
    encoded();
    kernels_.linear_layer(linear_.view(), codes_, &codes_, slots_.data());
  }
  void all() {
    pose();
    shadow();
    blend();
  }
  void clear() {
    std::fill(sum_.begin(), sum_.end(), 0.0f);
    std::fill(depth_.begin(), depth_.end(), 0.0f);
  }

  double linear_columns_per_block() const {
    const LinearView& layer = linear_.view();
    const LinearBlock& last = layer.blocks[layer.block_count - 1];
    return 2.0 * double(last.first_pair + last.pairs) / layer.block_count;
  }
  // Without the padding, whose work nobody sees.
  double evaluations() const { return double(model_.spheres.size() * model_.key_points.size()); }
  const CharacterModel& model() const { return model_; }

 private:
  const PointCodes& encoded() {
    codes_.low = words_.data();
    codes_.high = words_.data() + points_count();
    kernels_.encode_points(shadow_.data(), points_count(), linear_.view().shadow_limit, codes_);
    return codes_;
  }
  static AlignedArray<float> array(std::size_t count) { return {count, nook::default_memory()}; }
  std::size_t sphere_stride() const { return padded_count(rest_spheres_.view().count); }
  std::uint32_t points_count() const { return rest_points_.padded_count(); }
  SphereSoa spheres() const {
    return {sphere_target_.x,
            sphere_target_.y,
            sphere_target_.z,
            sphere_target_.inverse_radius,
            rest_spheres_.caster_weight(),
            rest_spheres_.view().count};
  }
  KeyPointSoa points() const {
    const KeyPointTarget& t = point_target_;
    return {t.x, t.y, t.z, t.nx, t.ny, t.nz, points_count()};
  }

  const ShadowKernels& kernels_;
  CharacterModel model_;
  std::vector<Mat3x4> pose_;
  RestSpheres rest_spheres_;
  RestKeyPoints rest_points_;
  LinearLayer linear_;
  AlignedArray<float> sphere_numbers_, point_numbers_, sum_, depth_, shadow_, slots_;
  AlignedArray<std::int32_t> words_{std::size_t{2} * points_count(), nook::default_memory()};
  PointCodes codes_;
  SphereTarget sphere_target_;
  KeyPointTarget point_target_;
};

void shadow_norm(benchmark::State& state, const ShadowKernels* kernels, Kernel kernel) {
  Character character(*kernels);
  Stopwatch simd, plain;
  const bool comparable =
      kernel.form == KernelForm::nook && (kernel.gamma == 1 || kernel.gamma == 1.5f || kernel.gamma == 2);
  for (auto _ : state) {
    simd.run([&] { character.norm_sum(kernel); });
    character.clear();
    if (!comparable) continue;
    plain.run([&] { character.plain_sum(kernel.gamma); });
    character.clear();
  }
  state.counters["G_evals_per_s"] = 1e-9 * character.evaluations() / simd.seconds();
  if (!comparable) return;
  state.counters["plain_G_evals_per_s"] = 1e-9 * character.evaluations() / plain.seconds();
  state.counters["times_plain"] = plain.seconds() / simd.seconds();
}

void added_casters(benchmark::State& state, const ShadowKernels* kernels) {
  Character character(*kernels);
  Stopwatch fast, exact;
  for (auto _ : state) {
    fast.run([&] { character.casters(); });
    exact.run([&] { character.ground(); });
    character.clear();
  }
  state.counters["fast_G_evals_per_s"] = 1e-9 * character.evaluations() / fast.seconds();
  state.counters["exact_G_evals_per_s"] = 1e-9 * character.evaluations() / exact.seconds();
}

void one_character(benchmark::State& state, const ShadowKernels* kernels, SkinFunction skin) {
  Character character(*kernels);
  const SampleSkin vertices = sample_skin(character.model());
  AlignedArray<SkinningMatrix> bones(character.model().bone_count(), nook::default_memory());
  const std::vector<Mat3x4> pose = sample_pose(bones.size(), 5);
  for (std::size_t b = 0; b < bones.size(); ++b) bones[b] = skinning_matrix(pose[b]);
  AlignedArray<float> posed(6 * vertices.view.count + 16, nook::default_memory());

  Stopwatch whole, skinning, posing, shadows, blending, blending_added;
  for (auto _ : state) {
    skinning.run([&] { skin(vertices.view, bones.data(), posed.data()); });
    whole.run([&] { character.all(); });
    posing.run([&] { character.pose(); });
    shadows.run([&] { character.shadow(); });
    blending_added.run([&] { character.blend_added(); });
    blending.run([&] { character.blend(); });
    benchmark::ClobberMemory();
  }
  state.counters["ao_us"] = 1e6 * whole.seconds();
  state.counters["pose_us"] = 1e6 * posing.seconds();
  state.counters["shadow_us"] = 1e6 * shadows.seconds();
  state.counters["linear_us"] = 1e6 * blending.seconds();
  state.counters["linear_added_us"] = 1e6 * blending_added.seconds();
  state.counters["linear_columns"] = character.linear_columns_per_block();
  state.counters["skinning_us"] = 1e6 * skinning.seconds();
  state.counters["skinning_ns_per_vertex"] = 1e9 * skinning.seconds() / vertices.view.count;
  state.counters["times_skinning"] = whole.seconds() / skinning.seconds();
}

SkinFunction skinning_of(Isa isa) {
  if (isa == Isa::avx512) return skin_avx512();
  if (isa == Isa::avx2) return skin_avx2();
  return skin_scalar;
}

const bool registered = [] {
  for (const Isa isa : all_isas) {
    const ShadowKernels* kernels = shadow_kernels(isa);
    if (!kernels) continue;
    const auto name = [&](const char* what) { return std::string(what) + "/" + kernels->name; };
    for (const float gamma : {1.0f, 1.5f, 2.0f, 1.7f})
      benchmark::RegisterBenchmark(
          (name("shadow_norm") + "/nook/gamma_" + std::to_string(gamma).substr(0, 3)).c_str(), shadow_norm,
          kernels, Kernel{KernelForm::nook, gamma});
    benchmark::RegisterBenchmark((name("shadow_norm") + "/paper/gamma_1.5").c_str(), shadow_norm, kernels,
                                 Kernel{KernelForm::paper, 1.5f});
    benchmark::RegisterBenchmark((name("shadow_norm") + "/rational/gamma_1.5").c_str(), shadow_norm, kernels,
                                 Kernel{KernelForm::rational, 1.5f});
    benchmark::RegisterBenchmark(name("added_casters").c_str(), added_casters, kernels);
    benchmark::RegisterBenchmark(name("one_character").c_str(), one_character, kernels, skinning_of(isa))
        ->Unit(benchmark::kMicrosecond);
  }
  return true;
}();

}  // namespace

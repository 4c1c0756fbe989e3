// The cost of a baked body in the poses of its clips, beside skinning the same file vertices in turns, and
// what the merging of far spheres changes. Files by the environment:
//   NOOK_BENCH_BODY=CHARACTER.glb NOOK_BENCH_MODEL=MODEL.nook nook_bake_bench --benchmark_filter=body
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <vector>

#include "bakers/character/pose_sets.h"
#include "bakers/import/gltf.h"
#include "bakers/import/skinned_mesh.h"
#include "platform/file_bytes.h"
#include "sdk/src/character/model_file.h"
#include "sdk/src/character/scene.h"
#include "tests/bench/skinning.h"

namespace {

using namespace nook;
using namespace nook::bench;

constexpr std::size_t max_poses = 24;

// The file vertices with their four largest weights, and poses of the clips.
struct Body {
  Ref<const LoadedModel> model;
  std::vector<bake::Pose> poses;
  AlignedArray<float> rest, weight;
  AlignedArray<std::uint8_t> bone;
  SkinnedVertices vertices;

  Body(const char* glb, const char* nook) {
    const bake::ImportedCharacter character = bake::import_gltf(glb);
    const std::vector<unsigned char> bytes = platform::read_file(nook);
    Memory* const memory = default_memory();
    model = Owned<LoadedModel>::make(
        memory, Ref<const RefCounted>(),
        read_character_model({reinterpret_cast<const std::byte*>(bytes.data()), bytes.size()}), memory);
    poses = bake::clip_poses(character, bake::motion_clips(character), 4);
    bake::thin_out(poses, max_poses);
    take_skin(character.mesh, memory);
  }

  void take_skin(const bake::SkinnedMesh& mesh, Memory* memory) {
    const std::size_t count = mesh.file_to_welded.size();
    rest = {6 * count, memory};
    weight = {4 * count, memory};
    bone = {4 * count, memory};
    std::vector<Vec3> normal;
    bake::vertex_normals(mesh.triangle, mesh.position, normal);
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t w = mesh.file_to_welded[i];
      const Vec3 p = mesh.position[w], n = normal[w];
      const float six[6] = {p.x, p.y, p.z, n.x, n.y, n.z};
      std::copy(six, six + 6, &rest[6 * i]);
      for (std::size_t b = 0; b < 4; ++b) {
        bone[4 * i + b] = static_cast<std::uint8_t>(mesh.weights[w].bone[b]);
        weight[4 * i + b] = mesh.weights[w].weight[b];
      }
    }
    vertices = {rest.data(), bone.data(), weight.data(), static_cast<std::uint32_t>(count)};
  }
};

// Null where the environment names no body, or one with more bones than a byte can number.
const Body* body_of_environment(benchmark::State& run) {
  static const std::unique_ptr<Body> body = [] {
    const char *const glb = std::getenv("NOOK_BENCH_BODY"), *const nook = std::getenv("NOOK_BENCH_MODEL");
    return glb && nook ? std::make_unique<Body>(glb, nook) : nullptr;
  }();
  if (!body)
    run.SkipWithError("set NOOK_BENCH_BODY and NOOK_BENCH_MODEL");
  else if (body->model->model.bone_count() > 256)
    run.SkipWithError("the body has more than 256 bones");
  else
    return body.get();
  return nullptr;
}

template <class Work>
double seconds_of(Work&& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// The fastest turn of each pose, as other processes can only add to it; the sum over poses, microseconds.
class Stopwatch {
 public:
  explicit Stopwatch(std::size_t poses) : best_(poses, 1e9) {}
  template <class Work>
  void run(std::size_t pose, Work&& work) {
    best_[pose] = std::min(best_[pose], seconds_of(work));
  }
  double mean_us() const {
    double sum = 0;
    for (const double seconds : best_) sum += seconds;
    return 1e6 * sum / double(best_.size());
  }

 private:
  std::vector<double> best_;
};

SkinFunction skinning_of(nook_isa isa) {
  return isa == NOOK_ISA_AVX512 ? skin_avx512() : skin_avx2();
}

std::vector<SkinningMatrix> skinning_matrices(const bake::Pose& pose) {
  std::vector<SkinningMatrix> bones;
  for (const Mat3x4& bone : pose) bones.push_back(skinning_matrix(bone));
  return bones;
}

// Root mean square and largest of the differences of two scenes' AO.
struct Change {
  double squares = 0, largest = 0, count = 0;

  void add(const std::vector<float>& a, const std::vector<float>& b) {
    for (std::size_t i = 0; i < a.size(); ++i) {
      const double difference = std::abs(double(a[i]) - double(b[i]));
      squares += difference * difference;
      largest = std::max(largest, difference);
    }
    count += double(a.size());
  }
  double rms() const { return std::sqrt(squares / count); }
};

SceneSettings settings_of(nook_isa isa, bool merges) {
  SceneSettings settings;
  settings.isa = isa;
  if (!merges) settings.far_error = 0;
  return settings;
}

std::vector<float> ao_of(const Scene& scene, nook_instance_id id) {
  const Instance& instance = instance_of(scene, id);
  std::vector<float> ao(instance.model->model.file_to_welded.size());
  read_ao(scene, instance, ao.data(), sizeof(float));
  return ao;
}

// A body alone: pose, update and read.
void body_alone(benchmark::State& run) {
  const auto isa = static_cast<nook_isa>(run.range(0));
  const Body* const body = body_of_environment(run);
  if (!body) return;
  const SkinFunction skin = skinning_of(isa);
  if (!skin) return run.SkipWithError("this processor lacks the instruction set");
  Scene merging(settings_of(isa, true), {}, default_memory()),
      exact(settings_of(isa, false), {}, default_memory());
  const nook_instance_id id = add_instance(merging, body->model), same = add_instance(exact, body->model);
  const std::size_t vertices = body->vertices.count;
  std::vector<float> posed(6 * vertices + 16), ao(vertices);
  std::vector<unsigned char> bytes(vertices);
  const std::size_t poses = body->poses.size();
  Stopwatch skinning(poses), posing(poses), updating(poses), reading(poses), reading_bytes(poses), all(poses),
      whole(poses);
  Change change;
  double pairs = 0;
  for (auto _ : run)
    for (std::size_t p = 0; p < poses; ++p) {
      const std::vector<SkinningMatrix> bones = skinning_matrices(body->poses[p]);
      skinning.run(p, [&] { skin(body->vertices, bones.data(), posed.data()); });
      all.run(p, [&] {
        posing.run(p, [&] { set_pose(merging, id, body->poses[p]); });
        updating.run(p, [&] { update(merging); });
        reading.run(p, [&] { read_ao(merging, instance_of(merging, id), ao.data(), sizeof(float)); });
      });
      reading_bytes.run(
          p, [&] { read_ao_as(merging, instance_of(merging, id), NOOK_FORMAT_UNORM8, bytes.data(), 1); });
      set_pose(exact, same, body->poses[p]);
      whole.run(p, [&] { update(exact); });
      change.add(ao, ao_of(exact, same));
      pairs += double(merging.stats.evaluations) / double(exact.stats.evaluations);
    }
  run.counters["ao_us"] = all.mean_us();
  run.counters["pose_us"] = posing.mean_us();
  run.counters["update_us"] = updating.mean_us();
  run.counters["update_exact_us"] = whole.mean_us();
  run.counters["read_us"] = reading.mean_us();
  run.counters["read_bytes_us"] = reading_bytes.mean_us();
  run.counters["skinning_us"] = skinning.mean_us();
  run.counters["times_skinning"] = all.mean_us() / skinning.mean_us();
  run.counters["rms"] = change.rms();
  run.counters["max"] = change.largest;
  run.counters["pairs"] = pairs / double(run.iterations()) / double(poses);
}
BENCHMARK(body_alone)->Arg(NOOK_ISA_AVX2)->Arg(NOOK_ISA_AVX512)->Unit(benchmark::kMillisecond);

// 25 bodies on a square grid of 2.8 m, moved by up to 0.4 m, so that none is nearer than 2 m.
class Square {
 public:
  static constexpr std::size_t side = 5, count = side * side;

  Square(const Body& body, nook_isa isa, bool merges)
      : body_(body), scene_(settings_of(isa, merges), {}, default_memory()) {
    for (std::size_t i = 0; i < count; ++i) ids_.push_back(add_instance(scene_, body.model));
    link_nearest(scene_, 4, 10);
    scene_.terms = NOOK_TERM_SELF | NOOK_TERM_LINKS;
  }
  // Neighbours have different poses.
  void set_poses(std::size_t frame) {
    for (std::size_t i = 0; i < count; ++i) {
      bake::Pose pose = body_.poses[(frame + 7 * i) % body_.poses.size()];
      const float x = 2.8f * float(i % side) + 0.4f * std::sin(float(i)),
                  z = 2.8f * float(i / side) + 0.4f * std::cos(2 * float(i));
      for (Mat3x4& bone : pose) bone.m[3] += x, bone.m[11] += z;
      set_pose(scene_, ids_[i], pose);
    }
  }
  void run() { update(scene_); }
  std::vector<float> ao(std::size_t i) const { return ao_of(scene_, ids_[i]); }
  double links() const { return double(scene_.stats.links) / count; }

 private:
  const Body& body_;
  Scene scene_;
  std::vector<nook_instance_id> ids_;
};

// An update of a body with its four nearest neighbours.
void body_among_far_neighbours(benchmark::State& run) {
  const auto isa = static_cast<nook_isa>(run.range(0));
  const Body* const body = body_of_environment(run);
  if (!body) return;
  const SkinFunction skin = skinning_of(isa);
  if (!skin) return run.SkipWithError("this processor lacks the instruction set");
  Square merging(*body, isa, true), exact(*body, isa, false);
  std::vector<float> posed(6 * body->vertices.count + 16);
  constexpr std::size_t frames = 6;
  Stopwatch skinning(frames), updating(frames), whole(frames);
  Change change;
  for (auto _ : run)
    for (std::size_t f = 0; f < frames; ++f) {
      const std::vector<SkinningMatrix> bones = skinning_matrices(body->poses[f % body->poses.size()]);
      merging.set_poses(f);
      exact.set_poses(f);
      skinning.run(f, [&] { skin(body->vertices, bones.data(), posed.data()); });
      updating.run(f, [&] { merging.run(); });
      whole.run(f, [&] { exact.run(); });
      for (std::size_t i = 0; i < Square::count; ++i) change.add(merging.ao(i), exact.ao(i));
    }
  run.counters["update_us"] = updating.mean_us() / Square::count;
  run.counters["update_exact_us"] = whole.mean_us() / Square::count;
  run.counters["skinning_us"] = skinning.mean_us();
  run.counters["times_skinning"] = updating.mean_us() / Square::count / skinning.mean_us();
  run.counters["links"] = merging.links();
  run.counters["rms"] = change.rms();
  run.counters["max"] = change.largest;
}
BENCHMARK(body_among_far_neighbours)->Arg(NOOK_ISA_AVX2)->Arg(NOOK_ISA_AVX512)->Unit(benchmark::kMillisecond);

}  // namespace

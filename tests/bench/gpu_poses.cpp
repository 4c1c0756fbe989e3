// Prints the CPU time that all of Nook's calls of a frame take for each instance of a crowd. OpenGL is a
// stub, and poses come from the CPU, then from the GPU. Usage: nook_gpu_poses_bench [instances].
#include <nook/experimental/nook_debug.h>
#include <nook/experimental/nook_gl_poses.h>
#include <time.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <vector>

#include "sdk/src/character/model_file.h"
#include "tests/bench/gl_stub.h"
#include "tests/bench/sample_character.h"

using namespace nook;

namespace {

void need_ok(nook_result result) {
  if (result == NOOK_OK) return;
  std::fprintf(stderr, "%s\n", nook_last_message());
  std::exit(1);
}

double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

// What the host does before Nook's calls, and these calls, which alone are timed.
struct Frame {
  std::function<void(int)> animate;
  std::function<void()> call;
};

// Returns the median of some frames, after a few that fill caches.
double median_seconds(const Frame& frame) {
  constexpr int warm = 3, timed = 15;
  std::vector<double> seconds;
  for (int i = 0; i < warm + timed; ++i) {
    frame.animate(i);
    const double begin = cpu_seconds();
    frame.call();
    if (i >= warm) seconds.push_back(cpu_seconds() - begin);
  }
  std::nth_element(seconds.begin(), seconds.begin() + timed / 2, seconds.end());
  return seconds[timed / 2];
}

// This crowd stands on a square, 2 m apart, and has one model.
class Stage {
 public:
  Stage(nook_context context, nook_model model, std::uint32_t bones, std::uint32_t count,
        std::uint32_t neighbours)
      : bones_(bones) {
    nook_scene_desc scene_desc;
    need_ok(nook_scene_desc_init(&scene_desc));
    need_ok(nook_scene_create(context, &scene_desc, &scene_));
    nook_gl_desc desc;
    need_ok(nook_gl_desc_init(&desc));
    desc.get_proc = bench::stub_loader;
    desc.state_mode = NOOK_GL_STATE_HOST;
    need_ok(nook_gl_create(context, &desc, &gl_));
    for (std::uint32_t i = 0; i < count; ++i) {
      nook_instance_id id = 0;
      need_ok(nook_scene_add_instance(scene_, model, &id));
      ids_.push_back(id);
    }
    if (neighbours) need_ok(nook_scene_link_nearest(scene_, neighbours, 5));
    for (std::size_t p = 0; p < body_count; ++p)
      bodies_.push_back(bench::sample_pose(bones, static_cast<unsigned>(p + 1)));
    side_ = static_cast<std::uint32_t>(std::ceil(std::sqrt(double(count))));
  }
  ~Stage() {
    nook_gl_destroy(&gl_);
    nook_scene_destroy(&scene_);
  }
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;

  Frame cpu_frame() {
    return {[this](int number) { animate(number); },
            [this] {
              nook_pose_desc desc = pose();
              for (std::size_t i = 0; i < ids_.size(); ++i) {
                desc.transforms = transforms_[i * bones_].m;
                need_ok(nook_scene_set_pose(scene_, ids_[i], &desc));
              }
              need_ok(nook_gl_scene_update(gl_, scene_));
            }};
  }

  // Takes the size of the bodies' spheres from the CPU's poses, so that both crowds cull alike.
  void measure_bodies() {
    nook_scene_instance_info info{};
    info.struct_size = sizeof info;
    need_ok(nook_scene_describe_instance(scene_, ids_[0], &info));
    radius_ = info.bound_radius;
  }

  Frame gpu_frame() {
    return {[this](int number) { tell(number); },
            [this] {
              const nook_pose_desc desc = pose();
              nook_gl_poses poses{};
              poses.struct_size = sizeof poses;
              poses.pose = &desc;
              poses.buffer = 1;
              poses.size = sizeof(Mat3x4) * bones_ * ids_.size();
              need_ok(nook_gl_scene_set_poses(gl_, scene_, &poses, instances_.data(),
                                              static_cast<std::uint32_t>(instances_.size())));
              need_ok(nook_gl_scene_update(gl_, scene_));
            }};
  }

 private:
  static constexpr std::size_t body_count = 16;

  // Rows of rest-to-world matrices, the cheapest that the CPU takes: they are copied.
  nook_pose_desc pose() const {
    nook_pose_desc desc;
    need_ok(nook_pose_desc_init(&desc));
    desc.kind = NOOK_POSE_REST_TO_WORLD;
    desc.layout = NOOK_TRANSFORM_ROWS_3X4;
    desc.transform_count = bones_;
    return desc;
  }

  Vec3 place_of(std::size_t i) const {
    return {2.0f * static_cast<float>(i % side_), 0, 2.0f * static_cast<float>(i / side_)};
  }

  void animate(int number) {
    transforms_.resize(ids_.size() * bones_);
    for (std::size_t i = 0; i < ids_.size(); ++i) {
      const std::vector<Mat3x4>& body = bodies_[(i + static_cast<std::size_t>(number)) % body_count];
      const Vec3 place = place_of(i);
      for (std::size_t b = 0; b < bones_; ++b) {
        Mat3x4& bone = transforms_[i * bones_ + b];
        bone = body[b];
        bone.m[3] += place.x;
        bone.m[11] += place.z;
      }
    }
  }

  void tell(int number) {
    instances_.resize(ids_.size());
    for (std::size_t i = 0; i < ids_.size(); ++i) {
      const Vec3 place = place_of(i);
      instances_[i] = {ids_[i],
                       static_cast<std::uint32_t>(i * bones_),
                       {place.x + 0.001f * static_cast<float>(number), 0, place.z},
                       radius_,
                       1,
                       {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}};
    }
  }

  std::uint32_t bones_, side_ = 1;
  nook_scene scene_ = nullptr;
  nook_gl gl_ = nullptr;
  std::vector<nook_instance_id> ids_;
  std::vector<std::vector<Mat3x4>> bodies_;
  std::vector<Mat3x4> transforms_;
  std::vector<nook_gl_instance_pose> instances_;
  float radius_ = 1;
};

}  // namespace

int main(int argc, char** argv) {
  const auto count = static_cast<std::uint32_t>(argc > 1 ? std::atoi(argv[1]) : 10000);
  nook_context context = nullptr;
  nook_context_desc desc;
  need_ok(nook_context_desc_init(&desc));
  need_ok(nook_context_create(&desc, &context));
  const CharacterModel character = bench::sample_model();
  const std::vector<std::byte> bytes = write_character_model(character);
  nook_model model = nullptr;
  need_ok(nook_model_load(context, bytes.data(), bytes.size(), &model));
  const auto bones = static_cast<std::uint32_t>(character.bone_count());
  std::printf("%u instances of %u bones; CPU time of a frame in µs for each instance\n", count, bones);
  std::printf("neighbours   CPU poses   GPU poses   ratio\n");
  for (const std::uint32_t neighbours : {0u, 4u}) {
    Stage stage(context, model, bones, count, neighbours);
    const double cpu = median_seconds(stage.cpu_frame());
    stage.measure_bodies();
    const double gpu = median_seconds(stage.gpu_frame());
    std::printf("%10u   %9.3f   %9.3f   %5.3f\n", neighbours, 1e6 * cpu / count, 1e6 * gpu / count,
                gpu / cpu);
  }
  nook_model_destroy(&model);
  nook_context_destroy(&context);
}

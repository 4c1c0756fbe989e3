// Prints the CPU time that all of Nook's calls of a frame take for each instance of a crowd. OpenGL is a
// stub. Poses come from the CPU, then from the GPU, then from clips. For clips it also prints the times of
// nook_scene_set_clips and of nook_scene_set_clip alone.
// Usage: nook_gpu_poses_bench [instances] [clips]. With "clips" it leaves out the other poses.
//        nook_gpu_poses_bench table [largest count]. Prints the frame's time and the memory of crowds of 100
//        instances, of 1,000 and so on, up to 10,000 by default. 100,000 need more spheres than fit into a
//        storage block of 128 MiB, and end with Nook's message.
//        nook_gpu_poses_bench churn [instances]. Prints the largest CPU time of each call on the OpenGL thread
//        while 100 models with ten instances each come and go beside a crowd by clips in streaming mode, and
//        what a retired slot costs.
//        nook_gpu_poses_bench pool [largest count]. Prints the same for crowds by clips without neighbours,
//        where all are without a pool, and where 200 instances are near in a pool.
#include <nook/experimental/nook_clip_crowds.h>
#include <nook/experimental/nook_debug.h>
#include <nook/experimental/nook_gl_poses.h>
#include <nook/experimental/nook_streaming.h>
#include <time.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string_view>
#include <vector>

#include "sdk/src/character/clip_set.h"
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

// A clip of one second whose frames are sample poses. Each frame has a mode of its own, so that there are as
// many modes as real clips have.
ClipSet sample_clip(const CharacterModel& model) {
  constexpr std::uint32_t frames = 31, ao_modes = 16;
  ClipSet set;
  ClipRange& clip = set.clips.emplace_back();
  clip.name = "walk";
  clip.duration_s = 1;
  clip.frame_count = set.frame_count = frames;
  set.model_hash = clip_model_hash(model);
  set.ao.rows = static_cast<std::uint32_t>(model.vertex_count());
  set.ao.modes = ao_modes;
  set.ao.mode.resize(std::size_t{ao_modes} * set.ao.rows, 1);
  set.ao.weight.resize(std::size_t{ao_modes} * frames, 1000);
  set.ao.scale.resize(ao_modes, 0.1f);
  const auto bones = static_cast<std::uint32_t>(model.bone_count());
  set.bones.resize(bones, BoneSpan{{0, 1, 0}, 0.2f});
  set.pose.rows = pose_rows_per_bone * bones;
  set.pose.modes = frames;
  set.pose.scale.resize(frames, 4);
  set.pose.weight.resize(std::size_t{frames} * frames, 0);
  for (std::uint32_t f = 0; f < frames; ++f) {
    set.pose.weight[f * frames + f] = 32767;
    for (const Mat3x4& bone : bench::sample_pose(bones, f + 1)) {
      const BoneSpan& span = set.bones[0];
      float rows[pose_rows_per_bone];
      for (int i = 0; i < 9; ++i) rows[i] = span.radius * bone.m[4 * (i / 3) + i % 3];
      const Vec3 centre = transform_point(bone, span.centre);
      rows[9] = centre.x;
      rows[10] = centre.y;
      rows[11] = centre.z;
      for (const float row : rows)
        set.pose.mode.push_back(static_cast<std::int16_t>(std::lround(row / 4 * 32767)));
    }
  }
  return set;
}

// This crowd stands on a square, 2 m apart, and has one model.
class Stage {
 public:
  static constexpr std::uint32_t pool_places = 200;

  Stage(nook_context context, nook_model model, std::uint32_t bones, std::uint32_t count,
        std::uint32_t neighbours, bool has_pool = false)
      : bones_(bones) {
    nook_scene_desc scene_desc;
    need_ok(nook_scene_desc_init(&scene_desc));
    need_ok(nook_scene_create(context, &scene_desc, &scene_));
    nook_gl_desc desc;
    need_ok(nook_gl_desc_init(&desc));
    desc.get_proc = bench::stub_loader;
    desc.state_mode = NOOK_GL_STATE_HOST;
    need_ok(nook_gl_create(context, &desc, &gl_));
    side_ = static_cast<std::uint32_t>(std::ceil(std::sqrt(double(count))));
    if (has_pool) {
      // The camera stands in a corner of the crowd.
      const float corner[3] = {0, 0, 0};
      need_ok(nook_scene_set_camera(scene_, corner));
      const nook_gl_pool_desc pool{sizeof pool, pool_places, 1000, count};
      need_ok(nook_gl_scene_set_pool(gl_, scene_, &pool));
    }
    for (std::uint32_t i = 0; i < count; ++i) {
      nook_instance_id id = 0;
      need_ok(nook_scene_add_instance(scene_, model, &id));
      ids_.push_back(id);
    }
    if (neighbours) need_ok(nook_scene_link_nearest(scene_, neighbours, 5));
    for (std::size_t p = 0; p < body_count; ++p)
      bodies_.push_back(bench::sample_pose(bones, static_cast<unsigned>(p + 1)));
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

  Frame clips_frame(nook_clips clips) {
    return {[this](int number) { play(number); },
            [this, clips] {
              set_clips(clips);
              need_ok(nook_gl_scene_update(gl_, scene_));
            }};
  }
  nook_scene scene() const { return scene_; }
  nook_gl gl() const { return gl_; }

  Frame set_clips_alone(nook_clips clips) {
    return {[this](int number) { play(number); }, [this, clips] { set_clips(clips); }};
  }
  Frame set_each_clip(nook_clips clips) {
    return {[this](int number) { play(number); },
            [this, clips] {
              for (const nook_instance_clip& one : playing_)
                need_ok(nook_scene_set_clip(scene_, one.instance, clips, &one.time, one.place_3x4));
            }};
  }

  nook_scene_info scene_info() const {
    nook_scene_info info{};
    info.struct_size = sizeof info;
    need_ok(nook_scene_describe(scene_, &info));
    return info;
  }
  nook_gl_info gl_info() const {
    nook_gl_info info{};
    info.struct_size = sizeof info;
    need_ok(nook_gl_describe(gl_, &info));
    return info;
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

  void play(int number) {
    playing_.resize(ids_.size());
    for (std::size_t i = 0; i < ids_.size(); ++i) {
      const Vec3 place = place_of(i);
      const double seconds = 0.016 * number + 0.37 * static_cast<double>(i);
      playing_[i] = {
          ids_[i], 0, {0, NOOK_CLIP_LOOP, seconds}, {1, 0, 0, place.x, 0, 1, 0, 0, 0, 0, 1, place.z}};
    }
  }

  void set_clips(nook_clips clips) {
    need_ok(
        nook_scene_set_clips(scene_, clips, playing_.data(), static_cast<std::uint32_t>(playing_.size())));
  }

  std::uint32_t bones_, side_ = 1;
  nook_scene scene_ = nullptr;
  nook_gl gl_ = nullptr;
  std::vector<nook_instance_id> ids_;
  std::vector<std::vector<Mat3x4>> bodies_;
  std::vector<Mat3x4> transforms_;
  std::vector<nook_gl_instance_pose> instances_;
  std::vector<nook_instance_clip> playing_;
  float radius_ = 1;
};

// The crowd that a bench makes: its model, its clips and the number of bones.
struct Crowd {
  nook_context context;
  nook_model model;
  nook_clips clips;
  std::uint32_t bones;
};

// The time of a frame by each kind of poses.
struct FrameTimes {
  double cpu, gpu, clips;
};

FrameTimes frame_times(Stage& stage, const Crowd& crowd) {
  FrameTimes seconds{};
  seconds.cpu = median_seconds(stage.cpu_frame());
  stage.measure_bodies();
  seconds.gpu = median_seconds(stage.gpu_frame());
  seconds.clips = median_seconds(stage.clips_frame(crowd.clips));
  return seconds;
}

void compare_poses(const Crowd& crowd, std::uint32_t count) {
  std::printf("neighbours   CPU poses   GPU poses   ratio   clips   ratio\n");
  for (const std::uint32_t neighbours : {0u, 4u}) {
    Stage stage(crowd.context, crowd.model, crowd.bones, count, neighbours);
    const FrameTimes seconds = frame_times(stage, crowd);
    std::printf("%10u   %9.3f   %9.3f   %5.3f   %5.3f   %5.3f\n", neighbours, 1e6 * seconds.cpu / count,
                1e6 * seconds.gpu / count, seconds.gpu / seconds.cpu, 1e6 * seconds.clips / count,
                seconds.clips / seconds.cpu);
  }
}

void compare_clip_calls(const Crowd& crowd, std::uint32_t count) {
  Stage stage(crowd.context, crowd.model, crowd.bones, count, 0);
  const double all = median_seconds(stage.set_clips_alone(crowd.clips)),
               each = median_seconds(stage.set_each_clip(crowd.clips));
  std::printf("nook_scene_set_clips %.2f ms, nook_scene_set_clip of each instance %.0f ms\n", 1e3 * all,
              1e3 * each);
}

void print_table(const Crowd& crowd, std::uint32_t largest) {
  std::printf(
      "                          ms of a frame                   bytes of an instance\n"
      "instances   neighbours   CPU poses   GPU poses   clips      host    OpenGL\n");
  for (std::uint32_t count = 100; count <= largest; count *= 10)
    for (const std::uint32_t neighbours : {0u, 4u}) {
      Stage stage(crowd.context, crowd.model, crowd.bones, count, neighbours);
      const FrameTimes seconds = frame_times(stage, crowd);
      const nook_gl_info gl = stage.gl_info();
      std::printf("%9u   %10u   %9.3f   %9.3f   %5.3f   %7.0f   %7.0f\n", count, neighbours,
                  1e3 * seconds.cpu, 1e3 * seconds.gpu, 1e3 * seconds.clips,
                  double(stage.scene_info().memory_bytes) / count, double(gl.buffer_bytes) / count);
    }
}

// Without a pool, 100,000 instances do not fit into a storage block of 128 MiB.
void print_pool(const Crowd& crowd, std::uint32_t largest) {
  constexpr std::uint32_t most_without = 10'000;
  std::printf(
      "                 ms of a frame   bytes of an instance\n"
      "instances   pool         clips      host    OpenGL\n");
  for (std::uint32_t count = 100; count <= largest; count *= 10)
    for (const bool has_pool : {false, true}) {
      if (!has_pool && count > most_without) continue;
      Stage stage(crowd.context, crowd.model, crowd.bones, count, 0, has_pool);
      const double seconds = median_seconds(stage.clips_frame(crowd.clips));
      std::printf("%9u   %4s   %11.3f   %7.0f   %7.0f\n", count, has_pool ? "yes" : "no", 1e3 * seconds,
                  double(stage.scene_info().memory_bytes) / count,
                  double(stage.gl_info().buffer_bytes) / count);
    }
}

// The CPU times of one kind of call, in seconds.
class CallTimes {
 public:
  template <class Call>
  void time(const Call& call) {
    const double begin = cpu_seconds();
    call();
    seconds_.push_back(cpu_seconds() - begin);
  }
  void print(const char* name) {
    std::sort(seconds_.begin(), seconds_.end());
    std::printf("%-30s %8zu   %9.1f   %9.1f   %9.1f\n", name, seconds_.size(),
                1e6 * seconds_[seconds_.size() / 2], 1e6 * seconds_[seconds_.size() * 99 / 100],
                1e6 * seconds_.back());
  }

 private:
  std::vector<double> seconds_;
};

// A model with its clips and instances.
struct Guest {
  nook_model model = nullptr;
  nook_clips clips = nullptr;
  std::vector<nook_instance_id> ids;
};

void play(nook_scene scene, const Guest& guest, std::uint32_t frame) {
  std::vector<nook_instance_clip> playing;
  for (std::size_t i = 0; i < guest.ids.size(); ++i)
    playing.push_back({guest.ids[i],
                       0,
                       {0, NOOK_CLIP_LOOP, 0.016 * frame + 0.1 * double(i)},
                       {1, 0, 0, -2 * float(i), 0, 1, 0, 0, 0, 0, 1, 0}});
  need_ok(
      nook_scene_set_clips(scene, guest.clips, playing.data(), static_cast<std::uint32_t>(playing.size())));
}

// The files of a model and of its clips.
struct Files {
  const std::vector<std::byte>&model, &clips;
};

void print_churn(const Crowd& crowd, const Files& files, std::uint32_t count) {
  constexpr std::uint32_t models = 100, instances = 10, staying = 30, frames = 1000, budget_us = 500;
  Stage stage(crowd.context, crowd.model, crowd.bones, count, 0);
  const nook_gl_stream_desc desc{sizeof desc, 8, count + models * instances};
  need_ok(nook_gl_scene_set_streaming(stage.gl(), stage.scene(), &desc));
  need_ok(nook_gl_scene_prepare(stage.gl(), stage.scene()));
  const Frame frame = stage.clips_frame(crowd.clips);
  CallTimes alone, update, prepare, add, remove;
  const auto run = [&](int number, CallTimes& times) {
    frame.animate(number);
    times.time([&] { frame.call(); });
  };
  for (int f = 0; f < 3; ++f) frame.animate(f), frame.call();
  for (int f = 0; f < 50; ++f) run(f, alone);
  std::vector<Guest> guests;
  std::uint32_t come = 0;
  for (std::uint32_t f = 0; f < frames; ++f) {
    if (f % (frames / models) == 0 && come < models) {
      Guest& guest = guests.emplace_back();
      ++come;
      need_ok(nook_model_load(crowd.context, files.model.data(), files.model.size(), &guest.model));
      need_ok(
          nook_clips_load(crowd.context, guest.model, files.clips.data(), files.clips.size(), &guest.clips));
      add.time([&] {
        for (std::uint32_t i = 0; i < instances; ++i)
          need_ok(nook_scene_add_instance(stage.scene(), guest.model, &guest.ids.emplace_back()));
      });
    }
    if (guests.size() > staying) {
      remove.time([&] {
        for (const nook_instance_id id : guests.front().ids)
          need_ok(nook_scene_remove_instance(stage.scene(), id));
        nook_clips_destroy(&guests.front().clips);
        nook_model_destroy(&guests.front().model);
      });
      guests.erase(guests.begin());
    }
    for (const Guest& guest : guests) play(stage.scene(), guest, f);
    prepare.time(
        [&] { need_ok(nook_gl_scene_prepare_within(stage.gl(), stage.scene(), budget_us, nullptr)); });
    run(static_cast<int>(f), update);
  }
  std::printf(
      "%u instances, %u models with %u instances each come and go in %u frames, budget %u µs\n"
      "                                         CPU time in µs\n"
      "call                              calls      median   99 of 100     largest\n",
      count, models, instances, frames, budget_us);
  prepare.print("nook_gl_scene_prepare_within");
  alone.print("frame's calls without churn");
  update.print("frame's calls with churn");
  add.print("add ten instances");
  remove.print("remove ten, destroy the model");
  for (Guest& guest : guests) {
    nook_clips_destroy(&guest.clips);
    nook_model_destroy(&guest.model);
  }
}

// A slot of the scene is used for 4,096 instances, and then never again.
void print_retired_slots(const Crowd& crowd) {
  constexpr std::uint32_t uses = 4096, slots = 64;
  Stage stage(crowd.context, crowd.model, crowd.bones, 1, 0);
  const std::uint64_t before = stage.scene_info().memory_bytes;
  CallTimes pair;
  pair.time([&] {
    for (std::uint32_t i = 0; i < uses * slots; ++i) {
      nook_instance_id id = 0;
      need_ok(nook_scene_add_instance(stage.scene(), crowd.model, &id));
      need_ok(nook_scene_remove_instance(stage.scene(), id));
    }
  });
  std::printf("%u instances added and removed one after another retire %u slots: %.0f bytes for each\n",
              uses * slots, slots, double(stage.scene_info().memory_bytes - before) / slots);
  pair.print("all of these calls");
}

}  // namespace

int main(int argc, char** argv) {
  const std::string_view mode = argc > 1 ? argv[1] : "";
  const bool is_pool = mode == "pool", is_churn = mode == "churn",
             is_table = mode == "table" || is_pool || is_churn;
  const char* number = is_table ? (argc > 2 ? argv[2] : "10000") : (argc > 1 ? argv[1] : "10000");
  const auto count = static_cast<std::uint32_t>(std::atoi(number));
  Crowd crowd{};
  nook_context_desc desc;
  need_ok(nook_context_desc_init(&desc));
  need_ok(nook_context_create(&desc, &crowd.context));
  const CharacterModel character = bench::sample_model();
  const std::vector<std::byte> bytes = write_character_model(character),
                               clip_bytes = write_clip_set(sample_clip(character));
  need_ok(nook_model_load(crowd.context, bytes.data(), bytes.size(), &crowd.model));
  need_ok(nook_clips_load(crowd.context, crowd.model, clip_bytes.data(), clip_bytes.size(), &crowd.clips));
  crowd.bones = static_cast<std::uint32_t>(character.bone_count());
  if (is_churn) {
    print_churn(crowd, {bytes, clip_bytes}, count);
    print_retired_slots(crowd);
  } else if (is_pool) {
    print_pool(crowd, count);
  } else if (is_table) {
    print_table(crowd, count);
  } else {
    std::printf("%u instances of %u bones; CPU time of a frame in µs for each instance\n", count,
                crowd.bones);
    if (argc <= 2 || std::string_view(argv[2]) != "clips") compare_poses(crowd, count);
    compare_clip_calls(crowd, count);
  }
  nook_clips_destroy(&crowd.clips);
  nook_model_destroy(&crowd.model);
  nook_context_destroy(&crowd.context);
}

// The CPU side of the world pass beside nook_scene_update of the same crowd, on one thread through the C ABI.
// The camera sees a part of the crowd; its frame is small, so that a software renderer has little to draw.
// CPU counts this thread alone, without the renderer's own. Minima over all frames.
#include <benchmark/benchmark.h>
#include <glad/gl.h>
#include <nook/nook_world.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <ctime>
#include <memory>
#include <stdexcept>
#include <vector>

#include "platform/platform.h"
#include "sdk/src/character/model_file.h"
#include "tests/bench/sample_character.h"
#include "tests/pose_of_rows.h"

namespace {

using namespace nook;
using namespace nook::bench;

constexpr int side_px = 64;

void require(nook_result result) {
  if (result != NOOK_OK) throw std::runtime_error(nook_last_message());
}

double thread_seconds() {
  std::timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

template <class Work>
double seconds(Work&& work) {
  const double start = thread_seconds();
  work();
  return thread_seconds() - start;
}

// The sample character with forty capsules of a limb's size.
CharacterModel model_with_casters() {
  CharacterModel model = sample_model();
  for (std::uint16_t i = 0; i < 40; ++i) {
    WorldCaster& caster = model.world_casters.emplace_back();
    caster.bone = std::uint16_t(i % model.bone_count());
    const float height = 0.04f * float(i), aside = 0.1f * float(i % 5) - 0.2f;
    caster.capsule = {{aside, height, 0}, {aside, height + 0.1f, 0.02f}, 0.05f, 0.06f};
    caster.ao_scale = 0.9f;
  }
  return model;
}

struct WorldFrame {
  explicit WorldFrame(std::uint32_t count) : context_(platform::create_context({})) {
    nook_context_desc context_desc;
    require(nook_context_desc_init(&context_desc));
    require(nook_context_create(&context_desc, &nook_));
    nook_gl_desc gl_desc;
    require(nook_gl_desc_init(&gl_desc));
    gl_desc.get_proc = platform::Context::loader;
    gl_desc.get_proc_user = context_.get();
    require(nook_gl_create(nook_, &gl_desc, &gl_));
    const CharacterModel model = model_with_casters();
    const std::vector<std::byte> file = write_character_model(model);
    require(nook_model_load(nook_, file.data(), file.size(), &model_));
    nook_scene_desc scene_desc;
    require(nook_scene_desc_init(&scene_desc));
    require(nook_scene_create(nook_, &scene_desc, &scene_));
    bones_ = model.bone_count();
    for (std::uint32_t i = 0; i < count; ++i)
      require(nook_scene_add_instance(scene_, model_, &ids_.emplace_back()));
    make_pass();
  }
  ~WorldFrame() {
    nook_world_destroy(&pass_);
    nook_scene_destroy(&scene_);
    nook_model_destroy(&model_);
    nook_gl_destroy(&gl_);
    nook_context_destroy(&nook_);
  }
  WorldFrame(const WorldFrame&) = delete;
  WorldFrame& operator=(const WorldFrame&) = delete;

  void set_poses() {
    ++frame_number_;
    const auto side = std::uint32_t(std::ceil(std::sqrt(double(ids_.size()))));
    for (std::size_t i = 0; i < ids_.size(); ++i) {
      std::vector<Mat3x4> pose = sample_pose(bones_, (unsigned(i) + frame_number_) % 16);
      for (Mat3x4& bone : pose) {
        bone.m[3] += 1.4142f * float(i % side);
        bone.m[11] -= 1.4142f * float(i / side);
      }
      require(nook::test::set_rows(scene_, ids_[i], pose.data()->m, bones_));
    }
  }
  void update() { require(nook_scene_update(scene_)); }
  void render() { require(nook_world_render(pass_, &screen_, &frame_)); }
  void finish() { context_->gl().Finish(); }
  std::int32_t casters() const {
    nook_world_info info{};
    info.struct_size = sizeof info;
    require(nook_world_describe(pass_, &info));
    return info.caster_count;
  }

 private:
  void make_pass() {
    nook_world_desc desc;
    require(nook_world_desc_init(&desc));
    desc.max_width = desc.max_height = side_px;
    require(nook_world_create(gl_, &desc, &pass_));
    const std::vector<float> depth(side_px * side_px, 5.0f);
    const GladGLContext& gl = context_->gl();
    gl.GenTextures(1, &depth_);
    gl.BindTexture(GL_TEXTURE_2D, depth_);
    gl.TexImage2D(GL_TEXTURE_2D, 0, GL_R32F, side_px, side_px, 0, GL_RED, GL_FLOAT, depth.data());
    require(nook_gl_frame_desc_init(&screen_));
    screen_.width = screen_.height = side_px;
    screen_.depth_texture = depth_;
    screen_.depth_kind = NOOK_DEPTH_LINEAR;
    const float projection[16] = {2, 0, 0, 0, 0, 2, 0, 0, 0, 0, -1, -1, 0, 0, -0.02f, 0};
    std::memcpy(screen_.projection, projection, sizeof projection);
    require(nook_world_frame_desc_init(&frame_));
    frame_.scene = scene_;
    frame_.cutoff_error = 1.0f / 256;
    // From a corner of the crowd, along its diagonal.
    const float c = 0.7071068f;
    const float view[16] = {c, 0, c, 0, 0, 1, 0, 0, -c, 0, c, 0, 0, -1.6f, 0, 1};
    std::memcpy(screen_.view, view, sizeof view);
  }

  std::unique_ptr<platform::Context> context_;
  nook_context nook_ = nullptr;
  nook_gl gl_ = nullptr;
  nook_model model_ = nullptr;
  nook_scene scene_ = nullptr;
  nook_world pass_ = nullptr;
  GLuint depth_ = 0;
  nook_gl_frame_desc screen_{};
  nook_world_frame_desc frame_{};
  std::vector<nook_instance_id> ids_;
  std::size_t bones_ = 0;
  unsigned frame_number_ = 0;
};

void world_pass(benchmark::State& state) {
  WorldFrame frame(std::uint32_t(state.range(0)));
  double update = 1e9, render = 1e9;
  for (auto _ : state) {
    frame.set_poses();
    update = std::min(update, seconds([&] { frame.update(); }));
    render = std::min(render, seconds([&] { frame.render(); }));
    frame.finish();
  }
  state.counters["update_ms"] = 1e3 * update;
  state.counters["render_ms"] = 1e3 * render;
  state.counters["update_over_render"] = update / render;
  state.counters["casters_uploaded"] = double(frame.casters());
}
BENCHMARK(world_pass)->Arg(100)->Arg(1000)->Arg(10000)->Iterations(3)->Unit(benchmark::kMillisecond);

}  // namespace

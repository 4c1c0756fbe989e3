#include <nook/nook_world.h>

#include <limits>
#include <numbers>

#include "bakers/lab/gpu_time/crowd.h"
#include "bakers/lab/gpu_time/timed_rows.h"

namespace nook::lab {

using namespace measure;

namespace {

using namespace bake::nnao;

constexpr std::uint32_t bodies = 100;
constexpr float spacing = 1.4f;  // metres

// Returns a view that shows only the floor y = 0.
TracedView floor_view(const Camera& camera) {
  TracedView view;
  view.camera = camera;
  const Vec3 up = view_direction(camera, {0, 1, 0});
  for (std::uint32_t y = 0; y < camera.height; ++y)
    for (std::uint32_t x = 0; x < camera.width; ++x) {
      const PixelRay ray = pixel_ray(camera, float(x) + 0.5f, float(y) + 0.5f);
      const float length = -ray.origin_ws.y / ray.direction_ws.y;
      view.depth.push_back(length > 0 ? length : std::numeric_limits<float>::infinity());
      view.normal.push_back(up);
    }
  return view;
}

class WorldPass {
 public:
  WorldPass(const NookGl& gl, int width, int height, bool half) {
    nook_world_desc desc;
    succeed(nook_world_desc_init(&desc));
    desc.max_width = width;
    desc.max_height = height;
    desc.half_resolution = half;
    succeed(nook_world_create(gl.get(), &desc, &pass_));
  }
  ~WorldPass() { nook_world_destroy(&pass_); }
  WorldPass(const WorldPass&) = delete;
  WorldPass& operator=(const WorldPass&) = delete;

  nook_world get() const { return pass_; }

 private:
  nook_world pass_ = nullptr;
};

}  // namespace

std::vector<TimedRow> time_world(const Timing& timing, const std::filesystem::path& model) {
  std::vector<TimedRow> rows;
  // The camera stands behind the last row of the crowd and looks over the heads of the bodies.
  const Camera camera = look_at({0, 2.5f, 11}, {0, 0.5f, 0}, 0, std::numbers::pi_v<float> / 3,
                                std::uint32_t(timing.width), std::uint32_t(timing.height));
  const GpuView view(timing.context.gl(), floor_view(camera));
  Crowd crowd(timing.nook, model, bodies, spacing);
  crowd.pose(0);
  ScreenFrame screen = frame_of(view);
  nook_world_frame_desc frame;
  succeed(nook_world_frame_desc_init(&frame));
  frame.scene = crowd.scene();
  set_view(camera.world_from_view, screen.view);
  for (const bool half : {true, false})
    for (const float cutoff : {1.0f / 1024, 1.0f / 256}) {
      const std::string name = "world, 100 bodies, cutoff_error 1/" + std::to_string(int(1 / cutoff)) +
                               (half ? ", half resolution" : "");
      if (!timing.wanted(name)) continue;
      const WorldPass pass(timing.nook, timing.width, timing.height, half);
      frame.cutoff_error = cutoff;
      timing.add(rows, name, [&] { succeed(nook_world_render(pass.get(), &screen, &frame)); });
    }
  return rows;
}

}  // namespace nook::lab

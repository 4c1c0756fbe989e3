#include "bakers/measure/composite/shipped_pass.h"

namespace nook::measure {

ShippedPass::ShippedPass(const GladGLContext& functions, const NookGl& gl, std::span<const std::byte> model,
                         int width, int height, int taps, bool half_resolution, float radius)
    : functions_(functions), context_(gl.context()), radius_(radius) {
  succeed(nook_model_load(context_, model.data(), model.size(), &model_));
  nook_nnao_desc screen;
  succeed(nook_nnao_desc_init(&screen));
  screen.max_width = width;
  screen.max_height = height;
  screen.taps = taps;
  nook_nnao_debug_desc debug;
  succeed(nook_nnao_debug_desc_init(&debug));
  debug.path = NOOK_NNAO_PATH_FRAGMENT;
  screen.next = &debug;
  succeed(nook_nnao_create(gl.get(), &screen, &screen_));
  nook_world_desc world;
  succeed(nook_world_desc_init(&world));
  world.max_width = width;
  world.max_height = height;
  world.half_resolution = half_resolution;
  succeed(nook_world_create(gl.get(), &world, &world_));
}

ShippedPass::~ShippedPass() {
  nook_world_destroy(&world_);
  nook_nnao_destroy(&screen_);
  nook_scene_destroy(&scene_);
  nook_model_destroy(&model_);
}

void ShippedPass::pose(std::span<const Figure> figures) {
  nook_scene_destroy(&scene_);
  nook_scene_desc desc;
  succeed(nook_scene_desc_init(&desc));
  succeed(nook_scene_create(context_, &desc, &scene_));
  nook_pose_desc pose;
  succeed(nook_pose_desc_init(&pose));
  pose.kind = NOOK_POSE_REST_TO_WORLD;
  pose.layout = NOOK_TRANSFORM_ROWS_3X4;
  for (const Figure& figure : figures) {
    nook_instance_id id = 0;
    succeed(nook_scene_add_instance(scene_, model_, &id));
    pose.transforms = figure.pose.data()->m;
    pose.transform_count = std::uint32_t(figure.pose.size());
    succeed(nook_scene_set_pose(scene_, id, &pose));
  }
}

std::vector<float> ShippedPass::ao(const RoomView& view) {
  const GpuView images(functions_, view.view);
  std::vector<float> layer;
  for (const std::uint8_t figure : view.is_figure) {
    layer.push_back(1);
    layer.push_back(figure);
  }
  const GpuImage mask(functions_, GL_RG32F, GL_RG, images.width, images.height, layer.data());
  ScreenFrame screen = frame_of(images);
  screen.radius = radius_;
  screen.gbuffer_ao = NOOK_GBUFFER_AO_EXCLUDE;
  screen.gbuffer_ao_texture = mask.texture();
  succeed(nook_nnao_render(screen_, &screen, &screen));
  nook_nnao_info screen_info{};
  screen_info.struct_size = sizeof screen_info;
  succeed(nook_nnao_describe(screen_, &screen_info));
  nook_world_frame_desc world;
  succeed(nook_world_frame_desc_init(&world));
  set_view(view.view.camera.world_from_view, screen.view);
  world.scene = scene_;
  world.ao_texture = screen_info.texture;
  succeed(nook_world_render(world_, &screen, &world));
  nook_world_info info{};
  info.struct_size = sizeof info;
  succeed(nook_world_describe(world_, &info));
  return read_red(functions_, info.texture, images.width, images.height);
}

}  // namespace nook::measure

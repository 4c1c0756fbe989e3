#include "bakers/measure/composite/shipped_pass.h"

namespace nook::measure {

ShippedPass::ShippedPass(const GladGLContext& functions, const NookGl& gl, std::span<const std::byte> model,
                         int width, int height, int taps, bool half_resolution, float radius)
    : functions_(functions), context_(gl.context()), radius_(radius) {
  succeed(nook_character_model_load(context_, model.data(), model.size(), &model_));
  nook_nnao_desc screen;
  succeed(nook_nnao_desc_init(&screen, sizeof screen, NOOK_VERSION));
  screen.max_width = width;
  screen.max_height = height;
  screen.taps = taps;
  screen.path = NOOK_NNAO_PATH_FRAGMENT;
  succeed(nook_nnao_create(gl.get(), &screen, &screen_));
  nook_world_pass_desc world;
  succeed(nook_world_pass_desc_init(&world, sizeof world, NOOK_VERSION));
  world.max_width = width;
  world.max_height = height;
  world.half_resolution = half_resolution;
  succeed(nook_world_pass_create(gl.get(), &world, &world_));
}

ShippedPass::~ShippedPass() {
  nook_world_pass_destroy(&world_);
  nook_nnao_destroy(&screen_);
  nook_scene_destroy(&scene_);
  nook_character_model_destroy(&model_);
}

void ShippedPass::pose(std::span<const Figure> figures) {
  nook_scene_destroy(&scene_);
  nook_scene_desc desc;
  succeed(nook_scene_desc_init(&desc, sizeof desc, NOOK_VERSION));
  succeed(nook_scene_create(context_, &desc, &scene_));
  for (const Figure& figure : figures) {
    nook_instance_id id = 0;
    succeed(nook_scene_add_instance(scene_, model_, &id));
    succeed(nook_scene_set_pose(scene_, id, figure.pose.data()->m, std::uint32_t(figure.pose.size())));
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
  nook_nnao_frame_desc screen = frame_of(images);
  screen.radius = radius_;
  screen.layer = NOOK_NNAO_LAYER_APART;
  screen.layer_texture = mask.texture();
  succeed(nook_nnao_render(screen_, &screen));
  nook_nnao_info screen_info{};
  screen_info.struct_size = sizeof screen_info;
  succeed(nook_nnao_describe(screen_, &screen_info));
  nook_world_frame_desc world;
  succeed(nook_world_frame_desc_init(&world, sizeof world, NOOK_VERSION));
  world.screen = &screen;
  set_view(view.view.camera.world_from_view, world.view);
  world.scene = scene_;
  world.ao_texture = screen_info.texture;
  succeed(nook_world_render(world_, &world));
  nook_world_pass_info info{};
  info.struct_size = sizeof info;
  succeed(nook_world_pass_describe(world_, &info));
  return read_red(functions_, info.texture, images.width, images.height);
}

}  // namespace nook::measure

#include "samples/crowd/crowd_scene.h"

#include <tbb/parallel_for.h>

#include <cstdio>
#include <glm/gtc/type_ptr.hpp>
#include <stdexcept>
#include <string>

namespace crowd {
namespace {

constexpr float ground_plane[4] = {0, 1, 0, 0};
// The distance between the centres of bounding spheres. Neighbours that are farther away cause hardly any AO.
constexpr float link_distance_m = 4.0f;

nook_context_desc host_services() {
  nook_context_desc desc = nook::context_desc();
  desc.log = [](void*, nook_log_severity severity, const char* text) {
    if (severity != NOOK_LOG_INFO) std::fprintf(stderr, "nook: %s\n", text);
  };
  desc.parallel_for = [](void*, std::uint32_t count, nook_job_fn body, void* body_user) {
    tbb::parallel_for(0u, count, [&](std::uint32_t i) { body(body_user, i); });
  };
  return desc;
}

nook_gl_desc gl_settings(platform::Context& context, int tier) {
  nook_gl_desc desc = nook::gl_desc();
  desc.get_proc = platform::Context::loader;
  desc.get_proc_user = &context;
  desc.max_tier = tier;
  return desc;
}

// Returns a muted colour, always the same for the same character.
glm::vec3 albedo_of(std::size_t character) {
  // Linear reflectances of plaster, sand, terracotta, sage, slate and rose.
  static const glm::vec3 colours[] = {{0.62f, 0.60f, 0.56f}, {0.58f, 0.48f, 0.34f}, {0.52f, 0.28f, 0.19f},
                                      {0.34f, 0.43f, 0.30f}, {0.27f, 0.36f, 0.46f}, {0.54f, 0.38f, 0.37f}};
  return colours[character % 6];
}

}  // namespace

CrowdScene::CrowdScene(platform::Context& context, const Hero& hero, std::span<const unsigned char> model,
                       const CrowdSize& size, const nook_scene_desc& desc)
    : hero_(hero),
      context_(host_services()),
      model_(load(model)),
      scene_(context_, desc),
      gl_(context_, gl_settings(context, size.tier)) {
  for (std::uint32_t i = 0; i < size.characters; ++i) {
    instances_.push_back(scene_.add_instance(model_));
    scene_.set_ground(instances_.back(), ground_plane);
  }
  link_nearest(size.neighbours);
  // Makes the buffers now, so that the first frame does not allocate, and gl_.view works before the first
  // frame.
  gl_.prepare(scene_);
}

nook::CharacterModel CrowdScene::load(std::span<const unsigned char> bytes) const {
  nook::CharacterModel model(context_, bytes.data(), bytes.size());
  const nook_model_info info = model.info();
  if (info.file_vertex_count != hero_.vertex_count() || info.bone_count != hero_.bone_count())
    throw std::runtime_error("crowd: the model does not belong to the character (got " +
                             std::to_string(info.file_vertex_count) + " vertices and " +
                             std::to_string(info.bone_count) + " bones, need " +
                             std::to_string(hero_.vertex_count()) + " and " +
                             std::to_string(hero_.bone_count()) + "); bake the character again");
  return model;
}

void CrowdScene::set_model(std::span<const unsigned char> bytes) {
  nook::CharacterModel model = load(bytes);
  for (const nook_instance_id id : instances_) scene_.set_model(id, model);
  model_ = std::move(model);
  gl_.prepare(scene_);
}

void CrowdScene::link_nearest(std::uint32_t neighbours) {
  scene_.link_nearest(neighbours, link_distance_m);
}

void CrowdScene::set_light(std::span<const nook_lobe> lobes) {
  for (const nook_instance_id id : instances_)
    scene_.set_light(id, lobes.data(), std::uint32_t(lobes.size()));
  lit_ = !lobes.empty();
}

void CrowdScene::set_poses(const std::vector<Bones>& poses) {
  nook_pose_desc desc = nook::pose_desc();
  // The importer of the bakers gives rest-to-world matrices. An engine leaves kind and layout at their
  // defaults, NOOK_POSE_SKINNING and NOOK_TRANSFORM_COLUMNS_4X4, and passes the matrices of its vertex
  // shader.
  desc.kind = NOOK_POSE_REST_TO_WORLD;
  desc.layout = NOOK_TRANSFORM_ROWS_3X4;
  for (std::size_t i = 0; i < instances_.size(); ++i) {
    desc.transforms = poses[i].data();
    desc.transform_count = std::uint32_t(poses[i].size() / 12);
    scene_.set_pose(instances_[i], desc);
  }
}

void CrowdScene::set_camera(const glm::vec3& eye_ws) {
  scene_.set_camera(glm::value_ptr(eye_ws));
}

void CrowdScene::update(std::uint32_t terms) {
  // The check boxes of the window use this. set_terms is experimental, and an engine does not need it: all
  // terms are on by default.
  nook::set_terms(scene_, terms);
  gl_.update(scene_);
}

std::vector<DrawnInstance> CrowdScene::drawn(const std::vector<Bones>& poses) const {
  std::vector<DrawnInstance> drawn(poses.size());
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    const nook_gl_view ao = gl_.view(scene_, instances_[i]);
    drawn[i] = {&poses[i], {ao.buffer, ao.offset, ao.stride}, albedo_of(i), {}, 0};
    if (!lit_) continue;
    const nook_gl_view light = gl_.view(scene_, instances_[i], NOOK_CHANNEL_DIRECTIONAL_AO);
    drawn[i].light = {light.buffer, light.offset, light.stride};
    drawn[i].light_texel = light.light;
  }
  return drawn;
}

}  // namespace crowd

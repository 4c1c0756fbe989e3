#include "samples/crowd/crowd_scene.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstdio>
#include <glm/gtc/type_ptr.hpp>
#include <stdexcept>

namespace crowd {
namespace {

constexpr float kGroundPlane[4] = {0, 1, 0, 0};
// Between the centres of bounding spheres. Neighbours that are farther away hardly darken.
constexpr float kLinkDistance_m = 4.0f;

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

nook_scene_desc scene_settings(const CrowdSceneRequest& request) {
  nook_scene_desc desc = nook::scene_desc();
  desc.form = request.form;
  desc.lod_error = request.lod_error;
  return desc;
}

nook_gl_desc gl_settings(platform::Context& context, int tier) {
  nook_gl_desc desc = nook::gl_desc();
  desc.get_proc = platform::Context::loader;
  desc.get_proc_user = &context;
  desc.max_tier = tier;
  return desc;
}

}  // namespace

CrowdScene::CrowdScene(platform::Context& context, std::span<const unsigned char> model_bytes,
                       const CrowdSceneRequest& request)
    : context_(host_services()),
      model_(context_, model_bytes.data(), model_bytes.size()),
      scene_(context_, scene_settings(request)),
      gl_(context_, gl_settings(context, request.tier)) {
  for (std::uint32_t i = 0; i < request.characters; ++i) {
    instances_.push_back(scene_.add_instance(model_));
    scene_.set_ground(instances_.back(), kGroundPlane);
  }
  link_nearest(request.neighbours);
  gl_.prepare(scene_);
}

void CrowdScene::set_model(std::span<const unsigned char> model_bytes) {
  nook::CharacterModel model(context_, model_bytes.data(), model_bytes.size());
  const nook_model_info before = model_.info(), now = model.info();
  if (now.file_vertex_count != before.file_vertex_count || now.bone_count != before.bone_count)
    throw std::runtime_error(
        "crowd: the model is of another character (got " + std::to_string(now.file_vertex_count) +
        " vertices and " + std::to_string(now.bone_count) + " bones, need " +
        std::to_string(before.file_vertex_count) + " and " + std::to_string(before.bone_count) + ")");
  for (const nook_instance_id id : instances_) scene_.set_model(id, model);
  model_ = std::move(model);
  gl_.prepare(scene_);
}

void CrowdScene::set_camera(const glm::vec3& eye_ws) {
  scene_.set_camera(glm::value_ptr(eye_ws));
}

nook_scene_instance_info CrowdScene::info(std::size_t character) const {
  return nook::instance_info(scene_, instances_[character]);
}

glm::vec3 CrowdScene::centre_ws(std::size_t character) const {
  return glm::make_vec3(info(character).bound_centre_ws);
}

std::vector<nook_scene_sphere> CrowdScene::spheres(std::size_t character) const {
  return nook::posed_spheres(scene_, instances_[character]);
}

std::vector<nook_scene_key_point> CrowdScene::key_points(std::size_t character) const {
  return nook::posed_key_points(scene_, instances_[character]);
}

std::vector<std::uint32_t> CrowdScene::links(std::size_t character) const {
  std::vector<std::uint32_t> characters;
  for (const nook_instance_id caster : nook::linked_casters(scene_, instances_[character]))
    characters.push_back(
        std::uint32_t(std::find(instances_.begin(), instances_.end(), caster) - instances_.begin()));
  return characters;
}

void CrowdScene::update_on_cpu() {
  scene_.update();
}

void CrowdScene::link_nearest(std::uint32_t neighbours) {
  scene_.link_nearest(neighbours, kLinkDistance_m);
}

void CrowdScene::set_poses(const std::vector<Bones>& poses) {
  nook_pose_desc desc = nook::pose_desc();
  desc.kind = NOOK_POSE_REST_TO_WORLD;
  desc.layout = NOOK_TRANSFORM_ROWS_3X4;
  for (std::size_t i = 0; i < instances_.size(); ++i) {
    desc.transforms = poses[i].data();
    desc.transform_count = std::uint32_t(poses[i].size() / 12);
    scene_.set_pose(instances_[i], desc);
  }
}

void CrowdScene::update(std::uint32_t terms) {
  nook::set_terms(scene_, terms);
  gl_.update(scene_);
}

VertexSource CrowdScene::ao(std::size_t character) const {
  const nook_gl_view view = gl_.view(scene_, instances_[character]);
  return {view.buffer, view.offset, view.stride};
}

std::vector<float> CrowdScene::read_ao(std::size_t character) const {
  std::vector<float> ao(model_.info().file_vertex_count);
  gl_.read(scene_, instances_[character], NOOK_CHANNEL_AO, ao.data(), std::uint32_t(ao.size()));
  return ao;
}

void CrowdScene::set_light(std::span<const nook_lobe> lobes) {
  for (const nook_instance_id id : instances_)
    scene_.set_light(id, lobes.data(), std::uint32_t(lobes.size()));
}

nook_gl_view CrowdScene::light(std::size_t character) const {
  return gl_.view(scene_, instances_[character], NOOK_CHANNEL_DIRECTIONAL_AO);
}

std::vector<std::vector<float>> CrowdScene::directional_ao(std::span<const std::uint32_t> characters,
                                                           std::span<const nook_lobe> lobes) {
  for (const std::uint32_t c : characters)
    scene_.set_light(instances_[c], lobes.data(), std::uint32_t(lobes.size()));
  nook::set_terms(scene_, NOOK_TERM_ALL);
  scene_.update();
  std::vector<std::vector<float>> occlusion;
  const std::uint32_t count = model_.info().file_vertex_count;
  for (const std::uint32_t c : characters) {
    scene_.read_directional_ao(instances_[c], occlusion.emplace_back(3 * std::size_t(count)).data(), count);
    scene_.set_light(instances_[c], nullptr, 0);
  }
  return occlusion;
}

}  // namespace crowd

// C++17 wrappers of characters and scenes: nook_character.h, nook_pose.h and nook_vertices.h.
#ifndef NOOK_CHARACTER_HPP
#define NOOK_CHARACTER_HPP

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "nook_character.h"
#include "nook_handle.hpp"
#include "nook_pose.h"
#include "nook_vertices.h"

namespace nook {
inline namespace wrapper {

inline nook_scene_desc scene_desc() {
  nook_scene_desc desc;
  check(nook_scene_desc_init(&desc, sizeof desc, NOOK_VERSION));
  return desc;
}

inline nook_pose_desc pose_desc() {
  nook_pose_desc desc;
  check(nook_pose_desc_init(&desc, sizeof desc, NOOK_VERSION));
  return desc;
}

class CharacterModel : public Unique<nook_character_model, nook_character_model_destroy> {
 public:
  CharacterModel() = default;
  CharacterModel(const Context& context, const void* bytes, std::size_t size)
      : Unique(load(context, bytes, size)) {}

  nook_character_model_info info() const {
    nook_character_model_info info{};
    info.struct_size = sizeof info;
    check(nook_character_model_describe(get(), &info));
    return info;
  }
  nook_character_memory memory() const {
    nook_character_memory memory{};
    memory.struct_size = sizeof memory;
    check(nook_character_model_memory(get(), &memory));
    return memory;
  }
  // Returns an empty string for an index out of range.
  std::string bone_name(std::uint32_t bone) const {
    const char* name = nook_character_model_bone_name(get(), bone);
    return name ? name : "";
  }
  std::vector<float> static_ao() const {
    std::vector<float> ao(info().file_vertex_count);
    check(nook_character_model_static_ao(get(), ao.data(), static_cast<std::uint32_t>(ao.size())));
    return ao;
  }
  // Eight signed bytes for each vertex, as nook_character_model_blocked_vectors has them.
  std::vector<std::int8_t> blocked_vectors() const {
    std::vector<std::int8_t> bytes(std::size_t{8} * info().file_vertex_count);
    check(nook_character_model_blocked_vectors(get(), bytes.data(), info().file_vertex_count, 0));
    return bytes;
  }
  // The transform of each bone, -1 where no name matches.
  std::vector<std::int32_t> map_bones(const std::vector<const char*>& names, std::uint32_t flags = 0) const {
    nook_bone_names rules{};
    rules.struct_size = sizeof rules;
    rules.flags = flags;
    rules.names = names.data();
    rules.name_count = static_cast<std::uint32_t>(names.size());
    std::vector<std::int32_t> map(info().bone_count);
    check(nook_character_model_map_bones(get(), &rules, map.data(), static_cast<std::uint32_t>(map.size()),
                                         nullptr));
    return map;
  }
  // index is less than info().check_vertex_count.
  nook_rest_vertex rest_vertex(std::uint32_t index) const {
    nook_rest_vertex vertex{};
    vertex.struct_size = sizeof vertex;
    check(nook_character_model_rest_vertex(get(), index, &vertex));
    return vertex;
  }
  // index is less than info().skin_count.
  nook_skin_info skin(std::uint32_t index) const {
    nook_skin_info skin{};
    skin.struct_size = sizeof skin;
    check(nook_character_model_skin(get(), index, &skin));
    return skin;
  }
  // Fills the answers in `answer`.
  void check_pose(const nook_pose_desc& desc, nook_pose_check& answer) const {
    answer.struct_size = sizeof answer;
    wrapper::check(nook_character_model_check_pose(get(), &desc, &answer));
  }
  // The model in the order of a host's vertices; vertices[i] is this model's vertex for the host's vertex i.
  CharacterModel remap(const std::vector<std::uint32_t>& vertices) const {
    nook_character_model handle = nullptr;
    check(nook_character_model_remap(get(), vertices.data(), static_cast<std::uint32_t>(vertices.size()),
                                     &handle));
    return CharacterModel(handle);
  }

 private:
  explicit CharacterModel(nook_character_model handle) : Unique(handle) {}
  static nook_character_model load(const Context& context, const void* bytes, std::size_t size) {
    nook_character_model handle = nullptr;
    check(nook_character_model_load(context.get(), bytes, size, &handle));
    return handle;
  }
};

class Scene : public Unique<nook_scene, nook_scene_destroy> {
 public:
  explicit Scene(const Context& context, const nook_scene_desc& desc = scene_desc())
      : Unique(create(context, desc)) {}

  nook_instance_id add_instance(const CharacterModel& model) {
    nook_instance_id id = 0;
    check(nook_scene_add_instance(get(), model.get(), &id));
    return id;
  }
  void remove_instance(nook_instance_id id) { check(nook_scene_remove_instance(get(), id)); }
  // The bone counts of both models are equal.
  void set_model(nook_instance_id id, const CharacterModel& model) {
    check(nook_scene_set_model(get(), id, model.get()));
  }
  // bones_3x4 holds 12 floats for each bone, row-major.
  void set_pose(nook_instance_id id, const float* bones_3x4, std::uint32_t bone_count) {
    check(nook_scene_set_pose(get(), id, bones_3x4, bone_count));
  }
  // The pose as a host has it; pose_desc() begins a description.
  void set_pose(nook_instance_id id, const nook_pose_desc& desc) {
    check(nook_scene_set_pose_from(get(), id, &desc));
  }
  void link(nook_instance_id receiver, nook_instance_id caster) {
    check(nook_scene_link(get(), receiver, caster));
  }
  void unlink(nook_instance_id receiver, nook_instance_id caster) {
    check(nook_scene_unlink(get(), receiver, caster));
  }
  void link_nearest(std::uint32_t k, float max_distance) {
    check(nook_scene_link_nearest(get(), k, max_distance));
  }
  void set_ground(nook_instance_id id, const float* plane_xyzd) {
    check(nook_scene_set_ground(get(), id, plane_xyzd));
  }
  nook_occluder_id add_occluder(const float centre_ws[3], float radius) {
    nook_occluder_id id = 0;
    check(nook_scene_add_occluder(get(), centre_ws, radius, &id));
    return id;
  }
  void set_occluder(nook_occluder_id id, const float centre_ws[3], float radius) {
    check(nook_scene_set_occluder(get(), id, centre_ws, radius));
  }
  void remove_occluder(nook_occluder_id id) { check(nook_scene_remove_occluder(get(), id)); }
  // receiver 0: every instance.
  void limit_occluder(nook_occluder_id id, nook_instance_id receiver) {
    check(nook_scene_limit_occluder(get(), id, receiver));
  }
  void set_camera(const float position_ws[3]) { check(nook_scene_set_camera(get(), position_ws)); }
  void set_terms(std::uint32_t terms) { check(nook_scene_set_terms(get(), terms)); }
  void update() { check(nook_scene_update(get())); }
  void read_ao(nook_instance_id id, float* out, std::uint32_t count, std::size_t stride = 0) const {
    check(nook_scene_read_ao(get(), id, out, count, stride));
  }
  // Writes four signed bytes for each vertex.
  void read_bent_normals(nook_instance_id id, std::int8_t* out, std::uint32_t count,
                         std::size_t stride = 0) const {
    check(nook_scene_read_bent_normals(get(), id, out, count, stride));
  }
  void set_light(nook_instance_id id, const nook_probe_lobe* lobes, std::uint32_t lobe_count) {
    check(nook_scene_set_light(get(), id, lobes, lobe_count));
  }
  // Writes three floats for each vertex.
  void read_directional_ao(nook_instance_id id, float* out_rgb, std::uint32_t count,
                           std::size_t stride = 0) const {
    check(nook_scene_read_directional_ao(get(), id, out_rgb, count, stride));
  }
  std::uint64_t memory() const {
    std::uint64_t bytes = 0;
    check(nook_scene_memory(get(), &bytes));
    return bytes;
  }
  nook_scene_stats stats() const {
    nook_scene_stats stats{};
    stats.struct_size = sizeof stats;
    check(nook_scene_read_stats(get(), &stats));
    return stats;
  }

 private:
  static nook_scene create(const Context& context, const nook_scene_desc& desc) {
    nook_scene handle = nullptr;
    check(nook_scene_create(context.get(), &desc, &handle));
    return handle;
  }
};

}  // namespace wrapper
}  // namespace nook
#endif

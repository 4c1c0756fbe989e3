// C++17 wrappers of characters and scenes: nook_character.h.
#ifndef NOOK_CHARACTER_HPP
#define NOOK_CHARACTER_HPP

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "nook_character.h"
#include "nook_handle.hpp"

namespace nook {
inline namespace wrapper {

inline nook_scene_desc scene_desc() {
  nook_scene_desc desc;
  check(nook_scene_desc_init(&desc));
  return desc;
}

inline nook_pose_desc pose_desc() {
  nook_pose_desc desc;
  check(nook_pose_desc_init(&desc));
  return desc;
}

inline nook_bone_map_desc bone_map_desc() {
  nook_bone_map_desc desc;
  check(nook_bone_map_desc_init(&desc));
  return desc;
}

inline nook_vertex_match_desc vertex_match_desc() {
  nook_vertex_match_desc desc;
  check(nook_vertex_match_desc_init(&desc));
  return desc;
}

inline nook_pose_check_desc pose_check_desc() {
  nook_pose_check_desc desc;
  check(nook_pose_check_desc_init(&desc));
  return desc;
}

class CharacterModel : public Unique<nook_model, nook_model_destroy> {
 public:
  CharacterModel() = default;
  CharacterModel(const Context& context, const void* bytes, std::size_t size)
      : Unique(load(context, bytes, size)) {}

  nook_model_info info() const {
    nook_model_info info{};
    info.struct_size = sizeof info;
    check(nook_model_describe(get(), &info));
    return info;
  }
  // Returns an empty string for an index out of range.
  std::string bone_name(std::uint32_t bone) const {
    const char* name = nook_model_bone_name(get(), bone);
    return name ? name : "";
  }
  std::vector<float> static_ao() const {
    std::vector<float> ao(info().file_vertex_count);
    check(nook_model_read(get(), NOOK_MODEL_STATIC_AO, ao.data(), static_cast<std::uint32_t>(ao.size()), 0));
    return ao;
  }
  // Returns eight signed bytes for each vertex, as NOOK_MODEL_OCCLUDED_DIRECTIONS describes.
  std::vector<std::int8_t> occluded_directions() const {
    const std::uint32_t count = info().file_vertex_count;
    std::vector<std::int8_t> bytes(std::size_t{8} * count);
    check(nook_model_read(get(), NOOK_MODEL_OCCLUDED_DIRECTIONS, bytes.data(), count, 0));
    return bytes;
  }
  // Returns the index of the transform of each bone, or -1 if no name matches.
  std::vector<std::int32_t> map_bones(const std::vector<const char*>& names, std::uint32_t flags = 0) const {
    nook_bone_map_desc desc = bone_map_desc();
    desc.flags = flags;
    desc.names = names.data();
    desc.name_count = static_cast<std::uint32_t>(names.size());
    std::vector<std::int32_t> map(info().bone_count);
    check(nook_model_map_bones(get(), &desc, map.data(), static_cast<std::uint32_t>(map.size()), nullptr));
    return map;
  }
  // `index` must be less than info().check_vertex_count.
  nook_check_vertex_info check_vertex(std::uint32_t index) const {
    nook_check_vertex_info vertex{};
    vertex.struct_size = sizeof vertex;
    check(nook_model_describe_check_vertex(get(), index, &vertex));
    return vertex;
  }
  // `index` must be less than info().skin_count.
  nook_skin_info skin(std::uint32_t index) const {
    nook_skin_info skin{};
    skin.struct_size = sizeof skin;
    check(nook_model_describe_skin(get(), index, &skin));
    return skin;
  }
  // Initialise `vertices` with pose_check_desc().
  nook_pose_check_info check_pose(const nook_pose_desc& desc, const nook_pose_check_desc& vertices) const {
    nook_pose_check_info info{};
    info.struct_size = sizeof info;
    check(nook_model_check_pose(get(), &desc, &vertices, &info));
    return info;
  }
  // Returns a copy of the model in the order of your vertices. vertices[i] is the index of your vertex i in
  // this model.
  CharacterModel remap(const std::vector<std::uint32_t>& vertices) const {
    nook_model handle = nullptr;
    check(nook_model_remap(get(), vertices.data(), static_cast<std::uint32_t>(vertices.size()), &handle));
    return CharacterModel(handle);
  }

 private:
  explicit CharacterModel(nook_model handle) : Unique(handle) {}
  static nook_model load(const Context& context, const void* bytes, std::size_t size) {
    nook_model handle = nullptr;
    check(nook_model_load(context.get(), bytes, size, &handle));
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
  // Both models must have the same number of bones.
  void set_model(nook_instance_id id, const CharacterModel& model) {
    check(nook_scene_set_model(get(), id, model.get()));
  }
  // Initialise `desc` with pose_desc().
  void set_pose(nook_instance_id id, const nook_pose_desc& desc) {
    check(nook_scene_set_pose(get(), id, &desc));
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
  nook_occluder_id add_occluder(const nook_occluder& occluder) {
    nook_occluder_id id = 0;
    check(nook_scene_add_occluder(get(), &occluder, &id));
    return id;
  }
  void set_occluder(nook_occluder_id id, const nook_occluder& occluder) {
    check(nook_scene_set_occluder(get(), id, &occluder));
  }
  void remove_occluder(nook_occluder_id id) { check(nook_scene_remove_occluder(get(), id)); }
  void set_camera(const float position_ws[3]) { check(nook_scene_set_camera(get(), position_ws)); }
  void update() { check(nook_scene_update(get())); }
  void read(nook_instance_id id, nook_channel channel, nook_format format, void* out, std::uint32_t count,
            std::size_t stride = 0) const {
    check(nook_scene_read(get(), id, channel, format, out, count, stride));
  }
  // Writes one float for each vertex.
  void read_ao(nook_instance_id id, float* out, std::uint32_t count, std::size_t stride = 0) const {
    read(id, NOOK_CHANNEL_AO, NOOK_FORMAT_FLOAT, out, count, stride);
  }
  // Writes four signed bytes for each vertex.
  void read_bent_normals(nook_instance_id id, std::int8_t* out, std::uint32_t count,
                         std::size_t stride = 0) const {
    read(id, NOOK_CHANNEL_BENT_NORMAL, NOOK_FORMAT_SNORM8, out, count, stride);
  }
  void set_light(nook_instance_id id, const nook_lobe* lobes, std::uint32_t lobe_count) {
    check(nook_scene_set_light(get(), id, lobes, lobe_count));
  }
  // Writes three floats for each vertex.
  void read_directional_ao(nook_instance_id id, float* out_rgb, std::uint32_t count,
                           std::size_t stride = 0) const {
    read(id, NOOK_CHANNEL_DIRECTIONAL_AO, NOOK_FORMAT_FLOAT, out_rgb, count, stride);
  }
  nook_scene_info info() const {
    nook_scene_info info{};
    info.struct_size = sizeof info;
    check(nook_scene_describe(get(), &info));
    return info;
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

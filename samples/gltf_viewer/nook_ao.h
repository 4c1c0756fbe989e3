// Everything in this viewer that touches Nook: the AO of the character's vertices, and the AO of the screen.
#pragma once

#include <glm/gtc/type_ptr.hpp>
#include <nook/nook.hpp>
#include <optional>
#include <span>

#include "samples/gltf_viewer/viewed_character.h"

namespace viewer {

class NookAo {
 public:
  NookAo(const CharacterFile& file, const std::vector<unsigned char>& model, nook_gl_proc_fn get_proc,
         void* user, int width, int height)
      : file_(file), model_(context_, model.data(), model.size()), character_(scene_.add_instance(model_)) {
    if (model_.info().file_vertex_count != file.vertices.size())
      throw std::runtime_error(
          "the model was baked from other meshes; bake a model from this file, with the same --without");
    std::vector<const char*> names;
    for (const Node& node : file.nodes) names.push_back(node.name.c_str());
    node_of_bone_ = model_.map_bones(names);
    const float ground[4] = {0, 1, 0, 0};  // the plane y = 0
    scene_.set_ground(character_, ground);
    nook_gl_desc gl = nook::gl_desc();
    gl.get_proc = get_proc;
    gl.get_proc_user = user;
    gl_.emplace(context_, gl);
    nook_nnao_desc screen = nook::nnao_desc(NOOK_NNAO_PRESET_BEST);  // 32 taps leave no streaks on the floor
    frame_.width = screen.max_width = width;
    frame_.height = screen.max_height = height;
    screen.blur = 2;  // the picture has no temporal anti-aliasing, which would average the taps' pattern
    screen_.emplace(*gl_, screen);
  }

  // Evaluates a pose. The result is bound as a vertex attribute of one float.
  nook_gl_view character(const Pose& pose) {
    // These matrices also pose the parts without a skin. The bone names say which nodes they belong to.
    const std::span matrices(pose.matrices);
    set_pose(NOOK_POSE_JOINT_TO_WORLD, matrices.subspan(file_.first_node_matrix), node_of_bone_, 0);
    for (std::uint32_t s = 0; s < file_.skins.size(); ++s)
      if (const Skin& skin = file_.skins[s]; skin.has_mesh)
        set_pose(NOOK_POSE_SKINNING, matrices.subspan(skin.first_matrix, skin.joints.size()), {}, s);
    gl_->update(scene_);
    return gl_->view(scene_, character_);
  }

  // Returns a texture with the AO of each pixel in red. If the layer of a pixel is (c, 1), the result is c.
  std::uint32_t screen(std::uint32_t depth, std::uint32_t layer, const glm::mat4& projection,
                       float radius_m) {
    frame_.depth_texture = depth;
    frame_.gbuffer_ao = NOOK_GBUFFER_AO_REPLACE;
    frame_.gbuffer_ao_texture = layer;
    std::copy_n(glm::value_ptr(projection), 16, frame_.projection);
    desc_.radius = radius_m;
    screen_->render(frame_, desc_);
    return screen_->info().texture;
  }

 private:
  void set_pose(nook_pose_kind kind, std::span<const glm::mat4> matrices,
                const std::vector<std::int32_t>& map, std::uint32_t skin) {
    nook_pose_desc desc = nook::pose_desc();
    desc.kind = kind;
    desc.layout = NOOK_TRANSFORM_COLUMNS_4X4;
    desc.transforms = glm::value_ptr(matrices[0]);
    desc.transform_count = std::uint32_t(matrices.size());
    desc.skin = skin;
    desc.transform_of_bone = map.data();
    desc.bone_count = std::uint32_t(map.size());
    desc.flags = NOOK_POSE_FLAG_PARTIAL;
    scene_.set_pose(character_, desc);
  }

  const CharacterFile& file_;
  nook::Context context_;
  nook::CharacterModel model_;
  nook::Scene scene_{context_};
  nook_instance_id character_;
  std::optional<nook::Gl> gl_;
  std::optional<nook::Nnao> screen_;
  nook_gl_frame_desc frame_ = nook::gl_frame_desc();
  nook_nnao_frame_desc desc_ = nook::nnao_frame_desc();
  std::vector<std::int32_t> node_of_bone_;
};

}  // namespace viewer

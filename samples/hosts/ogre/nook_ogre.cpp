#include "samples/hosts/ogre/nook_ogre.h"

#include <RenderSystems/GL3Plus/OgreGL3PlusHardwareVertexBuffer.h>

namespace {

std::uint32_t gl_name(const Ogre::TexturePtr& texture) {
  std::uint32_t name = 0;
  texture->getCustomAttribute("GLID", &name);
  return name;
}

}  // namespace

NookOgre::NookOgre(const Ogre::Entity& entity, Ogre::HardwareVertexBufferSharedPtr ao, const void* model,
                   std::size_t size, const nook_gl_desc& gl)
    : entity_(entity),
      ao_(std::move(ao)),
      model_(context_, model, size),
      gl_(context_, gl),
      character_(scene_.add_instance(model_)) {
  std::vector<const char*> names;
  for (const Ogre::Bone* bone : entity.getSkeleton()->getBones()) names.push_back(bone->getName().c_str());
  bone_map_ = model_.map_bones(names);
  scene_.set_ground(character_, Ogre::Vector4(0, 1, 0, 0).ptr());
}

void NookOgre::listen(const Ogre::TexturePtr& depth, const Ogre::TexturePtr& result,
                      const Ogre::Camera& camera, float radius_m) {
  nook_nnao_desc desc = nook::nnao_desc();
  frame_.width = desc.max_width = int(depth->getWidth());
  frame_.height = desc.max_height = int(depth->getHeight());
  screen_ = std::make_unique<nook::Nnao>(gl_, desc);
  frame_.depth_texture = gl_name(depth);
  frame_.depth_kind = NOOK_DEPTH_LINEAR;
  frame_.sky_depth = camera.getFarClipDistance();
  frame_settings_.radius = radius_m;
  frame_.target = NOOK_TARGET_TEXTURE;
  frame_.target_name = gl_name(result);
  camera_ = &camera;
  depth->getBuffer()->getRenderTarget()->addListener(this);
}

void NookOgre::set_pose() {
  /* [pose] */
  std::vector<Ogre::Affine3> bones;
  for (const Ogre::Bone* bone : entity_.getSkeleton()->getBones()) bones.push_back(bone->_getFullTransform());
  nook_pose_desc desc = nook::pose_desc();
  desc.kind = NOOK_POSE_JOINT_TO_WORLD;
  desc.layout = NOOK_TRANSFORM_ROWS_4X4;
  desc.transforms = bones[0][0];
  desc.transform_count = std::uint32_t(bones.size());
  desc.transform_of_bone = bone_map_.data();
  desc.bone_count = std::uint32_t(bone_map_.size());
  desc.place_3x4 = entity_._getParentNodeFullTransform()[0];
  scene_.set_pose(character_, desc);
  /* [end] */
}

// OGRE draws only from its own buffers, so Nook writes the AO into one of them.
void NookOgre::update_on_gpu() {
  set_pose();
  gl_.update(scene_);
  /* [ao] */
  nook_gl_ao_target target{};
  target.buffer = static_cast<Ogre::GL3PlusHardwareVertexBuffer&>(*ao_).getGLBufferId();
  gl_.write_ao(scene_, {character_}, target);
  /* [end] */
}

void NookOgre::update_on_cpu() {
  set_pose();
  scene_.update();
  std::vector<float> ao(ao_->getNumVertices());
  scene_.read_ao(character_, ao.data(), std::uint32_t(ao.size()));
  ao_->writeData(0, 4 * ao.size(), ao.data(), true);
}

// OGRE draws into textures upside down, and so does the projection here.
void NookOgre::postRenderTargetUpdate(const Ogre::RenderTargetEvent&) {
  /* [screen] */
  const Ogre::Matrix4 projection = camera_->getProjectionMatrixWithRSDepth();
  for (int i = 0; i < 16; ++i) frame_.projection[i] = projection[i % 4][i / 4] * (i % 4 == 1 ? -1.0f : 1.0f);
  screen_->render(frame_, frame_settings_);
  /* [end] */
}

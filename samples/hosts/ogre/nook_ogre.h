// Nook in an OGRE program with the GL3Plus render system: the AO of one entity's vertices, and the AO of the
// screen.
#pragma once

#include <Ogre.h>

#include <nook/nook.hpp>

class NookOgre : public Ogre::RenderTargetListener {
 public:
  // The bones of the entity's skeleton must have the names of the file's nodes. `ao` is a vertex buffer with
  // one float for each vertex, in the order of the file.
  NookOgre(const Ogre::Entity& entity, Ogre::HardwareVertexBufferSharedPtr ao, const void* model,
           std::size_t size, const nook_gl_desc& gl);
  // After OGRE has drawn `depth`, writes AO to `result`, an RGBA texture of the same size. `depth` is a
  // render texture of 32-bit floats; its red channel must hold the distance of the surface from the camera's
  // plane.
  void listen(const Ogre::TexturePtr& depth, const Ogre::TexturePtr& result, const Ogre::Camera& camera,
              float radius_m);

  // Call one of these in each frame, after the bones have moved.
  void update_on_gpu();
  void update_on_cpu();
  void postRenderTargetUpdate(const Ogre::RenderTargetEvent& event) override;

 private:
  void set_pose();

  const Ogre::Entity& entity_;
  Ogre::HardwareVertexBufferSharedPtr ao_;
  nook::Context context_;
  nook::CharacterModel model_;
  nook::Scene scene_{context_};
  nook::Gl gl_;
  nook_instance_id character_;
  std::vector<std::int32_t> bone_map_;
  std::unique_ptr<nook::Nnao> screen_;
  nook_gl_frame_desc frame_ = nook::gl_frame_desc();
  nook_nnao_frame_desc frame_settings_ = nook::nnao_frame_desc();
  const Ogre::Camera* camera_ = nullptr;
};

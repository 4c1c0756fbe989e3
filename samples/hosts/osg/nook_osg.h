// Nook in an OpenSceneGraph program. It makes the AO of one geometry's vertices, and the AO of the screen.
#pragma once

#include <nook/nook.hpp>
#include <optional>
#include <osg/Camera>
#include <osg/Geometry>
#include <osg/Texture2D>

// A callback of the camera that draws depth, which must come before the other cameras. The callback runs the
// passes after this camera has drawn. All OpenGL calls happen in the draw traversal, on its thread.
class NookOsg : public osg::Camera::DrawCallback {
 public:
  // The AO of the vertices reaches the shaders in this attribute.
  static constexpr unsigned ao_slot = 5;

  // The vertices of the geometry must be in the order of the file. `gl` sets the function loader and the
  // state mode.
  NookOsg(osg::Geometry* geometry, const void* model, std::size_t size, const nook_gl_desc& gl, bool on_gpu);
  // After the camera has drawn depth, writes the AO of the screen to `result`, a texture of the same size.
  void listen(osg::Camera* camera, osg::Texture2D* depth, osg::Texture2D* result, float radius_m);
  // Sets the skinning matrices of the next frame, in the order of the skin in the file.
  void set_pose(const std::vector<osg::Matrixf>& matrices, std::uint32_t skin);
  void operator()(osg::RenderInfo& info) const override;

 private:
  struct Binder;
  struct Update;

  nook::Context context_;
  nook::CharacterModel model_;
  nook::Scene scene_{context_};
  nook_instance_id character_;
  nook_gl_desc gl_desc_;
  osg::ref_ptr<osg::FloatArray> ao_;  // on the CPU only
  osg::ref_ptr<osg::Texture2D> depth_, result_;
  nook_nnao_desc screen_desc_ = nook::nnao_desc();
  mutable nook_gl_frame_desc frame_ = nook::gl_frame_desc();
  nook_nnao_frame_desc frame_settings_ = nook::nnao_frame_desc();
  std::optional<nook::Gl> gl_;
  mutable std::optional<nook::Nnao> screen_;
};

#include "samples/hosts/osg/nook_osg.h"

#include <algorithm>

// Draws a geometry with Nook's buffer as an attribute.
struct NookOsg::Binder : osg::Drawable::DrawCallback {
  const NookOsg& nook;
  explicit Binder(const NookOsg& owner) : nook(owner) {}

  void drawImplementation(osg::RenderInfo& info, const osg::Drawable* drawable) const override {
    const auto* const gl = info.getState()->get<osg::GLExtensions>();
    /* [ao] */
    const nook_gl_view view = nook.gl_->view(nook.scene_, nook.character_);
    info.getState()->unbindVertexBufferObject();  // so that OSG binds its own buffers again
    gl->glBindBuffer(GL_ARRAY_BUFFER, view.buffer);
    gl->glVertexAttribPointer(ao_slot, 1, GL_FLOAT, GL_FALSE, GLsizei(view.stride),
                              reinterpret_cast<const void*>(std::uintptr_t(view.offset)));
    gl->glEnableVertexAttribArray(ao_slot);
    gl->glBindBuffer(GL_ARRAY_BUFFER, 0);
    drawable->drawImplementation(info);
    gl->glDisableVertexAttribArray(ao_slot);
    /* [end] */
  }
};

// Creates what needs an OpenGL context, and evaluates the vertices before anything draws them.
struct NookOsg::Update : osg::Camera::DrawCallback {
  NookOsg& nook;
  explicit Update(NookOsg& owner) : nook(owner) {}

  void operator()(osg::RenderInfo&) const override {
    if (!nook.gl_) {
      nook.gl_.emplace(nook.context_, nook.gl_desc_);
      nook.screen_.emplace(*nook.gl_, nook.screen_desc_);
    }
    if (!nook.ao_) nook.gl_->update(nook.scene_);
  }
};

NookOsg::NookOsg(osg::Geometry* geometry, const void* model, std::size_t size, const nook_gl_desc& gl,
                 bool on_gpu)
    : model_(context_, model, size), character_(scene_.add_instance(model_)), gl_desc_(gl) {
  scene_.set_ground(character_, osg::Vec4f(0, 1, 0, 0).ptr());
  if (on_gpu) {
    geometry->setDrawCallback(new Binder(*this));
    return;
  }
  ao_ = new osg::FloatArray(model_.info().file_vertex_count);
  geometry->setVertexAttribArray(ao_slot, ao_, osg::Array::BIND_PER_VERTEX);
}

void NookOsg::listen(osg::Camera* camera, osg::Texture2D* depth, osg::Texture2D* result, float radius_m) {
  depth_ = depth;
  result_ = result;
  frame_.width = screen_desc_.max_width = depth->getTextureWidth();
  frame_.height = screen_desc_.max_height = depth->getTextureHeight();
  frame_settings_.radius = radius_m;
  frame_.target = NOOK_TARGET_TEXTURE;
  camera->setInitialDrawCallback(new Update(*this));
  camera->setFinalDrawCallback(this);
}

void NookOsg::set_pose(const std::vector<osg::Matrixf>& matrices, std::uint32_t skin) {
  /* [pose] */
  nook_pose_desc desc = nook::pose_desc();
  desc.kind = NOOK_POSE_SKINNING;
  desc.layout = NOOK_TRANSFORM_COLUMNS_4X4;
  desc.transforms = matrices[0].ptr();
  desc.transform_count = std::uint32_t(matrices.size());
  desc.skin = skin;
  scene_.set_pose(character_, desc);
  /* [end] */
  if (!ao_) return;
  scene_.update();
  scene_.read_ao(character_, &ao_->front(), std::uint32_t(ao_->size()));
  ao_->dirty();
}

void NookOsg::operator()(osg::RenderInfo& info) const {
  /* [screen] */
  osg::State& state = *info.getState();
  state.applyTextureAttribute(0, result_);  // makes the texture
  frame_.depth_texture = depth_->getTextureObject(state.getContextID())->id();
  frame_.target_name = result_->getTextureObject(state.getContextID())->id();
  const osg::Matrixf projection(info.getCurrentCamera()->getProjectionMatrix());
  std::copy_n(projection.ptr(), 16, frame_.projection);
  screen_->render(frame_, frame_settings_);
  /* [end] */
}

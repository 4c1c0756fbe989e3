#include "samples/hosts/vtk/nook_vtk.h"

#include <vtk_glew.h>

#include <vtkCamera.h>
#include <vtkMatrix4x4.h>
#include <vtkObjectFactory.h>
#include <vtkOpenGLFramebufferObject.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLState.h>
#include <vtkRenderState.h>
#include <vtkRenderer.h>
#include <vtkShaderProgram.h>
#include <vtkTextureObject.h>

#include <cmath>

vtkStandardNewMacro(vtkNookAoPass);

vtkNookAoPass::vtkNookAoPass()
    : colour_(vtkTextureObject::New()),
      depth_(vtkTextureObject::New()),
      ao_(vtkTextureObject::New()),
      framebuffer_(vtkOpenGLFramebufferObject::New()) {}

vtkNookAoPass::~vtkNookAoPass() {
  framebuffer_->Delete();
  for (vtkTextureObject* texture : {colour_, depth_, ao_}) texture->Delete();
}

// The textures and the pass, which are made again when the size changes.
void vtkNookAoPass::Prepare(vtkRenderer* renderer) {
  auto* const window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  int width, height;
  renderer->GetTiledSizeAndOrigin(&width, &height, &origin_[0], &origin_[1]);
  if (nnao_ && width == size_[0] && height == size_[1]) return;
  size_[0] = width;
  size_[1] = height;
  for (vtkTextureObject* texture : {colour_, depth_, ao_}) texture->SetContext(window);
  framebuffer_->SetContext(window);
  colour_->Allocate2D(unsigned(width), unsigned(height), 4, VTK_UNSIGNED_CHAR);
  ao_->Allocate2D(unsigned(width), unsigned(height), 4, VTK_UNSIGNED_CHAR);
  depth_->AllocateDepth(unsigned(width), unsigned(height), vtkTextureObject::Float32);
  if (!gl_) gl_.emplace(context_, gl_desc_);
  nook_nnao_desc desc = nook::nnao_desc(NOOK_NNAO_PRESET_BEST);
  desc.max_width = width;
  desc.max_height = height;
  nnao_.emplace(*gl_, desc);
}

void vtkNookAoPass::DrawDepth(const vtkRenderState* state) {
  vtkOpenGLState* const gl = framebuffer_->GetContext()->GetState();
  gl->PushFramebufferBindings();
  framebuffer_->Bind();
  framebuffer_->AddColorAttachment(0, colour_);
  framebuffer_->AddDepthAttachment(depth_);
  framebuffer_->ActivateDrawBuffer(0);
  framebuffer_->StartNonOrtho(size_[0], size_[1]);
  gl->vtkglClearColor(0, 0, 0, 0);
  gl->vtkglDepthMask(GL_TRUE);
  gl->vtkglClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  DelegatePass->Render(state);
  gl->PopFramebufferBindings();
}

void vtkNookAoPass::DrawAo(vtkRenderer* renderer) {
  nook_gl_frame_desc frame = nook::gl_frame_desc();
  nook_nnao_frame_desc desc = nook::nnao_frame_desc();
  frame.width = size_[0];
  frame.height = size_[1];
  frame.depth_texture = depth_->GetHandle();
  const vtkMatrix4x4* const projection =
      renderer->GetActiveCamera()->GetProjectionTransformMatrix(renderer->GetTiledAspectRatio(), -1, 1);
  for (int i = 0; i < 16; ++i) frame.projection[i] = float(projection->GetElement(i % 4, i / 4));
  double box[6];
  renderer->ComputeVisiblePropBounds(box);
  desc.radius = float(
      Radius > 0 ? Radius : RadiusShare * std::hypot(box[1] - box[0], box[3] - box[2], box[5] - box[4]));
  frame.target = NOOK_TARGET_TEXTURE;
  frame.target_name = ao_->GetHandle();
  nnao_->render(frame, desc);
}

void vtkNookAoPass::Render(const vtkRenderState* state) {
  vtkRenderer* const renderer = state->GetRenderer();
  Prepare(renderer);
  PreRender(state);  // both draws use this pass's shaders of the props
  vtkOpenGLState* const gl = framebuffer_->GetContext()->GetState();
  gl->Push();
  DrawDepth(state);
  DrawAo(renderer);
  gl->Pop();
  DelegatePass->Render(state);
  PostRender(state);
  NumberOfRenderedProps = DelegatePass->GetNumberOfRenderedProps();
}

bool vtkNookAoPass::PostReplaceShaderValues(std::string&, std::string&, std::string& fragment,
                                            vtkAbstractMapper*, vtkProp*) {
  /* [shader] */
  vtkShaderProgram::Substitute(fragment, "vec4(ambientColor + diffuse",
                               "vec4(nook_ambient() * ambientColor + nook_direct() * diffuse");
  vtkShaderProgram::Substitute(
      fragment, "void main()",
      "uniform sampler2D nook_ao;\nuniform ivec2 nook_origin;\nuniform float nook_share;\n"
      "float nook_ambient() { return texelFetch(nook_ao, ivec2(gl_FragCoord.xy) - nook_origin, 0).r; }\n"
      "float nook_direct() { return mix(1.0, nook_ambient(), nook_share); }\n"
      "void main()");
  /* [end] */
  return true;
}

bool vtkNookAoPass::SetShaderParameters(vtkShaderProgram* program, vtkAbstractMapper*, vtkProp*,
                                        vtkOpenGLVertexArrayObject*) {
  ao_->Activate();
  program->SetUniformi("nook_ao", ao_->GetTextureUnit());
  program->SetUniform2i("nook_origin", origin_);
  program->SetUniformf("nook_share", float(DirectShare));
  return true;
}

void vtkNookAoPass::ReleaseGraphicsResources(vtkWindow* window) {
  nnao_.reset();
  gl_.reset();
  framebuffer_->ReleaseGraphicsResources(window);
  for (vtkTextureObject* texture : {colour_, depth_, ao_}) texture->ReleaseGraphicsResources(window);
  vtkImageProcessingPass::ReleaseGraphicsResources(window);
}

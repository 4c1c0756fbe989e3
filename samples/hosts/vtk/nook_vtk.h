// A render pass of VTK with Nook's screen-space AO. Use it like vtkSSAOPass, around the pass of the opaque
// props:
//
//   vtkNew<vtkRenderStepsPass> steps;
//   vtkNew<vtkNookAoPass> ao;
//   ao->SetDelegatePass(steps->GetOpaquePass());
//   steps->SetOpaquePass(ao);
//   renderer->SetPass(steps);
//
// Only ambient light is darkened, so set the ambient coefficient of properties above 0. Set DirectShare to
// darken direct light too. Translucent props, volumes and overlays are drawn after the pass and are not
// darkened.
#pragma once

#include <vtkImageProcessingPass.h>

#include <nook/nook.hpp>
#include <optional>

class vtkOpenGLFramebufferObject;
class vtkTextureObject;

class vtkNookAoPass : public vtkImageProcessingPass {
 public:
  static vtkNookAoPass* New();
  vtkTypeMacro(vtkNookAoPass, vtkImageProcessingPass);

  // The radius in the unit of the data. 0 (default): RadiusShare (default 0.1) times the diagonal of the
  // visible props.
  vtkSetMacro(Radius, double);
  vtkSetMacro(RadiusShare, double);
  // How strongly the AO darkens the diffuse light of lamps, from 0 (default, not at all) to 1.
  vtkSetMacro(DirectShare, double);
  // Required. `gl` sets the function loader and the state mode.
  void SetGl(const nook_gl_desc& gl) { gl_desc_ = gl; }

  void Render(const vtkRenderState* state) override;
  void ReleaseGraphicsResources(vtkWindow* window) override;
  bool PostReplaceShaderValues(std::string& vertex, std::string& geometry, std::string& fragment,
                               vtkAbstractMapper* mapper, vtkProp* prop) override;
  bool SetShaderParameters(vtkShaderProgram* program, vtkAbstractMapper* mapper, vtkProp* prop,
                           vtkOpenGLVertexArrayObject* array) override;

 protected:
  vtkNookAoPass();
  ~vtkNookAoPass() override;

 private:
  void Prepare(vtkRenderer* renderer);
  void DrawDepth(const vtkRenderState* state);
  void DrawAo(vtkRenderer* renderer);

  double Radius = 0, RadiusShare = 0.1, DirectShare = 0;
  int size_[2] = {}, origin_[2] = {};
  vtkTextureObject *colour_, *depth_, *ao_;
  vtkOpenGLFramebufferObject* framebuffer_;
  nook_gl_desc gl_desc_ = nook::gl_desc();
  nook::Context context_;
  std::optional<nook::Gl> gl_;
  std::optional<nook::Nnao> nnao_;
};

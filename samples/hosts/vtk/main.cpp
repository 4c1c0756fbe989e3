// VTK draws a body, a floor and a translucent ball, with Nook's pass or with VTK's own.
//
//   nook_host_vtk CHARACTER.glb MODEL.nook --out PICTURE.png [--path none|gpu|vtk] [--orthographic]
//
// nook_vtk.cpp is all that a VTK program needs. The model is not read: this host has the AO of the screen
// only.
#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderStepsPass.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSSAOPass.h>
#include <vtkSphereSource.h>
#include <vtkUnsignedCharArray.h>

#include "samples/hosts/host.h"
#include "samples/hosts/vtk/nook_vtk.h"

namespace {

constexpr double kRadiusShare = 0.1;

struct Surface {
  std::vector<glm::vec3> positions, normals;
  std::vector<std::uint32_t> triangles;
  glm::vec3 colour;
};

Surface posed_body(const hosts::Scene& scene) {
  Surface body{scene.file.skinned(scene.pose), {}, scene.file.triangles, glm::vec3(0.75f, 0.72f, 0.68f)};
  for (const viewer::Vertex& vertex : scene.file.vertices) {
    glm::mat4 skin(0);
    for (int k = 0; k < 4; ++k) skin += vertex.weights[k] * scene.pose.matrices[vertex.matrices[k]];
    body.normals.push_back(glm::normalize(glm::mat3(skin) * vertex.normal));
  }
  return body;
}

Surface floor_of(const hosts::Scene& scene) {
  Surface floor{{}, {}, {0, 1, 2, 2, 1, 3}, glm::vec3(0.6f)};
  for (const float z : {0.6f, -0.6f})
    for (const float x : {-0.6f, 0.6f}) {
      floor.positions.push_back(scene.size_m * glm::vec3(x, 0, z));
      floor.normals.emplace_back(0, 1, 0);
    }
  return floor;
}

vtkNew<vtkActor> actor_of(const Surface& surface, const hosts::Options& o) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkFloatArray> normals;
  normals->SetNumberOfComponents(3);
  for (const glm::vec3& p : surface.positions) points->InsertNextPoint(p.x, p.y, p.z);
  for (const glm::vec3& n : surface.normals) normals->InsertNextTuple3(n.x, n.y, n.z);
  vtkNew<vtkCellArray> cells;
  for (std::size_t i = 0; i < surface.triangles.size(); i += 3) {
    const vtkIdType corners[3] = {surface.triangles[i], surface.triangles[i + 1], surface.triangles[i + 2]};
    cells->InsertNextCell(3, corners);
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetPolys(cells);
  data->GetPointData()->SetNormals(normals);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  vtkProperty* const look = actor->GetProperty();
  const bool shows_ao = o.show == "ao";
  const glm::vec3 colour = shows_ao ? glm::vec3(1) : surface.colour;
  look->SetColor(double(colour.r), double(colour.g), double(colour.b));
  look->SetAmbient(shows_ao ? 1 : 0.6);
  look->SetDiffuse(shows_ao ? 0 : 0.4);
  return actor;
}

vtkNew<vtkActor> glass_ball(const hosts::Scene& scene) {
  vtkNew<vtkSphereSource> sphere;
  sphere->SetRadius(0.12 * double(scene.size_m));
  sphere->SetCenter(0.32 * double(scene.size_m), 0.12 * double(scene.size_m), 0.15 * double(scene.size_m));
  sphere->SetThetaResolution(48);
  sphere->SetPhiResolution(32);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(sphere->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(0.2, 0.5, 0.9);
  actor->GetProperty()->SetOpacity(0.4);
  actor->GetProperty()->SetAmbient(0.5);
  return actor;
}

void draw(const hosts::Options& o) {
  const hosts::Scene scene(o);
  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(0.66, 0.70, 0.76);
  renderer->AddActor(actor_of(posed_body(scene), o));
  renderer->AddActor(actor_of(floor_of(scene), o));
  if (o.show != "ao") renderer->AddActor(glass_ball(scene));
  vtkCamera* const camera = renderer->GetActiveCamera();
  camera->SetPosition(double(scene.eye_ws.x), double(scene.eye_ws.y), double(scene.eye_ws.z));
  camera->SetFocalPoint(double(scene.target_ws.x), double(scene.target_ws.y), double(scene.target_ws.z));
  camera->SetViewAngle(double(glm::degrees(scene.vertical_fov_rad)));
  camera->SetParallelScale(0.5 * double(scene.size_m));
  camera->SetParallelProjection(o.orthographic);
  camera->SetClippingRange(double(scene.near_m), double(scene.far_m));

  vtkNew<vtkRenderWindow> window;
  window->SetMultiSamples(0);
  window->SetSize(o.width_px, o.height_px);
  window->AddRenderer(renderer);
  window->Render();
  hosts::start_counting_gl_errors();

  vtkNew<vtkRenderStepsPass> steps;
  vtkNew<vtkNookAoPass> nook;
  vtkNew<vtkSSAOPass> own;
  if (o.path == "vtk") {
    own->SetRadius(kRadiusShare * double(scene.size_m));
    own->SetBias(0.01 * kRadiusShare * double(scene.size_m));
    own->BlurOn();
    own->SetDelegatePass(steps);
    renderer->SetPass(own);
  } else if (o.path != "none") {
    nook_gl_desc gl = nook::gl_desc();
    gl.get_proc = hosts::gl_proc;
    gl.state_mode = o.state_mode();
    nook->SetGl(gl);
    nook->SetRadius(kRadiusShare * double(scene.size_m));
    nook->SetDelegatePass(steps->GetOpaquePass());
    steps->SetOpaquePass(nook);
    renderer->SetPass(steps);
  } else {
    renderer->SetPass(steps);
  }
  for (int frame = 0; frame < 3; ++frame) window->Render();
  vtkNew<vtkUnsignedCharArray> pixels;
  window->GetPixelData(0, 0, o.width_px - 1, o.height_px - 1, 1, pixels);
  const std::size_t row = 3 * std::size_t(o.width_px);
  std::vector<unsigned char> rgb(row * std::size_t(o.height_px));
  for (int y = 0; y < o.height_px; ++y)
    std::copy_n(pixels->GetPointer(vtkIdType(row) * (o.height_px - 1 - y)), row, &rgb[row * std::size_t(y)]);
  hosts::finish("vtk", o, rgb.data());
}

}  // namespace

int main(int argc, char** argv) {
  return hosts::run("nook_host_vtk", argc, argv, draw);
}

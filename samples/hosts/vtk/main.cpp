// VTK draws a body, a floor and a translucent ball, with Nook's pass or with VTK's own.
//
//   nook_host_vtk CHARACTER.glb MODEL.nook --out PICTURE.png [--path none|gpu|vtk|traced] [--orthographic]
//
// With --path traced and --show ao, the picture has ray-traced AO at the vertices. nook_vtk.cpp is all that a
// VTK program needs. The model is not read, because this host only has screen-space AO.
#include <nook/experimental/nook_trace.h>
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

#include <cmath>

#include "samples/hosts/host.h"
#include "samples/hosts/vtk/nook_vtk.h"

namespace {

constexpr double radius_share = 0.1;

struct Surface {
  std::vector<glm::vec3> positions, normals;
  std::vector<std::uint32_t> triangles;
  glm::vec3 colour;
  std::vector<float> ao;  // of the vertices, if it was traced
};

Surface posed_body(const hosts::Scene& scene) {
  Surface body{scene.file.skinned(scene.pose), {}, scene.file.triangles, glm::vec3(0.75f, 0.72f, 0.68f), {}};
  for (const viewer::Vertex& vertex : scene.file.vertices) {
    glm::mat4 skin(0);
    for (int k = 0; k < 4; ++k) skin += vertex.weights[k] * scene.pose.matrices[vertex.matrices[k]];
    body.normals.push_back(glm::normalize(glm::mat3(skin) * vertex.normal));
  }
  return body;
}

// A square of small cells, so that values at its vertices show contacts.
Surface floor_of(const hosts::Scene& scene) {
  constexpr std::uint32_t cells = 160;
  Surface floor;
  floor.colour = glm::vec3(0.6f);
  for (std::uint32_t z = 0; z <= cells; ++z)
    for (std::uint32_t x = 0; x <= cells; ++x) {
      floor.positions.push_back(1.2f * scene.size_m *
                                glm::vec3(float(x) / cells - 0.5f, 0, 0.5f - float(z) / cells));
      floor.normals.emplace_back(0, 1, 0);
      const std::uint32_t a = z * (cells + 1) + x, b = a + cells + 1;
      if (x < cells && z < cells)
        floor.triangles.insert(floor.triangles.end(), {a, a + 1, b, b, a + 1, b + 1});
    }
  return floor;
}

// Computes the reference for the passes, with rays from every vertex up to the same radius.
void trace_ao(std::vector<Surface>& surfaces, float radius_m) {
  std::vector<nook_bake_occluder_mesh> meshes;
  for (const Surface& s : surfaces)
    meshes.push_back({&s.positions[0].x, s.triangles.data(), std::uint32_t(s.positions.size()),
                      std::uint32_t(s.triangles.size())});
  for (Surface& s : surfaces) {
    nook_bake_trace_desc desc;
    if (nook_bake_trace_desc_init(&desc) != NOOK_OK) throw std::runtime_error(nook_bake_last_message());
    desc.meshes = meshes.data();
    desc.mesh_count = std::uint32_t(meshes.size());
    desc.positions = &s.positions[0].x;
    desc.normals = &s.normals[0].x;
    desc.point_count = std::uint32_t(s.positions.size());
    desc.rays = 1024;
    desc.radius = radius_m;
    s.ao.resize(s.positions.size());
    if (nook_bake_trace_ao(&desc, s.ao.data(), desc.point_count) != NOOK_OK)
      throw std::runtime_error(nook_bake_last_message());
  }
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
  if (!surface.ao.empty()) {
    vtkNew<vtkUnsignedCharArray> greys;
    greys->SetNumberOfComponents(3);
    for (const float ao : surface.ao) {
      const double grey = std::round(255.0 * double(ao));
      greys->InsertNextTuple3(grey, grey, grey);
    }
    data->GetPointData()->SetScalars(greys);
  }
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  vtkProperty* const look = actor->GetProperty();
  const bool shows_ao = o.show == "ao";
  const glm::vec3 colour = shows_ao ? glm::vec3(1) : surface.colour;
  look->SetColor(double(colour.r), double(colour.g), double(colour.b));
  look->SetAmbient(shows_ao            ? 1
                   : o.show == "plain" ? 0
                                       : 0.6);  // plain has no ambient light, which is what
                                                // AO darkens
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
  std::vector<Surface> surfaces{posed_body(scene), floor_of(scene)};
  if (o.path == "traced") trace_ao(surfaces, float(radius_share) * scene.size_m);
  for (const Surface& surface : surfaces) renderer->AddActor(actor_of(surface, o));
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
    own->SetRadius(radius_share * double(scene.size_m));
    own->SetBias(0.01 * radius_share * double(scene.size_m));
    own->BlurOn();
    own->SetDelegatePass(steps);
    renderer->SetPass(own);
  } else if (o.path == "gpu") {
    /* [pass] */
    nook_gl_desc gl = nook::gl_desc();
    gl.get_proc = hosts::gl_proc;
    gl.state_mode = o.state_mode();
    nook->SetGl(gl);
    nook->SetRadius(radius_share * double(scene.size_m));
    nook->SetDelegatePass(steps->GetOpaquePass());
    steps->SetOpaquePass(nook);
    renderer->SetPass(steps);
    /* [end] */
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

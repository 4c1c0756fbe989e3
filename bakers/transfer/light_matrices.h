// The raw data of the paper's form: for each vertex the matrix from lobes to the light modes of a material.
#pragma once

#include "bakers/tensor/tensor.h"
#include "bakers/transfer/lobes_of_directions.h"
#include "bakers/transfer/visible_directions.h"
#include "sdk/src/material/tables.h"
#include "sdk/src/transfer/tangent_frame.h"

namespace nook::bake::transfer {

// The scene and the material of all vertices. All references must outlive the matrices.
struct MatrixSource {
  const SurfaceMesh& mesh;
  const RayScene& scene;
  const nook::transfer::CubeCells& cells;
  const LobesOfDirections& lobes;
  const nook::material::MaterialTables& tables;
  const SurfaceHoles* holes = nullptr;
  float origin_offset = 0;
};

// The memory that one thread reuses.
struct MatrixWorkspace {
  std::vector<VisibleDirection> visible;
  std::vector<float> basis;
  tensor::Matrix matrix;  // lobes x 3 light modes
};

// Sets work.matrix to the integrals of visibility, lobe and light basis at a vertex. The caller has set
// FlushDenormals.
void light_matrix(const MatrixSource& source, std::uint32_t lobes, std::size_t vertex, MatrixWorkspace& work);

}  // namespace nook::bake::transfer

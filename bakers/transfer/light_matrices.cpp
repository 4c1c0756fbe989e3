#include "bakers/transfer/light_matrices.h"

#include "bakers/transfer/bake.h"
#include "sdk/src/material/reflectance.h"

namespace nook::bake::transfer {

void light_matrix(const MatrixSource& source, std::uint32_t lobes, std::size_t vertex,
                  MatrixWorkspace& work) {
  const std::size_t modes = std::size_t(3) * source.tables.btf.light_modes;
  const nook::transfer::Frame frame = frame_of(source.mesh, vertex);
  const Vec3 side = frame.bitangent();
  work.basis.resize(modes);
  work.matrix.setZero(Eigen::Index(lobes), Eigen::Index(modes));
  work.visible.clear();
  visible_directions(source.scene,
                     source.mesh.position[vertex] + source.mesh.normal[vertex] * source.origin_offset,
                     source.mesh.normal[vertex], source.cells.direction, source.holes, work.visible);
  const Eigen::Map<const Eigen::RowVectorXf> basis(work.basis.data(), Eigen::Index(modes));
  for (const auto& [i, share] : work.visible) {
    const Vec3 d = source.cells.direction[i];
    light_basis_at(source.tables, {dot(frame.tangent, d), dot(side, d), dot(frame.normal, d)}, work.basis);
    for (std::uint32_t k = source.lobes.begin[i]; k < source.lobes.begin[i + 1]; ++k)
      work.matrix.row(Eigen::Index(source.lobes.lobe[k])) += basis * (share * source.lobes.weight[k]);
  }
}

}  // namespace nook::bake::transfer

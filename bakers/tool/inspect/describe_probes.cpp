#include "bakers/tool/inspect/describe.h"

#include <algorithm>

#include "sdk/src/probe/probe_file.h"

namespace nook::tool {
namespace {

constexpr const char* basis_names[] = {"spherical Gaussians", "spherical harmonics", "ambient dice"};
constexpr const char* domain_names[] = {"sphere", "hemisphere"};
constexpr const char* packing_names[] = {"float", "half", "RGB9E5"};

}  // namespace

Row describe_probes(std::span<const std::byte> bytes) {
  const probe::Probes probes = probe::read_probes(bytes);
  const probe::Basis& basis = probes.basis;
  const probe::Grid& grid = probes.grid;
  Row row;
  row["kind"] = "light probe";
  row["format_version"] = Container(bytes, probe::probe_kind).version();
  row["bytes"] = bytes.size();
  row["probes"] = grid.size();
  if (grid.size() > 1) {
    row["counts"] = grid.counts;
    row["origin_m"] = {grid.origin_ws.x, grid.origin_ws.y, grid.origin_ws.z};
    row["spacing_m"] = {grid.spacing_ws.x, grid.spacing_ws.y, grid.spacing_ws.z};
  }
  row["basis"] = text_of(basis_names, std::size_t(basis.kind));
  row["domain"] = text_of(domain_names, std::size_t(basis.domain));
  row["functions"] = basis.count;
  row["ambient"] = basis.ambient;
  if (basis.kind == probe::BasisKind::gaussians) {
    const auto [low, high] = std::minmax_element(
        basis.sharpness.begin(), basis.sharpness.begin() + basis.count - (basis.ambient ? 1 : 0));
    row["sharpness_lowest"] = *low;
    row["sharpness_highest"] = *high;
  }
  row["packing"] = text_of(packing_names, std::size_t(probe::packing_of(bytes)));
  if (probes.walls.any()) {
    row["cells"] = grid.cells();
    row["wall_cells"] =
        std::ranges::count_if(probes.walls.cell, [](const auto& cell) { return !cell.open(); });
    row["wall_bias_m"] = probes.walls.bias;
  }
  add_recipe(row, probes.recipe);
  return row;
}

}  // namespace nook::tool

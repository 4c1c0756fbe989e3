#include <algorithm>
#include <cstdio>
#include <optional>
#include <string>

#include "bakers/job/bake_identity.h"
#include "bakers/tool/inspect/describe.h"
#include "sdk/src/probe/probe_file.h"
#include "sdk/src/transfer/transfer_file.h"

namespace nook::tool {
namespace {

constexpr const char* basis_names[] = {"spherical Gaussians", "spherical harmonics", "ambient dice"};
constexpr const char* domain_names[] = {"sphere", "hemisphere"};
constexpr const char* packing_names[] = {"float", "half", "RGB9E5"};

// Returns the target error that the bake of a grid was given. Returns null for files of earlier versions.
Row asked_error(std::string_view recipe) {
  const std::optional<bake::BakeIdentity> identity = bake::stored_identity(recipe);
  if (!identity) return Row();
  const Row text = Row::parse(identity->text, nullptr, false);
  const Row settings = text.is_object() ? text.value("settings", Row()) : Row();
  return settings.is_object() ? settings.value("error", Row()) : Row();
}

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
  if (basis.kind == probe::BasisKind::gaussians) row["gloss"] = probes.has_gloss();
  row["packing"] = text_of(packing_names, std::size_t(probe::packing_of(bytes)));
  if (probes.walls.any()) {
    row["cells"] = grid.cells();
    row["wall_cells"] =
        std::ranges::count_if(probes.walls.cell, [](const auto& cell) { return !cell.open(); });
    row["wall_bias_m"] = probes.walls.bias;
  }
  add_recipe(row, probes.recipe);
  if (grid.size() > 1) row["asked_error"] = asked_error(probes.recipe);
  return row;
}

Row describe_transfer(std::span<const std::byte> bytes) {
  const transfer::Transfer transfer = transfer::read_transfer(bytes);
  double sum = 0;
  for (const std::uint8_t share : transfer.shares) sum += share;
  const transfer::PaperTransfer& paper = transfer.paper;
  Row row;
  row["kind"] = "radiance transfer";
  row["format_version"] = Container(bytes, transfer::transfer_kind).version();
  row["bytes"] = bytes.size();
  row["vertices"] = transfer.vertex_count();
  row["lobes"] = transfer.lobes;
  row["sharpness"] = transfer::sharpness_of(transfer.lobes);
  row["form"] = paper.is_used() ? "paper" : "separated";
  if (paper.is_used()) {
    row["light_modes"] = paper.light_modes;
    row["clusters"] = paper.clusters;
    row["lobe_rank"] = paper.lobe_rank;
    row["vertex_rank"] = paper.vertex_rank;
  } else {
    row["share_bytes"] = transfer.shares.size();
    row["mean_share"] = sum / (255.0 * double(transfer.shares.size()));
  }
  row["bounces"] = transfer.bounces;
  row["indirect_bytes"] = sizeof(std::uint16_t) * transfer.indirect.size();
  if (transfer.votf_hash != 0) {
    char hash[17];
    std::snprintf(hash, sizeof hash, "%016llx", static_cast<unsigned long long>(transfer.votf_hash));
    row["votf"] = hash;
  }
  add_recipe(row, transfer.recipe);
  return row;
}

}  // namespace nook::tool

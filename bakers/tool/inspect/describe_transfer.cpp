#include <cstdio>
#include <string>

#include "bakers/tool/inspect/describe.h"
#include "sdk/src/transfer/transfer_file.h"

namespace nook::tool {

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

#include "bakers/tool/inspect/describe.h"

#include "sdk/src/nnao/layers.h"
#include "sdk/src/nnao/network_file.h"

namespace nook::tool {

Row describe_network(std::span<const std::byte> bytes) {
  const nnao::Network network = nnao::read_network(bytes);
  Row row;
  row["kind"] = "screen-space network";
  row["format_version"] = Container(bytes, nnao::network_kind).version();
  row["bytes"] = bytes.size();
  std::size_t parameters = network.paper.filters.size();
  nnao::visit_layers(network, [&](std::span<const float> values) { parameters += values.size(); });
  row["parameters"] = parameters;
  add_recipe(row, network.recipe);
  return row;
}

}  // namespace nook::tool

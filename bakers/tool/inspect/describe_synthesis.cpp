#include "bakers/tool/inspect/describe.h"
#include "sdk/src/synthesis/coordinates.h"

namespace nook::tool {

Row describe_synthesis(std::span<const std::byte> bytes) {
  const synthesis::Coordinates coordinates = synthesis::read_coordinates(bytes);
  Row row;
  row["kind"] = "synthesis";
  row["format_version"] = Container(bytes, synthesis::synthesis_kind).version();
  row["bytes"] = bytes.size();
  row["side"] = coordinates.side;
  row["material_width"] = coordinates.width;
  row["material_height"] = coordinates.height;
  add_recipe(row, coordinates.recipe);
  return row;
}

}  // namespace nook::tool

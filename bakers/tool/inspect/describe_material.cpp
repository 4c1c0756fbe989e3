#include <string>

#include "bakers/job/material_bake.h"
#include "bakers/tool/inspect/describe.h"
#include "sdk/src/material/material_file.h"
#include "sdk/src/material/view_cells.h"
#include "sdk/src/synthesis/coordinates.h"

namespace nook::tool {
namespace {

void describe_tensor(Row& row, const std::string& name, const material::ClusteredTensor& tensor) {
  const material::TensorShape& shape = tensor.shape;
  row[name + "_ranks"] = Row::array({shape.rank_light, shape.rank_view, shape.rank_x, shape.rank_y});
  row[name + "_clusters"] = shape.clusters;
  row[name + "_mixture"] = shape.mixture;
  row[name + "_view_map"] = tensor.map.side;
  row[name + "_terms"] = material::cell_terms(tensor);
}

void describe_neural(Row& row, const material::Neural& neural) {
  const material::NeuralShape& shape = neural.shape;
  row["neural_channels"] = shape.channels;
  row["neural_units"] = shape.units;
  row["neural_layers"] = shape.layers;
  row["neural_offset"] = Row::array({shape.offset_channels, shape.offset_units});
  row["neural_weights"] = neural.weights.size();
}

}  // namespace

Row describe_material(std::span<const std::byte> bytes) {
  const material::Material material = material::read_material(bytes);
  constexpr const char* forms[] = {"none", "binary", "distance"};
  Row row;
  row["kind"] = "material";
  row["format_version"] = Container(bytes, material::material_kind).version();
  row["bytes"] = bytes.size();
  row["bits"] = material.bits;
  row["compressed_bytes"] = material::compressed_bytes(material);
  row["lights"] = material.lights.size();
  row["views"] = material.views.size();
  const bool is_neural = material.neural.is_used();
  row["width"] = is_neural ? material.neural.shape.width : material.btf.shape.width;
  row["height"] = is_neural ? material.neural.shape.height : material.btf.shape.height;
  is_neural ? describe_neural(row, material.neural) : describe_tensor(row, "btf", material.btf);
  row["visibility"] = text_of(forms, std::size_t(material.visibility));
  if (material.visibility != material::VisibilityForm::none) {
    row["visibility_mapping"] = Row::array({material.mapping.threshold, material.mapping.weight});
    describe_tensor(row, "votf", material.votf);
  }
  if (material.relief.moves()) {
    row["relief_heights"] = Row::array({material.relief.low, material.relief.high});
    row["relief_steps"] = material.relief.steps;
  }
  add_recipe(row, material.recipe);
  return row;
}

Row describe_raw_material(std::span<const std::byte> bytes) {
  const bake::material::RawMaterial raw = bake::material::read_raw_material(bytes);
  return {{"kind", "raw material"},      {"name", raw.name},          {"bytes", bytes.size()},
          {"lights", raw.lights.size()}, {"views", raw.views.size()}, {"width", raw.width},
          {"height", raw.height},        {"votf", !raw.mask.empty()}};
}

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

// nook inspect: what is inside a .nook file.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "character/model_file.h"
#include "cli/commands.h"
#include "cli/common_options.h"
#include "cli/input_file.h"
#include "cli/output_file.h"
#include "cli/table.h"
#include "material/material_file.h"
#include "material/raw_file.h"
#include "nnao/layers.h"
#include "nnao/network_file.h"

namespace nook::cli {
namespace {

using Json = nlohmann::ordered_json;

struct Options {
  CommonOptions common;
  std::string input;
};

constexpr const char* kernel_names[] = {"paper", "nook", "rational"};

Json describe_character(std::span<const std::byte> bytes) {
  const CharacterModel model = read_character_model(bytes);
  const Container container(bytes, character_kind);
  Json row;
  row["kind"] = "character model";
  row["format_version"] = container.version();
  row["bytes"] = bytes.size();
  row["vertices"] = model.vertex_count();
  row["file_vertices"] = model.file_to_welded.size();
  row["primitives"] = model.primitives.size();
  row["bones"] = model.bone_count();
  row["spheres"] = model.spheres.size();
  row["key_points"] = model.key_points.size();
  row["influences"] = model.influences;
  row["kernel"] = kernel_names[std::size_t(model.kernel.form)];
  row["gamma"] = model.kernel.gamma;
  row["bounding_radius_m"] = model.bounding_radius;
  for (const char* name : {"HEAD", "BONE", "SPHR", "KEYP", "LINR", "STAO", "FMAP", "PRIM", "RECP"}) {
    const char letters[5] = {name[0], name[1], name[2], name[3], 0};
    row[std::string("bytes_") + name] = container.has(letters) ? container.section(letters).remaining() : 0;
  }
  const Json recipe = Json::parse(model.recipe, nullptr, false);
  if (recipe.is_object())
    for (const auto& item : recipe.items()) row["recipe_" + item.key()] = item.value();
  return row;
}

Json describe_network(std::span<const std::byte> bytes) {
  const nook::nnao::Network network = nook::nnao::read_network(bytes);
  Json row;
  row["kind"] = "screen-space network";
  row["format_version"] = Container(bytes, nook::nnao::network_kind).version();
  row["bytes"] = bytes.size();
  std::size_t parameters = network.paper.filters.size();
  nook::nnao::visit_layers(network, [&](std::span<const float> values) { parameters += values.size(); });
  row["parameters"] = parameters;
  const Json recipe = Json::parse(network.recipe, nullptr, false);
  if (recipe.is_object())
    for (const auto& item : recipe.items()) row["recipe_" + item.key()] = item.value();
  return row;
}

void describe_tensor(Json& row, const std::string& name, const nook::material::ClusteredTensor& t) {
  const nook::material::TensorShape& s = t.shape;
  row[name + "_ranks"] = Json::array({s.rank_light, s.rank_view, s.rank_x, s.rank_y});
  row[name + "_clusters"] = s.clusters;
  row[name + "_mixture"] = s.mixture;
  row[name + "_view_map"] = t.map.side;
}

Json describe_material(std::span<const std::byte> bytes) {
  const nook::material::Material material = nook::material::read_material(bytes);
  constexpr const char* forms[] = {"none", "binary", "distance"};
  Json row;
  row["kind"] = "material";
  row["format_version"] = Container(bytes, nook::material::material_kind).version();
  row["bytes"] = bytes.size();
  row["compressed_bytes"] = nook::material::compressed_bytes(material);
  row["lights"] = material.lights.size();
  row["views"] = material.views.size();
  row["width"] = material.btf.shape.width;
  row["height"] = material.btf.shape.height;
  describe_tensor(row, "btf", material.btf);
  row["visibility"] = forms[std::size_t(material.visibility)];
  if (material.visibility != nook::material::VisibilityForm::none) describe_tensor(row, "votf", material.votf);
  const Json recipe = Json::parse(material.recipe, nullptr, false);
  if (recipe.is_object())
    for (const auto& part : recipe.items())
      for (const auto& item : part.value().items()) row[part.key() + "_" + item.key()] = item.value();
  return row;
}

Json describe_raw_material(std::span<const std::byte> bytes) {
  const bake::material::RawMaterial raw = bake::material::read_raw_material(bytes);
  return {{"kind", "raw material"},      {"name", raw.name},     {"bytes", bytes.size()}, {"lights", raw.lights.size()},
          {"views", raw.views.size()},   {"width", raw.width},   {"height", raw.height},  {"votf", !raw.mask.empty()}};
}

void run(const Options& options) {
  const std::vector<std::byte> bytes = read_file(options.input);
  std::optional<OutputFile> report;
  if (!options.common.report.empty()) report.emplace(options.common.report);
  const Json row = naming_file(options.input, [&] {
    if (bytes.size() >= 16 && container_kind(bytes) == nook::nnao::network_kind.kind) return describe_network(bytes);
    if (bytes.size() >= 16 && container_kind(bytes) == nook::material::material_kind.kind) return describe_material(bytes);
    if (bytes.size() >= 16 && container_kind(bytes) == bake::material::raw_kind.kind) return describe_raw_material(bytes);
    if (bytes.size() >= 16 && container_kind(bytes) != character_kind.kind && container_kind(bytes) != 0)
      throw Failure(NOOK_ERROR_BAD_FILE,
                    "a .nook file of a kind that this version cannot inspect; use a newer one");
    return describe_character(bytes);
  });
  if (report)
    report->commit(Json{{"rows", Json::array({row})}}.dump(2, ' ', false, Json::error_handler_t::replace) +
                   "\n");
  if (!options.common.quiet) std::fputs(table_text(Json::array({row})).c_str(), stdout);
}

}  // namespace

void add_inspect(CLI::App& tool) {
  CLI::App* command = tool.add_subcommand("inspect", "show what a .nook file holds");
  const auto options = std::make_shared<Options>();
  command->add_option("file", options->input, "a .nook file")->required();
  add_common_options(*command, options->common);
  command->callback([options] { run(*options); });
}

}  // namespace nook::cli

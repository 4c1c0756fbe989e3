// nook inspect: what is inside a .nook file.
#include <CLI/CLI.hpp>
#include <algorithm>
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
#include "nnao/layers.h"
#include "nnao/network_file.h"
#include "probe/probe_file.h"

namespace nook::cli {
namespace {

using Json = nlohmann::ordered_json;

struct Options {
  CommonOptions common;
  std::string input;
};

constexpr const char* kernel_names[] = {"paper", "nook", "rational"};

void add_recipe(Json& row, std::string_view text) {
  const Json recipe = Json::parse(text, nullptr, false);
  if (recipe.is_object())
    for (const auto& item : recipe.items()) row["recipe_" + item.key()] = item.value();
}

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
  add_recipe(row, model.recipe);
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
  add_recipe(row, network.recipe);
  return row;
}

constexpr const char* basis_names[] = {"spherical Gaussians", "spherical harmonics", "ambient dice"};
constexpr const char* domain_names[] = {"sphere", "hemisphere"};
constexpr const char* packing_names[] = {"float", "half", "RGB9E5"};

Json describe_probes(std::span<const std::byte> bytes) {
  using namespace nook::probe;
  const Probes probes = read_probes(bytes);
  const Basis& basis = probes.basis;
  const Grid& grid = probes.grid;
  Json row;
  row["kind"] = "light probe";
  row["format_version"] = Container(bytes, probe_kind).version();
  row["bytes"] = bytes.size();
  row["probes"] = grid.size();
  row["counts"] = grid.counts;
  row["origin_m"] = {grid.origin_ws.x, grid.origin_ws.y, grid.origin_ws.z};
  row["spacing_m"] = {grid.spacing_ws.x, grid.spacing_ws.y, grid.spacing_ws.z};
  row["basis"] = basis_names[std::size_t(basis.kind)];
  row["domain"] = domain_names[std::size_t(basis.domain)];
  row["functions"] = basis.count;
  row["ambient"] = basis.ambient;
  if (basis.kind == BasisKind::gaussians) {
    const auto [low, high] = std::minmax_element(
        basis.sharpness.begin(), basis.sharpness.begin() + basis.count - (basis.ambient ? 1 : 0));
    row["sharpness_lowest"] = *low;
    row["sharpness_highest"] = *high;
  }
  row["packing"] = packing_names[std::size_t(packing_of(bytes))];
  float least = 0, most = 0;
  for (const Vec3 c : probes.coefficients) {
    least = std::min({least, c.x, c.y, c.z});
    most = std::max({most, c.x, c.y, c.z});
  }
  row["coefficient_lowest"] = least;
  row["coefficient_highest"] = most;
  add_recipe(row, probes.recipe);
  return row;
}

void run(const Options& options) {
  const std::vector<std::byte> bytes = read_file(options.input);
  std::optional<OutputFile> report;
  if (!options.common.report.empty()) report.emplace(options.common.report);
  const Json row = naming_file(options.input, [&] {
    if (bytes.size() >= 16 && container_kind(bytes) == nook::nnao::network_kind.kind)
      return describe_network(bytes);
    if (bytes.size() >= 16 && container_kind(bytes) == nook::probe::probe_kind.kind)
      return describe_probes(bytes);
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

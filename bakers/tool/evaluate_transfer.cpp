// `nook evaluate transfer` compares baked radiance transfer with direct sums and with path tracing. It also
// measures simpler forms.
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "bakers/measure/transfer/transfer_pictures.h"
#include "bakers/measure/transfer/vector_error.h"
#include "bakers/tool/command_end.h"
#include "bakers/tool/command_files.h"
#include "bakers/tool/command_inputs.h"
#include "bakers/tool/command_line.h"
#include "bakers/tool/commands.h"
#include "bakers/tool/evaluation.h"
#include "bakers/tool/stored_meshes.h"
#include "platform/progress_bar.h"
#include "platform/stopwatch.h"
#include "sdk/src/material/material_check.h"
#include "sdk/src/material/material_file.h"
#include "sdk/src/transfer/transfer_check.h"
#include "sdk/src/transfer/transfer_file.h"

namespace nook::tool {
namespace {

using Json = nlohmann::ordered_json;

struct Options {
  CommonOptions common;
  std::filesystem::path mesh, transfer, material, raw, images;
  std::vector<std::filesystem::path> lights;
  bake::ImportOptions reading;
  measure::PictureSettings picture;
  float tiles = 1;
  std::optional<std::uint32_t> truth_bounces;
  bool without_suns = false, no_pictures = false, truth_holes = false;
};

void check_mesh(const Options& o, const bake::SurfaceMesh& mesh, const transfer::Transfer& baked) {
  if (!measure::is_baked_mesh(mesh, baked))
    throw ToolError(
        exit_bad_input,
        o.transfer.string() + ": was baked from another mesh than " + o.mesh.string() +
            "; bake the transfer again, or choose the same meshes as its bake (--mesh, --without)");
}

// The light transport that the reference includes. It is the same as in the file, for the shape with its
// material.
struct TruthOf {
  TruthOf(const Options& o, const transfer::Transfer& baked, const material::MaterialTables& tables) {
    settings.bounces = o.truth_bounces.value_or(baked.bounces);
    settings.tiles = o.tiles;
    name = o.raw.empty() ? "decoded material, " : "raw material, ";
    name += settings.bounces == 0 ? "direct light" : std::to_string(settings.bounces) + " bounces";
    if (baked.votf_hash == 0 && !o.truth_holes) return;
    name += ", holes of the VOTF";
    if (baked.votf_hash != 0 && baked.votf_hash != tables.votf_hash && !o.common.quiet)
      std::fprintf(stderr,
                   "nook: %s was baked with the holes of another material than %s; the errors below include "
                   "this difference\n",
                   o.transfer.c_str(), o.material.c_str());
    if (tables.visibility == material::VisibilityForm::none) return;
    holes = bake::transfer::make_hole_table(tables);
    settings.holes = &*holes;
  }

  std::optional<bake::transfer::HoleTable> holes;
  measure::TruthSettings settings;
  std::string name;
};

std::optional<measure::RawReflectance> read_raw(const Options& o) {
  if (o.raw.empty() || o.no_pictures) return std::nullopt;
  return naming_file(o.raw, [&] { return measure::read_raw_reflectance(read_file(o.raw)); });
}

Json evaluate(const Options& o) {
  platform::ProgressBar bar(o.common.quiet);
  const std::vector<std::byte> bytes = read_file(o.transfer), material_bytes = read_file(o.material);
  const transfer::Transfer baked = naming_file(o.transfer, [&] { return transfer::read_transfer(bytes); });
  const bake::ImportOptions reading =
      with_stored_meshes(o.reading, o.transfer, std::string_view(baked.recipe), o.common);
  const bake::SurfaceMesh mesh =
      naming_file(o.mesh, [&] { return bake::import_surface(o.mesh, reading); }).mesh;
  check_mesh(o, mesh, baked);
  const material::MaterialTables tables = naming_file(o.material, [&] {
    return material::make_tables(material::read_material(material_bytes), {}, default_memory());
  });
  material::refuse_neural(tables.neural.is_used(), "radiance transfer");
  naming_file(o.transfer,
              [&] { transfer::check_same_light(baked, tables.btf.light_modes, tables.light_hash); });
  const bool is_paper = baked.paper.is_used();
  const TruthOf truth(o, baked, tables);
  platform::Stopwatch watch;
  const transfer::LobeFit fit(baked.lobes);
  const double factor_ms = watch.seconds() * 1e3;
  std::vector<measure::MeasuredLight> lights;
  for (const std::filesystem::path& path : o.lights) {
    lights.push_back(measure::measured_light(path.stem().string(), read_map(path), fit, o.without_suns));
  }
  const auto progress = [&](const char* label, const char* unit) {
    return [&bar, label, unit](std::size_t done, std::size_t total) {
      bar.show(label, unit, done, total);
      return !interrupted();
    };
  };
  const measure::VectorMeasure vectors = measure::measure_vectors(mesh, baked, tables, lights, truth.settings,
                                                                  progress("summing light", "vertices"));
  const std::optional<measure::RawReflectance> raw = read_raw(o);
  measure::PictureSettings picture = o.picture;
  picture.truth = truth.settings;
  picture.seed = o.common.seed;
  Json rows = Json::array();
  for (std::size_t l = 0; l < lights.size(); ++l) {
    measure::PictureError error;
    if (!o.no_pictures) {
      const measure::PictureSource source{mesh, tables, vectors, l, lights[l].map, raw ? &*raw : nullptr};
      error = measure::measure_pictures(source, picture, progress("path tracing", "rows"));
      if (!o.images.empty()) bake::write_png(o.images / (as_file_name(lights[l].name) + ".png"), error.sheet);
    }
    for (std::size_t form = 0; form < 3; ++form) {
      Json row;
      row["shape"] = o.mesh.stem().string();
      row["light"] = lights[l].name;
      row["form"] = form == 0 && is_paper ? measure::paper_form_name : measure::transfer_form_names[form];
      row["lobes"] = baked.lobes;
      row["bounces"] = form == 0 ? baked.bounces : 0;
      row["bytes"] = form == 0 ? bytes.size() : form == 1 ? baked.vertex_count() : 0;
      row["file_bytes"] = form == 0 ? Json(bytes.size()) : Json();
      row["indirect_bytes"] = form == 0 ? Json(sizeof(std::uint16_t) * baked.indirect.size()) : Json();
      row["se_db"] = vectors.lights[l].se_db[form];
      row["se_exact_db"] = form == 0 && !is_paper ? Json(vectors.lights[l].se_exact_db) : Json();
      if (!o.no_pictures) {
        row["mse"] = error.mse[form];
        row["noise_floor_mse"] = error.noise_floor_mse;
        row["truth"] = truth.name;
        row["truth_bounces"] = truth.settings.bounces;
      }
      row["light_error"] = lights[l].quality.relative_error;
      row["negative_share"] = lights[l].quality.negative_share;
      row["ms_fit"] = lights[l].fit_ms;
      row["ms_vectors"] = form == 0 ? Json(vectors.lights[l].vectors_ms) : Json();
      rows.push_back(row);
    }
  }
  return {{"rows", rows}, {"ms_factor", factor_ms}, {"without_suns", o.without_suns}};
}

}  // namespace

void add_evaluate_transfer(Command evaluate_command) {
  const Command command = evaluate_command.add_subcommand(
      "transfer",
      "measure baked radiance transfer, against direct sums over the light and against path tracing");
  const auto options = std::make_shared<Options>();
  Options& o = *options;
  command.add_input("mesh", o.mesh, "the shape that the transfer was baked from, a .glb or .gltf file")
      .required();
  command
      .add_input("transfer", o.transfer, "the baked transfer, a .nook file that `nook bake transfer` wrote")
      .required();
  command.add_input("--material", o.material, "the .nook file of the material on the shape").required();
  command.add_input("--raw", o.raw,
                    "path trace the reference pictures with this uncompressed material, a file that `nook "
                    "bake material --keep-raw` wrote. Default: with the decoded --material");
  command
      .add_input("--light", o.lights,
                 "measure under the light of these latitude-longitude maps, .hdr or .exr files")
      .required();
  command.add_flag("--without-suns", o.without_suns,
                   "remove the suns from the maps first. Use it if your engine draws suns with shadow maps");
  command.add_option("--images", o.images,
                     "write a PNG file for each light into this folder. It shows the path-traced reference "
                     "and each form of the transfer side by side");
  command.add_flag("--no-pictures", o.no_pictures,
                   "do not draw or measure pictures; measure only the transfer vectors");
  command.add_option("--width", o.picture.width, "width of a picture in pixels")
      .check(in_range(16, 4096))
      .capture_default_str();
  command.add_option("--height", o.picture.height, "height of a picture in pixels")
      .check(in_range(16, 4096))
      .capture_default_str();
  command.add_option("--paths", o.picture.paths, "number of paths per pixel of the path-traced picture")
      .check(in_range(2u, 1u << 20))
      .capture_default_str();
  command
      .add_option("--truth-bounces", o.truth_bounces,
                  "number of bounces of light in the path-traced picture. Default: as in the baked transfer")
      .check(in_range(0u, 8u));
  command.add_flag("--truth-holes", o.truth_holes,
                   "in the path-traced picture, let light fall through the holes of the material, even if "
                   "the transfer was baked without holes");
  command.add_option("--tiles", o.tiles, "number of tiles of the material per unit of texture coordinates")
      .check(in_range(0.01f, 1000.0f))
      .capture_default_str();
  add_import_options(command, o.reading);
  add_common_options(command, o.common);
  command.callback([options] {
    CommandFiles files{
        {{"the mesh", options->mesh}, {"the transfer", options->transfer}, {"--material", options->material}},
        {},
        options->images};
    if (!options->raw.empty()) files.inputs.push_back({"--raw", options->raw});
    for (const std::filesystem::path& light : options->lights) files.inputs.push_back({"--light", light});
    run_evaluation(options->common, files, [&] { return evaluate(*options); });
  });
}

}  // namespace nook::tool

// `nook bake material` ray traces a meso-structure or the maps of a physically based material, or reads a
// measured BTF. Then it compresses the result.
#include <algorithm>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "bakers/images/pbr_reader.h"
#include "bakers/images/ubo_reader.h"
#include "bakers/job/material_bake.h"
#include "bakers/job/material_identity.h"
#include "bakers/measure/material/material_pictures.h"
#include "bakers/tool/baking.h"
#include "bakers/tool/command_end.h"
#include "bakers/tool/command_files.h"
#include "bakers/tool/command_inputs.h"
#include "bakers/tool/command_line.h"
#include "bakers/tool/commands.h"
#include "bakers/tool/compression_options.h"
#include "bakers/tool/table.h"
#include "platform/output_file.h"
#include "platform/progress_bar.h"
#include "platform/stopwatch.h"
#include "sdk/src/material/material_file.h"

namespace nook::tool {
namespace {

using namespace bake::material;
using nook::material::VisibilityForm;
using Json = nlohmann::ordered_json;
struct Options {
  CommonOptions common;
  CompressionOptions compression;
  std::string meso, visibility_mapping;
  BakeOptions baking;
  std::filesystem::path pbr, btf, raw, keep_raw, images;
  std::filesystem::path relief;              // path of a height image; empty: none
  FloatColours colours = FloatColours::rgb;  // how to read the colours of floating-point images of --btf
  std::uint32_t directions = 100, lights = 0, texels = 0;
  float max_tilt_deg = bake::material::default_max_tilt_deg;
  TraceSettings trace;
  float tile_side_m = 1;  // side of the tile in metres: of a mesh of --meso, of the maps of --pbr, and of the
                          // image of --relief
  float height_scale_m = 0.05f;
  bake::ImportOptions reading;
  std::optional<std::uint32_t> count;
  std::optional<float> radius, thickness, roughness;
  float detail = 1;
  bool strict = false;  // do not write a material with a bad verdict
};

MesoParameters meso_of(const Options& o) {
  MesoParameters p = meso_parameters(o.meso);
  if (o.count) p.count = *o.count;
  if (o.radius) p.radius = *o.radius;
  if (o.thickness) p.thickness = *o.thickness;
  if (o.roughness) p.roughness = *o.roughness;
  p.detail = o.detail;
  p.seed = o.common.seed;
  return p;
}

// Returns true if the value of --meso is the path of a mesh, which means that it is not the name of a
// built-in structure.
bool is_mesh(const std::string& meso) {
  return !meso.empty() && std::ranges::count(meso_names(), std::string_view(meso)) == 0;
}

bool is_traced(const Options& o) {
  return !o.meso.empty() || !o.pbr.empty();
}

// Returns the number of grid points along each side of the maps. There is one grid point for each view ray,
// because detail between rays is not seen.
std::uint32_t map_points(const Options& o) {
  constexpr std::uint32_t fewest = 4, most = 384;
  return std::clamp(o.trace.width * o.trace.samples, fewest, most);
}

bake::MesoSource source_of_maps(const Options& o) {
  const PbrFolder folder = naming_file(o.pbr, [&] { return read_pbr_folder(o.pbr, map_points(o)); });
  if (!o.common.quiet)
    for (const std::string& name : folder.file_names) std::fprintf(stderr, "nook: read %s\n", name.c_str());
  return {{},
          surface_of_maps(folder.maps, o.height_scale_m, o.tile_side_m),
          o.directions,
          o.lights,
          o.max_tilt_deg,
          o.trace};
}

bake::MesoSource source_of(const Options& o) {
  if (!o.pbr.empty()) return source_of_maps(o);
  if (!is_mesh(o.meso)) return {meso_of(o), {}, o.directions, o.lights, o.max_tilt_deg, o.trace};
  MesoSurface tile = naming_file(o.meso, [&] {
    bake::StaticScene scene = bake::import_static_scene(o.meso, bake::SceneTextures::skip, o.reading);
    print_warnings(o.meso, scene.warnings, o.common);
    return tile_of_scene(std::move(scene), o.tile_side_m);
  });
  return {{}, std::move(tile), o.directions, o.lights, o.max_tilt_deg, o.trace};
}

std::string folder_name(const std::filesystem::path& folder) {
  return (folder.filename().empty() ? folder.parent_path() : folder).filename().string();
}

Json recipe_of_trace(const Options& o) {
  if (!o.btf.empty())
    return {{"btf", o.btf.filename().string()},
            {"texels", o.texels},
            {"colours", o.colours == FloatColours::xyz ? "xyz" : "rgb"}};
  if (!o.raw.empty()) return {{"raw", o.raw.filename().string()}};
  Json recipe;
  if (!o.pbr.empty()) {
    recipe = {{"pbr", folder_name(o.pbr)}, {"height_scale", o.height_scale_m}, {"tile_side", o.tile_side_m}};
  } else if (is_mesh(o.meso)) {
    recipe = {{"tile", std::filesystem::path(o.meso).filename().string()}, {"tile_side", o.tile_side_m}};
  } else {
    const MesoParameters p = meso_of(o);
    recipe = {{"meso", p.name},           {"count", p.count},         {"radius", p.radius},
              {"thickness", p.thickness}, {"roughness", p.roughness}, {"detail", p.detail}};
  }
  recipe.update({{"directions", o.directions},
                 {"lights", o.lights ? o.lights : o.directions},
                 {"max_tilt_deg", o.max_tilt_deg},
                 {"texels", o.trace.width},
                 {"samples", o.trace.samples},
                 {"bounces", o.trace.bounces},
                 {"bounce_rays", o.trace.bounce_rays},
                 {"seed", o.common.seed}});
  return recipe;
}

RawMaterial read_measured(const Options& o, const bake::Progress& progress) {
  constexpr std::size_t most_bytes = std::size_t{6} << 30;
  if (std::filesystem::is_directory(o.btf) || !std::filesystem::exists(o.btf))
    return read_ubo_folder(o.btf, o.texels, progress, most_bytes, o.colours);
  RawMaterial raw = read_btf_file(read_any_file(o.btf), o.texels, most_bytes);
  raw.name = o.btf.stem().string();
  return raw;
}

bake::Progress shown_on(platform::ProgressBar& bar, const char* label, const char* unit) {
  return [&bar, label, unit](std::size_t done, std::size_t total) {
    bar.show(label, unit, done, total);
    return !interrupted();
  };
}

// The input of the compression: a raw material, or a structure that must be traced first. Also contains the
// heights of --relief.
struct Source {
  RawMaterial raw;
  std::optional<bake::MesoSource> traced;
  PbrMaps relief;
};

RawMaterial read_raw(const Options& o) {
  if (!o.raw.empty()) return naming_file(o.raw, [&] { return read_raw_material(read_file(o.raw)); });
  platform::ProgressBar bar(o.common.quiet);
  return naming_file(o.btf, [&] { return read_measured(o, shown_on(bar, "reading", "images")); });
}

RawMaterial obtain(const Options& o, const Source& source, platform::ProgressBar& bar) {
  if (!source.traced) return source.raw;
  RawMaterial raw = bake::trace_meso_source(*source.traced, shown_on(bar, "ray tracing", "views"));
  raw.name = !o.pbr.empty()    ? folder_name(o.pbr)
             : is_mesh(o.meso) ? std::filesystem::path(o.meso).stem().string()
                               : o.meso;
  // A height field has no gaps.
  if (!o.pbr.empty()) raw.mask.clear();
  return raw;
}

// Reads the image of --relief. If the material will be traced, resamples the image to the texels of the
// material. If the material comes from a file, the image keeps its own resolution. Throws if heights are out
// of range.
PbrMaps read_relief(const Options& o) {
  return naming_file(o.relief, [&] {
    PbrMaps image = read_height_image(o.relief);
    if (is_traced(o)) image = heights_at(image, o.trace.width);
    heights_of_map(image, o.height_scale_m, o.tile_side_m);
    return image;
  });
}

void set_heights(const Options& o, const PbrMaps& image, RawMaterial& raw) {
  if (raw.width != raw.height)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "--relief with an image needs a material with as many columns as rows (got %u x %u)",
                  raw.width, raw.height);
  const PbrMaps maps = image.side == raw.width ? image : heights_at(image, raw.width);
  const std::vector<float> z =
      naming_file(o.relief, [&] { return heights_of_map(maps, o.height_scale_m, o.tile_side_m); });
  raw.heights.resize(z.size());
  for (std::size_t x = 0; x < raw.width; ++x)
    for (std::size_t y = 0; y < raw.height; ++y) raw.heights[x * raw.height + y] = z[y * raw.width + x];
}

// Warns if a K-CTA material gets no view map, because decoding it is then more expensive than its settings
// suggest.
void note_missing_map(const Options& o, const CompressionSettings& settings) {
  if (!o.common.quiet && settings.method == Method::k_cta && settings.map_side == 0)
    std::fprintf(stderr,
                 "nook: without a view map, decoding mixes up to %u clusters per pixel instead of %u\n",
                 std::min(settings.cluster_count(), 3 * settings.mixture), settings.mixture);
}

void write_pictures(const Options& o, const RawMaterial& raw, std::span<const std::byte> file) {
  if (o.images.empty()) return;
  bake::write_png(o.images / (as_file_name(raw.name) + "_raw.png"), measure::raw_sheet(raw));
  bake::write_png(o.images / (as_file_name(raw.name) + "_difference.png"),
                  measure::difference_sheet(raw, nook::material::read_material(file)));
}

bake::BakeIdentity identity_of(const Options& o, const Source& source) {
  nlohmann::json settings = {{"compression", bake::settings_of(o.compression.settings)},
                             {"ranks", o.compression.ranks},
                             {"votf_ranks", o.compression.votf_ranks},
                             {"threshold", o.compression.threshold}};
  nlohmann::json inputs = nlohmann::json::object();
  if (source.traced) {
    settings["source"] = bake::settings_of(*source.traced);
    inputs = bake::inputs_of(*source.traced);
  } else {
    inputs["raw"] = bake::content_hash(source.raw);
  }
  if (!o.relief.empty()) {
    inputs["relief"] = bake::content_hash(source.relief);
    settings["height_scale"] = o.height_scale_m;
    settings["tile_side"] = o.tile_side_m;
  }
  // A cached result of a bake without --strict may have a bad verdict, so --strict must be part of the
  // identity.
  if (o.strict) settings["strict"] = true;
  return bake::identify_bake(bake::BakeKind::material, settings, inputs);
}

// Removes the sentences from a row. They do not fit into the table and are printed above it.
Json without_words(Json row) {
  row.erase("verdict_words");
  return row;
}

// Prints the verdict on the material. With --strict, throws if the verdict is bad. This happens before an
// existing file is replaced.
void tell_verdict(const Options& o, const Verdict& verdict) {
  if (o.strict && verdict.grade == Grade::bad)
    throw ToolError(exit_bad_result,
                    "bake material: " + verdict.words + "; --strict does not write such a material");
  if (!o.common.quiet) std::fprintf(stderr, "nook: %s\n", verdict.words.c_str());
}

BakeOutput bake(const Options& o, const Source& source, const bake::BakeIdentity& identity) {
  std::optional<platform::OutputFile> raw_file;
  if (!o.keep_raw.empty()) raw_file.emplace(o.keep_raw, file_events(o.common.quiet));
  platform::ProgressBar bar(o.common.quiet);
  const platform::Stopwatch watch;
  RawMaterial raw = obtain(o, source, bar);
  const double seconds_obtain = watch.seconds();
  if (raw_file) raw_file->commit(write_raw_material(raw));
  Json relief_source;
  if (!o.relief.empty()) {
    set_heights(o, source.relief, raw);
    relief_source = {{"heights", o.relief.filename().string()},
                     {"height_scale", o.height_scale_m},
                     {"tile_side", o.tile_side_m}};
  }
  check_compression(o.compression, raw, !raw.mask.empty());
  CompressionSettings settings;
  const auto choose = [&](const RawMaterial& fitted) {
    settings = compression_settings(o.compression, fitted);
    settings.seed = o.common.seed;
    return settings;
  };
  bake::CompressedMaterial compressed =
      bake::compress_to_file(raw, o.compression.settings.relief, choose, recipe_of_trace(o), relief_source,
                             stage_progress(bar, "compressing the "), identity);
  note_missing_map(o, settings);
  tell_verdict(o, compressed.verdict);
  write_pictures(o, raw, compressed.file);
  Json json = compressed.row;
  json["lights"] = raw.lights.size();
  json["views"] = raw.views.size();
  json["width"] = raw.width;
  json["height"] = raw.height;
  json["raw_bytes"] = sizeof(float) * raw.btf.size();
  json["seconds_source"] = seconds_obtain;
  const Json report{{"rows", Json::array({json})}, {"recipe", compressed.recipe}};
  return {std::move(compressed.file), report.dump(2, ' ', false, Json::error_handler_t::replace) + "\n",
          table_text(Json::array({without_words(std::move(json))}))};
}

PreparedBake prepare(const Options& o) {
  Source source;
  if (!o.relief.empty()) source.relief = read_relief(o);
  if (is_traced(o))
    source.traced = source_of(o);
  else
    source.raw = read_raw(o);
  const bake::BakeIdentity identity = identity_of(o, source);
  return {identity, [&o, source = std::move(source), identity] { return bake(o, source, identity); }};
}

// Returns the sizes of a material that will be ray traced. For a material that will be read from a file, the
// result has no views.
RawMaterial expected_sizes(const Options& o) {
  RawMaterial sizes;
  if (!is_traced(o)) return sizes;
  sizes.name = o.meso;
  sizes.views.resize(o.directions);
  sizes.lights.resize(o.lights ? o.lights : o.directions);
  sizes.width = o.trace.width;
  sizes.height = o.trace.height;
  return sizes;
}

void run(Options& o) {
  if (int(!o.meso.empty()) + int(!o.pbr.empty()) + int(!o.btf.empty()) + int(!o.raw.empty()) != 1)
    throw ToolError(exit_bad_arguments,
                    "bake material: give exactly one source: --meso, --pbr, --btf or --raw");
  if (o.compression.settings.relief == ReliefSource::known && o.relief.empty() && !is_traced(o))
    throw ToolError(exit_bad_arguments,
                    "bake material: --relief known needs --meso or --pbr, whose heights are known; for --btf "
                    "or --raw, give an image of the heights");
  if (is_mesh(o.meso) && !std::filesystem::exists(o.meso)) meso_parameters(o.meso);
  if (!o.relief.empty() && !std::filesystem::exists(o.relief))
    throw ToolError(exit_bad_input, "bake material: --relief: there is no file " + o.relief.string() +
                                        "; need an image of heights, none, estimated or known");
  if (o.texels) o.trace.width = o.trace.height = o.texels;
  o.trace.seed = o.common.seed;
  o.trace.finds_heights = o.compression.settings.relief == ReliefSource::known && o.relief.empty();
  CompressionSettings& settings = o.compression.settings;
  if (!o.visibility_mapping.empty())
    settings.mapping = visibility_mapping(o.visibility_mapping, settings.visibility);
  // A height field has no gaps.
  check_compression(o.compression, expected_sizes(o), !o.meso.empty());
  CommandFiles files{{{"--pbr", o.pbr},
                      {"--btf", o.btf},
                      {"--raw", o.raw},
                      {"--meso", is_mesh(o.meso) ? o.meso : ""},
                      {"--relief", o.relief}},
                     {{"--keep-raw", o.keep_raw}},
                     o.images};
  BakeCommand command{o.common, o.baking, std::move(files), "stopped; no material was written"};
  command.makes_more = !o.keep_raw.empty() || !o.images.empty();
  run_bake(std::move(command), [&] { return prepare(o); });
}

}  // namespace

void add_bake_material(Command bake) {
  const Command command =
      bake.add_subcommand("material",
                          "compress a material with depth, such as a fabric, so that a shader can decode it "
                          "in real time.\nGive one source: --meso, --pbr, --btf or --raw.");
  const auto options = std::make_shared<Options>();
  Options& o = *options;
  std::string names;
  for (const std::string_view name : meso_names()) names.append(names.empty() ? "" : ", ").append(name);
  command
      .add_input("--meso", o.meso,
                 "source: a structure to ray trace, such as threads or holes (meso-structure). Give the name "
                 "of a built-in structure (" +
                     names + "), or a .glb or .gltf file with a closed mesh of one tile, y up")
      .type_name("NAME|TILE.glb");
  command.add_input("--pbr", o.pbr,
                    "source: a folder with the maps of a physically based material, whose heights are ray "
                    "traced. The names of the files must tell which map is the base colour, normal, "
                    "roughness or gloss, metalness and height");
  command
      .add_option("--height-scale", o.height_scale_m,
                  "for the height map of --pbr or the image of --relief: height in metres of the value 1. "
                  "Give 1 if the values are in metres")
      .check(non_negative_number())
      .capture_default_str();
  command
      .add_option(
          "--tile-size", o.tile_side_m,
          "side of one tile in metres, for the mesh of --meso, the maps of --pbr or the image of --relief")
      .check(positive_number())
      .capture_default_str();
  add_import_options(command, o.reading);
  command.add_input("--btf", o.btf,
                    "source: a measured BTF (images for many views and lights). Give a folder of images with "
                    "tl, pl, tv and pv in their names (UBO 2003, UTIA), or a .btf file (UBO 2014)");
  command
      .add_option_function(
          "--btf-colours",
          [&o](const std::string& v) { o.colours = v == "xyz" ? FloatColours::xyz : FloatColours::rgb; },
          "colour space of the images of --btf that have float values: rgb (default, linear), or xyz under "
          "D65 (UTIA)")
      .check(one_of({"rgb", "xyz"}))
      .type_name("NAME");
  command.add_input("--raw", o.raw,
                    "source: an uncompressed material, which --keep-raw of an earlier bake wrote");
  add_bake_options(command, o.baking);
  command.add_flag(
      "--strict", o.strict,
      "if the quality is bad, fail with exit code 4 and do not write the .nook file. The quality is bad if "
      "the signal-to-error ratio is below 12 dB in the views and lights that the fit does not see");
  command.add_option(
      "--keep-raw", o.keep_raw,
      "also write the uncompressed material to this file; `nook evaluate material` and --raw read it");
  command.add_option("--images", o.images,
                     "write PNG files into this folder: the uncompressed material, the decoded material and "
                     "their difference");
  command
      .add_option("--directions", o.directions,
                  "for --meso and --pbr: number of view directions to trace. Without --lights, also the "
                  "number of light directions")
      .check(in_range(4, 1024))
      .capture_default_str();
  command
      .add_option("--lights", o.lights,
                  "for --meso and --pbr: number of light directions to trace. Default: the light directions "
                  "are the view directions")
      .check(in_range(4, 1024));
  command
      .add_option(
          "--max-tilt", o.max_tilt_deg,
          "for --meso and --pbr: largest angle in degrees between the normal and a view or light direction")
      .check(in_range(10.0, 80.0))
      .capture_default_str();
  command
      .add_option(
          "--texels", o.texels,
          "number of texels along a side of the material. Default: 96 for --meso and --pbr. With --btf, a "
          "square of this size is cut from the middle of the images; default: the whole images")
      .check(in_range(1, 1024));
  command
      .add_option("--samples", o.trace.samples,
                  "for --meso and --pbr: number of view rays along each side of a texel. A texel takes the "
                  "square of this number, for each view")
      .check(in_range(1, 16))
      .capture_default_str();
  command
      .add_option("--bounces", o.trace.bounces,
                  "for --meso and --pbr: number of diffuse bounces of light to trace")
      .check(in_range(0, 16))
      .capture_default_str();
  command
      .add_option("--bounce-rays", o.trace.bounce_rays,
                  "for --meso and --pbr: number of rays that gather bounced light at each vertex")
      .check(in_range(1, 4096))
      .capture_default_str();
  command
      .add_option("--count", o.count,
                  "for a built-in --meso: number of fibres (fiber, default 10), of holes along a side "
                  "(roughhole, 2) or of yarns along a side (weave, 4)")
      .check(in_range(1, 1000));
  command.add_option("--radius", o.radius,
                     "for a built-in --meso, in tile sides, up to 0.5: radius of a fibre (fiber, default "
                     "0.04), radius of a hole (roughhole, 0.18) or half the width of a yarn (weave, 0.1)");
  command.add_option("--thickness", o.thickness,
                     "for a built-in --meso, in tile sides, up to 1: thickness of the mat of fibres (fiber, "
                     "default 0.16), of the plate (roughhole, 0.12) or of a yarn (weave, 0.09)");
  command.add_option(
      "--roughness", o.roughness,
      "for a built-in --meso, 0 to 0.5: how far fibres wander sideways (fiber, default 0.06), how strong the "
      "noise of the plate is (roughhole, 0.03) or how deep the plies of a yarn are (weave, 0.12)");
  command
      .add_option(
          "--detail", o.detail,
          "for a built-in --meso: factor for the number of mesh segments along each length; default 1")
      .check(in_range(0.1, 4.0));
  CompressionSettings& s = o.compression.settings;
  command
      .add_option_function(
          "--method",
          [&s](const std::string& v) {
            s.method = v == "n-svd"    ? Method::n_svd
                       : v == "cta"    ? Method::cta
                       : v == "neural" ? Method::neural
                                       : Method::k_cta;
          },
          "how to compress: k-cta (default), cta, n-svd or neural. neural trains a small network for "
          "minutes, which is better for flat and glossy materials; it compresses visibility by k-cta")
      .check(one_of({"k-cta", "cta", "n-svd", "neural"}))
      .type_name("NAME");
  command
      .add_option("--channels", s.neural_channels,
                  "for --method neural: number of feature channels per texel, a multiple of 4. Each channel "
                  "takes half a byte per texel in the file")
      .check(in_range(4, 64))
      .capture_default_str();
  command.add_option("--steps", s.neural_steps, "for --method neural: number of steps to train the network")
      .check(in_range(1, 1000000))
      .capture_default_str();
  command
      .add_option_function(
          "--votf",
          [&s](const std::string& v) {
            s.visibility = v == "none"     ? VisibilityForm::none
                           : v == "binary" ? VisibilityForm::binary
                                           : VisibilityForm::distance;
          },
          "how to store visibility (which texels a view sees): distance (default, signed distances in texels "
          "to the border), binary (0 or 1) or none")
      .check(one_of({"distance", "binary", "none"}))
      .type_name("NAME");
  command
      .add_option("--visibility-mapping", o.visibility_mapping,
                  "threshold T and weight W with which shaders turn stored values into visibility. Default: "
                  "0.5,1 for --votf binary; half a texel and its reciprocal for --votf distance. paper uses "
                  "the numbers of Tsai and Shih 2012: 0.5,1 for binary and 0.05,12 for distance")
      .type_name("T,W|paper");
  command
      .add_option("--view-map", s.map_side,
                  "for --method k-cta: number of cells along a side of the view maps, which are resampled "
                  "from the views. With 0, there are no view maps: a shader then mixes the three nearest "
                  "views, which takes up to three times the work")
      .check(in_range(0, 512))
      .capture_default_str();
  command
      .add_option(
          "--step-penalty", s.step_penalty,
          "penalty on differences between neighbouring cells of the view map. A larger value gives smaller "
          "jumps of the picture when the view turns, but a larger error; 10 halves the largest jump")
      .check(in_range(0.0, 1000.0))
      .capture_default_str();
  command
      .add_option_function(
          "--relief",
          [&o, &s](const std::string& v) {
            s.relief = v == "none"        ? ReliefSource::none
                       : v == "estimated" ? ReliefSource::estimated
                                          : ReliefSource::known;
            o.relief = s.relief == ReliefSource::known && v != "known" ? v : "";
          },
          "store heights, through which shaders march rays to make views between the stored views sharper. "
          "none (default) stores no heights. known stores the heights of --meso or --pbr. estimated finds "
          "the heights on which the views agree, and stores them only if they improve the prediction of "
          "views. IMAGE is a picture of heights, scaled by --height-scale and --tile-size")
      .type_name("none|estimated|known|IMAGE");
  command.reads(o.relief);
  add_compression_options(command, o.compression);
  add_common_options(command, o.common);
  command.callback([options] { run(*options); });
}

}  // namespace nook::tool

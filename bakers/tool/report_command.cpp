// `nook report` makes a page for artists about the content of a .nook file and its errors.
#include <algorithm>
#include <cctype>
#include <memory>
#include <optional>

#include "bakers/job/material_bake.h"
#include "bakers/measure/report/pages.h"
#include "bakers/raytrace/worker_arena.h"
#include "bakers/tool/command_end.h"
#include "bakers/tool/command_files.h"
#include "bakers/tool/command_inputs.h"
#include "bakers/tool/command_line.h"
#include "bakers/tool/commands.h"
#include "bakers/tool/common_options.h"
#include "bakers/tool/evaluation.h"
#include "bakers/tool/inspect/describe.h"
#include "bakers/tool/results/report_all.h"
#include "bakers/tool/stored_meshes.h"
#include "platform/output_file.h"
#include "platform/progress_bar.h"
#include "platform/stopwatch.h"
#include "sdk/src/material/material_file.h"
#include "sdk/src/nnao/recording_file.h"
#include "sdk/src/probe/probe_file.h"
#include "sdk/src/transfer/transfer_file.h"

namespace nook::tool {
namespace {

// The files that a page needs in addition to its .nook file, by kind.
struct ReportSources {
  std::filesystem::path shape;               // .glb or .gltf
  std::filesystem::path map;                 // .hdr or .exr
  std::vector<std::filesystem::path> nooks;  // other .nook files, and raw materials
};

// The sources that a page of one kind accepts.
struct TakenSources {
  bool shape = false, map = false;
  std::size_t nooks = 0;
};

std::string end_of(const std::filesystem::path& file) {
  std::string end = file.extension().string();
  std::ranges::transform(end, end.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  return end;
}

void take_once(std::filesystem::path& place, const std::filesystem::path& file, const char* what) {
  if (!place.empty())
    throw ToolError(exit_bad_arguments, file.string() + ": is the second " + what + "; give only one");
  place = file;
}

// Sorts files by their extensions. Throws ToolError (bad arguments) for an unknown extension, or a second
// shape or map.
ReportSources sort_sources(const std::vector<std::filesystem::path>& files) {
  ReportSources sources;
  for (const std::filesystem::path& file : files) {
    const std::string end = end_of(file);
    if (end == ".glb" || end == ".gltf")
      take_once(sources.shape, file, "shape");
    else if (end == ".hdr" || end == ".exr")
      take_once(sources.map, file, "map");
    else if (end == ".nook" || end == ".raw")
      sources.nooks.push_back(file);
    else
      throw ToolError(exit_bad_arguments,
                      file.string() + ": is not a source; give .glb, .gltf, .hdr, .exr, .nook or .raw files");
  }
  return sources;
}

// Throws ToolError (bad arguments) if a page of `kind` does not accept one of the sources. `need` is the text
// of the message that says what the page accepts.
void require_sources(const ReportSources& sources, const TakenSources& taken, const std::string& kind,
                     const std::string& need) {
  const std::filesystem::path* extra = nullptr;
  if (!taken.shape && !sources.shape.empty()) extra = &sources.shape;
  if (!taken.map && !sources.map.empty()) extra = &sources.map;
  if (sources.nooks.size() > taken.nooks) extra = &sources.nooks[taken.nooks];
  if (extra)
    throw ToolError(exit_bad_arguments,
                    extra->string() + ": is not a source for the page of a " + kind + "; give " + need);
}

struct Options {
  CommonOptions common;
  ReportAllOptions all;
  std::filesystem::path file, output;
  std::vector<std::filesystem::path> sources;
  std::string licence;
  bake::ImportOptions reading;
  report::BodySettings body;
};

struct Job {
  const Options& options;
  const ReportSources& sources;
  platform::ProgressBar& bar;
  report::PageSource& page;

  measure::StageProgress stages(const char* unit) const {
    return [this, unit](const char* label) {
      return [this, unit, label](std::size_t done, std::size_t total) {
        bar.show(label, unit, done, total);
        return !interrupted();
      };
    };
  }
  void show_shape() const {
    page.shown.push_back({sources.shape.filename().string(), naming_file(sources.shape, [&] {
                            return bake::read_asset_notes(sources.shape, options.reading.linked);
                          })});
  }
};

void require_shape(const Job& job, const std::string& kind) {
  if (job.sources.shape.empty())
    throw ToolError(exit_bad_arguments, job.options.file.string() + ": the page of a " + kind +
                                            " needs the .glb or .gltf file that it was baked from");
}

report::PageParts body_of(const Job& job) {
  require_sources(job.sources, {true, false, 0}, "character model",
                  "the .glb or .gltf file that it was baked from");
  require_shape(job, "character model");
  const measure::BakedCharacter baked =
      read_evaluated_files({job.sources.shape, job.options.file, job.options.reading}, job.options.common);
  job.show_shape();
  report::BodySettings settings = job.options.body;
  settings.seed = job.options.common.seed;
  return naming_file(job.options.file,
                     [&] { return report::body_parts(baked, settings, job.stages("steps")); });
}

report::PageParts probes_of(const Job& job, std::span<const std::byte> bytes) {
  const probe::Probes probes = probe::read_probes(bytes);
  require_sources(job.sources, {false, probes.grid.size() == 1, 0}, "light probe",
                  "the .hdr or .exr map that a single probe was baked from, or nothing");
  std::optional<bake::Environment> map;
  if (!job.sources.map.empty()) {
    map.emplace(read_map(job.sources.map));
    job.page.shown.push_back({job.sources.map.filename().string(), {}});
  }
  return report::probe_parts(probes, map ? &*map : nullptr);
}

report::PageParts material_of(const Job& job, std::span<const std::byte> bytes) {
  require_sources(job.sources, {false, false, 1}, "material",
                  "the raw material that --keep-raw wrote, or nothing");
  const material::Material material = material::read_material(bytes);
  std::optional<bake::material::RawMaterial> raw;
  if (!job.sources.nooks.empty()) {
    const std::filesystem::path& file = job.sources.nooks.front();
    raw.emplace(naming_file(file, [&] { return bake::material::read_raw_material(read_file(file)); }));
  }
  return report::material_parts(bytes, material, raw ? &*raw : nullptr);
}

report::PageParts transfer_of(const Job& job, std::span<const std::byte> bytes) {
  require_sources(job.sources, {true, false, 0}, "radiance transfer",
                  "the .glb or .gltf file that it was baked from");
  require_shape(job, "radiance transfer");
  const transfer::Transfer baked = transfer::read_transfer(bytes);
  const bake::ImportOptions reading = with_stored_meshes(job.options.reading, job.options.file,
                                                         std::string_view(baked.recipe), job.options.common);
  const bake::ImportedSurface surface =
      naming_file(job.sources.shape, [&] { return bake::import_surface(job.sources.shape, reading); });
  print_warnings(job.sources.shape, surface.warnings, job.options.common);
  job.show_shape();
  return report::transfer_parts(bytes.size(), baked, surface.mesh);
}

report::PageParts parts_of(const Job& job, std::span<const std::byte> bytes, const std::string& kind) {
  if (kind == "character model") return body_of(job);
  return naming_file(job.options.file, [&]() -> report::PageParts {
    if (kind == "light probe") return probes_of(job, bytes);
    if (kind == "material") return material_of(job, bytes);
    if (kind == "radiance transfer") return transfer_of(job, bytes);
    require_sources(job.sources, {}, kind, "none");
    if (kind == "recorded frame of the screen-space pass")
      return report::frame_parts(nook::nnao::read_recording(bytes));
    return {report::Html("A file without pictures."),
            report::Html("<p>There is no advice for this kind of file.</p>\n"),
            {},
            {}};
  });
}

void run(const Options& options) {
  platform::Stopwatch watch;
  CommandFiles files{
      {{"the input", options.file}}, {{"-o", options.output}, {"--report", options.common.report}}, {}};
  for (const std::filesystem::path& source : options.sources) files.inputs.push_back({"a source", source});
  require_distinct_files(files);
  const ReportSources sources = sort_sources(options.sources);
  const platform::FileEvents events = file_events(options.common.quiet);
  platform::OutputFile output(options.output, events);
  std::optional<platform::OutputFile> report_file;
  if (!options.common.report.empty()) report_file.emplace(options.common.report, events);

  report::PageSource page;
  page.title = options.file.filename().string();
  page.licence = options.licence;
  const std::vector<std::byte> bytes = read_file(options.file);
  page.facts = naming_file(options.file, [&] { return describe(bytes); });
  platform::ProgressBar bar(options.common.quiet);
  report::PageParts parts;
  bake::run_with_threads(options.common.threads, [&] {
    parts = parts_of({options, sources, bar, page}, bytes, page.facts["kind"].get<std::string>());
  });
  const std::string html = report::page_of(page, parts);
  output.commit(html);
  const Row row{{"page", options.output.filename().string()},
                {"kind", page.facts["kind"]},
                {"page_bytes", html.size()},
                {"seconds", watch.seconds()}};
  if (report_file)
    report_file->commit(Row{{"rows", Row::array({row})}}.dump(2, ' ', false, Row::error_handler_t::replace) +
                        "\n");
}

void run_all(const Options& options) {
  if (!options.file.empty())
    throw ToolError(exit_bad_arguments, "report: --all reads a folder and does not take a file (got " +
                                            options.file.string() + "); give one of them");
  ReportAllOptions all = options.all;
  all.output = options.output;
  report_all(all, options.common);
}

void run_either(const Options& options) {
  if (!options.all.folder.empty()) return run_all(options);
  if (options.file.empty())
    throw ToolError(exit_bad_arguments, "report: give a .nook file, or a folder with --all");
  if (options.output.empty()) throw ToolError(exit_bad_arguments, "--output is required");
  if (!options.all.before.empty()) throw ToolError(exit_bad_arguments, "--since: needs --all");
  run(options);
}

void add_all_options(const Command& command, ReportAllOptions& all) {
  command.add_option(
      "--all", all.folder,
      "write one page about all baked files in this folder, instead of one file. Failed bakes come first, "
      "then the files with the largest errors. The page also says what changed since the earlier page "
      "(--since). The default of -o is then nook_report.html in the folder");
  command.add_option("--since", all.before,
                     "with --all: compare with this earlier page. Default: the page that -o replaces");
}

}  // namespace

void add_report(Command tool) {
  const Command command = tool.add_subcommand(
      "report",
      "write an HTML page for artists about a .nook file, or about all files of a folder (--all).\nThe page "
      "of a file shows pictures of its AO or light beside ray tracing, the clips and places with the largest "
      "errors, a 3D view that you can turn, sizes, and advice.");
  const auto options = std::make_shared<Options>();
  Options& o = *options;
  command.add_input("file", o.file, "the .nook file; required without --all");
  command.add_input("sources", o.sources,
                    "the files that the .nook file was baked from; docs/guide/artists.md lists them for each "
                    "kind of .nook file");
  command.add_option("-o,--output", o.output, "write the page to this .html file; required without --all");
  add_all_options(command, o.all);
  command
      .add_option("--rays", o.body.rays,
                  "for a character: number of rays per vertex and pose, to measure the error")
      .check(in_range(1, 65536))
      .capture_default_str();
  command
      .add_option("--samples-per-clip", o.body.samples_per_clip,
                  "for a character: number of poses to measure from each clip. Default: as many as can be "
                  "ray traced in one to two minutes on two cores, at least 1 and at most 20")
      .check(in_range(1, 100000));
  command.add_option("--licence", o.licence, "show this text on the page as the licence of the asset");
  add_import_options(command, o.reading);
  add_common_options(command, o.common);
  command.callback([options] {
    try {
      run_either(*options);
    } catch (const Failure& failure) {
      if (failure.code() == NOOK_ERROR_CANCELLED) throw ToolError(exit_other, "stopped; nothing was written");
      throw;
    }
  });
}

}  // namespace nook::tool

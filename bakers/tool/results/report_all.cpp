#include "bakers/tool/results/report_all.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <optional>

#include "bakers/measure/report/asset_figures.h"
#include "bakers/measure/report/overview.h"
#include "bakers/raytrace/worker_arena.h"
#include "bakers/tool/command_end.h"
#include "bakers/tool/command_files.h"
#include "bakers/tool/inspect/describe.h"
#include "bakers/tool/results/find_assets.h"
#include "bakers/tool/results/read_asset.h"
#include "platform/output_file.h"
#include "platform/printable.h"
#include "platform/progress_bar.h"
#include "platform/stopwatch.h"

namespace nook::tool {
namespace {

namespace fs = std::filesystem;

constexpr const char* default_name = "nook_report.html";

std::string time_now() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  char text[40];
  std::strftime(text, sizeof text, "%Y-%m-%d %H:%M UTC", &utc);
  return text;
}

// URL-encodes a path for a link.
std::string encoded(const std::string& path) {
  std::string link;
  for (const char c : path) {
    const auto byte = static_cast<unsigned char>(c);
    const bool is_plain = (byte | 0x20) >= 'a' && (byte | 0x20) <= 'z';
    if (is_plain || (c >= '0' && c <= '9') || std::string_view("-._~/").find(c) != std::string_view::npos) {
      link += c;
      continue;
    }
    char escape[4];
    std::snprintf(escape, sizeof escape, "%%%02X", byte);
    link += escape;
  }
  return link;
}

// Returns the path from the page to the folder. A page that is written to a stream has no location, so it has
// no links.
std::string links_of(const fs::path& folder, const fs::path& output, bool is_regular) {
  std::error_code error;
  const fs::path page = fs::absolute(output, error).parent_path();
  const fs::path way = is_regular ? fs::proximate(folder, page, error) : fs::path();
  return error || way.empty() ? "" : encoded(way.generic_string()) + "/";
}

// Reads all assets on all threads. The work is split into pieces, so that progress and Ctrl-C can be handled
// between them.
std::vector<report::Asset> read_all(const fs::path& folder, const FoundAssets& found,
                                    const CommonOptions& common) {
  constexpr std::size_t piece = 256;
  const std::vector<std::pair<std::string, AssetFiles>> list(found.assets.begin(), found.assets.end());
  std::vector<std::optional<report::Asset>> read(list.size());
  platform::ProgressBar bar(common.quiet);
  for (std::size_t first = 0; first < list.size(); first += piece) {
    if (interrupted()) throw ToolError(exit_other, "stopped; nothing was written");
    bar.show("reading results", "assets", first, list.size());
    bake::run_with_threads(common.threads, [&] {
      tbb::parallel_for(first, std::min(first + piece, list.size()),
                        [&](std::size_t i) { read[i] = read_asset(folder, list[i].first, list[i].second); });
    });
  }
  bar.show("reading results", "assets", list.size(), list.size());
  std::vector<report::Asset> assets;
  for (std::optional<report::Asset>& asset : read)
    if (asset) assets.push_back(std::move(*asset));
  return assets;
}

// An unreadable folder may contain anything, so it is listed as broken.
void add_faults(const FoundAssets& found, std::vector<report::Asset>& assets) {
  for (const auto& [name, reason] : found.faults) {
    report::Asset asset;
    asset.name = platform::printable(name);
    asset.kind = "folder";
    asset.state = report::AssetState::broken;
    asset.notes = "this folder cannot be read: " + reason;
    assets.push_back(std::move(asset));
  }
}

// Reads the page that the new page is compared with. Returns nothing if the file at the output path is not
// such a page.
std::optional<report::LastPage> last_page(const ReportAllOptions& options, const fs::path& output) {
  const bool is_named = !options.before.empty();
  const fs::path& path = is_named ? options.before : output;
  std::error_code error;
  if (!is_named && !fs::is_regular_file(path, error)) return std::nullopt;
  const std::vector<std::byte> bytes = read_any_file(path);
  std::optional<report::LastPage> last =
      report::read_overview_page({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  const std::string fault =
      path.string() + ": is not a page of `nook report --all` that this version can read";
  if (!last && is_named) throw ToolError(exit_bad_input, fault);
  if (!last)
    std::fprintf(stderr, "nook: %s\n", platform::printable(fault + "; changes are not shown").c_str());
  return last;
}

void require_places(const ReportAllOptions& options, const fs::path& output, const CommonOptions& common,
                    const FoundAssets& found) {
  CommandFiles files{{}, {{"-o", output}, {"--report", common.report}}, {}};
  for (const auto& [name, asset] : found.assets) {
    // A JSON file without a model may have been written by an earlier --report.
    const bool is_free = asset.model.empty() && asset.report == common.report;
    for (const fs::path* path : {&asset.model, &asset.report, &asset.log})
      if (!path->empty() && !(is_free && path == &asset.report))
        files.inputs.push_back({"a file of --all", *path});
  }
  if (!options.before.empty() && options.before != output)
    files.inputs.push_back({"--since", options.before});
  require_distinct_files(files);
}

Row summary_of(const report::Overview& overview, const fs::path& output, std::size_t bytes, double seconds) {
  Row row{{"page", output.filename().string()}, {"assets", overview.assets.size()}};
  for (std::size_t i = 0; i < report::asset_state_count; ++i) {
    const auto state = report::AssetState(i);
    row[state_name(state)] = std::ranges::count(overview.assets, state, &report::Asset::state);
  }
  row["page_bytes"] = bytes;
  row["seconds"] = seconds;
  return row;
}

}  // namespace

void report_all(const ReportAllOptions& options, const CommonOptions& common) {
  const platform::Stopwatch watch;
  const fs::path output = options.output.empty() ? options.folder / default_name : options.output;
  const FoundAssets found = find_assets(options.folder);
  require_places(options, output, common, found);
  const platform::FileEvents events = file_events(common.quiet);
  platform::OutputFile page(output, events);
  std::optional<platform::OutputFile> report_file;
  if (!common.report.empty()) report_file.emplace(common.report, events);
  const std::optional<report::LastPage> last = last_page(options, output);

  report::Overview overview;
  // Uses the absolute path, because "." would not tell a later reader of the page which folder it was.
  std::error_code unknown;
  const fs::path whole = fs::absolute(options.folder, unknown).lexically_normal();
  overview.folder = (unknown ? options.folder : whole).string();
  overview.links = links_of(options.folder, output, page.is_regular());
  overview.made = time_now();
  overview.limits = report::asset_limits();
  overview.assets = read_all(options.folder, found, common);
  if (overview.assets.empty() && found.faults.empty())
    throw ToolError(exit_bad_input, "--all: " + options.folder.string() +
                                        " contains no baked file, and no log, report or unfinished part of a "
                                        "bake; give the folder that bakes write to");
  add_faults(found, overview.assets);
  if (last) {
    overview.before = last->made;
    mark_changes(overview.assets, *last);
  }
  sort_worst_first(overview.assets);
  const std::string html = report::overview_page(overview);
  page.commit(html);
  const Row rows = Row::array({summary_of(overview, output, html.size(), watch.seconds())});
  if (report_file)
    report_file->commit(Row{{"rows", rows}}.dump(2, ' ', false, Row::error_handler_t::replace) + "\n");
}

}  // namespace nook::tool

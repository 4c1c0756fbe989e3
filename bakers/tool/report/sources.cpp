#include "bakers/tool/report/sources.h"

#include <algorithm>
#include <cctype>

#include "bakers/tool/tool_error.h"

namespace nook::tool {
namespace {

std::string end_of(const std::filesystem::path& file) {
  std::string end = file.extension().string();
  std::ranges::transform(end, end.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  return end;
}

void take_once(std::filesystem::path& place, const std::filesystem::path& file, const char* what) {
  if (!place.empty())
    throw ToolError(exit_bad_arguments, file.string() + ": is the second " + what + "; give one");
  place = file;
}

}  // namespace

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
                      file.string() + ": a source is a .glb, .gltf, .hdr, .exr, .nook or .raw file");
  }
  return sources;
}

void require_sources(const ReportSources& sources, const TakenSources& taken, const std::string& kind,
                     const std::string& need) {
  const std::filesystem::path* extra = nullptr;
  if (!taken.shape && !sources.shape.empty()) extra = &sources.shape;
  if (!taken.map && !sources.map.empty()) extra = &sources.map;
  if (sources.nooks.size() > taken.nooks) extra = &sources.nooks[taken.nooks];
  if (extra)
    throw ToolError(exit_bad_arguments,
                    extra->string() + ": is no source of the page of a " + kind + "; give " + need);
}

}  // namespace nook::tool

// The files that a page is made from beside its .nook file, by what they are.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace nook::tool {

struct ReportSources {
  std::filesystem::path shape;               // .glb or .gltf
  std::filesystem::path map;                 // .hdr or .exr
  std::vector<std::filesystem::path> nooks;  // other .nook files, and raw materials
};

// By the ends of their names. Throws ToolError (bad arguments) for a name that is none of these, or a second
// shape or map.
ReportSources sort_sources(const std::vector<std::filesystem::path>& files);

// Throws ToolError (bad arguments) where the sources have what a page of `kind` does not take. need: in
// words.
struct TakenSources {
  bool shape = false, map = false;
  std::size_t nooks = 0;
};
void require_sources(const ReportSources& sources, const TakenSources& taken, const std::string& kind,
                     const std::string& need);

}  // namespace nook::tool

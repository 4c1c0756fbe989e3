// The result of a bake, and its report of progress.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace nook::bake {

struct BakedFile {
  std::vector<std::byte> model;  // of a .nook file
  std::string report;            // JSON
};

// The stage of a job.
enum class JobStage : std::uint8_t {
  waiting,
  raytrace,
  initialise,
  fit,
  casters,
  btf,
  votf,
  view_map,
  relief,
  done,
};

// Returns false to stop.
using StageReport = std::function<bool(JobStage stage, std::size_t done, std::size_t total)>;

}  // namespace nook::bake

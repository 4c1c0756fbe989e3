// The result of a bake, and its progress callback.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace nook::bake {

struct BakedFile {
  std::vector<std::byte> model;  // bytes of a .nook file
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

// Returns the text for the stage that a program shows to its user.
inline const char* text_of(JobStage stage) {
  switch (stage) {
    case JobStage::waiting:
      return "waiting";
    case JobStage::raytrace:
      return "ray tracing";
    case JobStage::initialise:
      return "initialising";
    case JobStage::fit:
      return "fitting";
    case JobStage::casters:
      return "fitting casters";
    case JobStage::btf:
      return "compressing colours";
    case JobStage::votf:
      return "compressing visibility";
    case JobStage::view_map:
      return "making the view map";
    case JobStage::relief:
      return "finding the relief";
    case JobStage::done:
      break;
  }
  return "done";
}

// The callback returns false to stop the bake.
using StageReport = std::function<bool(JobStage stage, std::size_t done, std::size_t total)>;

}  // namespace nook::bake

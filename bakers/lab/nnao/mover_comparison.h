// Measures means of AO over frames in which a skinned body moves, against ray tracing and beside single
// frames.
#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "bakers/lab/nnao/baseline_pass.h"
#include "bakers/lab/nnao/mover_view.h"
#include "platform/platform.h"

namespace nook::lab {

// Length of a sequence, and of the longest mean.
inline constexpr std::size_t mover_frames = 8;

// Which earlier frames a pass uses.
enum class MoverPass : std::uint8_t {
  single,   // each frame alone
  vectors,  // a mean over frames with motion vectors of the body
  cameras   // a mean over frames that follows the camera alone
};
inline constexpr std::array<MoverPass, 3> mover_passes{MoverPass::single, MoverPass::vectors,
                                                       MoverPass::cameras};
const char* mover_pass_name(MoverPass pass);

struct MoverError {
  int taps = 0;
  MoverPass pass = MoverPass::single;
  std::array<double, mover_part_count> mse{};   // in the last frame, by MoverPart; 0 without a pixel
  std::array<double, mover_part_count> bias{};  // mean of AO less the reference
};

struct MeasuredMover {
  std::string character, shot;
  bool camera_moves = false;
  std::array<std::size_t, mover_part_count> pixels{};
  std::vector<MoverError> errors;
};

// The view needs mover_frames frames. If images is not null, it receives the last frame's AO of each pass
// with 9 taps, in the order of mover_passes.
MeasuredMover measure_mover(platform::Context& context, const MoverView& view, measure::AoRequest request,
                            std::vector<std::vector<float>>* images);

// In a view, parts with fewer pixels do not count, because they would be chance.
inline constexpr std::size_t fewest_part_pixels = 100;

// Members `rows`: means over each character's views and over the characters; `ratios`: errors over the errors
// of single frames; `views`: each view and pass. docs/lab/nnao_protocol.md explains the columns. movers: one
// or more.
nlohmann::ordered_json mover_report(std::span<const MeasuredMover> movers, std::uint64_t seed);

std::string mover_markdown(const nlohmann::ordered_json& report);

}  // namespace nook::lab

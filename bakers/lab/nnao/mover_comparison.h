// Means of AO over frames where a skinned body moves, against ray tracing and beside single frames.
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

// Frames of a sequence, and the longest mean.
inline constexpr std::size_t mover_frames = 8;

// The earlier frames that a pass takes.
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
  std::array<double, mover_part_count> mse{};   // of the last frame, by MoverPart; 0 without a pixel
  std::array<double, mover_part_count> bias{};  // mean of AO less the reference
};

struct MeasuredMover {
  std::string character, shot;
  bool camera_moves = false;
  std::array<std::size_t, mover_part_count> pixels{};
  std::vector<MoverError> errors;
};

// view: of mover_frames. Keeps the last frame's AO of each pass with 9 taps in images, in the order of
// mover_passes, if it is not null.
MeasuredMover measure_mover(platform::Context& context, const MoverView& view, measure::AoRequest request,
                            std::vector<std::vector<float>>* images);

// Parts with fewer pixels in a view do not count there: they would be chance.
inline constexpr std::size_t fewest_part_pixels = 100;

// Members `rows`: means over each character's views and over the characters; `ratios`: of errors over those
// of single frames; `views`: each view and pass. docs/nnao_protocol.md has the columns. movers: one or more.
nlohmann::ordered_json mover_report(std::span<const MeasuredMover> movers, std::uint64_t seed);

// The tables of means and ratios.
std::string mover_markdown(const nlohmann::ordered_json& report);

}  // namespace nook::lab

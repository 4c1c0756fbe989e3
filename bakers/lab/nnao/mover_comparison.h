// Measures temporally accumulated AO in scenes in which a skinned body moves. The report compares it with ray
// tracing, and with AO that is computed from single frames.
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

// Number of frames in a sequence. It is also the largest number of frames that are averaged.
inline constexpr std::size_t mover_frames = 8;

// How a pass uses earlier frames.
enum class MoverPass : std::uint8_t {
  single,   // uses each frame alone
  vectors,  // accumulates frames, with motion vectors of the body
  cameras   // accumulates frames, and reprojects by the camera's motion only
};
inline constexpr std::array<MoverPass, 3> mover_passes{MoverPass::single, MoverPass::vectors,
                                                       MoverPass::cameras};
const char* mover_pass_name(MoverPass pass);

struct MoverError {
  int taps = 0;
  MoverPass pass = MoverPass::single;
  // Mean squared error in the last frame, indexed by MoverPart; 0 for a part without pixels.
  std::array<double, mover_part_count> mse{};
  std::array<double, mover_part_count> bias{};  // mean of AO - reference
};

struct MeasuredMover {
  std::string character, shot;
  bool camera_moves = false;
  std::array<std::size_t, mover_part_count> pixels{};
  std::vector<MoverError> errors;
};

// The view must have mover_frames frames. If `images` is not null, it receives the AO of each pass with 9
// taps in the last frame, in the order of mover_passes.
MeasuredMover measure_mover(platform::Context& context, const MoverView& view, measure::AoRequest request,
                            std::vector<std::vector<float>>* images);

// If a part has fewer pixels than this in a view, it is ignored in this view, because its error would be
// mostly noise.
inline constexpr std::size_t fewest_part_pixels = 100;

// Returns an object with three members. `rows` has the means over the views of each character, and over all
// characters. `ratios` has the errors divided by the errors of single frames. `views` has one entry for each
// view and pass. docs/lab/nnao_protocol.md explains the columns. `movers` must not be empty.
nlohmann::ordered_json mover_report(std::span<const MeasuredMover> movers, std::uint64_t seed);

std::string mover_markdown(const nlohmann::ordered_json& report);

}  // namespace nook::lab

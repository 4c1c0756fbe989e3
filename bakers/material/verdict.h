// Judges a baked material: can it be drawn in views and under lights that were not fitted? For this, the bake
// fits a part of the material again without every fifth view and light, and measures the error in these
// held-out views and lights.
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>

#include "bakers/material/compression.h"

namespace nook::bake::material {

enum class Grade : std::uint8_t {
  good,
  poor,
  bad,        // do not draw it
  not_judged  // see Verdict::words
};

// In the held-out views and lights, a material is good from good_db on, and bad below bad_db. The trial fit
// has a fifth fewer directions than the bake, so its dB values tend to be too low.
inline constexpr double good_db = 18, bad_db = 12;

struct Verdict {
  Grade grade = Grade::not_judged;
  std::string words;          // text for the user: what is wrong, and how to fix it
  double held_out_db = 0;     // signal-to-error ratio in the held-out views under the held-out lights
  double negative = 0;        // share of the radiances in these views and lights that are below -0.1 % of
                              // their root mean square
  double largest_step = 0;    // largest change of the radiances as the view moves by one degree, relative to
                              // the radiances
  bool one_cluster = false;   // K-CTA with a single cluster is N-SVD with a view map
  bool ranks_at_cap = false;  // a rank is as large as its mode, so that this mode is not compressed
  bool judged() const { return grade != Grade::not_judged; }
};

const char* grade_name(Grade grade);

// Judges the compression of a raw material with these settings. Uses a square of at most 24 x 24 texels from
// the middle of the material, without the VOTF. Materials with fewer than ten views or lights are not judged.
// Neural materials are not judged either, because a second training would take too long. The result has the
// same bits on any number of threads. `progress` is the same as for compress().
Verdict judge(const RawMaterial& raw, const CompressionSettings& settings,
              const StageProgress& progress = {});

// Returns the verdict in the form of recipes and reports.
nlohmann::ordered_json describe(const Verdict& verdict);

}  // namespace nook::bake::material

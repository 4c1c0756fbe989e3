// A material judges itself: is what a bake made of it fit to be drawn in views and under lights that nobody
// fitted? The bake fits a part of the material once more without every fifth view and light, and measures it
// there.
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

// A material is good from good_db in the held-out views and lights, and bad below bad_db. The trial fit has a
// fifth fewer directions than the bake, so that it errs on the low side.
inline constexpr double good_db = 18, bad_db = 12;

struct Verdict {
  Grade grade = Grade::not_judged;
  std::string words;          // for people: what is wrong, and what cures it
  double held_out_db = 0;     // in the held-out views under the held-out lights
  double negative = 0;        // share of radiances there below -0.1 % of their root mean square
  double largest_step = 0;    // of the radiances as the view moves by a degree, over the radiances
  bool one_cluster = false;   // K-CTA with a single cluster is N-SVD with a view map
  bool ranks_at_cap = false;  // a rank is as large as its mode, so that nothing is compressed in it
  bool judged() const { return grade != Grade::not_judged; }
};

const char* grade_name(Grade grade);

// Judges the compression of a raw material with these settings. Takes a square of at most 24 x 24 texels from
// its middle, without the VOTF. Materials with fewer than ten views or lights, and neural ones, whose
// training takes too long to be repeated, are not judged. The result has the same bits on any number of
// threads. progress: as of compress().
Verdict judge(const RawMaterial& raw, const CompressionSettings& settings,
              const StageProgress& progress = {});

// Returns the verdict as recipes and reports have it.
nlohmann::ordered_json describe(const Verdict& verdict);

}  // namespace nook::bake::material

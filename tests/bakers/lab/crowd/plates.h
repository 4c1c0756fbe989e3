// A character whose occlusion has closed forms: a square plate of 2 m that looks up, without thickness.
#pragma once

#include <memory>

#include "bakers/lab/crowd/truth.h"

namespace plates {

inline constexpr std::uint32_t kSide = 5;                          // vertices along a side
inline constexpr std::uint32_t kUsed = kSide * kSide;              // vertices that triangles use
inline constexpr std::uint32_t kVertices = kUsed + 1;              // one more, which no triangle uses
inline constexpr std::uint32_t kCentre = kUsed / 2;                // the vertex in the middle
inline constexpr float kCells = float((kSide - 1) * (kSide - 1));  // squares between the vertices

struct Release {
  void operator()(nook_bake_character character) const { nook_bake_character_destroy(&character); }
};
using Character = std::unique_ptr<nook_bake_character_s, Release>;
Character make_character();

// The plate at a place, turned about x: by 0 it looks up, by a quarter towards +z, by a half down.
nook::lab::crowd::Bones pose(float x_m, float y_m, float z_m, float turns = 0);

// The share of the cosine-weighted hemisphere that the plate covers, seen from distance_m before its middle.
float covered_share(float distance_m);

}  // namespace plates

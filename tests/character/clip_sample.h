// Small sets of clips with known numbers, for tests that need no bake.
#pragma once

#include <cmath>
#include <vector>

#include "sdk/src/character/clip_set.h"
#include "tests/character/model_sample.h"

namespace nook::test {

// Two clips for a model, of 5 frames in 2 s and of one frame without duration: modes of AO at random, and
// poses that are planted, so that the table holds each in a mode of its own.
struct ClipSample {
  ClipSet set;
  std::vector<std::vector<Mat3x4>> poses;  // of each frame, one matrix for each bone
};

// Fills the table with the poses, each in a mode of its own.
inline void plant_poses(ClipSample& sample) {
  ClipSet& set = sample.set;
  const auto frames = static_cast<std::uint32_t>(sample.poses.size());
  set.pose.mode.clear();
  set.pose.weight.clear();
  set.pose.scale.clear();
  set.pose.rows = pose_rows_per_bone * static_cast<std::uint32_t>(set.bones.size());
  set.pose.modes = frames;
  for (std::uint32_t f = 0; f < frames; ++f) {
    std::vector<float> rows;
    for (std::size_t b = 0; b < set.bones.size(); ++b) {
      const Mat3x4& matrix = sample.poses[f][b];
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) rows.push_back(set.bones[b].radius * matrix.m[4 * i + j]);
      const Vec3 centre = transform_point(matrix, set.bones[b].centre);
      rows.insert(rows.end(), {centre.x, centre.y, centre.z});
    }
    float largest = 0;
    for (const float row : rows) largest = std::max(largest, std::abs(row));
    for (const float row : rows)
      set.pose.mode.push_back(static_cast<std::int16_t>(std::lround(row / largest * 32767)));
    set.pose.scale.push_back(largest);
    for (std::uint32_t k = 0; k < frames; ++k)
      set.pose.weight.push_back(static_cast<std::int16_t>(k == f ? 32767 : 0));
  }
}

inline ClipSample sample_clips(const CharacterModel& model, std::uint32_t seed = 1,
                               std::uint32_t ao_modes = 8) {
  constexpr std::uint32_t frames = 6;
  Numbers numbers(seed);
  ClipSample sample;
  ClipSet& set = sample.set;
  for (const auto& [name, duration_s, count] : {std::tuple{"pose", 0.0f, 1u}, std::tuple{"walk", 2.0f, 5u}}) {
    ClipRange& clip = set.clips.emplace_back();
    clip.name = name;
    clip.duration_s = duration_s;
    clip.first_frame = set.frame_count;
    clip.frame_count = count;
    set.frame_count += count;
  }
  set.model_hash = clip_model_hash(model);
  set.ao.rows = static_cast<std::uint32_t>(model.vertex_count());
  set.ao.modes = ao_modes;
  for (std::size_t i = 0; i < std::size_t(set.ao.rows) * ao_modes; ++i)
    set.ao.mode.push_back(static_cast<std::int8_t>(int(numbers.below(255)) - 127));
  for (std::size_t i = 0; i < std::size_t(frames) * ao_modes; ++i)
    set.ao.weight.push_back(static_cast<std::int16_t>(int(numbers.below(65535)) - 32767));
  for (std::uint32_t k = 0; k < ao_modes; ++k) set.ao.scale.push_back(0.6f / float(1 + k));

  const auto bones = static_cast<std::uint32_t>(model.bone_count());
  for (std::uint32_t b = 0; b < bones; ++b)
    set.bones.push_back({numbers.place(0.3f), numbers.between(0.05f, 0.2f)});
  for (std::uint32_t f = 0; f < frames; ++f) {
    std::vector<Mat3x4>& pose = sample.poses.emplace_back();
    for (std::uint32_t b = 0; b < bones; ++b) pose.push_back(random_frame(numbers));
  }
  plant_poses(sample);
  set.recipe = "{\"rays\": 1}";
  return sample;
}

// The AO of a welded vertex by the definition, in double precision.
inline double sample_ao(const ClipSet& set, std::size_t first, std::size_t second, double share,
                        std::size_t vertex) {
  double ao = 0.5;
  for (std::size_t k = 0; k < set.ao.modes; ++k) {
    const double at_first = double(set.ao.frame_weight(first, k)),
                 at_second = double(set.ao.frame_weight(second, k));
    ao += (at_first + share * (at_second - at_first)) * double(set.ao.mode[k * set.ao.rows + vertex]) / 127;
  }
  return std::min(std::max(ao, 0.0), 1.0);
}

}  // namespace nook::test

// Recorded frames full of seeded numbers, for tests that need any frame.
#pragma once

#include <algorithm>
#include <cstdint>
#include <random>

#include "sdk/src/nnao/network_file.h"
#include "sdk/src/nnao/recording.h"

namespace nook::test {

// A wavy floor with sky above it, under a perspective with hardware depth.
inline nnao::Recording sample_recording(std::uint32_t width = 9, std::uint32_t height = 7,
                                        bool everything = true) {
  std::mt19937 random(3);
  const auto next = [&] { return float(random()) * 0x1p-32f; };
  nnao::Recording recording;
  recording.width = width;
  recording.height = height;
  recording.library_version = NOOK_VERSION;
  const float projection[16] = {1.5f, 0, 0, 0, 0, 1.5f, 0, 0, 0, 0, -1.002f, -1, 0, 0, -0.2002f, 0};
  std::ranges::copy(projection, recording.frame.projection);
  recording.frame.radius = 0.5f;
  recording.pass.taps = 16;
  for (std::size_t i = 0; i < recording.pixels(); ++i) {
    const bool sky = i / width + 1 == height;
    recording.depth.push_back(sky ? 1.0f : 0.95f + 0.02f * next());
    if (!everything) continue;
    for (int c = 0; c < 3; ++c) recording.normals.push_back(next());
    for (int c = 0; c < 2; ++c) recording.layer.push_back(float(random() % 256) / 255);
    recording.ao.push_back(float(random() % 256) / 255);
  }
  const auto network = nnao::default_network_file();
  recording.network.assign(network.begin(), network.end());
  if (!everything) return recording;
  recording.frame.layer = 1;
  recording.frame.intensity = 1.25f;
  recording.vendor = "a vendor";
  recording.renderer = "a renderer";
  recording.driver_version = "4.5";
  recording.note = "a remark";
  return recording;
}

}  // namespace nook::test

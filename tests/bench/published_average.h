// The published running average of probes, compiled with the flags of each instruction set of x86-64.
#pragma once

#include <cstddef>
#include <vector>

namespace nook::bench {

struct PublishedLobe {
  float axis[3], sharpness;
  float amplitude[3];
  float value;        // at the last sample
  float square;       // its mean over the samples
  float true_square;  // and over the sphere
};

struct PublishedFit {
  std::vector<PublishedLobe> lobes;
  float weight = 0;
};

using PublishedAverage = void (*)(PublishedFit& fit, const float* directions, const float* radiance,
                                  std::size_t count);

namespace published_sse2 {
void published_average(PublishedFit& fit, const float* directions, const float* radiance, std::size_t count);
}
namespace published_avx2 {
void published_average(PublishedFit& fit, const float* directions, const float* radiance, std::size_t count);
}
namespace published_avx512 {
void published_average(PublishedFit& fit, const float* directions, const float* radiance, std::size_t count);
}

}  // namespace nook::bench

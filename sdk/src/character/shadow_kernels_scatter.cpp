#include "sdk/src/character/shadow_kernels_tables.h"

namespace nook {

void scatter(const float* values, const std::uint32_t* index, std::uint32_t count, float* out,
             std::size_t stride_bytes) {
  if (stride_bytes == sizeof(float)) {
    for (std::uint32_t i = 0; i < count; ++i) out[i] = values[index[i]];
    return;
  }
  char* target = reinterpret_cast<char*>(out);
  for (std::uint32_t i = 0; i < count; ++i, target += stride_bytes)
    *reinterpret_cast<float*>(target) = values[index[i]];
}

}  // namespace nook

#include <algorithm>
#include <cmath>

#include "tests/bench/published_average.h"

namespace nook::bench::published_sse2 {

#include "tests/bench/published_average.inl"

}  // namespace nook::bench::published_sse2

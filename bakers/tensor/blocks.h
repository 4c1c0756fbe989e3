// Runs work in blocks. The bounds of the blocks depend only on the amount of work. So results that are added
// in the order of the blocks have the same bits on any number of threads.
#pragma once

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace nook::bake::tensor {

// Runs body(first, last) for each block, in parallel.
template <class Body>
void for_each_block(std::size_t count, std::size_t block, const Body& body) {
  tbb::parallel_for(std::size_t(0), (count + block - 1) / block,
                    [&](std::size_t b) { body(b * block, std::min(count, (b + 1) * block)); });
}

// Returns the sum of sum(first, last) over the blocks, which run in parallel.
template <class Sum>
double ordered_sum(std::size_t count, std::size_t block, const Sum& sum) {
  std::vector<double> part((count + block - 1) / block);
  for_each_block(count, block,
                 [&](std::size_t first, std::size_t last) { part[first / block] = sum(first, last); });
  double total = 0;
  for (double p : part) total += p;
  return total;
}

}  // namespace nook::bake::tensor

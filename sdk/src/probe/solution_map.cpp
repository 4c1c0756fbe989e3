#include "sdk/src/probe/solution_map.h"

#include <algorithm>

#include "sdk/src/probe/dense.h"

namespace nook::probe {

Vector<double> solution_map(const Basis& basis, Constraint constraint, Memory* memory) {
  const std::uint32_t n = basis.count, columns = n + band_functions;
  Vector<double> factor = basis_gram(basis, memory);
  cholesky(factor.data(), n, 0);
  LightBands bands;
  project_functions(basis, bands.function.data());
  Vector<double> map(std::size_t(n) * columns, 0.0, memory);
  // The channels of a fit are independent: each carries the unit vector of one column.
  std::array<double, 3 * max_functions> b;
  for (std::uint32_t first = 0; first < columns; first += 3) {
    const std::uint32_t end = std::min(first + 3, columns);
    b.fill(0);
    bands.light.fill(0);
    for (std::uint32_t column = first; column < end; ++column) {
      const std::uint32_t channel = column - first;
      if (column >= n)
        bands.light[3 * (column - n) + channel] = 1;
      else
        b[3 * column + channel] = 1;
    }
    for (std::uint32_t channel = 0; channel < 3; ++channel)
      cholesky_solve(factor.data(), n, b.data() + channel, 3);
    if (constraint == Constraint::bands) meet_bands(bands, factor.data(), n, exact_bands, b.data());
    for (std::uint32_t i = 0; i < n; ++i)
      for (std::uint32_t column = first; column < end; ++column)
        map[std::size_t(i) * columns + column] = b[3 * i + column - first];
  }
  return map;
}

}  // namespace nook::probe

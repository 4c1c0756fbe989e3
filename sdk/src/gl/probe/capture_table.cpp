#include "sdk/src/gl/probe/capture_table.h"

#include "sdk/src/probe/solution_map.h"

namespace nook::gl {
namespace {

void write_map(const CapturePlan& plan, const Vector<double>& map, float* out) {
  const std::uint32_t columns = plan.lobes + probe::band_functions;
  for (std::uint32_t row = 0; row < plan.lobes; ++row, out += plan.sums())
    for (std::uint32_t column = 0; column < columns; ++column) {
      const std::uint32_t sum =
          column < plan.lobes ? column : plan.lobe_groups() * NOOK_CAPTURE_GROUP + column - plan.lobes;
      out[sum] = float(map[std::size_t{row} * columns + column]);
    }
}

}  // namespace

Vector<float> capture_texels(const CapturePlan& plan, const probe::Basis& basis, probe::Constraint constraint,
                             Memory* memory) {
  Vector<float> texels(4 * plan.texels(), 0.0f, memory);
  if (plan.lobes == 0) return texels;
  float* lobe = texels.data() + 4 * CapturePlan::first_lobe;
  for (std::uint32_t i = 0; i < plan.lobes; ++i, lobe += 4) {
    lobe[0] = basis.axis[i].x;
    lobe[1] = basis.axis[i].y;
    lobe[2] = basis.axis[i].z;
    lobe[3] = basis.sharpness[i];
  }
  write_map(plan, probe::solution_map(basis, constraint, memory), texels.data() + 4 * plan.first_map_row());
  return texels;
}

}  // namespace nook::gl

#include "sdk/src/world/world_kernels.h"

#include <vector>

#include "sdk/src/core/aligned_array.h"
#include "tests/catch.h"
#include "tests/character/model_sample.h"
#include "tests/world/directions.h"

using namespace nook;
using namespace nook::test;

TEST_CASE("world kernels: every instruction set gives what the formula gives") {
  Numbers numbers(2);
  constexpr std::uint32_t count = 4 * simd_width;
  std::vector<PosedCaster> casters;
  for (int i = 0; i < 20; ++i) {
    const Vec3 a = numbers.place(1);
    casters.push_back({{a, i % 5 == 0 ? a : a + numbers.place(0.4f), numbers.between(0.01f, 0.2f),
                        numbers.between(0.01f, 0.2f)},
                       numbers.between(0.6f, 1.2f)});
  }
  alignas(64) float lanes[6][count];
  std::vector<Vec3> point, normal;
  for (std::uint32_t i = 0; i < count; ++i) {
    point.push_back(numbers.place(2));
    normal.push_back(numbers.direction());
    const float values[6] = {point[i].x, point[i].y, point[i].z, normal[i].x, normal[i].y, normal[i].z};
    for (int l = 0; l < 6; ++l) lanes[l][i] = values[l];
  }
  const world::PointSoa points{lanes[0], lanes[1], lanes[2], lanes[3], lanes[4], lanes[5], count};
  const Vec3 axis = normalised({0.4f, 0.9f, 0.1f});
  for (const Isa isa : all_isas) {
    const world::WorldKernels* const kernels = world::world_kernels(isa);
    if (!kernels) continue;
    INFO(kernels->name);
    CHECK(kernels->isa == isa);
    alignas(64) float open[count], part[count];
    std::fill_n(open, count, 1.0f);
    std::fill_n(part, count, 1.0f);
    kernels->open_hemisphere(casters.data(), std::uint32_t(casters.size()), points, open);
    kernels->open_part(casters.data(), std::uint32_t(casters.size()), points, axis, 0.1f, part);
    for (std::uint32_t i = 0; i < count; ++i) {
      float wanted = 1, wanted_part = 1;
      for (const PosedCaster& caster : casters) {
        Capsule c = caster.capsule;
        c.a = c.a - point[i];
        c.b = c.b - point[i];
        wanted_part *= 1 - world::part_coverage<float>(lanes_of(c), axis.x, axis.y, axis.z, 0.1f);
        c.radius_a *= caster.ao_scale;
        c.radius_b *= caster.ao_scale;
        wanted *= 1 - world::coverage<float>(lanes_of(c), normal[i].x, normal[i].y, normal[i].z);
      }
      // Inverse square roots have 22 bits on some processors; near a surface a share rises with the square
      // root of the distance, so that 2e-7 becomes 5e-4.
      CHECK(std::abs(open[i] - wanted) < 1e-3f);
      CHECK(std::abs(part[i] - wanted_part) < 1e-3f);
    }
  }
}

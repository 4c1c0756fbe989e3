#include <algorithm>

#include "sdk/src/material/material_file.h"
#include "tests/fuzz/seeds.h"
#include "tests/material/material_sample.h"

namespace nook::test {
namespace {

// The forms of a material with as few numbers as their checks allow: a fuzzer tries more of small ones.
material::test::SampleSize small(material::test::SampleSize size) {
  size.lights = 3;
  size.views = 5;
  size.width = 4;
  size.height = 3;
  size.rank_light = size.rank_x = size.rank_y = 2;
  size.rank_view = std::min(size.rank_view, 5u);
  size.clusters = std::min(size.clusters, 2u);
  size.map_side = std::min(size.map_side, 2u);
  return size;
}

}  // namespace

std::vector<Seed> seeds() {
  std::vector<Seed> made;
  for (const material::test::SampleSize& size : material::test::sample_forms)
    made.push_back({"material_" + std::to_string(made.size()) + ".nook",
                    material::write_material(material::test::sample_material(1, small(size)))});
  for (const std::uint32_t steps : {0u, 4u})
    made.push_back({"material_" + std::to_string(made.size()) + ".nook",
                    material::write_material(material::test::sample_material(
                        1, small({.relief_height = 0.2f, .relief_steps = steps})))});
  for (const auto visibility : {material::VisibilityForm::none, material::VisibilityForm::distance})
    made.push_back(
        {"material_" + std::to_string(made.size()) + ".nook",
         material::write_material(material::test::sample_material(
             1, small({.map_side = 2, .visibility = visibility, .channels = 4, .units = 4, .layers = 2})))});
  return made;
}

}  // namespace nook::test

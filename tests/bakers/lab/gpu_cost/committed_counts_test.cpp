// The committed counts against what the texts of the shaders say.
#include <nlohmann/json.hpp>

#include "bakers/lab/gpu_cost/cost_report.h"
#include "tests/catch.h"

using namespace nook::lab;

namespace {

double fetches_of(const std::string& name) {
  static const CostReport report = from_json(nlohmann::json::parse(
      file_text(std::string(NOOK_SOURCE_ROOT) + "/tests/bakers/lab/gpu_cost/counts.json")));
  REQUIRE(report.families.at(0).family == "navi21");
  for (const ShaderCost& shader : report.families[0].shaders)
    if (shader.shader == name) return shader.counts[InstructionClass::fetch];
  FAIL("no counts of " << name);
  return 0;
}

}  // namespace

TEST_CASE(
    "the network fetches depths of the pixel and its four neighbours, the host's normal, and one depth a "
    "tap") {
  for (const int taps : {9, 16, 32, 64})
    CHECK(fetches_of("occlusion.frag, " + std::to_string(taps)) == 6 + taps);
  // The filter takes seven values of AO along each axis.
  CHECK(fetches_of("filter.frag along x") == 7);
  CHECK(fetches_of("resolve.frag") == 7);
}

TEST_CASE("HBAO fetches depth and normal of the pixel and one depth a tap") {
  for (const int taps : {16, 32, 64}) CHECK(fetches_of("HBAO " + std::to_string(taps)) == 2 + taps);
}

TEST_CASE("a grid of probes takes three texels, and for each lobe its shape and eight amplitudes") {
  for (const int lobes : {6, 12, 24})
    CHECK(fetches_of("probe grid, irradiance, " + std::to_string(lobes) + " lobes") == 3 + 9 * lobes);
}

TEST_CASE("materials fetch what docs/lab/material_decoding.md counts") {
  CHECK(fetches_of("material, fiber, N-SVD") == 392);
  CHECK(fetches_of("material, fiber, K-CTA, K = 3") == 83);
  CHECK(fetches_of("material, roughhole, N-SVD") == 362);
  // Its loop over three terms stays a loop, and the fetch of a fourth cluster is counted in each turn, though
  // none takes it.
  CHECK(fetches_of("material, roughhole, K-CTA, K = 3") == 128 + 3);
  // A second place along the pixel fetches the modes of radiance and of the VOTF once more, 54 of the 83.
  CHECK(fetches_of("material, fiber, K-CTA, K = 3, two fetches") == 83 + 54);
  CHECK(fetches_of("neural material, small, two fetches") == 2 * 6);
}

TEST_CASE("the feedback shader fetches the bias, the attributes of four influences, and their key points") {
  // The four 16-bit indices take two fetches, since the compiler does not know how their buffer is aligned.
  // With light there are two texels for a key point.
  const int attributes = 1 + 2 + 1 + 1;
  CHECK(fetches_of("vertices.vert, 4 influences") == attributes + 4);
  CHECK(fetches_of("vertices.vert, 4 influences, light") == attributes + 2 * 4);
}

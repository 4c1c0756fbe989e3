// The comparisons with an evaluation that ray traces itself, so that the errors are known.
#include <nook/experimental/nook_debug.h>
#include <nook/nook_character.h>

#include <algorithm>
#include <cmath>

#include "bakers/lab/crowd/comparison.h"
#include "bakers/lab/crowd/sheet.h"
#include "tests/bakers/lab/crowd/plates.h"
#include "tests/catch.h"

using namespace nook::lab::crowd;

namespace {

// Ray traces AO with the ground if the terms have it, and never without neighbours.
class TracedCrowd final : public EvaluatedCrowd {
 public:
  explicit TracedCrowd(const PosedCrowd& crowd) : crowd_(crowd) {}

  void update(std::uint32_t terms) override { ground_ = (terms & NOOK_TERM_GROUND) != 0; }
  std::vector<float> ao(std::uint32_t character) const override {
    return traced_ao(crowd_, std::span(&character, 1), {1024, 77, ground_})[0];
  }
  std::vector<float> static_ao() const override { return std::vector<float>(crowd_.vertex_count(), 1.0f); }
  float gamma() const override { return 1; }
  VertexValues directional_ao(std::span<const std::uint32_t> characters,
                              std::span<const nook_lobe>) override {
    return VertexValues(characters.size(), std::vector<float>(3 * std::size_t(crowd_.vertex_count()), 1.0f));
  }

 private:
  const PosedCrowd& crowd_;
  bool ground_ = true;
};

// Draws pictures of one colour and counts the panels.
class CountingRenderer final : public PanelRenderer {
 public:
  platform::Image draw(const Group& group, const AoPanel& panel) override {
    CHECK((panel.ao.empty() || panel.ao.size() == group.members.size()));
    ao += !panel.ao.empty();
    screen_space += panel.screen_space != ScreenSpace::nowhere;
    floors += panel.floor_ao.has_value();
    return picture();
  }
  platform::Image draw(const Group& group, const IrradiancePanel& panel) override {
    CHECK(panel.irradiance.size() == group.members.size());
    CHECK(panel.floor.values.size() == 3 * std::size_t(panel.floor.patch.side) * panel.floor.patch.side);
    return picture();
  }

  int ao = 0, screen_space = 0, floors = 0;

 private:
  static platform::Image picture() { return {40, 50, 3, std::vector<std::uint8_t>(40 * 50 * 3, 128)}; }
};

// Two pairs of plates, one above the other with a gap of 0.6 m, and a plate that stands alone.
struct Scene {
  plates::Character character = plates::make_character();
  std::vector<Bones> poses{plates::pose(0, 0.1f, 0), plates::pose(0, 0.7f, 0), plates::pose(9, 0.1f, 0),
                           plates::pose(9, 0.7f, 0), plates::pose(4, 0.5f, 5, 0.25f)};
  std::vector<Place> places{{0, 0}, {0, 0}, {9, 0}, {9, 0}, {4, 5}};
  PosedCrowd crowd{character.get(), poses};
  TracedCrowd evaluated{crowd};
  CountingRenderer renderer;
  Subject subject{crowd, places, evaluated, renderer, 1};
};

}  // namespace

TEST_CASE("an evaluation that ray traces has the error of its noise, static AO has much more") {
  Scene scene;
  const AoErrors errors = measure_ao(scene.subject);
  CHECK(errors.characters == 4);
  CHECK(errors.have_neighbours);
  REQUIRE(errors.forms.size() == 5);
  CHECK(errors.forms[3].form == "all");
  // Both have the same expectation, and the reference with its 128 rays of 1,024 has most of the noise. Of a
  // hundred vertices with unequal noise either estimate of it may be off by half.
  CHECK(errors.forms[3].errors.mse < 2 * errors.noise_floor_mse);
  CHECK(errors.forms[3].errors.mse > errors.noise_floor_mse / 2);
  CHECK(errors.noise_floor_mse > 0);
  CHECK(errors.forms[4].form == "static");
  CHECK(errors.forms[4].errors.mse > 20 * errors.forms[3].errors.mse);
}

TEST_CASE("errors over visible vertices leave out what ray tracing finds black") {
  const plates::Character character = plates::make_character();
  const std::vector<Bones> poses{plates::pose(0, 0, 0)};
  const PosedCrowd crowd{character.get(), poses};
  // The first ten vertices are black in the reference and far off, the others are nearly right.
  VertexValues reference{std::vector<float>(plates::kVertices, 0.5f)},
      values{std::vector<float>(plates::kVertices, 0.6f)};
  for (std::uint32_t v = 0; v < 10; ++v) {
    reference[0][v] = v % 2 ? 0.0f : 0.009f;
    values[0][v] = reference[0][v] + 0.4f;
  }
  const std::uint32_t only = 0;
  const Errors errors = compare(crowd, {&only, 1}, values, reference);
  // Differences of single-precision numbers near 0.5.
  CHECK(std::abs(errors.mse_visible - 0.01) < 1e-6);
  CHECK(std::abs(errors.mse - (10 * 0.16 + (plates::kUsed - 10) * 0.01) / plates::kUsed) < 1e-6);
  reference[0].assign(plates::kVertices, 0.0f);
  CHECK(compare(crowd, {&only, 1}, values, reference).mse_visible == 0);
}

TEST_CASE("the sheet has five panels, and three more with screen-space AO") {
  Scene scene;
  const platform::Image plain = ao_sheet(scene.subject, nullptr);
  CHECK(plain.width == 3 * 40 + 2 * 4);
  CHECK(plain.height == 2 * 50 + 4);
  CHECK(scene.renderer.ao == 5);
  CHECK(scene.renderer.screen_space == 0);

  scene.renderer = {};
  const ScreenSpaceSettings settings{16, true, 0.5f};
  const platform::Image whole = ao_sheet(scene.subject, &settings);
  CHECK(whole.width == 4 * 40 + 3 * 4);
  CHECK(scene.renderer.ao == 6);
  CHECK(scene.renderer.screen_space == 2);
  CHECK(scene.renderer.floors == 1);
}

TEST_CASE("under constant light AO is all that counts, and what has no occlusion is wrong") {
  Scene scene;
  const std::vector<float> rgb(3 * 8 * 4, 1.0f);
  nook_lobe lobe{};
  lobe.axis[1] = 1;
  for (float& channel : lobe.amplitude) channel = 1;
  const Light light{std::span(&lobe, 1), {rgb.data(), 8, 4}, 1.0f};
  const LightErrors errors = measure_light(scene.subject, light);
  REQUIRE(errors.forms.size() == 3);
  // The variance of the reference's mean of twice 64 rays, and the variance of the evaluation's 1,024 rays.
  CHECK(errors.forms[0].errors.mse < 3 * errors.noise_floor_mse);
  CHECK(errors.forms[2].errors.mse > 20 * errors.noise_floor_mse);
  CHECK(light_sheet(scene.subject, light).width == 2 * 40 + 4);
}

TEST_CASE("a label leaves the picture below its strip as it is") {
  platform::Image image{60, 40, 3, std::vector<std::uint8_t>(60 * 40 * 3, 128)};
  draw_label(image, "AO");
  const auto strip_end = image.pixels.begin() + 60 * 3 * label_height_px;
  CHECK(std::count(image.pixels.begin(), strip_end, std::uint8_t(240)) > 0);
  CHECK(std::count(image.pixels.begin(), strip_end, std::uint8_t(128)) == 0);
  CHECK(std::all_of(strip_end, image.pixels.end(), [](std::uint8_t value) { return value == 128; }));
}

// The shipped GLSL gives what the CPU reference gives, in every form and however the layers are split.
#include <algorithm>
#include <cmath>

#include "sdk/src/material/parabolic.h"
#include "tests/gl/material_decoder.h"
#include "tests/gl/test_context.h"
#include "tests/material/material_sample.h"

using namespace nook;
using namespace nook::test;
using Size = material::test::SampleSize;

namespace {

constexpr float bound = 1.0f / 255;
// llvmpipe interpolates the levels of RGTC with weights in bytes, so that some are off by 1 / 127. Modes have
// coefficients of up to 2 here, and a fault of layout gives differences of 0.5.
constexpr float rgtc_bound = 4.0f / 127, rgtc_mean_bound = 5e-4f;

constexpr nook_material_modes plain = NOOK_MATERIAL_MODES_PLAIN;

struct Form : Size {
  nook_material_modes modes = plain;
  int whole_light_modes = 4;
};

// N-SVD, CTA, K-CTA, K-CTA resampled, ranks that are no multiples of four, more terms than one texel of the
// membership holds, one texel, no VOTF; integers of several of these; reliefs; neural materials; blocks of
// several of these, with sides that are no multiples of four.
const Size forms[] = {
    {.width = 16, .height = 16, .rank_view = 8, .clusters = 1, .mixture = 1},
    {.width = 16, .height = 8, .clusters = 5, .mixture = 1},
    {.width = 12, .height = 12, .rank_light = 8, .clusters = 5, .mixture = 3},
    {.width = 16, .height = 16, .clusters = 6, .mixture = 3, .map_side = 24},
    {.rank_light = 3, .rank_view = 5, .visibility = material::VisibilityForm::binary},
    {.views = 14, .rank_view = 1, .clusters = 9, .mixture = 6},
    {.width = 1, .height = 1, .rank_x = 1, .rank_y = 1},
    {.visibility = material::VisibilityForm::none},
    {.width = 16, .height = 16, .clusters = 6, .mixture = 3, .map_side = 24, .bits = 8},
    {.width = 12, .height = 8, .rank_light = 8, .rank_view = 8, .clusters = 1, .mixture = 1, .bits = 8},
    {.views = 14, .rank_view = 5, .clusters = 9, .mixture = 4, .map_side = 6, .bits = 8},
    {.visibility = material::VisibilityForm::none, .bits = 8},
    {.width = 16, .height = 16, .clusters = 6, .map_side = 24, .relief_height = 0.05f, .relief_steps = 8},
    {.width = 12, .height = 7, .bits = 8, .relief_height = 0.05f, .relief_steps = 5},
    {.width = 12, .height = 8, .map_side = 6, .bits = 8, .relief_height = -0.3f},
    {.width = 16, .height = 8, .channels = 16, .units = 32},
    {.width = 7, .height = 10, .map_side = 6, .channels = 4, .units = 8, .layers = 1},
    {.visibility = material::VisibilityForm::none, .channels = 8, .units = 12, .layers = 4},
};

// In the blocks that every context of its kind has.
const Form block_forms[] = {
    {{.width = 16, .height = 16, .rank_light = 8, .clusters = 6, .mixture = 3, .map_side = 24, .bits = 8}},
    {{.width = 13, .height = 6, .rank_light = 7, .rank_view = 5, .clusters = 1, .mixture = 1}},
    {{.width = 7, .height = 12, .clusters = 5, .mixture = 2}, plain, 0},
    {{.width = 1, .height = 1, .rank_x = 1, .rank_y = 1}, plain, 0},
    {{.width = 12, .height = 7, .rank_light = 8, .bits = 8, .relief_height = 0.05f, .relief_steps = 5}},
};

std::vector<Form> forms_of(const platform::Context& context) {
  std::vector<Form> all;
  for (const Size& size : forms) all.push_back({size});
  for (Form form : block_forms) {
    form.modes = context.is_es() ? NOOK_MATERIAL_MODES_EAC : NOOK_MATERIAL_MODES_RGTC;
    all.push_back(form);
  }
  return all;
}

void put(float (&out)[3], Vec3 v) {
  out[0] = v.x;
  out[1] = v.y;
  out[2] = v.z;
}

// Views lie inside cells of the view map, or of its parts, off their borders: there another order of rounding
// may choose the other cell. Levels are whole, since OpenGL leaves how they mix to the driver.
std::vector<nook_material_sample> samples_of(const nook_material_info& info, std::size_t count) {
  material::test::Numbers numbers(17);
  const std::uint32_t side =
      info.btf.view_map_side ? 256 / info.btf.view_map_side * info.btf.view_map_side : 256;
  const auto levels = std::uint32_t(std::log2(float(std::max(info.width, info.height)))) + 1;
  std::vector<nook_material_sample> samples(count);
  for (nook_material_sample& s : samples) {
    s.uv[0] = numbers.between(-2, 3);
    s.uv[1] = numbers.between(-2, 3);
    s.level = float(numbers.below(levels + 1));
    material::ParabolicPoint p;
    do {
      p.x = (float(numbers.below(side)) + numbers.between(0.1f, 0.9f)) / float(side) * 2 - 1;
      p.y = (float(numbers.below(side)) + numbers.between(0.1f, 0.9f)) / float(side) * 2 - 1;
    } while (p.x * p.x + p.y * p.y >= 1);
    put(s.view, material::from_parabolic(p));
    put(s.light, normalised({numbers.between(-1, 1), numbers.between(-1, 1), numbers.between(-0.2f, 1)}));
  }
  return samples;
}

float difference(const nook_material_value& a, const nook_material_value& b) {
  float largest = std::max(std::abs(a.occlusion - b.occlusion), std::abs(a.visibility - b.visibility));
  for (int i = 0; i < 3; ++i) largest = std::max(largest, std::abs(a.radiance[i] - b.radiance[i]));
  return largest;
}

}  // namespace

TEST_CASE("material: the GLSL agrees with the CPU reference to 1/255") {
  NOOK_NEED_CONTEXT(context);
  MaterialFixture fixture(context);
  const std::vector<Form> all = forms_of(context);
  for (const Form& form : all) {
    const nook_material loaded =
        fixture.load(material::test::sample_material(21, form), form.modes, form.whole_light_modes);
    const nook_material_info info = info_of(loaded);
    const MaterialDecoder decoder(context.gl(), fixture.upload(loaded), info);
    const std::vector<nook_material_sample> samples = samples_of(info, 2048);
    std::vector<nook_material_value> wanted(samples.size());
    NOOK_OK_OR_FAIL(
        nook_material_evaluate(loaded, samples.data(), std::uint32_t(samples.size()), wanted.data()));
    const std::vector<GpuValue> got = decoder.decode(samples);
    const bool is_rgtc = form.modes == NOOK_MATERIAL_MODES_RGTC;
    float brightest = 0, sum = 0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      INFO("form " << &form - all.data() << ", sample " << i << ", level " << samples[i].level);
      // The mapping (26) steps from weight times threshold to 1; on either side both may be right.
      nook_material_value value = got[i].value;
      if (std::abs(wanted[i].occlusion - info.visibility_threshold) < 1e-4f)
        value.visibility = wanted[i].visibility;
      // Visibility is weight times the VOTF's value: so much larger is its difference.
      if (is_rgtc) value.visibility = wanted[i].visibility;
      CHECK(difference(value, wanted[i]) <= (is_rgtc ? rgtc_bound : bound));
      sum += difference(value, wanted[i]);
      for (const float radiance : wanted[i].radiance) brightest = std::max(brightest, std::abs(radiance));
    }
    CHECK(brightest > 0.5f);
    CHECK(sum / float(samples.size()) < (is_rgtc ? rgtc_mean_bound : bound));
  }
}

TEST_CASE("material: layers split over several textures give the same picture") {
  NOOK_NEED_CONTEXT(context);
  MaterialFixture fixture(context);
  const nook_material loaded = fixture.load(material::test::sample_material(
      5, {.width = 8, .height = 8, .rank_light = 8, .clusters = 5, .mixture = 2}));
  const nook_material_info info = info_of(loaded);
  const std::vector<nook_material_sample> samples = samples_of(info, 512);
  const nook_gl_material whole = fixture.upload(loaded);
  CHECK(info_of(whole).texture_count == 7);
  const std::vector<GpuValue> wanted = MaterialDecoder(context.gl(), whole, info).decode(samples);
  for (const int layers : {39, 16, 7}) {
    const nook_gl_material split = fixture.upload(loaded, layers);
    // 40 layers of the BTF, 5 of the VOTF.
    CHECK(info_of(split).texture_count == 5u + std::uint32_t((40 + layers - 1) / layers + 1));
    CHECK(info_of(split).texture_bytes == info_of(whole).texture_bytes);
    const std::vector<GpuValue> got = MaterialDecoder(context.gl(), split, info).decode(samples);
    for (std::size_t i = 0; i < samples.size(); ++i) CHECK(difference(got[i].value, wanted[i].value) == 0);
  }
}

TEST_CASE("material: more layers than OpenGL 3.3 guarantees are split") {
  NOOK_NEED_CONTEXT(context);
  MaterialFixture fixture(context);
  const nook_material loaded = fixture.load(material::test::sample_material(5, {.lights = 30,
                                                                                .views = 20,
                                                                                .width = 4,
                                                                                .height = 4,
                                                                                .rank_light = 16,
                                                                                .rank_view = 4,
                                                                                .clusters = 20}));
  const nook_material_info info = info_of(loaded);
  const std::vector<nook_material_sample> samples = samples_of(info, 256);
  std::vector<nook_material_value> wanted(samples.size());
  NOOK_OK_OR_FAIL(nook_material_evaluate(loaded, samples.data(), 256, wanted.data()));
  const nook_gl_material split = fixture.upload(loaded, 256);
  CHECK(info_of(split).texture_count == 8);  // 320 layers in two arrays
  const std::vector<GpuValue> got = MaterialDecoder(context.gl(), split, info).decode(samples);
  for (std::size_t i = 0; i < samples.size(); ++i) CHECK(difference(got[i].value, wanted[i]) <= bound);
}

TEST_CASE("material: blocks are split in pairs of layers, and refused where a context lacks them") {
  NOOK_NEED_CONTEXT(context);
  MaterialFixture fixture(context);
  const nook_material_modes modes = context.is_es() ? NOOK_MATERIAL_MODES_EAC : NOOK_MATERIAL_MODES_RGTC;
  const material::Material sample = material::test::sample_material(
      5, {.width = 9, .height = 8, .rank_light = 8, .clusters = 5, .mixture = 2});
  const nook_material loaded = fixture.load(sample, modes);
  const nook_material_info info = info_of(loaded);
  const std::vector<nook_material_sample> samples = samples_of(info, 256);
  const nook_gl_material whole = fixture.upload(loaded);
  CHECK(info_of(whole).texture_bytes == info.table_bytes);
  CHECK(info_of(whole).texture_count == 8);
  const std::vector<GpuValue> wanted = MaterialDecoder(context.gl(), whole, info).decode(samples);
  for (const int layers : {39, 21, 12}) {
    // 20 layers of the BTF as integers and 40 in blocks, 10 of the VOTF.
    const nook_gl_material split = fixture.upload(loaded, layers);
    const int pairs = layers / 2;
    CHECK(int(info_of(split).texture_count) ==
          5 + (20 + layers - 1) / layers + (20 + pairs - 1) / pairs + (5 + pairs - 1) / pairs);
    const std::vector<GpuValue> got = MaterialDecoder(context.gl(), split, info).decode(samples);
    for (std::size_t i = 0; i < samples.size(); ++i) CHECK(difference(got[i].value, wanted[i].value) == 0);
  }
  for (const nook_material_modes other : {NOOK_MATERIAL_MODES_RGTC, NOOK_MATERIAL_MODES_EAC}) {
    nook_gl_material uploaded = nullptr;
    const nook_result result =
        nook_gl_material_create(fixture.gl, fixture.load(sample, other), nullptr, &uploaded);
    CHECK((result == NOOK_OK || (other != modes && result == NOOK_ERROR_UNSUPPORTED)));
    CHECK((uploaded != nullptr) == (result == NOOK_OK));
    nook_gl_material_destroy(&uploaded);
  }
}

TEST_CASE("material: a pixel has the stated number of fetches") {
  NOOK_NEED_CONTEXT(context);
  MaterialFixture fixture(context);
  const std::vector<Form> all = forms_of(context);
  for (const Form& form : all) {
    const nook_material loaded =
        fixture.load(material::test::sample_material(2, form), form.modes, form.whole_light_modes);
    const nook_material_info info = info_of(loaded);
    nook_material_sample sample{};
    sample.view[2] = sample.light[2] = 1;
    const GpuValue got = MaterialDecoder(context.gl(), fixture.upload(loaded), info).decode({sample})[0];
    // A march ends where it meets the relief, after its first plane or later.
    CHECK(got.decode_fetches <= float(info.decode_fetches));
    CHECK(got.decode_fetches >= float(info.decode_fetches - form.relief_steps));
    CHECK(got.light_fetches == float(info.light_fetches));
    CHECK(got.occlusion_fetches == float(info.occlusion_fetches));
  }
}

TEST_CASE("material: a far view is the average of a near one") {
  NOOK_NEED_CONTEXT(context);
  MaterialFixture fixture(context);
  for (const std::uint32_t texels : {16u, 12u, 7u}) {
    const nook_material loaded = fixture.load(material::test::sample_material(
        3, {.width = texels, .height = texels, .rank_x = 5, .clusters = 4, .mixture = 3}));
    const nook_material_info info = info_of(loaded);
    const MaterialDecoder decoder(context.gl(), fixture.upload(loaded), info);
    nook_material_sample sample{};
    put(sample.view, normalised({0.4f, 0.3f, 0.7f}));
    put(sample.light, normalised({-0.2f, 0.5f, 0.6f}));
    // Near: a pixel for each texel. Far: the whole tile, and eight tiles, in one pixel.
    std::vector<nook_material_sample> near;
    for (std::uint32_t y = 0; y < texels; ++y)
      for (std::uint32_t x = 0; x < texels; ++x) {
        near.push_back(sample);
        near.back().uv[0] = (float(x) + 0.5f) / float(texels);
        near.back().uv[1] = (float(y) + 0.5f) / float(texels);
      }
    nook_material_value mean{};
    for (const GpuValue& pixel : decoder.decode(near)) {
      for (int i = 0; i < 3; ++i) mean.radiance[i] += pixel.value.radiance[i] / float(near.size());
      mean.occlusion += pixel.value.occlusion / float(near.size());
    }
    sample.uv[0] = 0.31f;
    sample.level = std::ceil(std::log2(float(texels)));
    std::vector<nook_material_sample> far{sample, sample};
    far[1].level += 3;
    for (const GpuValue& pixel : decoder.decode(far)) {
      nook_material_value got = pixel.value;
      mean.visibility = got.visibility;  // not linear
      // Half floats in both.
      CHECK(difference(got, mean) <= 1e-3f);
    }
  }
}

// The shipped GLSL gives what the CPU reference gives, in every form and however the layers are split.
#include <algorithm>
#include <cmath>
#include <limits>

#include "sdk/src/material/material_file.h"
#include "sdk/src/material/parabolic.h"
#include "sdk/src/material/reflectance.h"
#include "sdk/src/material/tables.h"
#include "tests/gl/filter_weights.h"
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

// Of a driver that weighs texels with few bits, beside what its weights explain (reaches_of): it filters
// integers of 8 bits with few bits too, and the levels of RGTC are off by 1 / 127 more often. On NVIDIA's the
// largest difference was 0.0195 where the weights explain none, and 2.2 times what they explain elsewhere,
// because each fetch has errors of its own; with RGTC the largest was 0.073 and the largest mean 0.006.
constexpr float coarse_bound = 6.0f / 255, coarse_rgtc_bound = 10.0f / 127, coarse_rgtc_mean_bound = 0.01f;
constexpr float times_reach = 2;
// Weights with a smaller error are floats.
constexpr float exact_weights = 1e-4f;

constexpr nook_material_blocks plain = NOOK_MATERIAL_BLOCKS_NONE;

struct Form : Size {
  nook_material_blocks modes = plain;
  int whole_light_modes = 4;
};

// N-SVD, CTA, K-CTA, K-CTA resampled, ranks that are not multiples of four, more terms than one texel of the
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
    form.modes = context.is_es() ? NOOK_MATERIAL_BLOCKS_EAC : NOOK_MATERIAL_BLOCKS_RGTC;
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
std::vector<LevelPixel> samples_of(const nook_material_info& info, std::size_t count) {
  material::test::Numbers numbers(17);
  const std::uint32_t side =
      info.btf.view_map_side ? 256 / info.btf.view_map_side * info.btf.view_map_side : 256;
  const auto levels = std::uint32_t(std::log2(float(std::max(info.width, info.height)))) + 1;
  std::vector<LevelPixel> samples(count);
  for (LevelPixel& s : samples) {
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

// A footprint in texels: an ellipse turned by `axis`, seen through pixels that are turned by `screen`.
void put_sides(nook_material_pixel& pixel, const nook_material_info& info, float longer, float shorter,
               float axis, float screen) {
  const auto side = [&](float(&out)[2], float along, float across) {
    out[0] = (std::cos(axis) * along - std::sin(axis) * across) / float(info.width);
    out[1] = (std::sin(axis) * along + std::cos(axis) * across) / float(info.height);
  };
  side(pixel.dx, longer * std::cos(screen), shorter * std::sin(screen));
  side(pixel.dy, -longer * std::sin(screen), shorter * std::cos(screen));
}

// Places and directions of samples_of, with footprints whose level is whole for that many fetches: longer
// than these cover, of the length that they cover, or shorter.
std::vector<nook_material_pixel> pixels_of(const nook_material_info& info, std::size_t count, int fetches) {
  material::test::Numbers numbers(23);
  std::vector<nook_material_pixel> pixels;
  for (const LevelPixel& s : samples_of(info, count)) {
    nook_material_pixel pixel{};
    std::copy_n(s.uv, 2, pixel.uv);
    std::copy_n(s.view, 3, pixel.view);
    std::copy_n(s.light, 3, pixel.light);
    const float side = std::exp2(s.level), longer = numbers.between(1, float(fetches));
    const bool is_longer = numbers.below(2) == 0;
    put_sides(pixel, info, side * (is_longer ? float(fetches) : longer),
              side * (is_longer ? numbers.between(0, 1) : 1), numbers.between(0, 6.3f),
              numbers.between(0, 6.3f));
    pixels.push_back(pixel);
  }
  return pixels;
}

// A form that was uploaded, with a program that decodes it.
struct Uploaded {
  Uploaded(MaterialFixture& fixture, const Form& form)
      : weight_error(filter_weight_error(fixture.context.gl())),
        loaded(fixture.load(material::test::sample_material(21, form), form.modes, form.whole_light_modes)),
        info(info_of(loaded)),
        is_rgtc(form.modes == NOOK_MATERIAL_BLOCKS_RGTC),
        decoder(fixture.context.gl(), fixture.upload(loaded), info, true) {}

  float weight_error;
  nook_material loaded;
  nook_material_info info;
  bool is_rgtc;
  MaterialDecoder decoder;
};

float visibility_of(float occlusion, const nook_material_info& info) {
  return material::visibility_of(material::VisibilityForm(info.visibility),
                                 {info.visibility_threshold, info.visibility_weight}, occlusion);
}

// Returns how far each value may be from the reference because the driver weighs texels with few bits: the
// largest difference of the reference where the place in the tile and the light move by the error of the
// weights, up and down along both axes. Nothing where the weights are floats. level: of an item.
template <class Item, class Level, class Evaluate>
std::vector<float> reaches_of(const std::vector<Item>& items, const std::vector<nook_material_value>& wanted,
                              float weight_error, const nook_material_info& info, Level level,
                              Evaluate evaluate) {
  std::vector<float> reaches(items.size(), 0.0f);
  if (weight_error <= exact_weights) return reaches;
  constexpr float light_texels = 32;  // along a side of the smallest table of light modes
  for (unsigned corner = 0; corner < 16; ++corner) {
    const auto sign = [&](unsigned bit) { return corner >> bit & 1 ? weight_error : -weight_error; };
    std::vector<Item> moved = items;
    for (Item& item : moved) {
      const float texels = std::exp2(level(item));
      item.uv[0] += sign(0) * texels / float(info.width);
      item.uv[1] += sign(1) * texels / float(info.height);
      if (item.light[2] <= 0) continue;
      const material::ParabolicPoint p =
          material::to_parabolic({item.light[0], item.light[1], item.light[2]});
      put(item.light,
          material::from_parabolic({p.x + 2 * sign(2) / light_texels, p.y + 2 * sign(3) / light_texels}));
    }
    std::vector<nook_material_value> values = evaluate(moved);
    for (std::size_t i = 0; i < items.size(); ++i) {
      values[i].visibility = wanted[i].visibility;  // it steps
      reaches[i] = std::max(reaches[i], difference(values[i], wanted[i]));
    }
  }
  return reaches;
}

// The mapping (26) steps from weight times threshold to 1; on either side both may be right. Visibility is
// weight times the VOTF's value: so much larger is its difference. With RGTC it belongs to the value that the
// driver's levels gave.
void check_agreement(const std::vector<GpuValue>& got, const std::vector<nook_material_value>& wanted,
                     const std::vector<float>& reaches, const Uploaded& form) {
  REQUIRE(got.size() == wanted.size());
  const bool is_coarse = form.weight_error > exact_weights;
  const float largest =
      is_coarse ? (form.is_rgtc ? coarse_rgtc_bound : coarse_bound) : (form.is_rgtc ? rgtc_bound : bound);
  const float mean = !form.is_rgtc ? bound : is_coarse ? coarse_rgtc_mean_bound : rgtc_mean_bound;
  float sum = 0, sum_of_reaches = 0;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    INFO("sample or pixel " << i);
    nook_material_value value = got[i].value;
    if (form.is_rgtc || is_coarse)
      CHECK(std::abs(value.visibility - visibility_of(value.occlusion, form.info)) <= bound);
    if (form.is_rgtc || is_coarse || std::abs(wanted[i].occlusion - form.info.visibility_threshold) < 1e-4f)
      value.visibility = wanted[i].visibility;
    CHECK(difference(value, wanted[i]) <= largest + times_reach * reaches[i]);
    sum += difference(value, wanted[i]);
    sum_of_reaches += reaches[i];
  }
  CHECK(sum < mean * float(wanted.size()) + sum_of_reaches);
}

void check_samples(const Uploaded& form) {
  const std::vector<LevelPixel> samples = samples_of(form.info, 2048);
  const auto evaluate = [&](const std::vector<LevelPixel>& of) {
    std::vector<nook_material_value> values(of.size());
    NOOK_OK_OR_FAIL(nook_material_evaluate(form.loaded, round_pixels(of, form.info).data(),
                                           std::uint32_t(of.size()), 1, values.data()));
    return values;
  };
  const std::vector<nook_material_value> wanted = evaluate(samples);
  const auto level = [](const LevelPixel& sample) { return sample.level; };
  check_agreement(form.decoder.decode(samples), wanted,
                  reaches_of(samples, wanted, form.weight_error, form.info, level, evaluate), form);
  float brightest = 0;
  for (const nook_material_value& value : wanted)
    for (const float radiance : value.radiance) brightest = std::max(brightest, std::abs(radiance));
  CHECK(brightest > 0.5f);
}

void check_pixels(const Uploaded& form, int fetches) {
  const std::vector<nook_material_pixel> pixels = pixels_of(form.info, 512, fetches);
  const auto evaluate = [&](const std::vector<nook_material_pixel>& of) {
    std::vector<nook_material_value> values(of.size());
    NOOK_OK_OR_FAIL(nook_material_evaluate(form.loaded, of.data(), std::uint32_t(of.size()),
                                           std::uint32_t(fetches), values.data()));
    return values;
  };
  const std::vector<nook_material_value> wanted = evaluate(pixels);
  // The longer side, at least as long as the side of the fetches.
  const auto level = [&](const nook_material_pixel& p) {
    const auto length = [&](float x, float y) {
      return std::hypot(x * float(form.info.width), y * float(form.info.height));
    };
    return std::log2(std::max(length(p.dx[0], p.dx[1]), length(p.dy[0], p.dy[1])));
  };
  check_agreement(form.decoder.decode(pixels, fetches), wanted,
                  reaches_of(pixels, wanted, form.weight_error, form.info, level, evaluate), form);
}

// A march ends where it meets the relief, after its first plane or later.
void check_fetches(const Uploaded& form, std::uint32_t relief_steps) {
  const nook_material_info& info = form.info;
  nook_material_pixel pixel{};
  pixel.view[2] = pixel.light[2] = 1;
  put_sides(pixel, info, 4, 1, 1, 0);
  for (const int fetches : {0, 1, 3}) {
    const GpuValue got = form.decoder.decode(std::vector{pixel}, fetches)[0];
    const auto further = std::uint32_t(std::max(fetches - 1, 0));
    const std::uint32_t decoded = info.decode_fetches + further * info.further_decode_fetches;
    CHECK(got.decode_fetches <= float(decoded));
    CHECK(got.decode_fetches >= float(decoded - (further + 1) * relief_steps));
    CHECK(got.light_fetches == float(info.light_fetches));
    CHECK(got.occlusion_fetches == float(info.occlusion_fetches + further * info.further_occlusion_fetches));
  }
}

}  // namespace

TEST_CASE("material: the GLSL agrees with the CPU reference to 1/255, with the stated number of fetches") {
  NOOK_NEED_CONTEXT(context);
  MaterialFixture fixture(context);
  const std::vector<Form> all = forms_of(context);
  for (const Form& form : all) {
    INFO("form " << &form - all.data());
    const Uploaded uploaded(fixture, form);
    check_samples(uploaded);
    for (const int fetches : {2, 3}) check_pixels(uploaded, fetches);
    check_fetches(uploaded, form.relief_steps);
  }
}

TEST_CASE("material: round footprints are decoded as by one fetch, and others always to numbers") {
  NOOK_NEED_CONTEXT(context);
  MaterialFixture fixture(context);
  for (const Size& size :
       {Size{.width = 16, .height = 8, .map_side = 6},
        Size{.width = 16, .height = 8, .bits = 8, .relief_height = 0.05f, .relief_steps = 8},
        Size{.width = 16, .height = 8, .channels = 8}}) {
    const Uploaded form(fixture, {size});
    const nook_material_info& info = form.info;
    const MaterialDecoder& decoder = form.decoder;
    nook_material_pixel pixel{{0.3f, -1.4f}, {0, 0}, {0, 0}, {0.48f, 0.6f, 0.64f}, {0, 0.6f, 0.8f}};
    std::vector<nook_material_pixel> round;
    for (const float side : {0.5f, 1.0f, 3.0f, 4.0f, 64.0f}) {
      round.push_back(pixel);
      put_sides(round.back(), info, side, side, 0, 0);
    }
    round.push_back(pixel);  // no size
    const std::vector<GpuValue> wanted = decoder.decode(round, 0);
    for (const int fetches : {1, 2, 3, 8, 1000, -5}) {
      const std::vector<GpuValue> got = decoder.decode(round, fetches);
      for (std::size_t i = 0; i < round.size(); ++i) CHECK(difference(got[i].value, wanted[i].value) == 0);
    }
    const float infinite = std::numeric_limits<float>::infinity(), no_number = std::nanf("");
    std::vector<nook_material_pixel> bad;
    for (const float number : {infinite, no_number, 3e38f, -1e20f})
      for (int i = 0; i < 4; ++i) {
        bad.push_back(pixel);
        put_sides(bad.back(), info, 2, 1, 1, 0);
        (i < 2 ? bad.back().dx[i] : bad.back().dy[i - 2]) = number;
      }
    put_sides(pixel, info, 1e6f, 1e6f, 0, 0);
    const GpuValue coarsest = decoder.decode(std::vector{pixel}, 0)[0];
    for (const GpuValue& value : decoder.decode(bad, 2))
      CHECK(difference(value.value, coarsest.value) <= bound);
  }
}

TEST_CASE("material: layers split over several textures give the same picture") {
  NOOK_NEED_CONTEXT(context);
  MaterialFixture fixture(context);
  const nook_material loaded = fixture.load(material::test::sample_material(
      5, {.width = 8, .height = 8, .rank_light = 8, .clusters = 5, .mixture = 2}));
  const nook_material_info info = info_of(loaded);
  const std::vector<LevelPixel> samples = samples_of(info, 512);
  const nook_gl_upload whole = fixture.upload(loaded);
  CHECK(info_of(whole).texture_count == 7);
  const std::vector<GpuValue> wanted = MaterialDecoder(context.gl(), whole, info).decode(samples);
  for (const int layers : {39, 16, 7}) {
    const nook_gl_upload split = fixture.upload(loaded, layers);
    // 40 layers of the BTF, 5 of the VOTF.
    CHECK(info_of(split).texture_count == 5u + std::uint32_t((40 + layers - 1) / layers + 1));
    CHECK(info_of(split).bytes == info_of(whole).bytes);
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
  const std::vector<LevelPixel> samples = samples_of(info, 256);
  const auto evaluate = [&](const std::vector<LevelPixel>& of) {
    std::vector<nook_material_value> values(of.size());
    NOOK_OK_OR_FAIL(nook_material_evaluate(loaded, round_pixels(of, info).data(), std::uint32_t(of.size()), 1,
                                           values.data()));
    return values;
  };
  const std::vector<nook_material_value> wanted = evaluate(samples);
  const auto level = [](const LevelPixel& sample) { return sample.level; };
  const float weight_error = filter_weight_error(context.gl());
  const std::vector<float> reaches = reaches_of(samples, wanted, weight_error, info, level, evaluate);
  const nook_gl_upload split = fixture.upload(loaded, 256);
  CHECK(info_of(split).texture_count == 8);  // 320 layers in two arrays
  const std::vector<GpuValue> got = MaterialDecoder(context.gl(), split, info).decode(samples);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    nook_material_value value = got[i].value;
    const bool is_coarse = weight_error > exact_weights;
    if (is_coarse) value.visibility = wanted[i].visibility;
    CHECK(difference(value, wanted[i]) <= (is_coarse ? coarse_bound : bound) + times_reach * reaches[i]);
  }
}

TEST_CASE("material: blocks are split in pairs of layers, and either form is uploaded or refused") {
  NOOK_NEED_CONTEXT(context);
  MaterialFixture fixture(context);
  const nook_material_blocks modes = context.is_es() ? NOOK_MATERIAL_BLOCKS_EAC : NOOK_MATERIAL_BLOCKS_RGTC;
  const material::Material sample = material::test::sample_material(
      5, {.width = 9, .height = 8, .rank_light = 8, .clusters = 5, .mixture = 2});
  const nook_material loaded = fixture.load(sample, modes);
  const nook_material_info info = info_of(loaded);
  const std::vector<LevelPixel> samples = samples_of(info, 256);
  const nook_gl_upload whole = fixture.upload(loaded);
  CHECK(info_of(whole).bytes == info.table_bytes);
  CHECK(info_of(whole).texture_count == 8);
  const std::vector<GpuValue> wanted = MaterialDecoder(context.gl(), whole, info).decode(samples);
  for (const int layers : {39, 21, 12}) {
    // 20 layers of the BTF as integers and 40 in blocks, 10 of the VOTF.
    const nook_gl_upload split = fixture.upload(loaded, layers);
    const int pairs = layers / 2;
    CHECK(int(info_of(split).texture_count) ==
          5 + (20 + layers - 1) / layers + (20 + pairs - 1) / pairs + (5 + pairs - 1) / pairs);
    const std::vector<GpuValue> got = MaterialDecoder(context.gl(), split, info).decode(samples);
    for (std::size_t i = 0; i < samples.size(); ++i) CHECK(difference(got[i].value, wanted[i].value) == 0);
  }
  for (const nook_material_blocks other : {NOOK_MATERIAL_BLOCKS_RGTC, NOOK_MATERIAL_BLOCKS_EAC}) {
    nook_gl_upload uploaded = nullptr;
    const nook_result result = nook_gl_upload_material(fixture.gl, fixture.load(sample, other), &uploaded);
    CHECK((result == NOOK_OK || (other != modes && result == NOOK_ERROR_UNSUPPORTED)));
    CHECK((uploaded != nullptr) == (result == NOOK_OK));
    nook_gl_upload_destroy(&uploaded);
  }
}

TEST_CASE("material: a far view is the average of a near one") {
  NOOK_NEED_CONTEXT(context);
  MaterialFixture fixture(context);
  for (const std::uint32_t texels : {16u, 12u, 7u}) {
    const material::Material made = material::test::sample_material(
        3, {.width = texels, .height = texels, .rank_x = 5, .clusters = 4, .mixture = 3});
    const nook_material loaded = fixture.load(made);
    // Decoders clamp radiance at 0, which is not linear; the tables give it before.
    const material::MaterialTables tables = material::make_tables(
        material::read_material(material::write_material(made)), Parallel(), default_memory());
    const nook_material_info info = info_of(loaded);
    const MaterialDecoder decoder(context.gl(), fixture.upload(loaded), info);
    LevelPixel sample{};
    put(sample.view, normalised({0.4f, 0.3f, 0.7f}));
    put(sample.light, normalised({-0.2f, 0.5f, 0.6f}));
    // Near: a pixel for each texel. Far: the whole tile, and eight tiles, in one pixel.
    std::vector<LevelPixel> near;
    for (std::uint32_t y = 0; y < texels; ++y)
      for (std::uint32_t x = 0; x < texels; ++x) {
        near.push_back(sample);
        near.back().uv[0] = (float(x) + 0.5f) / float(texels);
        near.back().uv[1] = (float(y) + 0.5f) / float(texels);
      }
    nook_material_value mean{};
    const float share = 1 / float(near.size());
    for (const LevelPixel& pixel : near) {
      const material::Sample at{pixel.uv[0], pixel.uv[1], 0, normalised({0.4f, 0.3f, 0.7f}),
                                normalised({-0.2f, 0.5f, 0.6f})};
      const material::Radiance radiance = material::evaluate_btf(tables, at);
      mean.radiance[0] += share * radiance.red;
      mean.radiance[1] += share * radiance.green;
      mean.radiance[2] += share * radiance.blue;
      mean.occlusion += share * material::evaluate_votf(tables, at);
    }
    for (float& channel : mean.radiance) channel = std::max(channel, 0.0f);
    sample.uv[0] = 0.31f;
    sample.level = std::ceil(std::log2(float(texels)));
    std::vector<LevelPixel> far{sample, sample};
    far[1].level += 3;
    for (const GpuValue& pixel : decoder.decode(far)) {
      nook_material_value got = pixel.value;
      mean.visibility = got.visibility;  // not linear
      // Half floats in both.
      CHECK(difference(got, mean) <= 1e-3f);
    }
  }
}

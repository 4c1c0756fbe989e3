// Probes through the C interface: bad parameters, structs of other releases, memory.
#include <nook/experimental/nook_sg.h>
#include <nook/nook_probe.h>

#include <cmath>
#include <limits>
#include <string>

#include "tests/abi/growing_struct.h"
#include "tests/abi/host.h"

using namespace nook::test;

namespace {

constexpr nook_result invalid = NOOK_ERROR_INVALID_ARGUMENT;

bool last_is(const char* start, const char* part) {
  const std::string text = nook_last_message();
  return text.rfind(start, 0) == 0 && text.find(part) != std::string::npos;
}

nook_probe_fit_desc fit_desc() {
  nook_probe_fit_desc desc;
  nook_probe_fit_desc_init(&desc);
  return desc;
}

nook_probe_desc probe_desc() {
  nook_probe_desc desc;
  nook_probe_desc_init(&desc);
  return desc;
}

nook_probe_fit_study_desc study_desc() {
  nook_probe_fit_study_desc desc;
  nook_probe_fit_study_desc_init(&desc);
  return desc;
}

constexpr std::size_t sample_count = 500;
struct Sky {
  float directions[3 * sample_count], radiance[3 * sample_count];
  Sky() {
    for (std::size_t i = 0; i < sample_count; ++i) {
      const float z = 1 - 2 * (float(i) + 0.5f) / sample_count, r = std::sqrt(1 - z * z);
      directions[3 * i] = r * std::cos(2.4f * float(i));
      directions[3 * i + 1] = r * std::sin(2.4f * float(i));
      directions[3 * i + 2] = z;
      for (std::size_t c = 0; c < 3; ++c) radiance[3 * i + c] = 1 + z;
    }
  }
};

// A context, a fit with samples and its probe.
struct ProbeStage {
  Host host;
  nook_context context = nullptr;
  nook_probe_fit fit = nullptr;
  nook_probe probe = nullptr;
  Sky sky;

  ProbeStage() {
    const nook_context_desc context_desc = host.context_desc();
    nook_context_create(&context_desc, &context);
    const nook_probe_fit_desc desc = fit_desc();
    nook_probe_fit_create(context, &desc, &fit);
    nook_probe_fit_add_samples(fit, sky.directions, sky.radiance, nullptr, sample_count);
    nook_probe_fit_solve(fit, &probe);
  }
  ~ProbeStage() {
    nook_probe_destroy(&probe);
    nook_probe_fit_destroy(&fit);
    nook_context_destroy(&context);
  }
  ProbeStage(const ProbeStage&) = delete;
  ProbeStage& operator=(const ProbeStage&) = delete;
};

nook_result run_everything(Host& host) {
  nook_result first_failure = NOOK_OK;
  const auto note = [&](nook_result result) {
    if (first_failure == NOOK_OK) first_failure = result;
    return result == NOOK_OK;
  };
  const nook_context_desc context_desc = host.context_desc();
  nook_context context = nullptr;
  nook_probe_fit_desc desc = fit_desc();
  desc.ambient = 1;
  nook_probe_fit fit = nullptr;
  nook_probe probe = nullptr, loaded = nullptr;
  static const Sky sky;
  unsigned char file[4096];
  std::size_t size = sizeof file;
  if (note(nook_context_create(&context_desc, &context)) &&
      note(nook_probe_fit_create(context, &desc, &fit)) &&
      note(nook_probe_fit_add_samples(fit, sky.directions, sky.radiance, nullptr, sample_count)) &&
      note(nook_probe_fit_solve(fit, &probe)) &&
      note(nook_probe_save(probe, NOOK_PROBE_PACKING_FLOAT, file, &size)) &&
      note(nook_probe_load(context, file, size, &loaded))) {
  }
  nook_probe_destroy(&loaded);
  nook_probe_fit_destroy(&fit);
  nook_context_destroy(&context);
  nook_probe_destroy(&probe);
  return first_failure;
}

}  // namespace

// The sky is 1 + z: 2 from above, 1 in the mean, with the irradiance pi + 2 pi / 3 from above.
TEST_CASE("a fitted sky gives the light of the sky, as lobes and as harmonics") {
  const ProbeStage stage;
  nook_lobe lobes[12];
  REQUIRE(nook_probe_read_lobes(stage.probe, nullptr, lobes, 12) == NOOK_OK);
  const float up[3] = {0, 0, 1};
  float harmonics[27], zonal[15];
  REQUIRE(nook_sg_to_sh(lobes, 12, 2, harmonics) == NOOK_OK);
  REQUIRE(nook_sh_to_zh3(harmonics, zonal) == NOOK_OK);
  // Twelve wide lobes cannot follow a cosine exactly, and the fit weighs the sphere alike: a quarter of the
  // radiance at one point, about a hundredth of an integral.
  const auto radiance_from_above = [&](nook_result result, const float* rgb) {
    CHECK(result == NOOK_OK);
    CHECK(std::abs(rgb[0] - 2) < 0.5f);
  };
  const auto irradiance_from_above = [&](nook_result result, const float* rgb) {
    CHECK(result == NOOK_OK);
    CHECK(std::abs(rgb[0] - 5.236f) < 0.06f);
  };
  float rgb[3];
  radiance_from_above(nook_probe_radiance(stage.probe, nullptr, up, rgb, 1), rgb);
  radiance_from_above(nook_sg_radiance(lobes, 12, up, rgb, 1), rgb);
  radiance_from_above(nook_sh_radiance(harmonics, 2, up, rgb, 1), rgb);
  radiance_from_above(nook_sh_radiance(zonal, NOOK_SH_ZH3, up, rgb, 1), rgb);
  irradiance_from_above(nook_probe_irradiance(stage.probe, nullptr, up, rgb, 1), rgb);
  irradiance_from_above(nook_sg_irradiance(lobes, 12, NOOK_PROBE_IRRADIANCE_BANDS, up, rgb, 1), rgb);
  irradiance_from_above(nook_sh_irradiance(harmonics, 2, up, rgb, 1), rgb);
  irradiance_from_above(nook_sh_irradiance(zonal, NOOK_SH_ZH3, up, rgb, 1), rgb);
  CHECK(std::abs(harmonics[0] * 0.282095f - 1) < 0.02f);
  // A mirror that looks up shows the light above.
  const nook_probe_surface mirror{{0, 0, 1}, {0, 0, 1}, {1, 0, 0}, 0.1f, 0.1f, 1};
  radiance_from_above(nook_sg_specular(lobes, 12, NOOK_PROBE_SPECULAR_ANISOTROPIC, &mirror, rgb, 1), rgb);
}

TEST_CASE("gloss: fits have lobes for it that are never negative, and other probes say what they lack") {
  const ProbeStage stage;
  nook_lobe light[12], gloss[12];
  REQUIRE(nook_probe_read_lobes(stage.probe, nullptr, light, 12) == NOOK_OK);
  REQUIRE(nook_probe_read_gloss(stage.probe, nullptr, gloss, 12) == NOOK_OK);
  for (int i = 0; i < 12; ++i) {
    CHECK(std::equal(gloss[i].axis, gloss[i].axis + 3, light[i].axis));
    CHECK(gloss[i].sharpness == light[i].sharpness);
    CHECK(*std::min_element(gloss[i].amplitude, gloss[i].amplitude + 3) >= 0);
  }
  // A file keeps them, and a place looks them up.
  std::vector<std::byte> file(4096);
  std::size_t size = file.size();
  REQUIRE(nook_probe_save(stage.probe, NOOK_PROBE_PACKING_FLOAT, file.data(), &size) == NOOK_OK);
  nook_probe loaded = nullptr;
  REQUIRE(nook_probe_load(stage.context, file.data(), size, &loaded) == NOOK_OK);
  nook_lobe again[12];
  const float place[3] = {1, 2, 3};
  REQUIRE(nook_probe_read_gloss(loaded, place, again, 12) == NOOK_OK);
  CHECK(std::memcmp(again, gloss, sizeof gloss) == 0);
  nook_probe_destroy(&loaded);
  CHECK(nook_probe_read_gloss(stage.probe, nullptr, gloss, 11) == NOOK_ERROR_INVALID_ARGUMENT);
  // Lobes that the host gives are the light's alone.
  nook_probe_desc desc = probe_desc();
  desc.lobes = light;
  desc.lobe_count = 12;
  nook_probe given = nullptr;
  REQUIRE(nook_probe_create(stage.context, &desc, &given) == NOOK_OK);
  CHECK(nook_probe_read_gloss(given, nullptr, gloss, 12) == NOOK_ERROR_UNSUPPORTED);
  CHECK(last_is("nook_probe_read_gloss: ", "no gloss amplitudes"));
  nook_probe_destroy(&given);
}

TEST_CASE("lobes: the product is sharper than its factors, the convolution is wider, and axes turn") {
  nook_lobe lobes[2] = {{{1, 0, 0}, 4, {2, 1, 0}, 0}, {{0, 1, 0}, 6, {1, 1, 2}, 0}}, out;
  REQUIRE(nook_sg_product(&lobes[0], &lobes[1], &out) == NOOK_OK);
  // |4 x + 6 y|
  CHECK(std::abs(out.sharpness - std::sqrt(52.0f)) < 1e-5f);
  REQUIRE(nook_sg_convolve(&lobes[0], &lobes[1], &out) == NOOK_OK);
  CHECK(out.sharpness < 4);
  float rgb[3];
  REQUIRE(nook_sg_integral(&lobes[0], rgb) == NOOK_OK);
  // 2 pi a (1 - exp(-2 s)) / s
  CHECK(std::abs(rgb[0] - 2 * 3.14159265f * 2 * (1 - std::exp(-8.0f)) / 4) < 1e-5f);
  const float quarter_turn[9] = {0, -1, 0, 1, 0, 0, 0, 0, 1};
  REQUIRE(nook_sg_rotate(lobes, 2, quarter_turn) == NOOK_OK);
  CHECK(std::abs(lobes[0].axis[1] - 1) < 1e-6f);
  CHECK(std::abs(lobes[1].axis[0] + 1) < 1e-6f);
}

TEST_CASE("probes: structs of every release") {
  check_init<nook_probe_fit_desc>(nook_desc_init, NOOK_DESC_PROBE_FIT);
  check_init<nook_probe_desc>(nook_desc_init, NOOK_DESC_PROBE);
  check_init<nook_probe_fit_study_desc>(nook_desc_init, NOOK_DESC_PROBE_FIT_STUDY);
  ProbeStage stage;
  check_use(fit_desc(), [&](const nook_probe_fit_desc* desc) {
    nook_probe_fit fit = nullptr;
    const nook_result result = nook_probe_fit_create(stage.context, desc, &fit);
    nook_probe_fit_destroy(&fit);
    return result;
  });
  check_use(study_desc(), [&](const nook_probe_fit_study_desc* study) {
    nook_probe_fit_desc desc = fit_desc();
    desc.next = study;
    nook_probe_fit fit = nullptr;
    const nook_result result = nook_probe_fit_create(stage.context, &desc, &fit);
    nook_probe_fit_destroy(&fit);
    return result;
  });
  nook_probe_desc good = probe_desc();
  const std::vector<float> coefficients(36, 0.5f);
  good.functions = stage.fit;
  good.coefficients = coefficients.data();
  check_use(good, [&](const nook_probe_desc* desc) {
    nook_probe probe = nullptr;
    const nook_result result = nook_probe_create(stage.context, desc, &probe);
    nook_probe_destroy(&probe);
    return result;
  });
  check_info<nook_probe_fit_info>(
      [&](nook_probe_fit_info* info) { return nook_probe_fit_describe(stage.fit, info); });
  check_info<nook_probe_info>([&](nook_probe_info* info) { return nook_probe_describe(stage.probe, info); });
}

TEST_CASE("fits: bad descriptors name their field") {
  ProbeStage stage;
  nook_probe_fit fit = stage.fit;
  const auto refused = [&](auto&& change, const char* part) {
    nook_probe_fit_desc desc = fit_desc();
    change(desc);
    CHECK(nook_probe_fit_create(stage.context, &desc, &fit) == invalid);
    CHECK(fit == nullptr);
    INFO(nook_last_message());
    CHECK(last_is("nook_probe_fit_create: ", part));
  };
  using Desc = nook_probe_fit_desc;
  refused([](Desc& d) { d.method = 4; }, "desc.method is unknown (got 4");
  refused([](Desc& d) { d.form = 2; }, "desc.form is unknown (got 2, need 0 to 1)");
  refused([](Desc& d) { d.match_sh = 2; }, "desc.match_sh is unknown (got 2, need 0 to 1)");
  refused([](Desc& d) { d.form = NOOK_FORM_PAPER, d.match_sh = 0; },
          "NOOK_FORM_PAPER, which itself chooses desc.method and desc.match_sh");
  refused([](Desc& d) { d.form = NOOK_FORM_PAPER, d.method = NOOK_PROBE_FIT_RUNNING_AVERAGE; },
          "NOOK_FORM_PAPER, which itself chooses desc.method and desc.match_sh");
  refused([](Desc& d) { d.basis = -1; }, "desc.basis");
  refused([](Desc& d) { d.domain = 2; }, "desc.domain");
  refused([](Desc& d) { d.ambient = 2; }, "desc.ambient");
  refused([](Desc& d) { d.reserved = 1; }, "desc.reserved");
  refused([](Desc& d) { d.basis = NOOK_PROBE_BASIS_DICE; }, "desc.basis");
  refused([](Desc& d) { d.lobe_count = 0; }, "desc.lobe_count is out of range (got 0, need 1 to 64)");
  refused([](Desc& d) { d.lobe_count = 64, d.ambient = 1; }, "got 64, need 1 to 63");
  refused([](Desc& d) { d.sharpness = -1; }, "desc.sharpness");
  refused([](Desc& d) { d.sharpness = NAN; }, "desc.sharpness");
  refused([](Desc& d) { d.up[2] = 0.5f; }, "desc.up");
  refused([](Desc& d) { d.growing_samples = -1; }, "growing_samples");
  refused([](Desc& d) { d.basis = NOOK_PROBE_BASIS_SH, d.order = 5; }, "order of the harmonics");
  static const float same[] = {0, 0, 1, 0, 1, 0, 0, 0, 1};
  refused([](Desc& d) { d.axes = same, d.lobe_count = 3; },
          "lobe 2 (axis 0, 0, 1, sharpness 1.5) is the same function as lobe 0");
  static const float long_axis[] = {0, 0, 2};
  refused([](Desc& d) { d.axes = long_axis, d.lobe_count = 1; }, "axis of lobe 0");
  static const float flat[] = {6, 0};
  refused([](Desc& d) { d.sharpnesses = flat, d.lobe_count = 2; }, "sharpness of lobe 1");

  const nook_probe_fit_desc desc = fit_desc();
  CHECK(nook_probe_fit_create(nullptr, &desc, &fit) == invalid);
  CHECK(nook_probe_fit_create(stage.context, nullptr, &fit) == invalid);
  CHECK(nook_probe_fit_create(stage.context, &desc, nullptr) == invalid);
}

TEST_CASE("fits: bad extensions name their field") {
  ProbeStage stage;
  const auto refused = [&](auto&& change, const char* part) {
    nook_probe_fit_desc desc = fit_desc();
    nook_probe_fit_study_desc study = study_desc();
    desc.next = &study;
    change(desc, study);
    nook_probe_fit fit = stage.fit;
    CHECK(nook_probe_fit_create(stage.context, &desc, &fit) == invalid);
    CHECK(fit == nullptr);
    INFO(nook_last_message());
    CHECK(last_is("nook_probe_fit_create: ", part));
  };
  using Desc = nook_probe_fit_desc;
  using Study = nook_probe_fit_study_desc;
  refused([](Desc&, Study& s) { s.method = 4; }, "method of nook_probe_fit_study_desc is unknown (got 4");
  refused([](Desc&, Study& s) { s.published_step = 2; }, "published_step");
  refused([](Desc&, Study& s) { s.denominator = -1; }, "denominator");
  refused([](Desc&, Study& s) { s.dice = 2; }, "dice");
  refused([](Desc& d, Study& s) { d.form = NOOK_FORM_PAPER, s.method = NOOK_PROBE_FIT_STUDY_MOMENTS; },
          "replaces desc.form and desc.method");
  refused([](Desc& d, Study& s) { d.method = 1, s.method = NOOK_PROBE_FIT_STUDY_MOMENTS; },
          "replaces desc.form and desc.method");
  refused([](Desc&, Study& s) { s.next = &s; }, "two descriptors of the same type");
  nook_probe_desc other = probe_desc();
  refused([&](Desc& d, Study&) { d.next = &other; }, "cannot extend this one (got type 10)");
}

// The paper's form is a running average with the published step and without match_sh, and no other.
TEST_CASE("fits: the paper's form is the published method") {
  ProbeStage stage;
  const auto solved = [&](nook_probe_fit_desc desc, const nook_probe_fit_study_desc& study) {
    desc.next = &study;
    nook_probe_fit fit = nullptr;
    REQUIRE(nook_probe_fit_create(stage.context, &desc, &fit) == NOOK_OK);
    REQUIRE(nook_probe_fit_add_samples(fit, stage.sky.directions, stage.sky.radiance, nullptr,
                                       sample_count) == NOOK_OK);
    nook_probe probe = nullptr;
    REQUIRE(nook_probe_fit_solve(fit, &probe) == NOOK_OK);
    std::vector<float> coefficients(36);
    REQUIRE(nook_probe_read_coefficients(probe, 0, coefficients.data(), 12) == NOOK_OK);
    nook_probe_destroy(&probe);
    nook_probe_fit_destroy(&fit);
    return coefficients;
  };
  nook_probe_fit_desc paper = fit_desc(), by_hand = fit_desc();
  paper.form = NOOK_FORM_PAPER;
  by_hand.method = NOOK_PROBE_FIT_RUNNING_AVERAGE;
  by_hand.match_sh = 0;
  nook_probe_fit_study_desc published = study_desc(), exact = study_desc();
  published.published_step = 1;
  exact.denominator = NOOK_PROBE_DENOMINATOR_PRECOMPUTED;
  const std::vector<float> expected = solved(paper, study_desc());
  CHECK(solved(by_hand, published) == expected);
  CHECK(solved(by_hand, study_desc()) != expected);
  by_hand.match_sh = 1;
  CHECK(solved(by_hand, published) != expected);
  CHECK(solved(paper, exact) != expected);
}

TEST_CASE("ambient dice are a basis of studies") {
  ProbeStage stage;
  nook_probe_fit_desc desc = fit_desc();
  nook_probe_fit_study_desc study = study_desc();
  study.dice = 1;
  desc.next = &study;
  nook_probe_fit fit = nullptr;
  nook_probe probe = nullptr;
  REQUIRE(nook_probe_fit_create(stage.context, &desc, &fit) == NOOK_OK);
  REQUIRE(nook_probe_fit_solve(fit, &probe) == NOOK_OK);
  nook_probe_info info{};
  info.struct_size = sizeof info;
  REQUIRE(nook_probe_describe(probe, &info) == NOOK_OK);
  CHECK(info.basis == NOOK_PROBE_BASIS_DICE);
  CHECK(info.function_count == 12);
  nook_probe_destroy(&probe);
  nook_probe_fit_destroy(&fit);
}

TEST_CASE("fits: bad calls") {
  ProbeStage stage;
  const float* d = stage.sky.directions;
  CHECK(nook_probe_fit_add_samples(nullptr, d, d, nullptr, 1) == invalid);
  CHECK(nook_probe_fit_add_samples(stage.fit, nullptr, d, nullptr, 1) == invalid);
  CHECK(nook_probe_fit_add_samples(stage.fit, d, nullptr, nullptr, 1) == invalid);
  CHECK(nook_probe_fit_add_samples(stage.fit, nullptr, nullptr, nullptr, 0) == NOOK_OK);
  CHECK(nook_probe_fit_merge(stage.fit, stage.fit) == invalid);
  CHECK(nook_probe_fit_seed(stage.fit, nullptr) == invalid);
  CHECK(nook_probe_fit_reset(nullptr) == invalid);
  nook_probe_fit none = nullptr;
  nook_probe_fit_destroy(&none);
  nook_probe_fit_destroy(nullptr);

  // Bad samples are counted and cause no error.
  const float bad[] = {0, 0, 1, 0, 0, 0, 0, 1, 0}, light[] = {1, 1, NAN, 1, 1, 1, 1, 1, 1};
  const float weights[] = {1, 1, -1};
  CHECK(nook_probe_fit_add_samples(stage.fit, bad, light, weights, 3) == NOOK_OK);
  nook_probe_fit_info info{};
  info.struct_size = sizeof info;
  REQUIRE(nook_probe_fit_describe(stage.fit, &info) == NOOK_OK);
  CHECK(info.samples == sample_count);
  CHECK(info.skipped == 3);
  CHECK(info.skipped_direction == 1);
  CHECK(info.skipped_radiance == 1);
  CHECK(info.skipped_weight == 1);
}

TEST_CASE("probes: bad parameters and bad files") {
  ProbeStage stage;
  nook_probe probe = stage.probe;
  unsigned char file[4096];
  std::size_t size = 16;
  CHECK(nook_probe_save(stage.probe, NOOK_PROBE_PACKING_FLOAT, file, &size) == invalid);
  CHECK(last_is("nook_probe_save: ", "got 16 bytes, need "));
  CHECK(size > 16);  // what is needed
  CHECK(nook_probe_save(stage.probe, 3, nullptr, &size) == invalid);
  size = sizeof file;
  REQUIRE(nook_probe_save(stage.probe, NOOK_PROBE_PACKING_FLOAT, file, &size) == NOOK_OK);
  CHECK(nook_probe_load(stage.context, file, size - 1, &probe) == NOOK_ERROR_BAD_FILE);
  CHECK(probe == nullptr);
  CHECK(nook_probe_load(stage.context, stage.host.bytes.data(), stage.host.bytes.size(), &probe) ==
        NOOK_ERROR_BAD_FILE);  // a character
  file[8] = 9;
  CHECK(nook_probe_load(stage.context, file, size, &probe) == NOOK_ERROR_FILE_VERSION);
  CHECK(last_is("nook_probe_load: ", "(got 9,"));

  nook_probe_desc desc = probe_desc();
  std::vector<float> coefficients(36, 1.0f);
  CHECK(nook_probe_create(stage.context, &desc, &probe) == invalid);
  desc.functions = stage.fit;
  CHECK(nook_probe_create(stage.context, &desc, &probe) == invalid);
  desc.coefficients = coefficients.data();
  desc.counts[1] = 0;
  CHECK(nook_probe_create(stage.context, &desc, &probe) == invalid);
  desc.counts[1] = 1;
  coefficients[4] = std::numeric_limits<float>::infinity();
  CHECK(nook_probe_create(stage.context, &desc, &probe) == invalid);
  CHECK(last_is("nook_probe_create: ", "coefficient 1 of probe 0"));

  float rgb[36];
  CHECK(nook_probe_read_coefficients(stage.probe, 1, rgb, 12) == invalid);
  CHECK(nook_probe_irradiance(stage.probe, nullptr, nullptr, rgb, 1) == invalid);
  CHECK(nook_probe_radiance(stage.probe, nullptr, nullptr, rgb, 1) == invalid);
  nook_probe_fit_desc harmonics = fit_desc();
  harmonics.basis = NOOK_PROBE_BASIS_SH;
  nook_probe_fit fit = nullptr;
  nook_probe other = nullptr;
  REQUIRE(nook_probe_fit_create(stage.context, &harmonics, &fit) == NOOK_OK);
  REQUIRE(nook_probe_fit_solve(fit, &other) == NOOK_OK);
  const nook_probe_fit different[2] = {stage.fit, fit};
  desc = probe_desc();
  desc.counts[0] = 2;
  desc.fits = different;
  desc.fit_count = 2;
  CHECK(nook_probe_create(stage.context, &desc, &probe) == invalid);
  CHECK(last_is("nook_probe_create: ", "desc.fits[1] and desc.fits[0] have different functions"));
  nook_lobe lobes[64];
  CHECK(nook_probe_read_lobes(other, nullptr, lobes, 9) == invalid);
  nook_probe_destroy(&other);
  nook_probe_fit_destroy(&fit);
  CHECK(last_is("nook_probe_read_lobes: ", "not lobes"));
}

// The probes of a grid from fits, from lobes and from coefficients are the same.
TEST_CASE("probes: all sources of light") {
  ProbeStage stage;
  nook_probe_fit bright = nullptr;
  const nook_probe_fit_desc desc = fit_desc();
  const std::vector<float> white(3 * sample_count, 2.0f);
  REQUIRE(nook_probe_fit_create(stage.context, &desc, &bright) == NOOK_OK);
  REQUIRE(nook_probe_fit_add_samples(bright, stage.sky.directions, white.data(), nullptr, sample_count) ==
          NOOK_OK);
  nook_probe bright_probe = nullptr;
  REQUIRE(nook_probe_fit_solve(bright, &bright_probe) == NOOK_OK);
  std::vector<float> coefficients(72);
  std::vector<nook_lobe> lobes(24);
  REQUIRE(nook_probe_read_coefficients(stage.probe, 0, coefficients.data(), 12) == NOOK_OK);
  REQUIRE(nook_probe_read_coefficients(bright_probe, 0, &coefficients[36], 12) == NOOK_OK);
  REQUIRE(nook_probe_read_lobes(stage.probe, nullptr, lobes.data(), 12) == NOOK_OK);
  REQUIRE(nook_probe_read_lobes(bright_probe, nullptr, &lobes[12], 12) == NOOK_OK);
  nook_probe_destroy(&bright_probe);

  const nook_probe_fit fits[2] = {stage.fit, bright};
  const auto made = [&](auto&& change) {
    nook_probe_desc grid = probe_desc();
    grid.counts[0] = 2;
    change(grid);
    nook_probe probe = nullptr;
    REQUIRE(nook_probe_create(stage.context, &grid, &probe) == NOOK_OK);
    std::vector<float> read(72);
    for (std::uint32_t i = 0; i < 2; ++i)
      REQUIRE(nook_probe_read_coefficients(probe, i, &read[36 * i], 12) == NOOK_OK);
    std::vector<nook_lobe> own(12);
    REQUIRE(nook_probe_read_lobes(probe, nullptr, own.data(), 12) == NOOK_OK);
    // Axes are normalised once more.
    for (std::size_t i = 0; i < 12; ++i) CHECK(std::abs(own[i].axis[0] - lobes[i].axis[0]) < 1e-6f);
    CHECK(own[3].sharpness == lobes[3].sharpness);
    // One call looks up both probes.
    const float places[6] = {0, 0, 0, 1, 0, 0}, up[6] = {0, 0, 1, 0, 0, 1};
    float both[6], one[3];
    REQUIRE(nook_probe_irradiance(probe, places, up, both, 2) == NOOK_OK);
    REQUIRE(nook_probe_irradiance(stage.probe, nullptr, up, one, 1) == NOOK_OK);
    CHECK(std::abs(both[0] - one[0]) < 1e-5f * one[0]);
    // Constant light of 2 has the irradiance 2 pi; lobes without an ambient term are within 1 %.
    CHECK(std::abs(both[3] - 6.2832f) < 0.06f);
    // The sky is dark below, and constant light is not.
    const float down[6] = {0, 0, -1, 0, 0, -1};
    REQUIRE(nook_probe_radiance(probe, places, down, both, 2) == NOOK_OK);
    REQUIRE(nook_probe_radiance(stage.probe, nullptr, down, one, 1) == NOOK_OK);
    CHECK(std::abs(both[0] - one[0]) < 1e-5f);
    CHECK(both[3] > both[0] + 1);
    nook_probe_destroy(&probe);
    return read;
  };
  CHECK(made([&](nook_probe_desc& d) { d.fits = fits, d.fit_count = 2; }) == coefficients);
  CHECK(made([&](nook_probe_desc& d) { d.lobes = lobes.data(), d.lobe_count = 12; }) == coefficients);
  CHECK(made([&](nook_probe_desc& d) { d.functions = bright, d.coefficients = coefficients.data(); }) ==
        coefficients);

  const auto refused = [&](auto&& change, const char* part) {
    nook_probe_desc grid = probe_desc();
    grid.counts[0] = 2;
    change(grid);
    nook_probe probe = stage.probe;
    CHECK(nook_probe_create(stage.context, &grid, &probe) == invalid);
    CHECK(probe == nullptr);
    INFO(nook_last_message());
    CHECK(last_is("nook_probe_create: ", part));
  };
  using Desc = nook_probe_desc;
  refused([&](Desc& d) { d.fits = fits, d.fit_count = 1; }, "desc.fit_count is not the number of probes");
  refused([&](Desc& d) { d.fits = fits, d.fit_count = 2, d.lobes = lobes.data(); }, "2 sources of light");
  const nook_probe_fit half[2] = {stage.fit, nullptr};
  refused([&](Desc& d) { d.fits = half, d.fit_count = 2; }, "desc.fits[1] is NULL");
  refused([&](Desc& d) { d.lobes = lobes.data(); }, "desc.lobe_count is out of range");
  lobes[15].sharpness += 1;
  refused([&](Desc& d) { d.lobes = lobes.data(), d.lobe_count = 12; }, "lobe 3 of probe 1");
  nook_probe_fit_destroy(&bright);
}

// The last lobe of sharpness 0 is the ambient term.
TEST_CASE("probes: lobes with an ambient term") {
  ProbeStage stage;
  const nook_lobe lobes[3] = {
      {{1, 0, 0}, 4, {2, 1, 0}, 0}, {{-1, 0, 0}, 4, {0, 1, 2}, 0}, {{0, 0, 1}, 0, {0.5f, 0.5f, 0.5f}, 0}};
  nook_probe_desc desc = probe_desc();
  desc.lobes = lobes;
  desc.lobe_count = 3;
  nook_probe probe = nullptr;
  REQUIRE(nook_probe_create(stage.context, &desc, &probe) == NOOK_OK);
  nook_probe_info info{};
  info.struct_size = sizeof info;
  REQUIRE(nook_probe_describe(probe, &info) == NOOK_OK);
  CHECK(info.ambient == 1);
  CHECK(info.function_count == 3);
  float of_probe[3], of_lobes[3];
  const float direction[3] = {0.6f, 0, 0.8f};
  REQUIRE(nook_probe_radiance(probe, nullptr, direction, of_probe, 1) == NOOK_OK);
  REQUIRE(nook_sg_radiance(lobes, 3, direction, of_lobes, 1) == NOOK_OK);
  for (int c = 0; c < 3; ++c) CHECK(std::abs(of_probe[c] - of_lobes[c]) < 1e-5f);
  nook_probe_destroy(&probe);
}

TEST_CASE("lobes: bad parameters") {
  const float up[3] = {0, 0, 1};
  float rgb[3] = {7, 7, 7};
  nook_lobe good{{0, 0, 1}, 6, {1, 1, 1}, 0}, out;
  const auto refused = [&](nook_lobe lobe, const char* part) {
    CHECK(nook_sg_radiance(&lobe, 1, up, rgb, 1) == invalid);
    CHECK(last_is("nook_sg_radiance: ", part));
  };
  refused({{0, 0, 2}, 6, {1, 1, 1}, 0}, "axis of lobe 0");
  refused({{0, 0, 1}, -1, {1, 1, 1}, 0}, "sharpness of lobe 0");
  refused({{0, 0, 1}, 6, {1, NAN, 1}, 0}, "amplitude of lobe 0");
  CHECK(rgb[0] == 7);
  CHECK(nook_sg_radiance(&good, 65, up, rgb, 1) == invalid);
  CHECK(nook_sg_product(&good, nullptr, &out) == invalid);
  const float mirror[9] = {1, 0, 0, 0, 1, 0, 0, 0, -1}, scaled[9] = {2, 0, 0, 0, 2, 0, 0, 0, 2};
  CHECK(nook_sg_rotate(&good, 1, mirror) == invalid);
  CHECK(last_is("nook_sg_rotate: ", "mirrored"));
  CHECK(nook_sg_rotate(&good, 1, scaled) == invalid);
  float harmonics[75];
  CHECK(nook_sg_to_sh(&good, 1, 0, harmonics) == invalid);
  nook_probe_surface surface{{0, 0, 1}, {0, 0, 1}, {1, 0, 0}, 0.1f, 0.1f, 0.04f};
  CHECK(nook_sg_specular(&good, 1, 2, &surface, rgb, 1) == invalid);
  surface.alpha_y = 0;
  CHECK(nook_sg_specular(&good, 1, 0, &surface, rgb, 1) == invalid);
  CHECK(last_is("nook_sg_specular: ", "alpha_y of surface 0"));
  surface.alpha_y = 0.2f;
  surface.tangent[0] = 0;
  CHECK(nook_sg_specular(&good, 1, 0, &surface, rgb, 1) == invalid);
}

TEST_CASE("probes: each allocation refused in turn is one clean failure") {
  Host plain;
  REQUIRE(run_everything(plain) == NOOK_OK);
  CHECK(plain.blocks == 0);
  const int total = plain.allocations;
  REQUIRE(total > 10);
  for (int n = 0; n < total; ++n) {
    Host host;
    host.refuse_at = n;
    INFO("allocation " << n);
    CHECK(run_everything(host) == NOOK_ERROR_OUT_OF_MEMORY);
    CHECK(host.blocks == 0);
  }
}

TEST_CASE("samples, reading and evaluation allocate nothing") {
  // All methods of fits, then all methods of studies.
  for (int i = 0; i < 7; ++i) {
    ProbeStage stage;
    nook_probe_fit_desc desc = fit_desc();
    nook_probe_fit_study_desc study = study_desc();
    desc.next = &study;
    if (i <= NOOK_PROBE_FIT_RUNNING_AVERAGE_NON_NEGATIVE)
      desc.method = i;
    else
      study.method = i - NOOK_PROBE_FIT_RUNNING_AVERAGE_NON_NEGATIVE;
    nook_probe_fit fit = nullptr;
    REQUIRE(nook_probe_fit_create(stage.context, &desc, &fit) == NOOK_OK);
    const int before = stage.host.allocations;
    float rgb[36];
    nook_lobe lobes[12];
    CHECK(nook_probe_fit_add_samples(fit, stage.sky.directions, stage.sky.radiance, nullptr, sample_count) ==
          NOOK_OK);
    const float where[3] = {0.3f, 0, 0};
    CHECK(nook_probe_read_lobes(stage.probe, where, lobes, 12) == NOOK_OK);
    CHECK(nook_probe_irradiance(stage.probe, where, where, rgb, 1) == NOOK_OK);
    CHECK(nook_sg_radiance(lobes, 12, stage.sky.directions, rgb, 1) == NOOK_OK);
    CHECK(stage.host.allocations == before);
    nook_probe_fit_destroy(&fit);
  }
}

TEST_CASE("harmonics refuse arrays that are not light") {
  const float c[75] = {1, 1, 1}, bad[27] = {1, NAN, 1}, up[3] = {0, 0, 1};
  float out[15];
  CHECK(nook_sh_irradiance(c, 0, up, out, 1) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(nook_sh_irradiance(c, 5, up, out, 1) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(nook_sh_radiance(nullptr, 2, up, out, 1) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(nook_sh_radiance(c, 2, nullptr, out, 1) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(nook_sh_to_zh3(bad, out) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(nook_sh_to_zh3(c, nullptr) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(nook_sh_irradiance(c, NOOK_SH_ZH3, up, nullptr, 1) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(nook_sh_radiance(bad, NOOK_SH_ZH3, up, out, 1) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(nook_sh_radiance(c, NOOK_SH_ZH3, nullptr, nullptr, 0) == NOOK_OK);
}

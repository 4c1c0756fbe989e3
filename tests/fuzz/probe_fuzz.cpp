// Loads bytes as light probes, evaluates, writes and uploads what loads, and fits other probes by a script,
// through the C ABI: nothing may crash, light of a file is finite, and a file that was written loads again,
// whatever the bytes. Built for libFuzzer with clang; elsewhere probe_fuzz_replay.cpp drives it.
#include <nook/experimental/nook_sg.h>
#include <nook/nook_gl.h>

#include <cmath>

#include "tests/fuzz/container_input.h"
#include "tests/fuzz/library.h"

namespace {

using namespace nook::test;

constexpr float directions[] = {0, 0, 1, 0.6f, -0.8f, 0, 0, 0, -1};
constexpr std::size_t direction_count = 3;
constexpr std::uint32_t max_commands = 24;

void fill(Script& script, float* numbers, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) numbers[i] = script.number();
}

// Along an axis, or any numbers.
void fill_direction(Script& script, float (&direction)[3]) {
  const std::uint32_t choice = script.byte();
  if (choice >= 192) return fill(script, direction, 3);
  const float angle = float(choice) * 0.7f, z = 1 - float(choice) / 96, r = std::sqrt(1 - z * z);
  direction[0] = r * std::cos(angle);
  direction[1] = r * std::sin(angle);
  direction[2] = z;
}

// At one position, NULL for the first probe, and at others.
void evaluate(nook_probe probe, const float* position) {
  float light[3 * direction_count], places[3 * direction_count] = {0, 0, 0, 1, 1, -1, -1e9f, 1e9f, 0.5f};
  if (position) std::copy_n(position, 3, places);
  for (const float* positions :
       {static_cast<const float*>(position ? places : nullptr), static_cast<const float*>(places)}) {
    require(ok(nook_probe_radiance(probe, positions, directions, light, direction_count)));
    for (const float value : light) require(std::isfinite(value));
    require(ok(nook_probe_irradiance(probe, positions, directions, light, direction_count)));
    for (const float value : light) require(std::isfinite(value));
  }
}

void save(nook_context context, nook_probe probe) {
  for (const nook_probe_packing packing :
       {NOOK_PROBE_PACKING_FLOAT, NOOK_PROBE_PACKING_HALF, NOOK_PROBE_PACKING_RGB9E5}) {
    std::size_t size = 0;
    if (!ok(nook_probe_save(probe, packing, nullptr, &size))) continue;
    std::vector<std::byte> file(size);
    if (!ok(nook_probe_save(probe, packing, file.data(), &size))) continue;
    nook_probe again = nullptr;
    require(ok(nook_probe_load(context, file.data(), file.size(), &again)));
    nook_probe_destroy(&again);
  }
}

// Lobes from anywhere may give anything, but no crash.
void use_lobes(Script& script, std::vector<nook_lobe>& lobes) {
  const auto count = std::uint32_t(lobes.size());
  float light[3 * direction_count], coefficients[75], rotation[9] = {0, -1, 0, 1, 0, 0, 0, 0, 1};
  ok(nook_sg_radiance(lobes.data(), count, directions, light, direction_count));
  ok(nook_sg_irradiance(lobes.data(), count, nook_probe_irradiance_form(script.below(4)), directions, light,
                        direction_count));
  nook_probe_surface surface{};
  surface.normal[2] = surface.tangent[0] = 1;
  fill_direction(script, surface.view);
  surface.alpha_x = script.number();
  surface.alpha_y = script.below(2) ? surface.alpha_x : script.number();
  surface.reflectance = script.number();
  ok(nook_sg_specular(lobes.data(), count, nook_probe_specular_form(script.below(3)), &surface, light, 1));
  if (count >= 2) {
    nook_lobe out{};
    ok(nook_sg_integral(&lobes[0], light));
    if (ok(nook_sg_product(&lobes[0], &lobes[1], &out))) ok(nook_sg_integral(&out, light));
    ok(nook_sg_convolve(&lobes[0], &lobes[1], &out));
  }
  ok(nook_sg_to_sh(lobes.data(), count, script.below(6), coefficients));
  if (script.below(4) == 3) fill(script, rotation, 9);
  ok(nook_sg_rotate(lobes.data(), count, rotation));
}

void use_probe(nook_context context, nook_probe probe, Script& script) {
  nook_probe_info info{};
  info.struct_size = sizeof info;
  require(ok(nook_probe_describe(probe, &info)) && info.function_count <= NOOK_PROBE_MAX_FUNCTIONS);
  std::vector<float> coefficients(3 * std::size_t(info.function_count));
  require(ok(
      nook_probe_read_coefficients(probe, info.probe_count - 1, coefficients.data(), info.function_count)));
  require(
      !ok(nook_probe_read_coefficients(probe, info.probe_count, coefficients.data(), info.function_count)));
  const float outside[3] = {0.4f, -1, 1e6f};
  evaluate(probe, nullptr);
  evaluate(probe, outside);
  float place[3];
  fill(script, place, 3);
  if (std::isfinite(place[0] + place[1] + place[2])) evaluate(probe, place);
  std::vector<nook_lobe> lobes(info.function_count);
  if (ok(nook_probe_read_lobes(probe, outside, lobes.data(), info.function_count))) use_lobes(script, lobes);
  if (ok(nook_probe_read_gloss(probe, outside, lobes.data(), info.function_count))) {
    for (const nook_lobe& lobe : lobes)
      require(std::min({lobe.amplitude[0], lobe.amplitude[1], lobe.amplitude[2]}) >= 0);
    use_lobes(script, lobes);
  }
  save(context, probe);
  nook_gl_upload grid = nullptr;
  if (ok(nook_gl_upload_probe(gl_of_tier(33), probe, nook_gl_probe_form(script.below(2)), &grid)))
    ok(nook_gl_update_probe(grid, probe));
  nook_gl_upload_destroy(&grid);
  nook_gl_upload uploaded = nullptr;
  if (!ok(nook_gl_upload_probe(gl_of_tier(33), probe, NOOK_GL_PROBE_LOBES, &uploaded))) return;
  ok(nook_gl_update_probe(uploaded, probe));
  nook_gl_upload_destroy(&uploaded);
}

void load(nook_context context, const std::vector<std::byte>& file, Script& script) {
  nook_probe probe = nullptr;
  if (!ok(nook_probe_load(context, file.data(), file.size(), &probe))) {
    require(probe == nullptr);
    return;
  }
  use_probe(context, probe, script);
  nook_probe_destroy(&probe);
}

// The arrays and the extension of a descriptor.
struct Given {
  std::array<float, 3 * NOOK_PROBE_MAX_FUNCTIONS> axes{};
  std::array<float, NOOK_PROBE_MAX_FUNCTIONS> sharpnesses{};
  nook_probe_fit_study_desc study;
};

nook_probe_fit_desc fit_desc(Script& script, Given& given) {
  nook_probe_fit_desc desc;
  ok(nook_probe_fit_desc_init(&desc));
  ok(nook_probe_fit_study_desc_init(&given.study));
  desc.next = &given.study;
  // The seven methods of fits and of studies, and one that does not exist.
  const std::uint32_t method = script.below(8);
  if (method <= NOOK_PROBE_FIT_RUNNING_AVERAGE_NON_NEGATIVE)
    desc.method = nook_probe_method(method);
  else
    given.study.method = nook_probe_study_method(method) - NOOK_PROBE_FIT_RUNNING_AVERAGE_NON_NEGATIVE;
  // Dice are one in 256, because the products of their functions are sums over 8192 directions.
  const std::uint32_t basis = script.byte();
  desc.basis = nook_probe_basis(basis == 3 ? 2 : basis % 2);
  given.study.dice = basis == 2;
  desc.domain = nook_probe_domain(script.below(3));
  const std::uint32_t settings = script.byte();
  // Few unless the script names a number: the integrals of their products are most of a fit's time.
  desc.lobe_count = settings & 1 ? script.byte() : 3 + (settings >> 6);
  desc.ambient = settings >> 1 & 1;
  if (settings & 4) fill_direction(script, desc.up);
  if (settings & 32) desc.match_sh = 0;
  if (settings & 8) {
    desc.sharpness = script.number();
    desc.order = script.below(6);
    given.study.denominator = nook_probe_denominator(script.below(4));
    given.study.published_step = std::int32_t(script.below(4));
    desc.growing_samples = script.number();
  }
  const std::size_t lobes = std::min<std::size_t>(desc.lobe_count, NOOK_PROBE_MAX_FUNCTIONS);
  if (settings & 16) {
    for (std::size_t i = 0; i < lobes; ++i) {
      float axis[3];
      fill_direction(script, axis);
      std::copy_n(axis, 3, &given.axes[3 * i]);
    }
    desc.axes = given.axes.data();
  }
  if ((settings & 24) == 24) {
    fill(script, given.sharpnesses.data(), lobes);
    desc.sharpnesses = given.sharpnesses.data();
  }
  return desc;
}

// Enough samples for every kernel's wide loop and its remainder.
void add_samples(nook_probe_fit fit, Script& script) {
  constexpr std::size_t most = 37;
  float direction[3 * most], radiance[3 * most], weight[most];
  const std::size_t count = script.below(most + 1), own = std::min<std::size_t>(count, 3);
  const bool weighted = script.below(2) == 1;
  for (std::size_t i = 0; i < count; ++i) {
    float axis[3] = {0, 0, 1};
    if (i < own) {
      fill_direction(script, axis);
    } else {
      const float z = 1 - 2 * float(i) / float(most), r = std::sqrt(1 - z * z), angle = 2.4f * float(i);
      axis[0] = r * std::cos(angle), axis[1] = r * std::sin(angle), axis[2] = z;
    }
    std::copy_n(axis, 3, &direction[3 * i]);
    for (std::size_t c = 0; c < 3; ++c) radiance[3 * i + c] = i < own ? script.number() : float(i % 5);
    weight[i] = i < own ? script.number() : 1;
  }
  require(ok(nook_probe_fit_add_samples(fit, direction, radiance, weighted ? weight : nullptr, count)));
}

void use_fit(nook_context context, nook_probe_fit fit, Script& script) {
  nook_probe_fit_info info{};
  info.struct_size = sizeof info;
  require(ok(nook_probe_fit_describe(fit, &info)) &&
          info.skipped == info.skipped_direction + info.skipped_radiance + info.skipped_weight);
  nook_probe probe = nullptr;
  if (ok(nook_probe_fit_solve(fit, &probe))) use_probe(context, probe, script);
  nook_probe_destroy(&probe);
  nook_probe_desc desc;
  ok(nook_probe_desc_init(&desc));
  const nook_probe_fit fits[2] = {fit, fit};
  desc.counts[script.below(3)] = desc.fit_count = 1 + script.below(2);
  desc.fits = fits;
  fill(script, desc.spacing_ws, 3);
  fill(script, desc.origin_ws, 3);
  if (!ok(nook_probe_create(context, &desc, &probe))) return;
  use_probe(context, probe, script);
  nook_probe_destroy(&probe);
}

// Two fits of the same functions. The second is made by the first command that uses it, because making one
// integrates products of its functions, which is most of an input's time.
class Fits {
 public:
  Fits(nook_context context, const nook_probe_fit_desc& desc) : context_(context), desc_(desc) { get(0); }
  ~Fits() {
    for (nook_probe_fit& made : fits_) nook_probe_fit_destroy(&made);
  }
  Fits(const Fits&) = delete;
  Fits& operator=(const Fits&) = delete;

  nook_probe_fit get(std::uint32_t which) {
    if (!fits_[which]) ok(nook_probe_fit_create(context_, &desc_, &fits_[which]));
    return fits_[which];
  }

 private:
  nook_context context_;
  const nook_probe_fit_desc& desc_;
  nook_probe_fit fits_[2] = {};
};

void fit(bool with_jobs, Script& script) {
  const nook_context context = context_with_jobs(with_jobs, script.below(6));
  Given given;
  const nook_probe_fit_desc desc = fit_desc(script, given);
  Fits fits(context, desc);
  if (!fits.get(0)) return;
  for (std::uint32_t i = 0; i < max_commands && !script.at_end(); ++i) {
    const std::uint32_t command = script.byte(), which = command >> 4 & 1;
    switch (command % 8) {
      case 0:
        ok(nook_probe_fit_merge(fits.get(which), fits.get(1 - which)));
        break;
      case 1:
        ok(nook_probe_fit_seed(fits.get(which), fits.get(1 - which)));
        break;
      case 2:
        ok(nook_probe_fit_reset(fits.get(which)));
        break;
      default:
        add_samples(fits.get(which), script);
    }
  }
  use_fit(context, fits.get(0), script);
}

void make_lobes(nook_context context, Script& script) {
  std::vector<nook_lobe> lobes(1 + script.below(4));
  for (nook_lobe& lobe : lobes) {
    fill_direction(script, lobe.axis);
    lobe.sharpness = script.number();
    fill(script, lobe.amplitude, 3);
  }
  use_lobes(script, lobes);
  nook_probe_desc desc;
  ok(nook_probe_desc_init(&desc));
  desc.lobes = lobes.data();
  desc.counts[0] = lobes.size() % 2 == 0 ? 1 + script.below(2) : 1;
  desc.lobe_count = std::uint32_t(lobes.size()) / desc.counts[0];
  nook_probe probe = nullptr;
  if (!ok(nook_probe_create(context, &desc, &probe))) return;
  evaluate(probe, nullptr);
  nook_probe_destroy(&probe);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  ContainerInput input = split_input(data, size);
  const std::uint32_t settings = input.script.byte();
  const nook_context context = context_with_jobs(settings % 2 == 1);
  load(context, input.file, input.script);
  if (input.script.at_end()) return 0;
  if ((settings & 6) == 6) fit(settings % 2 == 1, input.script);
  make_lobes(context, input.script);
  return 0;
}

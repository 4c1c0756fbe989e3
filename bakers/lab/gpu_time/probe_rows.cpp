#include <nook/nook_gl.h>

#include <algorithm>

#include "bakers/lab/gpu_time/timed_rows.h"
#include "bakers/lab/gpu_time/whole_image.h"

namespace nook::lab {

using namespace measure;

namespace {

struct Count {
  std::uint32_t counts[3];
};

// A grid of probes with twelve lobes each, whose amplitudes are from 0 to 1.
class Probe {
 public:
  Probe(const NookGl& gl, const std::uint32_t (&counts)[3]) {
    nook_probe_fit_desc fit_desc;
    succeed(nook_probe_fit_desc_init(&fit_desc));
    fit_desc.lobe_count = 12;
    succeed(nook_probe_fit_create(gl.context(), &fit_desc, &fit_));
    nook_probe_fit_info info{};
    info.struct_size = sizeof info;
    succeed(nook_probe_fit_describe(fit_, &info));
    nook_probe_desc desc;
    succeed(nook_probe_desc_init(&desc));
    desc.functions = fit_;
    std::ranges::copy(counts, desc.counts);
    const float spacing = 1;
    std::fill_n(desc.spacing_ws, 3, spacing);
    std::vector<float> coefficients(std::size_t(3) * info.function_count * counts[0] * counts[1] * counts[2]);
    for (std::size_t i = 0; i < coefficients.size(); ++i) coefficients[i] = float(i % 7) / 7;
    desc.coefficients = coefficients.data();
    succeed(nook_probe_create(gl.context(), &desc, &probe_));
    succeed(nook_gl_upload_probe(gl.get(), probe_, NOOK_GL_PROBE_LOBES, &uploaded_));
    info_.struct_size = sizeof info_;
    succeed(nook_gl_upload_describe(uploaded_, &info_));
  }
  ~Probe() {
    nook_gl_upload_destroy(&uploaded_);
    nook_probe_destroy(&probe_);
    nook_probe_fit_destroy(&fit_);
  }
  Probe(const Probe&) = delete;
  Probe& operator=(const Probe&) = delete;

  const nook_gl_upload_info& info() const { return info_; }

 private:
  nook_probe_fit fit_ = nullptr;
  nook_probe probe_ = nullptr;
  nook_gl_upload uploaded_ = nullptr;
  nook_gl_upload_info info_{};
};

struct Answer {
  const char* name;
  const char* expression;
};
constexpr Answer answers[] = {
    {"irradiance by bands", "nook_probe_irradiance(place, n)"},
    {"irradiance by a fit of the clamped cosine", "nook_probe_irradiance_fitted(place, n)"},
    {"glossy, isotropic",
     "nook_probe_specular_isotropic(place, NookProbeSurface(n, vec3(0, 0, 1), vec3(1, 0, 0), vec2(0.3), "
     "0.04))"},
};

}  // namespace

std::vector<TimedRow> time_probes(const Timing& timing) {
  std::vector<TimedRow> rows;
  for (const Count& count : {Count{{4, 4, 4}}, Count{{1, 1, 1}}}) {
    const Probe probe(timing.nook, count.counts);
    for (const Answer& answer : answers) {
      const std::string name =
          std::string(count.counts[0] > 1 ? "grid" : "one probe") + " of 12 lobes, " + answer.name;
      if (!timing.wanted(name)) continue;
      WholeImage image(timing.context.gl(), timing.width, timing.height, probe.info().glsl,
                       std::string("  vec3 n = normalize(vec3(at - 0.5, 0.4));\n"
                                   "  NookProbePlace place = nook_probe_place(vec3(3.0 * at, 1.0 + at.x));\n"
                                   "  colour = ") +
                           answer.expression + ";\n");
      image.bind(GL_TEXTURE_BUFFER, probe.info().textures[0].texture, "nook_probe_texels");
      timing.add(rows, name, [&] { image.draw(); });
    }
  }
  return rows;
}

}  // namespace nook::lab

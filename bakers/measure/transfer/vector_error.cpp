#include "bakers/measure/transfer/vector_error.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <ctime>
#include <mutex>
#include <numbers>
#include <optional>
#include <vector>

#include "bakers/raytrace/ambient_occlusion.h"
#include "bakers/raytrace/environment.h"
#include "bakers/transfer/separated_bake.h"
#include "bakers/transfer/visible_directions.h"
#include "platform/stopwatch.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/core/spherical_gaussian.h"
#include "sdk/src/material/material_check.h"
#include "sdk/src/material/reflectance.h"
#include "sdk/src/transfer/vectors.h"

namespace nook::measure {
namespace {

using nook::transfer::CubeCells;
using nook::transfer::Frame;
using nook::transfer::Transfer;

constexpr std::uint32_t truth_side = 32;  // 6,144 directions, as in the paper
constexpr std::uint32_t light_side = 32;  // the same for the lights that the runtime uses
constexpr float reach = 12;               // lobes are cut off at exp(-reach) of their height

// The lobes around each direction.
struct LobeValues {
  std::vector<std::uint32_t> begin, lobe;
  std::vector<float> value;
};

LobeValues lobe_values(const CubeCells& cells, std::uint32_t lobes) {
  const float sharpness = nook::transfer::sharpness_of(lobes);
  std::vector<Vec3> axes(lobes);
  nook::transfer::lobe_axes(axes);
  LobeValues out;
  for (const Vec3 d : cells.direction) {
    out.begin.push_back(std::uint32_t(out.lobe.size()));
    for (std::uint32_t j = 0; j < lobes; ++j) {
      if (dot(axes[j], d) < 1 - reach / sharpness) continue;
      out.lobe.push_back(j);
      out.value.push_back(gaussian_value(axes[j], sharpness, d));
    }
  }
  out.begin.push_back(std::uint32_t(out.lobe.size()));
  return out;
}

// Adds light * basis to `out`, for each channel.
void add_light(Vec3 light, std::span<const float> basis, std::span<float> out) {
  const std::size_t modes = basis.size() / 3;
  const float channel[3] = {light.x, light.y, light.z};
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t a = 0; a < modes; ++a) out[c * modes + a] += channel[c] * basis[c * modes + a];
}

double decibels(std::span<const float> truth, std::span<const float> other) {
  double signal = 0, error = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const double apart = double(truth[i]) - double(other[i]);
    signal += double(truth[i]) * double(truth[i]);
    error += apart * apart;
  }
  return 10 * std::log10(signal / std::max(error, 1e-300));
}

}  // namespace

bool is_baked_mesh(const bake::SurfaceMesh& mesh, const Transfer& transfer) {
  return mesh.position.size() == transfer.vertex_count() &&
         bake::transfer::hashes_of(mesh) == transfer.hashes;
}

MeasuredLight measured_light(std::string name, bake::Environment map, const nook::transfer::LobeFit& fit,
                             bool without_suns) {
  if (without_suns) map = bake::without_suns(map);
  using namespace nook::transfer;
  const MapView view{MapLayout::latlong, map.width(), map.height(), map.rgb()};
  const CubeCells fine(light_side), coarse(truth_side);
  const Vector<Vec3> means = cell_means(view, fine, default_memory());
  const Vector<Vec3> truth = cell_means(view, coarse, default_memory());
  std::vector<float> amplitudes(std::size_t(3) * fit.lobes());
  platform::Stopwatch watch;
  fit.fit(fine, means, Mat3x4{}, amplitudes);
  const double fit_ms = watch.seconds() * 1e3;
  const FitQuality quality = fit_quality(fit, amplitudes, fine, means, Mat3x4{});
  return {std::move(name),       std::move(map), {truth.begin(), truth.end()},
          std::move(amplitudes), quality,        fit_ms};
}

VectorMeasure measure_vectors(const bake::SurfaceMesh& mesh, const Transfer& transfer,
                              const nook::material::MaterialTables& tables,
                              std::span<const MeasuredLight> lights, const TruthSettings& settings,
                              const VectorProgress& progress) {
  const std::size_t count = mesh.position.size(), size = std::size_t(3) * tables.btf.light_modes;
  VectorMeasure measure;
  measure.light_modes = tables.btf.light_modes;
  measure.ao.resize(count);
  measure.lights.resize(lights.size());
  std::vector<Frame> frames;
  const bool is_paper = transfer.paper.is_used();
  for (std::size_t v = 0; v < count; ++v)
    frames.push_back(is_paper ? bake::transfer::frame_of(mesh, v) : unpack(transfer.frames[v]));

  Transfer direct = transfer;
  direct.bounces = 0;
  direct.indirect.clear();
  std::vector<std::vector<float>> direct_vectors(lights.size());

  const nook::transfer::Response response = response_of(tables, transfer.lobes);
  // The documents list times for AVX2, so this uses AVX2 if the processor has it.
  const Isa isa = isa_available(Isa::avx2) ? Isa::avx2 : choose_isa(NOOK_ISA_AUTO);
  for (std::size_t l = 0; l < lights.size(); ++l) {
    LightVectors& vectors = measure.lights[l];
    for (std::vector<float>& form : vectors.form) form.resize(count * size);
    // Measures processor time, because other programs on the machine disturb it less than wall-clock time.
    const std::clock_t begin = std::clock();
    baked_vectors(response, isa, lights[l].amplitudes, transfer, 0, transfer.vertex_count(),
                  {vectors.form[0].data(), size}, {}, default_memory());
    direct_vectors[l] = vectors.form[0];
    vectors.vectors_ms = 1e3 * double(std::clock() - begin) / CLOCKS_PER_SEC;
    if (transfer.bounces > 0)
      baked_vectors(response, isa, lights[l].amplitudes, direct, 0, direct.vertex_count(),
                    {direct_vectors[l].data(), size}, {}, default_memory());
    open_vectors(response, isa, lights[l].amplitudes, frames, {vectors.form[2].data(), size}, {},
                 default_memory());
  }

  const CubeCells cells(truth_side);
  const LobeValues lobes = lobe_values(cells, transfer.lobes);
  const bake::RayScene scene({mesh.position, mesh.triangle});
  const float offset = bake::ray_origin_offset(mesh.position);
  const auto holes = bake::transfer::surface_holes(mesh, settings.holes, settings.tiles, cells.size());
  std::vector<std::vector<float>> truth(lights.size()), exact(lights.size());
  for (auto* sums : {&truth, &exact})
    for (std::vector<float>& sum : *sums) sum.resize(count * size);
  std::atomic<bool> cancelled{false};
  std::mutex progress_mutex;
  std::size_t done = 0;
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, count, 64),
      [&](const auto& range) {
        const bake::FlushDenormals flush;
        std::vector<bake::transfer::VisibleDirection> visible;
        std::vector<float> basis(size);
        for (std::size_t v = range.begin(); v < range.end() && !cancelled; ++v) {
          const Frame& frame = frames[v];
          const Vec3 side = frame.bitangent();
          const std::uint8_t* const shares = is_paper ? nullptr : transfer.shares_of(v);
          visible.clear();
          bake::transfer::visible_directions(scene, mesh.position[v] + mesh.normal[v] * offset,
                                             mesh.normal[v], cells.direction, holes ? &*holes : nullptr,
                                             visible);
          auto next = visible.begin();
          double open = 0;
          for (std::uint32_t i = 0; i < cells.size(); ++i) {
            const Vec3 d = cells.direction[i],
                       local{dot(frame.tangent, d), dot(side, d), dot(frame.normal, d)};
            const bool is_visible = next != visible.end() && next->direction == i;
            const float share = is_visible ? next->share : 0.0f;
            next += is_visible;
            if (!(local.z > 0)) continue;
            light_basis_at(tables, local, basis);
            open += double(share * local.z * cells.solid_angle[i]);
            for (std::size_t l = 0; l < lights.size(); ++l) {
              if (is_visible)
                add_light(lights[l].cells[i] * (share * cells.solid_angle[i]), basis,
                          std::span(truth[l]).subspan(v * size, size));
              if (is_paper) continue;
              Vec3 sum;
              for (std::uint32_t k = lobes.begin[i]; k < lobes.begin[i + 1]; ++k) {
                const float* const a = &lights[l].amplitudes[3 * std::size_t(lobes.lobe[k])];
                sum +=
                    Vec3{a[0], a[1], a[2]} * (lobes.value[k] * float(shares[lobes.lobe[k]]) * (1 / 255.0f));
              }
              add_light(sum * cells.solid_angle[i], basis, std::span(exact[l]).subspan(v * size, size));
            }
          }
          measure.ao[v] = float(open / 3.14159265358979);
        }
        const std::lock_guard lock(progress_mutex);
        done += range.size();
        if (progress && !cancelled && !progress(done, count)) cancelled = true;
      },
      tbb::simple_partitioner());
  if (cancelled)
    throw Failure(NOOK_ERROR_CANCELLED, "cancelled while measuring (%zu of %zu vertices)", done, count);

  for (std::size_t l = 0; l < lights.size(); ++l) {
    LightVectors& vectors = measure.lights[l];
    for (std::size_t i = 0; i < count * size; ++i)
      vectors.form[1][i] = vectors.form[2][i] * std::min(measure.ao[i / size], 1.0f);
    for (std::size_t form = 0; form < 3; ++form)
      vectors.se_db[form] = decibels(truth[l], form == 0 ? direct_vectors[l] : vectors.form[form]);
    vectors.se_exact_db = decibels(truth[l], exact[l]);
  }
  return measure;
}

nook::transfer::Response response_of(const nook::material::MaterialTables& tables, std::uint32_t lobes) {
  nook::material::refuse_neural(tables.neural.is_used(), "radiance transfer");
  const nook::transfer::HemisphereCells cells(nook::transfer::sharpness_of(lobes), default_memory());
  const std::size_t count = std::size_t(3) * tables.btf.light_modes;
  std::vector<float> values(cells.direction.size() * count);
  for (std::size_t i = 0; i < cells.direction.size(); ++i)
    light_basis_at(tables, cells.direction[i], std::span(values).subspan(i * count, count));
  return make_response(
      lobes, cells,
      {values, tables.btf.light_modes, mean_reflectance(tables), tables.light_hash, tables.votf_hash},
      default_memory());
}

}  // namespace nook::measure

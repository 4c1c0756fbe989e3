// Vectors of the separated form on one core: 642 lobes, 16 light modes, a shape whose vertices see half of
// what is above them. The argument is the nook_isa; ratio_to_scalar is how many times as fast as that it is,
// and ms_of_36000 the time of 36,000 vertices.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <random>
#include <vector>

#include "sdk/src/core/floats.h"
#include "sdk/src/transfer/lit_rows.h"
#include "sdk/src/transfer/vectors.h"

namespace {

using namespace nook;
using namespace nook::transfer;

struct Shape {
  static constexpr std::uint32_t vertices = 512, lobes = 642, modes = 16;
  Response response;
  Transfer transfer;
  std::vector<float> amplitudes, vectors;

  Shape() : response(made_response()), vectors(std::size_t(vertices) * 3 * modes) {
    transfer.lobes = lobes;
    std::vector<Vec3> axes(lobes), normals(vertices);
    lobe_axes(axes);
    lobe_axes(normals);
    std::mt19937 random(1);
    std::uniform_real_distribution<float> uniform(0, 1);
    for (std::uint32_t i = 0; i < 3 * lobes; ++i) amplitudes.push_back(uniform(random));
    for (const Vec3 normal : normals) {
      const Frame frame = orthonormal_frame(normal, {0.3f, 1, 0.2f}, 1);
      transfer.frames.push_back(pack(frame));
      // A wall beside the vertex hides one half.
      const auto part = [](float height) { return std::clamp(0.5f + 6 * height, 0.0f, 1.0f); };
      for (const Vec3 axis : axes)
        transfer.shares.push_back(
            std::uint8_t(std::lround(255 * part(dot(axis, normal)) * part(dot(axis, frame.tangent)))));
    }
  }

  static Response made_response() {
    const HemisphereCells cells(sharpness_of(lobes), default_memory());
    std::vector<float> values;
    for (const Vec3 d : cells.direction)
      for (std::uint32_t k = 0; k < 3 * modes; ++k)
        values.push_back(d.z * std::cos(float(k % modes) * d.x + float(k / 7) * d.y));
    return make_response(lobes, cells, {values, modes, {}, 0, 0}, default_memory());
  }

  void run(Isa isa) {
    baked_vectors(response, isa, amplitudes, transfer, 0, vertices, {vectors.data(), 3 * modes}, {},
                  default_memory());
    benchmark::DoNotOptimize(vectors.data());
  }
};

void transfer_vectors(benchmark::State& state) {
  const auto isa = static_cast<Isa>(state.range(0));
  Shape shape;
  std::clock_t start = std::clock();
  constexpr int passes = 3;
  for (int pass = 0; pass < passes; ++pass) shape.run(Isa::scalar);
  const double scalar = double(std::clock() - start) / CLOCKS_PER_SEC / passes;
  start = std::clock();
  for (auto _ : state) shape.run(isa);
  const double seconds = double(std::clock() - start) / CLOCKS_PER_SEC / double(state.iterations());
  state.SetItemsProcessed(std::int64_t(state.iterations()) * Shape::vertices);
  state.counters["ratio_to_scalar"] = scalar / seconds;
  state.counters["ms_of_36000"] = 1e3 * seconds * 36000 / Shape::vertices;
}

// The paper's form of 36,000 vertices at the density of Table II: all vectors, or the rows that a shader
// mixes.
struct PaperShape {
  static constexpr std::uint32_t vertices = 36000, clusters = 100;
  Shape of;
  Transfer transfer;

  PaperShape() {
    transfer.lobes = Shape::lobes;
    PaperTransfer& paper = transfer.paper;
    paper.light_modes = Shape::modes;
    paper.clusters = clusters;
    paper.lobe_rank = 64;
    paper.vertex_rank = 12;
    paper.lobe_basis.assign(std::size_t(clusters) * Shape::lobes * 64, to_half(0.1f));
    paper.cores.assign(std::size_t(clusters) * 3 * Shape::modes * 12 * 64, to_half(0.2f));
    paper.coefficients.assign(std::size_t(vertices) * 12, to_half(0.3f));
    for (std::uint32_t v = 0; v < vertices; ++v) paper.cluster.push_back(std::uint8_t(v / 360));
  }
};

void transfer_paper_vectors(benchmark::State& state) {
  PaperShape shape;
  std::vector<float> vectors(std::size_t(PaperShape::vertices) * 3 * Shape::modes);
  for (auto _ : state)
    baked_vectors(shape.of.response, Isa::scalar, shape.of.amplitudes, shape.transfer, 0,
                  PaperShape::vertices, {vectors.data(), 3 * Shape::modes}, {}, default_memory());
}

void transfer_paper_rows(benchmark::State& state) {
  PaperShape shape;
  std::vector<float> rows(lit_row_count(shape.transfer) * 3 * Shape::modes);
  for (auto _ : state)
    write_lit_rows(shape.of.response, shape.of.amplitudes, shape.transfer, {}, default_memory(), rows);
  state.counters["bytes"] = double(rows.size() * sizeof(float));
}

void every_isa(benchmark::internal::Benchmark* all) {
  for (const Isa isa : all_isas)
    if (isa_available(isa)) all->Arg(static_cast<nook_isa>(isa));
}

}  // namespace

BENCHMARK(transfer_vectors)->Apply(every_isa);
BENCHMARK(transfer_paper_vectors)->Unit(benchmark::kMillisecond);
BENCHMARK(transfer_paper_rows)->Unit(benchmark::kMillisecond);

// The bake of the paper's form against the matrices that it compresses.
#include <tbb/task_arena.h>

#include <cmath>

#include "bakers/import/surface_mesh.h"
#include "bakers/raytrace/ambient_occlusion.h"
#include "bakers/transfer/paper_bake.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/transfer/lobe_fit.h"
#include "sdk/src/transfer/transfer_file.h"
#include "sdk/src/transfer/vectors.h"
#include "tests/catch.h"
#include "tests/material/material_sample.h"
#include "tests/transfer/shapes.h"

using namespace nook;
using namespace nook::bake;
using nook::transfer::Transfer;
namespace shapes = nook::transfer::test;

namespace {

SurfaceMesh ball_over_plane(std::uint32_t around, std::uint32_t across) {
  shapes::Shape shape = shapes::plane(1, across, 2);
  shapes::append(shape, shapes::ball({0, 0.25f, 0}, 0.2f, around));
  return import_surface(shapes::glb_of(shape)).mesh;
}

nook::material::MaterialTables tables() {
  nook::material::test::SampleSize size;
  size.lights = 40;
  return nook::material::make_tables(nook::material::test::sample_material(3, size), {}, default_memory());
}

// A smooth light with a bright side, as lobes.
std::vector<float> light_of(std::uint32_t lobes) {
  const nook::transfer::CubeCells cells(32);
  std::vector<Vec3> radiance;
  for (const Vec3 d : cells.direction)
    radiance.push_back(Vec3{0.4f, 0.5f, 0.7f} * (1.2f + 0.6f * d.y) +
                       Vec3{5, 4, 3} * std::exp(6 * (dot(d, normalised({0.6f, 0.5f, 0.3f})) - 1)));
  std::vector<float> amplitudes(std::size_t(3) * lobes);
  nook::transfer::LobeFit(lobes).fit(cells, radiance, Mat3x4{}, amplitudes);
  return amplitudes;
}

// The vectors of all vertices, from the file's numbers and from the matrices themselves.
struct Vectors {
  std::vector<float> baked, exact;
  double relative_error() const {
    double error = 0, size = 0;
    for (std::size_t i = 0; i < exact.size(); ++i) {
      error += double((baked[i] - exact[i]) * (baked[i] - exact[i]));
      size += double(exact[i] * exact[i]);
    }
    return std::sqrt(error / size);
  }
};
Vectors vectors_of(const SurfaceMesh& mesh, const Transfer& transfer, std::uint32_t side,
                   const nook::material::MaterialTables& worn) {
  const std::size_t count = mesh.position.size(), modes = worn.btf.light_modes;
  const std::vector<float> amplitudes = light_of(transfer.lobes);
  nook::transfer::Response response(default_memory());
  response.lobes = transfer.lobes;
  response.light_modes = worn.btf.light_modes;
  Vectors out;
  out.baked.resize(count * 3 * modes);
  baked_vectors(response, Isa::scalar, amplitudes, transfer, 0, std::uint32_t(count),
                {out.baked.data(), 3 * modes}, {}, default_memory());
  const nook::transfer::CubeCells cells(side);
  const bake::transfer::LobesOfDirections lobes = bake::transfer::lobes_of(cells, transfer.lobes);
  const RayScene scene({mesh.position, mesh.triangle});
  const bake::transfer::MatrixSource source{
      mesh, scene, cells, lobes, worn, nullptr, ray_origin_offset(mesh.position)};
  bake::transfer::MatrixWorkspace work;
  const FlushDenormals flush;
  for (std::size_t v = 0; v < count; ++v) {
    light_matrix(source, transfer.lobes, v, work);
    for (std::size_t i = 0; i < 3 * modes; ++i) {
      double sum = 0;
      for (std::size_t j = 0; j < transfer.lobes; ++j)
        sum += double(amplitudes[3 * j + i / modes] * work.matrix(Eigen::Index(j), Eigen::Index(i)));
      out.exact.push_back(float(sum));
    }
  }
  return out;
}

}  // namespace

TEST_CASE("at full ranks the paper's form keeps the matrices to its half floats") {
  const SurfaceMesh mesh = ball_over_plane(6, 3);
  const nook::material::MaterialTables worn = tables();
  bake::transfer::PaperSettings paper;
  paper.clusters = 1;
  paper.lobe_rank = paper.common_rank = 42;
  paper.vertex_rank = std::uint32_t(std::min<std::size_t>(mesh.position.size(), 64));
  const Transfer baked = bake::transfer::bake_paper(mesh, {42, 16}, paper, worn);
  CHECK(baked.paper.light_hash == worn.light_hash);
  // A half has 11 bits, and least squares gives neighbouring lobes amplitudes that cancel.
  CHECK(vectors_of(mesh, baked, 16, worn).relative_error() < 5e-3);
}

TEST_CASE("the paper's form loses little at its own ranks, and more clusters lose less") {
  const SurfaceMesh mesh = ball_over_plane(24, 20);
  const nook::material::MaterialTables worn = tables();
  double before = 1;
  for (const std::uint32_t clusters : {1u, 4u, 16u}) {
    bake::transfer::PaperSettings paper;
    paper.clusters = clusters;
    paper.lobe_rank = 24;
    paper.vertex_rank = 6;
    paper.common_rank = 64;
    const Transfer baked = bake::transfer::bake_paper(mesh, {162, 16}, paper, worn);
    CHECK(baked.paper.clusters == clusters);
    const std::vector<std::byte> bytes = nook::transfer::write_transfer(baked);
    const std::uint64_t counted =
        nook::transfer::paper_bytes(mesh.position.size(), clusters, 162, worn.btf.light_modes, 24, 6);
    CHECK(double(bytes.size()) == Approx(double(counted)).epsilon(0.02).margin(400));
    const double error = vectors_of(mesh, baked, 16, worn).relative_error();
    INFO(clusters << " clusters");
    CHECK(error < before);
    before = error;
  }
  CHECK(before < 0.1);
}

TEST_CASE("the paper's form has the same bytes on any number of threads, and can be cancelled") {
  const SurfaceMesh mesh = ball_over_plane(12, 8);
  const nook::material::MaterialTables worn = tables();
  bake::transfer::PaperSettings paper;
  paper.clusters = 4;
  paper.lobe_rank = 16;
  paper.common_rank = 32;
  const auto bytes = [&](int threads) {
    std::vector<std::byte> out;
    tbb::task_arena arena(threads);
    arena.execute([&] {
      out = nook::transfer::write_transfer(bake::transfer::bake_paper(mesh, {42, 8, 1}, paper, worn));
    });
    return out;
  };
  CHECK(bytes(1) == bytes(3));
  const auto stop = [](std::size_t, std::size_t) { return false; };
  CHECK_THROWS_AS(bake::transfer::bake_paper(mesh, {42, 8}, paper, worn, stop), Failure);
  CHECK_THROWS_AS(bake::transfer::bake_paper(mesh, {42, 8}, paper, worn, {}, stop), Failure);
}

TEST_CASE("settings of the paper's form that do not fit are refused") {
  const SurfaceMesh mesh = ball_over_plane(6, 3);
  const auto refused = [&](auto&& change) {
    bake::transfer::PaperSettings paper;
    change(paper);
    CHECK_THROWS_AS(bake::transfer::check_paper_bake(mesh, paper), Failure);
  };
  CHECK_NOTHROW(bake::transfer::check_paper_bake(mesh, {}));
  refused([](auto& p) { p.clusters = 257; });
  refused([](auto& p) { p.lobe_rank = 0; });
  refused([](auto& p) { p.vertex_rank = 65; });
  refused([](auto& p) { p.common_rank = 63; });
}

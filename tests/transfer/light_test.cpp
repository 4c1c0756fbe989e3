// Light as lobes, and vectors at vertices against sums over directions.
#include <array>
#include <atomic>
#include <cmath>
#include <numbers>
#include <thread>
#include <vector>

#include "sdk/src/core/light_map.h"
#include "sdk/src/core/spherical_gaussian.h"
#include "sdk/src/material/reflectance.h"
#include "sdk/src/transfer/lobe_fit.h"
#include "sdk/src/transfer/vectors.h"
#include "tests/catch.h"
#include "tests/material/material_sample.h"
#include "tests/transfer/transfer_sample.h"

using namespace nook;
using namespace nook::transfer;

namespace {

constexpr std::uint32_t lobes = 162;

// A sky with a broad bright side.
Vec3 sky(Vec3 d) {
  const float side = std::exp(4 * (dot(d, normalised({0.6f, 0.5f, 0.3f})) - 1));
  return Vec3{0.4f, 0.5f, 0.7f} * (1.2f + 0.6f * d.y) + Vec3{5, 4.5f, 4} * side;
}

std::vector<Vec3> radiance_of(const CubeCells& cells) {
  std::vector<Vec3> radiance;
  for (const Vec3 d : cells.direction) radiance.push_back(sky(d));
  return radiance;
}

material::MaterialTables sample_tables() {
  // Enough lights to make the light basis as smooth as a material's.
  material::test::SampleSize size;
  size.lights = 60;
  size.rank_light = 6;
  return material::make_tables(material::test::sample_material(3, size), {}, default_memory());
}

Response response_of(const material::MaterialTables& tables, std::uint32_t count) {
  const HemisphereCells cells(sharpness_of(count), default_memory());
  const std::size_t size = std::size_t(3) * tables.btf.light_modes;
  std::vector<float> values(cells.direction.size() * size);
  for (std::size_t i = 0; i < cells.direction.size(); ++i)
    material::light_basis_at(tables, cells.direction[i], std::span(values).subspan(i * size, size));
  return make_response(count, cells, {values, tables.btf.light_modes}, default_memory());
}

// The vector of an open vertex by a sum over the cells of a cube, with any light.
template <class Light>
std::vector<double> summed(const material::MaterialTables& tables, const Frame& frame, const CubeCells& cells,
                           Light&& light) {
  const std::size_t modes = tables.btf.light_modes;
  std::vector<double> sum(3 * modes);
  std::vector<float> basis(3 * modes);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const Vec3 d = cells.direction[i];
    material::light_basis_at(tables, {dot(frame.tangent, d), dot(frame.bitangent(), d), dot(frame.normal, d)},
                             basis);
    const Vec3 l = light(d) * cells.solid_angle[i];
    const float channel[3] = {l.x, l.y, l.z};
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t a = 0; a < modes; ++a) sum[c * modes + a] += double(channel[c] * basis[c * modes + a]);
  }
  return sum;
}

double relative_error(std::span<const double> truth, std::span<const float> got) {
  double error = 0, size = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    error += (truth[i] - double(got[i])) * (truth[i] - double(got[i]));
    size += truth[i] * truth[i];
  }
  return std::sqrt(error / size);
}

std::vector<Frame> frames_of(std::size_t count) {
  std::vector<Vec3> axes(count);
  lobe_axes(axes);
  std::vector<Frame> frames;
  for (std::size_t i = 0; i < count; ++i)
    frames.push_back(orthonormal_frame(axes[i], axes[(i + count / 2) % count], i % 2 ? 1.0f : -1.0f));
  return frames;
}

}  // namespace

TEST_CASE("the cells of a cube cover the sphere once") {
  const CubeCells cells(16);
  double sum = 0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    sum += double(cells.solid_angle[i]);
    CHECK(cube_cell_at(cells.direction[i], 16) == i);
  }
  CHECK(sum == Approx(4 * std::numbers::pi).epsilon(1e-5));
}

TEST_CASE("a light of one lobe gives that lobe") {
  const LobeFit fit(lobes);
  const CubeCells cells(64);
  for (const std::size_t lobe : {0u, 40u, 161u}) {
    std::vector<Vec3> radiance;
    for (const Vec3 d : cells.direction)
      radiance.push_back(Vec3{1, 2, 3} * gaussian_value(fit.axes()[lobe], fit.sharpness(), d));
    std::vector<float> amplitudes(3 * lobes);
    fit.fit(cells, radiance, Mat3x4{}, amplitudes);
    // The cells are a sum in place of an integral, and the Gram matrix magnifies the error.
    for (std::size_t j = 0; j < lobes; ++j)
      for (std::size_t c = 0; c < 3; ++c)
        CHECK(std::abs(amplitudes[3 * j + c] - (j == lobe ? float(c + 1) : 0.0f)) < 5e-3f);
  }
}

TEST_CASE("a directional light has its irradiance and its direction") {
  const LobeFit fit(642);
  const Vec3 towards = normalised({0.3f, 0.8f, -0.5f});
  std::vector<float> amplitudes(3 * 642);
  fit.fit_direction(towards, {2, 4, 6}, amplitudes);
  Vec3 flux;
  double total = 0;
  for (std::size_t j = 0; j < 642; ++j) {
    const float integral = gaussian_integral(fit.sharpness()) * amplitudes[3 * j + 1];
    total += double(integral);
    flux += fit.axes()[j] * integral;
  }
  // A projection keeps integrals against what lobes hold, constants to a few parts in a hundred.
  CHECK(total == Approx(4).epsilon(0.03));
  CHECK(dot(normalised(flux), towards) > 0.9999f);
}

TEST_CASE("an open vertex has the material's response to the light, by quadrature") {
  const material::MaterialTables tables = sample_tables();
  const Response response = response_of(tables, 642);
  const LobeFit fit(642);
  const CubeCells cells(64);
  std::vector<float> amplitudes(3 * 642);
  fit.fit(cells, radiance_of(cells), Mat3x4{}, amplitudes);
  const std::vector<Frame> frames = frames_of(20);
  const std::size_t size = std::size_t(3) * tables.btf.light_modes;
  std::vector<float> vectors(frames.size() * size);
  open_vectors(response, choose_isa(NOOK_ISA_AUTO), amplitudes, frames, {vectors.data(), size}, {},
               default_memory());
  for (std::size_t v = 0; v < frames.size(); ++v)
    // The sky is smooth, so that the lobes hold it; what is left is the response's grid, on a light basis of
    // random numbers that is rougher than any material's.
    CHECK(relative_error(summed(tables, frames[v], cells, sky), std::span(vectors).subspan(v * size, size)) <
          0.02);
}

TEST_CASE("turning light and shape together changes nothing") {
  const material::MaterialTables tables = sample_tables();
  const Response response = response_of(tables, 642);
  const LobeFit fit(642);
  const CubeCells cells(64);
  const std::vector<Vec3> radiance = radiance_of(cells);
  // A turn about a slanted axis: rows are the light's axes in the shape's space.
  const Vec3 z = normalised({0.4f, -0.3f, 0.8f}), x = normalised(cross({0, 1, 0}, z)), y = cross(z, x);
  Mat3x4 turn;
  const Vec3 rows[3] = {x, y, z};
  for (int r = 0; r < 3; ++r) {
    turn.m[4 * r] = rows[r].x;
    turn.m[4 * r + 1] = rows[r].y;
    turn.m[4 * r + 2] = rows[r].z;
  }
  std::vector<float> still(3 * 642), turned(3 * 642);
  fit.fit(cells, radiance, Mat3x4{}, still);
  fit.fit(cells, radiance, turn, turned);
  const std::vector<Frame> frames = frames_of(12);
  std::vector<Frame> turned_frames;
  const auto back = [&](Vec3 d) { return x * d.x + y * d.y + z * d.z; };  // from the light to the shape
  for (const Frame& f : frames) turned_frames.push_back({back(f.normal), back(f.tangent), f.handedness});
  const std::size_t size = std::size_t(3) * tables.btf.light_modes;
  std::vector<float> a(frames.size() * size), b(frames.size() * size);
  const Isa isa = choose_isa(NOOK_ISA_AUTO);
  open_vectors(response, isa, still, frames, {a.data(), size}, {}, default_memory());
  open_vectors(response, isa, turned, turned_frames, {b.data(), size}, {}, default_memory());
  const std::vector<double> truth(a.begin(), a.end());
  // Other lobes hold the light after the turn; both are within the error of their fit.
  CHECK(relative_error(truth, b) < 0.02);
}

TEST_CASE("a single lobe and share give the row of the response") {
  const material::MaterialTables tables = sample_tables();
  const Response response = response_of(tables, lobes);
  const LobeFit fit(lobes);
  const std::size_t size = std::size_t(3) * tables.btf.light_modes;
  const CubeCells cells(96);
  Transfer transfer;
  transfer.lobes = lobes;
  const std::vector<Frame> frames = frames_of(6);
  for (const Frame& frame : frames) transfer.frames.push_back(pack(frame));
  transfer.shares.assign(frames.size() * lobes, 0);
  for (std::size_t v = 0; v < frames.size(); ++v) {
    std::size_t above = 0;
    for (std::size_t j = 0; j < lobes; ++j)
      if (dot(fit.axes()[j], frames[v].normal) > dot(fit.axes()[above], frames[v].normal)) above = j;
    std::vector<float> amplitudes(3 * lobes);
    for (std::size_t c = 0; c < 3; ++c) amplitudes[3 * above + c] = 1;
    transfer.shares[v * lobes + above] = 51;  // a fifth
    std::vector<float> vector(size);
    baked_vectors(response, choose_isa(NOOK_ISA_AUTO), amplitudes, transfer, std::uint32_t(v), 1,
                  {vector.data(), size}, {}, default_memory());
    const std::vector<double> truth = summed(tables, unpack(transfer.frames[v]), cells, [&](Vec3 d) {
      return Vec3{1, 1, 1} * (0.2f * gaussian_value(fit.axes()[above], fit.sharpness(), d));
    });
    // One lobe alone shows the whole error of the grid, which many lobes average.
    CHECK(relative_error(truth, vector) < 0.03);
  }
}

TEST_CASE("every instruction set gives the vectors of the scalar kernels") {
  const material::MaterialTables tables = sample_tables();
  // Vertices are summed four at once with 642 lobes and two at once with 1,284; three are left over.
  constexpr std::uint32_t vertices = 11;
  for (const std::uint32_t lobes_here : {19u, 642u, 1284u}) {
    CAPTURE(lobes_here);
    const Response response = response_of(tables, lobes_here);
    const Transfer transfer = transfer::test::sample_transfer(vertices, lobes_here);
    std::vector<float> amplitudes(std::size_t(3) * lobes_here);
    for (std::size_t i = 0; i < amplitudes.size(); ++i) amplitudes[i] = std::sin(float(i)) + 0.5f;
    const std::size_t size = std::size_t(3) * tables.btf.light_modes;
    const auto vectors = [&](Isa isa) {
      std::vector<float> out(2 * vertices * size);
      baked_vectors(response, isa, amplitudes, transfer, 0, vertices, {out.data(), size}, {},
                    default_memory());
      open_vectors(response, isa, amplitudes, frames_of(vertices), {&out[vertices * size], size}, {},
                   default_memory());
      return out;
    };
    const std::vector<float> wanted = vectors(Isa::scalar);
    float largest = 0;
    for (const float value : wanted) largest = std::max(largest, std::abs(value));
    for (const Isa isa : all_isas) {
      if (!isa_available(isa)) continue;
      CAPTURE(isa_name(isa));
      const std::vector<float> got = vectors(isa);
      // Sums in another order, and roots by an estimate of 22 bits.
      for (std::size_t i = 0; i < got.size(); ++i) CHECK(std::abs(got[i] - wanted[i]) < 1e-4f * largest);
      // A part of the vertices has the same bits, whichever others are summed beside them.
      std::vector<float> part(5 * size);
      baked_vectors(response, isa, amplitudes, transfer, 3, 5, {part.data(), size}, {}, default_memory());
      CHECK(std::equal(part.begin(), part.end(), got.begin() + std::ptrdiff_t(3 * size)));
    }
  }
}

TEST_CASE("lobes on the rim of the grid, and those far below the horizon, stay inside it") {
  const material::MaterialTables tables = sample_tables();
  const Response response = response_of(tables, 642);
  const LobeFit fit(642);
  const std::size_t size = std::size_t(3) * tables.btf.light_modes;
  const std::vector<float> amplitudes(std::size_t(3) * 642, 1.0f);
  // Normals along lobes and against them, where the map of directions has its singular point.
  std::vector<Frame> frames;
  for (std::size_t j = 0; j < 642; j += 7)
    for (const float sign : {1.0f, -1.0f})
      frames.push_back(orthonormal_frame(fit.axes()[j] * sign, {0.3f, 1, 0.2f}, 1));
  for (const Isa isa : all_isas) {
    if (!isa_available(isa)) continue;
    std::vector<float> out(frames.size() * size);
    open_vectors(response, isa, amplitudes, frames, {out.data(), size}, {}, default_memory());
    CHECK(std::all_of(out.begin(), out.end(), [](float value) { return std::isfinite(value); }));
  }
}

TEST_CASE("suns are taken out of a map, and nothing is lost") {
  std::vector<float> rgb(3 * 64 * 32, 1.0f);
  for (const std::size_t texel : {64u * 8 + 20, 64u * 8 + 21}) rgb[3 * texel + 1] = 9000;
  const MapView map{MapLayout::latlong, 64, 32, rgb};
  Vector<float> rest(rgb.begin(), rgb.end());
  const Vector<MapSun> suns = take_suns(map, rest, default_memory());
  REQUIRE(suns.size() == 1);
  CHECK(dot(suns[0].direction, map_texel(map, 20, 8).direction) > 0.99f);
  double before = 0, after = 0;
  for (std::uint32_t row = 0; row < 32; ++row)
    for (std::uint32_t column = 0; column < 64; ++column) {
      const double angle = map_texel(map, column, row).solid_angle;
      before += double(rgb[3 * (row * 64 + column) + 1]) * angle;
      after += double(rest[3 * (row * 64 + column) + 1]) * angle;
    }
  CHECK(after + double(suns[0].irradiance.y) == Approx(before).epsilon(1e-5));
}

TEST_CASE("a sun of a cube map has the light of its texel, and the limit counts the whole sphere") {
  constexpr std::uint32_t side = 16;
  std::vector<float> rgb(std::size_t(3) * side * side * 6, 1.0f);
  const std::uint32_t row = 3 * side + 2, column = 5;
  for (std::size_t c = 0; c < 3; ++c) rgb[3 * (row * side + column) + c] = 9000;
  const MapView map{MapLayout::cube, side, 6 * side, rgb};
  const MapTexel texel = map_texel(map, column, row);
  // The sky of 1 and the texel at the limit together are a hundredth of the limit.
  const double share = texel.solid_angle / (4 * std::numbers::pi);
  const double limit = 100 * (1 - share) / (1 - 100 * share);
  // The rounds end within a thousandth of it.
  CHECK(sun_limit(map, default_memory()) == Approx(limit).epsilon(2e-3));
  Vector<float> rest(rgb.begin(), rgb.end());
  const Vector<MapSun> suns = take_suns(map, rest, default_memory());
  REQUIRE(suns.size() == 1);
  CHECK(dot(suns[0].direction, texel.direction) == Approx(1).epsilon(1e-6));
  CHECK(double(suns[0].irradiance.x) == Approx((9000 - limit) * texel.solid_angle).epsilon(1e-3));
}

TEST_CASE("reflected light is the light's bands times the baked ones, for the material's reflectance") {
  constexpr std::uint32_t count = 19;
  const material::MaterialTables tables = sample_tables();
  Response response = response_of(tables, count);
  response.reflectance = {0.5f, 0.25f, 0.8f};
  const LobeFit fit(count);
  const CubeCells cells(64);
  std::vector<float> amplitudes(3 * count);
  fit.fit(cells, radiance_of(cells), Mat3x4{}, amplitudes);
  const Transfer baked = transfer::test::sample_transfer(5, count, 2),
                 direct = transfer::test::sample_transfer(5, count);
  const std::size_t modes = tables.btf.light_modes, size = 3 * modes;
  std::vector<float> with(5 * size), without(5 * size);
  const Isa isa = choose_isa(NOOK_ISA_AUTO);
  baked_vectors(response, isa, amplitudes, baked, 0, 5, {with.data(), size}, {}, default_memory());
  baked_vectors(response, isa, amplitudes, direct, 0, 5, {without.data(), size}, {}, default_memory());
  // The light that the lobes hold, in bands and over the upper hemisphere, by sums over directions.
  std::array<double, 9> bands[3]{};
  for (std::size_t i = 0; i < cells.size(); ++i) {
    Vec3 sum;
    for (std::size_t j = 0; j < count; ++j)
      sum += Vec3{amplitudes[3 * j], amplitudes[3 * j + 1], amplitudes[3 * j + 2]} *
             gaussian_value(fit.axes()[j], fit.sharpness(), cells.direction[i]);
    const auto at = bands_at(cells.direction[i]);
    const float channel[3] = {sum.x, sum.y, sum.z};
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t k = 0; k < 9; ++k) bands[c][k] += double(channel[c] * at[k] * cells.solid_angle[i]);
  }
  const std::vector<double> even = summed(tables, Frame{}, cells, [](Vec3) { return Vec3{1, 1, 1}; });
  const double share[3] = {0.5, 0.25, 0.8};
  for (std::size_t v = 0; v < 5; ++v)
    for (std::size_t c = 0; c < 3; ++c) {
      double irradiance = 0;
      for (std::size_t k = 0; k < 9; ++k)
        irradiance += bands[c][k] * (share[c] * double(from_half(baked.indirect[18 * v + k])) +
                                     share[c] * share[c] * double(from_half(baked.indirect[18 * v + 9 + k])));
      for (std::size_t a = 0; a < modes; ++a) {
        const std::size_t i = v * size + c * modes + a;
        // Sums over directions stand for integrals on both sides, to a few parts in a thousand.
        CHECK(double(with[i] - without[i]) ==
              Approx(irradiance / std::numbers::pi * even[c * modes + a]).epsilon(0.01).margin(2e-3));
      }
    }
}

TEST_CASE("threads that ask a context for the same lobes at once get one fit") {
  FitCache cache(nook::default_memory());
  std::atomic<bool> go{false};
  std::array<const LobeFit*, 4> found{};
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < found.size(); ++i)
    threads.emplace_back([&, i] {
      while (!go) {
      }
      found[i] = &cache.of(42);
    });
  go = true;
  for (std::thread& thread : threads) thread.join();
  for (const LobeFit* fit : found) CHECK(fit == found[0]);
  CHECK(cache.of(42).lobes() == 42);
  CHECK(&cache.of(43) != found[0]);
  CHECK(&cache.of(42) == found[0]);
}

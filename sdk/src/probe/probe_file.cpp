#include "sdk/src/probe/probe_file.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sdk/src/core/floats.h"
#include "sdk/src/probe/harmonics.h"

namespace nook::probe {
namespace {

constexpr int mantissa_bits = 9;
constexpr int exponent_bias = 15;

float in_range(float channel) {
  return channel > 0 ? std::min(channel, max_rgb9e5) : 0.0f;  // NaN gives 0, too
}

}  // namespace

std::uint32_t to_rgb9e5(Vec3 rgb) {
  const float channel[3] = {in_range(rgb.x), in_range(rgb.y), in_range(rgb.z)};
  const float largest = std::max({channel[0], channel[1], channel[2]});
  int exponent = -exponent_bias;
  if (largest > 0) std::frexp(largest, &exponent);  // largest = f 2^exponent, f in [1/2, 1)
  exponent = std::max(exponent, -exponent_bias);
  // Rounding may increase the largest mantissa to 512, which needs a larger exponent.
  if (std::ldexp(largest, mantissa_bits - exponent) >= 511.5f) ++exponent;
  std::uint32_t bits = std::uint32_t(exponent + exponent_bias) << 27;
  for (int c = 0; c < 3; ++c) {
    const float mantissa = std::ldexp(channel[c], mantissa_bits - exponent);
    bits |= std::uint32_t(mantissa + 0.5f) << (mantissa_bits * c);
  }
  return bits;
}

Vec3 from_rgb9e5(std::uint32_t bits) {
  const float scale = std::ldexp(1.0f, int(bits >> 27) - exponent_bias - mantissa_bits);
  return {float(bits & 511u) * scale, float(bits >> 9 & 511u) * scale, float(bits >> 18 & 511u) * scale};
}

namespace {

void write_vec3(ByteWriter& out, Vec3 v) {
  out.f32(v.x);
  out.f32(v.y);
  out.f32(v.z);
}

Vec3 read_vec3(ByteReader& in) {
  const float x = in.f32(), y = in.f32(), z = in.f32();
  return {x, y, z};
}

void check_fits(const Probes& probes, Packing packing) {
  for (std::size_t i = 0; i < probes.coefficients.size(); ++i) {
    const Vec3 v = probes.coefficients[i];
    const float most = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    const float least = std::min({v.x, v.y, v.z});
    const std::size_t function = i % probes.basis.count, probe = i / probes.basis.count;
    if (packing == Packing::half && most > max_half)
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                    "coefficient %zu of probe %zu is too large for half floats (got %g, need at most %g); "
                    "scale the light down or pack as floats",
                    function, probe, double(most), double(max_half));
    if (packing == Packing::rgb9e5 && (most > max_rgb9e5 || least < 0))
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                    "coefficient %zu of probe %zu does not fit RGB9E5 (got %g, need 0 to %g); use a "
                    "non-negative method or pack as half floats",
                    function, probe, double(least < 0 ? least : most), double(max_rgb9e5));
  }
  const float limit = packing == Packing::half     ? max_half
                      : packing == Packing::rgb9e5 ? max_rgb9e5
                                                   : max_coefficient;
  for (std::size_t i = 0; i < probes.gloss.size(); ++i) {
    const float most = std::max({probes.gloss[i].x, probes.gloss[i].y, probes.gloss[i].z});
    if (most > limit)
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                    "gloss amplitude %zu of probe %zu is too large for this packing (got %g, need at most "
                    "%g); scale the light down or pack as floats",
                    i % probes.basis.count, i / probes.basis.count, double(most), double(limit));
  }
}

void write_coefficient(ByteWriter& out, Packing packing, Vec3 v) {
  switch (packing) {
    case Packing::float32:
      return write_vec3(out, v);
    case Packing::half:
      for (const float channel : {v.x, v.y, v.z}) out.u16(to_half(channel));
      return;
    case Packing::rgb9e5:
      return out.u32(to_rgb9e5(v));
  }
}

Vec3 read_coefficient(ByteReader& in, Packing packing) {
  switch (packing) {
    case Packing::float32:
      return read_vec3(in);
    case Packing::half: {
      const float x = from_half(std::uint16_t(in.u16())), y = from_half(std::uint16_t(in.u16())),
                  z = from_half(std::uint16_t(in.u16()));
      return {x, y, z};
    }
    case Packing::rgb9e5:
      return from_rgb9e5(in.u32());
  }
  return {};
}

// Reads a byte that selects one of `count` choices.
std::uint32_t read_choice(ByteReader& in, const char* what, std::uint32_t count) {
  const std::uint32_t value = in.u8();
  if (value >= count)
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "the %s of the probe is unknown (got %u, need less than %u); bake it again", what, value,
                  count);
  return value;
}

struct Head {
  Basis basis;
  Grid grid;
  Packing packing = Packing::float32;
};

Head read_head(ByteReader in) {
  Head head;
  head.basis.kind = BasisKind(read_choice(in, "basis", 3));
  head.basis.domain = Domain(read_choice(in, "domain", 2));
  head.basis.ambient = read_choice(in, "ambient term", 2) != 0;
  head.basis.order = read_choice(in, "order", max_order + 1);
  head.basis.count = in.u8();
  head.packing = Packing(read_choice(in, "packing", 3));
  head.basis.up = read_vec3(in);
  for (std::uint32_t& count : head.grid.counts) count = in.u32();
  head.grid.origin_ws = read_vec3(in);
  head.grid.spacing_ws = read_vec3(in);
  in.check_end();
  return head;
}

void read_lobes(ByteReader in, Basis& basis) {
  if (basis.count < 1 || basis.count > max_functions)
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "the number of lobes is out of range (got %u, need 1 to %u); bake the probe again",
                  basis.count, max_functions);
  for (std::uint32_t i = 0; i < basis.count; ++i) {
    basis.axis[i] = read_vec3(in);
    basis.sharpness[i] = in.f32();
  }
  in.check_end();
}

// Sets the functions of a basis that is not made of lobes. The description in the file must match the
// library's basis of the same order.
void complete(Basis& basis) {
  check_basis(basis, NOOK_ERROR_BAD_FILE);
  Basis made = basis.kind == BasisKind::dice ? dice_basis(basis.domain, basis.up)
                                             : harmonic_basis(basis.order, basis.domain, basis.up);
  if (basis.count != made.count || basis.ambient || basis.order != made.order)
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "the number of functions is wrong (got %u, need %u without an ambient term); bake it again",
                  basis.count, made.count);
  made.up = basis.up;
  basis = made;
}

void read_coefficients(ByteReader in, Packing packing, std::uint32_t count, const char* what,
                       Vector<Vec3>& out) {
  in.check_count(count, 8 * packed_bytes(packing), what);
  out.resize(count);
  for (Vec3& v : out) v = read_coefficient(in, packing);
  in.check_end();
}

void write_walls(ByteWriter& out, const GridWalls& walls) {
  out.f32(walls.bias);
  for (const CellWalls& cell : walls.cell) {
    for (const WallPlane& plane : cell.plane)
      for (const float value : {plane.normal.x, plane.normal.y, plane.normal.z, plane.offset})
        out.u16(to_half(value));
    for (const std::uint8_t mask : cell.counts) out.u8(mask);
  }
}

void read_walls(ByteReader in, std::uint32_t cells, GridWalls& walls) {
  constexpr std::uint32_t bits_of_cell = 8 * (8 * wall_planes + wall_sides);
  walls.bias = in.f32();
  in.check_count(cells, bits_of_cell, "cells with walls");
  walls.cell.resize(cells);
  const auto half = [&] { return from_half(std::uint16_t(in.u16())); };
  for (CellWalls& cell : walls.cell) {
    for (WallPlane& plane : cell.plane) {
      const float x = half(), y = half(), z = half();
      plane = {{x, y, z}, half()};
    }
    for (std::uint8_t& mask : cell.counts) mask = std::uint8_t(in.u8());
  }
  in.check_end();
}

}  // namespace

std::vector<std::byte> write_probes(const Probes& probes, Packing packing) {
  check_probes(probes, NOOK_ERROR_INVALID_ARGUMENT);
  check_fits(probes, packing);
  const Basis& basis = probes.basis;
  ByteWriter head, lobes, coefficients, recipe;
  head.u8(std::uint32_t(basis.kind));
  head.u8(std::uint32_t(basis.domain));
  head.u8(basis.ambient ? 1 : 0);
  head.u8(basis.order);
  head.u8(basis.count);
  head.u8(std::uint32_t(packing));
  write_vec3(head, basis.up);
  for (const std::uint32_t count : probes.grid.counts) head.u32(count);
  write_vec3(head, probes.grid.origin_ws);
  write_vec3(head, probes.grid.spacing_ws);
  std::vector<ContainerSection> sections{{four_letters("HEAD"), head.bytes()}};
  if (basis.kind == BasisKind::gaussians) {
    for (std::uint32_t i = 0; i < basis.count; ++i) {
      write_vec3(lobes, basis.axis[i]);
      lobes.f32(basis.sharpness[i]);
    }
    sections.push_back({four_letters("LOBE"), lobes.bytes()});
  }
  for (const Vec3 v : probes.coefficients) write_coefficient(coefficients, packing, v);
  sections.push_back({four_letters("COEF"), coefficients.bytes()});
  if (probes.has_gloss()) {
    ByteWriter gloss;
    for (const Vec3 v : probes.gloss) write_coefficient(gloss, packing, v);
    sections.push_back({four_letters("GLOS"), gloss.bytes()});
  }
  recipe.text(probes.recipe);
  sections.push_back({four_letters("RECP"), recipe.bytes()});
  ContainerKind kind = probe_kind;
  if (probes.walls.any()) {
    ByteWriter walls;
    write_walls(walls, probes.walls);
    sections.push_back({four_letters("WALL"), walls.bytes()});
  } else {
    kind.newest_version = 1;
  }
  return write_container(kind, sections);
}

Packing packing_of(std::span<const std::byte> bytes) {
  return read_head(Container(bytes, probe_kind).section("HEAD")).packing;
}

Probes read_probes(std::span<const std::byte> bytes, Memory* memory) {
  const Container file(bytes, probe_kind);
  const Head head = read_head(file.section("HEAD"));
  Probes probes(memory);
  probes.basis = head.basis;
  probes.grid = head.grid;
  if (head.basis.kind == BasisKind::gaussians)
    read_lobes(file.section("LOBE"), probes.basis);
  else
    complete(probes.basis);
  check_grid(probes.grid, NOOK_ERROR_BAD_FILE);
  const auto count = std::uint32_t(probes.grid.size() * probes.basis.count);
  read_coefficients(file.section("COEF"), head.packing, count, "coefficients", probes.coefficients);
  if (file.has("GLOS"))
    read_coefficients(file.section("GLOS"), head.packing, count, "gloss amplitudes", probes.gloss);
  ByteReader recipe = file.section("RECP");
  probes.recipe = recipe.text(recipe.remaining());
  if (file.version() >= 2 && file.has("WALL"))
    read_walls(file.section("WALL"), std::uint32_t(probes.grid.cells()), probes.walls);
  check_probes(probes, NOOK_ERROR_BAD_FILE);
  return probes;
}

}  // namespace nook::probe

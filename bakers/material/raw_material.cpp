#include "bakers/material/raw_material.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>

#include "sdk/src/core/failure.h"
#include "sdk/src/core/floats.h"

namespace nook::bake::material {

Vec3 direction_from_angles(float tilt_deg, float azimuth_deg) {
  const float degree = std::numbers::pi_v<float> / 180;
  const float tilt = tilt_deg * degree, azimuth = azimuth_deg * degree;
  return {std::sin(tilt) * std::cos(azimuth), std::sin(tilt) * std::sin(azimuth), std::cos(tilt)};
}

std::vector<Vec3> spiral_directions(std::uint32_t count, float max_tilt_deg) {
  if (count < 4)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "too few directions (got %u, need at least 4)", count);
  if (!(max_tilt_deg > 0 && max_tilt_deg < 90))
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "the largest tilt is %g degrees; it must lie between 0 and 90",
                  double(max_tilt_deg));
  const double golden_angle = std::numbers::pi * (3 - std::sqrt(5.0));
  const double lowest = std::cos(double(max_tilt_deg) * std::numbers::pi / 180);
  std::vector<Vec3> directions(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    // Equal steps in z are equal solid angles (Archimedes).
    const double z = 1 - (1 - lowest) * i / (count - 1);
    const double radius = std::sqrt(std::max(0.0, 1 - z * z)), azimuth = golden_angle * i;
    directions[i] = {float(radius * std::cos(azimuth)), float(radius * std::sin(azimuth)), float(z)};
  }
  return directions;
}

namespace {

// These limits are far above any use, but small enough that their product cannot overflow.
constexpr std::uint32_t most_directions = 65536, most_texels_a_side = 16384;

std::vector<std::byte> as_half_bytes(const std::vector<float>& values) {
  std::vector<std::byte> bytes(2 * values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::uint16_t half = to_half(values[i]);
    bytes[2 * i] = std::byte(half & 255u);
    bytes[2 * i + 1] = std::byte(half >> 8);
  }
  return bytes;
}

std::vector<float> from_half_bytes(std::string_view bytes) {
  std::vector<float> values(bytes.size() / 2);
  const auto byte = [&](std::size_t i) { return std::uint32_t(static_cast<unsigned char>(bytes[i])); };
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = from_half(std::uint16_t(byte(2 * i) | byte(2 * i + 1) << 8));
  return values;
}

std::vector<Vec3> read_directions(ByteReader& reader, std::uint32_t count) {
  std::vector<Vec3> directions(reader.check_count(count, 96, "directions"));
  for (Vec3& d : directions)
    for (float* c : {&d.x, &d.y, &d.z}) *c = reader.f32();
  return directions;
}

void need_size(const ByteReader& reader, std::size_t size) {
  if (reader.remaining() != size)
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "section %s does not have the size that the header gives (got "
                  "%zu bytes, need %zu); bake the file again",
                  reader.name(), reader.remaining(), size);
}

void check_directions(const std::vector<Vec3>& directions, const char* what) {
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const Vec3 d = directions[i];
    if (!(std::abs(length(d) - 1) < 1e-3f && d.z >= 0))
      throw Failure(NOOK_ERROR_BAD_FILE,
                    "%s direction %zu, (%g, %g, %g), is not a unit vector of the upper hemisphere", what, i,
                    double(d.x), double(d.y), double(d.z));
    for (std::size_t k = 0; k < i; ++k)
      if (directions[k] == d)
        throw Failure(NOOK_ERROR_BAD_FILE, "%s directions %zu and %zu are the same, (%g, %g, %g)", what, k, i,
                      double(d.x), double(d.y), double(d.z));
  }
}

}  // namespace

void check_raw_material(const RawMaterial& raw) {
  check_directions(raw.lights, "light");
  check_directions(raw.views, "view");
  const std::size_t views = raw.views.size(), texels = raw.texels();
  std::atomic<std::size_t> bad_row{raw.light_rows()};
  const auto first_bad = [&](std::size_t row) {
    const float* values = &raw.btf[row * views * texels];
    for (std::size_t i = 0; i < views * texels; ++i)
      if (!std::isfinite(values[i])) return i;
    return views * texels;
  };
  tbb::parallel_for(std::size_t{0}, raw.light_rows(), [&](std::size_t row) {
    if (first_bad(row) == views * texels) return;
    std::size_t before = bad_row;
    while (row < before && !bad_row.compare_exchange_weak(before, row)) {
    }
  });
  if (bad_row == raw.light_rows()) return;
  const std::size_t at = first_bad(bad_row), texel = at % texels;
  throw Failure(NOOK_ERROR_BAD_FILE,
                "light %zu, channel %zu, view %zu: texel (%zu, %zu) is not a finite number", bad_row / 3,
                bad_row % 3, at / texels, texel / raw.height, texel % raw.height);
}

std::vector<std::byte> write_raw_material(const RawMaterial& raw) {
  ByteWriter head, directions, mask;
  head.u32(std::uint32_t(raw.lights.size()));
  head.u32(std::uint32_t(raw.views.size()));
  head.u32(raw.width);
  head.u32(raw.height);
  head.u32(!raw.mask.empty());
  head.u32(std::uint32_t(raw.name.size()));
  head.text(raw.name);
  for (const auto& set : {raw.lights, raw.views})
    for (const Vec3 d : set)
      for (const float c : {d.x, d.y, d.z}) directions.f32(c);
  for (const float visible : raw.mask) mask.bits(visible > 0.5f, 1);
  const ContainerSection sections[] = {{four_letters("HEAD"), head.bytes()},
                                       {four_letters("DIRS"), directions.bytes()},
                                       {four_letters("BTF_"), as_half_bytes(raw.btf)},
                                       {four_letters("MASK"), mask.bytes()}};
  return write_container(raw_kind, sections);
}

RawMaterial read_raw_material(std::span<const std::byte> bytes) {
  const Container file(bytes, raw_kind);
  ByteReader head = file.section("HEAD"), directions = file.section("DIRS"), btf = file.section("BTF_"),
             mask = file.section("MASK");
  RawMaterial raw;
  const std::uint32_t lights = head.u32(), views = head.u32();
  raw.width = head.u32();
  raw.height = head.u32();
  const bool has_mask = head.u32() != 0;
  raw.name = head.text(head.u32());
  head.check_end();
  if (lights == 0 || views == 0 || lights > most_directions || views > most_directions || raw.texels() == 0 ||
      raw.width > most_texels_a_side || raw.height > most_texels_a_side)
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "the material has %u lights, %u views and %u x %u texels, but "
                  "needs 1 or more of each; bake the file again",
                  lights, views, raw.width, raw.height);
  raw.lights = read_directions(directions, lights);
  raw.views = read_directions(directions, views);
  directions.check_end();
  const std::size_t visible = raw.views.size() * raw.texels();
  need_size(btf, 2 * raw.light_rows() * visible);
  need_size(mask, has_mask ? (visible + 7) / 8 : 0);
  raw.btf = from_half_bytes(btf.text(btf.remaining()));
  if (has_mask) raw.mask.resize(visible);
  for (float& m : raw.mask) m = float(mask.bits(1));
  check_raw_material(raw);
  return raw;
}

namespace {

struct Size {
  std::size_t width = 1, height = 1;
  std::size_t texels() const { return width * height; }
  Size halved() const { return {(width + 1) / 2, (height + 1) / 2}; }
};

// A pyramid of images, starting with the finest level. Texels have the order x * height + y, as in
// RawMaterial.
using Levels = std::vector<std::vector<float>>;

std::vector<Size> sizes_of(Size size) {
  std::vector<Size> sizes{size};
  while (sizes.back().texels() > 1) sizes.push_back(sizes.back().halved());
  return sizes;
}

// Each level holds the sums of 2 x 2 texels of the level before.
void pull(const std::vector<Size>& sizes, Levels& levels) {
  levels.resize(sizes.size());
  for (std::size_t l = 1; l < sizes.size(); ++l) {
    const Size fine = sizes[l - 1], coarse = sizes[l];
    levels[l].assign(coarse.texels(), 0.0f);
    for (std::size_t x = 0; x < fine.width; ++x)
      for (std::size_t y = 0; y < fine.height; ++y)
        levels[l][x / 2 * coarse.height + y / 2] += levels[l - 1][x * fine.height + y];
  }
}

// Texel `at / 2` of the coarser level is the nearest to the texel `at`. Returns the second nearest one.
std::size_t beside(std::size_t at, std::size_t size) {
  return (at / 2 + (at % 2 ? 1 : size - 1)) % size;
}

// Divides the sums by the weights, which gives means. Empty texels get the linearly interpolated values of
// the coarser level.
void push(const std::vector<Size>& sizes, const Levels& weights, Levels& levels) {
  for (std::size_t l = sizes.size(); l-- > 0;) {
    const Size fine = sizes[l];
    for (std::size_t x = 0; x < fine.width; ++x)
      for (std::size_t y = 0; y < fine.height; ++y) {
        float& value = levels[l][x * fine.height + y];
        const float weight = weights[l][x * fine.height + y];
        if (weight > 0) {
          value /= weight;
        } else if (l + 1 < sizes.size()) {
          const Size coarse = sizes[l + 1];
          const std::size_t near_x = x / 2 * coarse.height, far_x = beside(x, coarse.width) * coarse.height;
          const std::size_t near_y = y / 2, far_y = beside(y, coarse.height);
          const std::vector<float>& from = levels[l + 1];
          value = (9 * from[near_x + near_y] + 3 * (from[far_x + near_y] + from[near_x + far_y]) +
                   from[far_x + far_y]) /
                  16;
        }
      }
  }
}

Levels pulled_weights(const std::vector<Size>& sizes, std::span<const float> coverage) {
  Levels weights(1);
  weights[0].assign(coverage.begin(), coverage.end());
  pull(sizes, weights);
  return weights;
}

void fill_image(const std::vector<Size>& sizes, const Levels& weights, float* image) {
  Levels levels(1);
  levels[0].resize(sizes[0].texels());
  for (std::size_t i = 0; i < levels[0].size(); ++i) levels[0][i] = weights[0][i] > 0 ? image[i] : 0;
  pull(sizes, levels);
  push(sizes, weights, levels);
  std::ranges::copy(levels[0], image);
}

}  // namespace

void fill_gaps(RawMaterial& raw, std::span<const float> coverage) {
  const std::size_t views = raw.views.size(), texels = raw.texels();
  if (coverage.size() != views * texels)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "the coverage has %zu values, but the %zu views have %zu texels in all", coverage.size(),
                  views, views * texels);
  const std::vector<Size> sizes = sizes_of({raw.width, raw.height});
  for (std::size_t view = 0; view < views; ++view) {
    const std::span<const float> own = coverage.subspan(view * texels, texels);
    if (std::ranges::all_of(own, [](float share) { return share == 1; })) continue;
    const Levels weights = pulled_weights(sizes, own);
    tbb::parallel_for(std::size_t{0}, raw.light_rows(), [&](std::size_t row) {
      fill_image(sizes, weights, &raw.btf[(row * views + view) * texels]);
    });
  }
}

void fill_image_gaps(std::span<float> image, std::span<const float> coverage, std::uint32_t width,
                     std::uint32_t height) {
  const std::vector<Size> sizes = sizes_of({width, height});
  fill_image(sizes, pulled_weights(sizes, coverage), image.data());
}

}  // namespace nook::bake::material

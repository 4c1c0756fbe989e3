// Writes .btf files of UBO2014 whose factors hold given values exactly: one factor is the unit matrix.
#pragma once

#include <cmath>
#include <vector>

#include "sdk/src/core/bytes.h"
#include "sdk/src/core/floats.h"

namespace nook::bake::material::test {

struct BtfFile {
  std::vector<float> lights, views;  // tilt and azimuth of each, radians
  std::uint32_t width = 0, height = 0;
  int colour_model = 0;
  float mean[3] = {}, matrix[9] = {};
  bool has_cosine = true, is_half = false, rotated = true;
  bool texels_are_rows = false;  // of the matrices, which have light and view pairs in their columns then
  std::uint32_t version = 4;
  // Of each channel, after the colour model: pair (light + lights * view) x texel (x + width * y, y from the
  // top).
  std::vector<float> channels[3];

  std::size_t pairs() const { return lights.size() / 2 * (views.size() / 2); }
  std::size_t texels() const { return std::size_t(width) * height; }
};

inline std::vector<std::byte> btf_head(const BtfFile& file) {
  ByteWriter rest;
  rest.u32(file.version);
  for (int i = 0; i < 3 * 80; ++i) rest.u8(i % 80 ? 0 : 'x');
  for (int i = 0; i < 4; ++i) rest.f32(1);
  if (file.version > 1) rest.u32(file.has_cosine);
  if (file.version > 2) {
    rest.u32(6);
    rest.text("<xml/>");
  }
  if (file.version > 3) rest.u32(3);
  for (int c = 0; file.version > 3 && c < 3; ++c) {
    rest.u32(1);
    rest.u8("RGB"[c]);
  }
  ByteWriter head;
  head.text(file.rotated ? "!DFMF08FCR" : "!DFMF08FC");
  head.u32(std::uint32_t(rest.bytes().size() + 4));
  std::vector<std::byte> bytes = head.bytes();
  bytes.insert(bytes.end(), rest.bytes().begin(), rest.bytes().end());
  return bytes;
}

inline void write_btf_channel(const BtfFile& file, const std::vector<float>& values, ByteWriter& out) {
  const std::size_t pairs = file.pairs(), texels = file.texels();
  const auto number = [&](float v) { file.is_half ? out.u16(to_half(v)) : out.f32(v); };
  out.u8(file.is_half ? 2 : 4);
  out.u32(std::uint32_t(pairs));
  out.u32(std::uint32_t(file.texels_are_rows ? texels : pairs));
  out.u32(std::uint32_t(file.texels_are_rows ? pairs : texels));
  for (std::size_t i = 0; i < pairs; ++i) number(1);
  const auto unit = [&] {
    for (std::size_t i = 0; i < pairs * pairs; ++i) number(i % (pairs + 1) == 0);
  };
  if (!file.texels_are_rows) unit();
  for (std::size_t t = 0; t < texels; ++t)
    for (std::size_t p = 0; p < pairs; ++p) number(values[p * texels + t]);
  if (file.texels_are_rows) unit();
}

inline std::vector<std::byte> write_btf_file(const BtfFile& file) {
  ByteWriter out;
  out.u32(std::uint32_t(file.views.size() / 2));
  for (std::size_t v = 0; v < file.views.size(); v += 2) {
    out.f32(file.views[v]);
    out.f32(file.views[v + 1]);
    out.u32(std::uint32_t(file.lights.size() / 2));
    for (const float angle : file.lights) out.f32(angle);
  }
  out.u32(file.width);
  out.u32(file.height);
  if (file.rotated) out.u32(0);
  out.u32(std::uint32_t(file.pairs()));
  out.u32(std::uint32_t(file.colour_model));
  for (const float m : file.mean) out.f32(m);
  for (const float m : file.matrix) out.f32(m);
  for (const std::vector<float>& values : file.channels) write_btf_channel(file, values, out);
  std::vector<std::byte> bytes = btf_head(file);
  bytes.insert(bytes.end(), out.bytes().begin(), out.bytes().end());
  return bytes;
}

// Two lights, three views, and different values everywhere.
inline BtfFile small_btf() {
  BtfFile file;
  file.lights = {0, 0, 0.5f, 2};
  file.views = {0, 0, 0.5f, 1, 1, -2};
  file.width = 4;
  file.height = 5;
  for (int c = 0; c < 3; ++c)
    for (std::size_t i = 0; i < file.pairs() * file.texels(); ++i)
      file.channels[c].push_back(0.1f + 0.3f * float(c) + 0.005f * float(i));
  return file;
}

}  // namespace nook::bake::material::test

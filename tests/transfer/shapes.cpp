#include "tests/transfer/shapes.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <numbers>

namespace nook::transfer::test {
namespace {

constexpr float pi = std::numbers::pi_v<float>;

// Two triangles for each cell of a grid of columns x rows vertices; u grows along columns, v along rows.
void add_grid(Shape& shape, std::uint32_t first, std::uint32_t columns, std::uint32_t rows) {
  for (std::uint32_t r = 0; r + 1 < rows; ++r)
    for (std::uint32_t c = 0; c + 1 < columns; ++c) {
      const std::uint32_t at = first + r * columns + c;
      shape.triangle.push_back({at, at + 1, at + columns});
      shape.triangle.push_back({at + 1, at + columns + 1, at + columns});
    }
}

Vec3 knot_point(float a) {
  const float radius = 0.3f * (1 + 0.45f * std::cos(3 * a));
  return {radius * std::cos(2 * a), 0.25f + 0.135f * std::sin(3 * a), radius * std::sin(2 * a)};
}

template <class T>
void add_bytes(std::vector<std::byte>& bytes, const std::vector<T>& values) {
  const std::size_t at = bytes.size();
  bytes.resize(at + values.size() * sizeof(T));
  std::memcpy(bytes.data() + at, values.data(), values.size() * sizeof(T));
}

void add_word(std::vector<std::byte>& bytes, std::uint32_t word) {
  for (int i = 0; i < 4; ++i) bytes.push_back(std::byte(word >> (8 * i)));
}

std::string json_of(const Shape& shape, std::size_t size) {
  Vec3 low = shape.position[0], high = low;
  for (const Vec3 p : shape.position) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  const std::string count = std::to_string(shape.position.size()),
                    indices = std::to_string(3 * shape.triangle.size());
  const auto triple = [](Vec3 v) {
    char text[80];
    std::snprintf(text, sizeof text, "[%.9g,%.9g,%.9g]", double(v.x), double(v.y), double(v.z));
    return std::string(text);
  };
  const std::size_t vertex = shape.position.size();
  const auto view = [](std::size_t offset, std::size_t bytes) {
    return "{\"buffer\":0,\"byteOffset\":" + std::to_string(offset) +
           ",\"byteLength\":" + std::to_string(bytes) + "}";
  };
  std::string text = R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],)";
  text +=
      R"("meshes":[{"primitives":[{"attributes":{"POSITION":0,"NORMAL":1,"TEXCOORD_0":2},"indices":3}]}],)";
  text += "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"type\":\"VEC3\",\"count\":" + count +
          ",\"min\":" + triple(low) + ",\"max\":" + triple(high) + "},";
  text += "{\"bufferView\":1,\"componentType\":5126,\"type\":\"VEC3\",\"count\":" + count + "},";
  text += "{\"bufferView\":2,\"componentType\":5126,\"type\":\"VEC2\",\"count\":" + count + "},";
  text += "{\"bufferView\":3,\"componentType\":5125,\"type\":\"SCALAR\",\"count\":" + indices + "}],";
  text += "\"bufferViews\":[" + view(0, 12 * vertex) + "," + view(12 * vertex, 12 * vertex) + "," +
          view(24 * vertex, 8 * vertex) + "," + view(32 * vertex, 12 * shape.triangle.size()) + "],";
  text += "\"buffers\":[{\"byteLength\":" + std::to_string(size) + "}]}";
  while (text.size() % 4) text += ' ';
  return text;
}

}  // namespace

Shape plane(float side_m, std::uint32_t across, float tiles, float y) {
  Shape shape;
  for (std::uint32_t r = 0; r < across; ++r)
    for (std::uint32_t c = 0; c < across; ++c) {
      const float s = float(c) / float(across - 1), t = float(r) / float(across - 1);
      shape.position.push_back({side_m * (s - 0.5f), y, side_m * (0.5f - t)});
      shape.normal.push_back({0, 1, 0});
      shape.uv.push_back({tiles * s, tiles * t});
    }
  add_grid(shape, 0, across, across);
  return shape;
}

Shape ball(Vec3 centre, float radius_m, std::uint32_t around) {
  Shape shape;
  const std::uint32_t columns = around + 1, rows = around / 2 + 1;
  for (std::uint32_t r = 0; r < rows; ++r)
    for (std::uint32_t c = 0; c < columns; ++c) {
      const float s = float(c) / float(columns - 1), t = float(r) / float(rows - 1);
      const float height = -std::cos(pi * t), wide = std::sin(pi * t);
      const Vec3 n{wide * std::cos(2 * pi * s), height, -wide * std::sin(2 * pi * s)};
      shape.position.push_back(centre + n * radius_m);
      shape.normal.push_back(normalised(n));
      shape.uv.push_back({2 * s, t});
    }
  add_grid(shape, 0, columns, rows);
  return shape;
}

Shape knot_over_plane(std::uint32_t along, std::uint32_t around, std::uint32_t across) {
  constexpr float tube = 0.085f;
  Shape shape;
  for (std::uint32_t k = 0; k < around; ++k)
    for (std::uint32_t i = 0; i < along; ++i) {
      const float a = 2 * pi * float(i % (along - 1)) / float(along - 1);
      const float b = 2 * pi * float(k % (around - 1)) / float(around - 1);
      const Vec3 forward = normalised(knot_point(a + 1e-3f) - knot_point(a - 1e-3f));
      const Vec3 side = normalised(cross(forward, {0, 1, 0})), up = cross(side, forward);
      const Vec3 n = normalised(side * std::cos(b) + up * std::sin(b));
      shape.position.push_back(knot_point(a) + n * tube);
      shape.normal.push_back(n);
      shape.uv.push_back({24 * float(i) / float(along - 1), 3 * float(k) / float(around - 1)});
    }
  add_grid(shape, 0, along, around);
  append(shape, plane(1.6f, across, 9));
  return shape;
}

Shape draped_cloth() {
  constexpr std::uint32_t across = 96;
  constexpr float radius = 0.3f, side = 1.1f;
  Shape shape;
  const auto at = [](float x, float z) {
    const float r = std::sqrt(x * x + z * z), angle = std::atan2(z, x);
    // The arc over the ball, then a steep fall with folds that deepen downwards.
    const float arc = std::min(r / radius, 1.35f), rest = std::max(r - 1.35f * radius, 0.0f);
    const float fold = 0.12f * rest / 0.4f * std::cos(9 * angle);
    const float out = radius * std::sin(arc) + rest * 0.25f + fold * 0.6f;
    const float down = radius * (1 - std::cos(arc)) + rest * 0.92f;
    return Vec3{out * std::cos(angle), 2 * radius + 0.03f - down, out * std::sin(angle)};
  };
  for (std::uint32_t r = 0; r < across; ++r)
    for (std::uint32_t c = 0; c < across; ++c) {
      const float s = float(c) / float(across - 1), t = float(r) / float(across - 1);
      const float x = side * (s - 0.5f) + 1e-5f, z = side * (0.5f - t) + 1e-5f;
      constexpr float step = 1e-3f;
      const Vec3 along_x = at(x + step, z) - at(x - step, z), along_z = at(x, z + step) - at(x, z - step);
      shape.position.push_back(at(x, z));
      shape.normal.push_back(normalised(cross(along_z, along_x)));
      shape.uv.push_back({6 * s, 6 * t});
    }
  add_grid(shape, 0, across, across);
  append(shape, plane(1.6f, 40, 9));
  return shape;
}

void append(Shape& shape, const Shape& other) {
  const auto first = std::uint32_t(shape.position.size());
  shape.position.insert(shape.position.end(), other.position.begin(), other.position.end());
  shape.normal.insert(shape.normal.end(), other.normal.begin(), other.normal.end());
  shape.uv.insert(shape.uv.end(), other.uv.begin(), other.uv.end());
  for (const auto& t : other.triangle) shape.triangle.push_back({t[0] + first, t[1] + first, t[2] + first});
}

std::vector<std::byte> glb_of(const Shape& shape) {
  std::vector<std::byte> binary;
  add_bytes(binary, shape.position);
  add_bytes(binary, shape.normal);
  add_bytes(binary, shape.uv);
  add_bytes(binary, shape.triangle);
  const std::string json = json_of(shape, binary.size());
  std::vector<std::byte> file;
  for (const std::uint32_t word : {0x46546c67u, 2u, std::uint32_t(28 + json.size() + binary.size()),
                                   std::uint32_t(json.size()), 0x4e4f534au})
    add_word(file, word);
  for (const char c : json) file.push_back(std::byte(c));
  add_word(file, std::uint32_t(binary.size()));
  add_word(file, 0x004e4942u);
  file.insert(file.end(), binary.begin(), binary.end());
  return file;
}

}  // namespace nook::transfer::test

#include "bakers/material/btf_file.h"

#include <tbb/parallel_for.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "bakers/material/raw_material.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/core/floats.h"

namespace nook::bake::material {
namespace {

using Matrix = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
constexpr std::string_view signature = "!DFMF08FC";
// These limits are far above any use, but small enough that products cannot overflow.
constexpr std::uint32_t most_directions = 65536, most_texels_a_side = 65536;

// The part of the file that is not read yet.
class Rest {
 public:
  explicit Rest(std::span<const std::byte> bytes) : bytes_(bytes) {}

  std::size_t size() const { return bytes_.size(); }
  std::span<const std::byte> take(std::uint64_t size, const char* what) {
    if (size > bytes_.size())
      throw Failure(NOOK_ERROR_BAD_FILE,
                    "the .btf file ends inside its %s (got %zu bytes, need %llu); download the file again",
                    what, bytes_.size(), static_cast<unsigned long long>(size));
    const auto taken = bytes_.first(std::size_t(size));
    bytes_ = bytes_.subspan(std::size_t(size));
    return taken;
  }
  std::uint32_t u8(const char* what) { return std::to_integer<std::uint32_t>(take(1, what)[0]); }
  std::uint32_t u32(const char* what);
  float f32(const char* what) { return bit_cast<float>(u32(what)); }

 private:
  std::span<const std::byte> bytes_;
};

std::uint64_t little(std::span<const std::byte> bytes) {
  std::uint64_t value = 0;
  for (std::size_t i = bytes.size(); i > 0; --i)
    value = value << 8 | std::to_integer<std::uint64_t>(bytes[i - 1]);
  return value;
}

std::uint32_t Rest::u32(const char* what) {
  return std::uint32_t(little(take(4, what)));
}

// Returns true if the file has rotations after the size.
bool read_signature(Rest& rest, std::span<const std::byte> bytes) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()),
                              std::min(bytes.size(), signature.size() + 1));
  if (text.substr(0, signature.size()) != signature)
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "the file does not begin with %.9s; need a BTF of UBO2014, compressed "
                  "by decorrelated full matrix factorisation",
                  signature.data());
  const bool rotated = text.size() > signature.size() && text.back() == 'R';
  rest.take(signature.size() + rotated, "signature");
  return rotated;
}

// Returns true if the data include the cosine of the light.
bool read_head(Rest& rest) {
  constexpr const char* what = "head";
  const std::size_t before = rest.size();
  const std::uint32_t size = rest.u32(what), version = rest.u32(what);
  rest.take(3 * 80 + 4 * 4, what);
  const bool has_cosine = version > 1 && rest.u32(what) != 0;
  if (version > 2) rest.take(rest.u32(what), what);
  const std::uint32_t channels = version > 3 ? rest.u32(what) : 3;
  if (channels != 3) throw Failure(NOOK_ERROR_BAD_FILE, "the .btf file has %u channels, need 3", channels);
  for (std::uint32_t c = 0; version > 3 && c < channels; ++c) rest.take(rest.u32(what), what);
  if (before - rest.size() != size)
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "the header of the .btf file says that it has %u bytes, but it has %zu", size,
                  before - rest.size());
  return has_cosine;
}

Vec3 read_direction(Rest& rest) {
  constexpr float degrees = 180 / 3.14159265358979f;
  const float tilt = rest.f32("directions"), azimuth = rest.f32("directions");
  return direction_from_angles(degrees * tilt, degrees * azimuth);
}

std::uint32_t check_directions(const Rest& rest, std::uint32_t count, const char* what) {
  if (count == 0 || count > most_directions || count > rest.size() / 8)
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "the .btf file says that it has %u %s directions, which is 0 or too many", count, what);
  return count;
}

void read_directions(Rest& rest, RawMaterial& raw) {
  const std::uint32_t views = check_directions(rest, rest.u32("directions"), "view");
  for (std::uint32_t v = 0; v < views; ++v) {
    raw.views.push_back(read_direction(rest));
    const std::uint32_t lights = check_directions(rest, rest.u32("directions"), "light");
    std::vector<Vec3> of_view(lights);
    for (Vec3& light : of_view) light = read_direction(rest);
    if (v == 0) raw.lights = of_view;
    if (of_view != raw.lights)
      throw Failure(NOOK_ERROR_BAD_FILE,
                    "the lights of view %u differ from the lights of view 0; all views need the same lights",
                    v);
  }
}

struct Size {
  std::uint32_t width = 0, height = 0;
};

Size read_size(Rest& rest, bool rotated) {
  Size size;
  size.width = rest.u32("size");
  size.height = rest.u32("size");
  if (rotated) rest.take(std::uint64_t(rest.u32("size")) * 9 * 4, "rotations");
  if (size.width == 0 || size.height == 0 || size.width > most_texels_a_side ||
      size.height > most_texels_a_side)
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "the .btf file says that it has %u x %u texels, which is 0 or too many", size.width,
                  size.height);
  return size;
}

// The transform that decorrelates colours.
struct ColourModel {
  int model = 0;
  Eigen::RowVector3f mean;
  Eigen::Matrix<float, 3, 3, Eigen::RowMajor> matrix;
};

ColourModel read_colour_model(Rest& rest) {
  constexpr const char* what = "colour model";
  ColourModel colour;
  rest.u32(what);  // skips the largest number of components
  colour.model = int(rest.u32(what));
  for (int i = 0; i < 3; ++i) colour.mean[i] = rest.f32(what);
  for (int i = 0; i < 9; ++i) colour.matrix(i / 3, i % 3) = rest.f32(what);
  constexpr int known[] = {0, 1, 3, 4, 9, 10, 11, 12};
  if (std::ranges::count(known, colour.model) == 0)
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "the .btf file has the colour model %d; Nook reads RGB (0), YUV (1), principal components "
                  "(3), YCoCg (4) and the logarithmic models 9 to 12",
                  colour.model);
  return colour;
}

Eigen::RowVector3f from_yuv(const Eigen::RowVector3f& c) {
  return {c[0] + 1.13983f * c[2], c[0] - 0.39465f * c[1] - 0.5806f * c[2], c[0] + 2.03211f * c[1]};
}

// Converts the three channels to linear RGB.
Eigen::RowVector3f to_rgb(const ColourModel& colour, Eigen::RowVector3f c) {
  constexpr float least = 1e-5f;  // added before the logarithm
  const float exponential = std::exp(c[0]);
  const auto from_signed_logarithm = [](float v) {
    return std::copysign(v == 0 ? 0.0f : least * std::exp(std::abs(v)), v);
  };
  switch (colour.model) {
    case 1:
      return from_yuv(c);
    case 3:
      return c * colour.matrix + colour.mean;
    case 4:
      return {c[0] + c[1] - c[2], c[0] + c[2], c[0] - c[1] - c[2]};
    case 9:
      return from_yuv({exponential - least, c[1], c[2]});
    case 10:
      return from_yuv({exponential - least, from_signed_logarithm(c[1]), from_signed_logarithm(c[2])});
    case 11:
      return from_yuv({exponential - least, c[1] * exponential, c[2] * exponential});
    case 12:
      return (c.array().exp() - least).matrix();
    default:
      return c;
  }
}

float number_of(std::span<const std::byte> bytes) {
  const std::uint64_t bits = little(bytes);
  if (bytes.size() == 2) return from_half(std::uint16_t(bits));
  return bytes.size() == 4 ? bit_cast<float>(std::uint32_t(bits)) : float(bit_cast<double>(bits));
}

// A matrix in the file, stored row by row.
struct Rows {
  std::span<const std::byte> bytes;
  std::size_t number_bytes = 0, columns = 0;

  void copy(std::size_t row, float* out) const {
    for (std::size_t i = 0; i < columns; ++i)
      out[i] = number_of(bytes.subspan((row * columns + i) * number_bytes, number_bytes));
  }
};

// The values of a channel are pairs * texels^T.
struct Channel {
  Matrix pairs;   // row light + lights * view
  Matrix texels;  // rows for the texels of the square that is read, in the order of RawMaterial::btf
};

Matrix all_rows(const Rows& rows, std::size_t count) {
  Matrix matrix(Eigen::Index(count), Eigen::Index(rows.columns));
  for (std::size_t r = 0; r < count; ++r) rows.copy(r, matrix.row(Eigen::Index(r)).data());
  return matrix;
}

// Returns the rows of the texels in the middle of the file's texture. In a raw material, y starts at the
// bottom, but in the file it starts at the top.
Matrix middle_rows(const Rows& rows, Size size, const RawMaterial& raw) {
  Matrix matrix(Eigen::Index(raw.texels()), Eigen::Index(rows.columns));
  const std::size_t left = (size.width - raw.width) / 2, top = (size.height - raw.height) / 2;
  for (std::size_t x = 0; x < raw.width; ++x)
    for (std::size_t y = 0; y < raw.height; ++y)
      rows.copy((top + raw.height - 1 - y) * size.width + left + x,
                matrix.row(Eigen::Index(x * raw.height + y)).data());
  return matrix;
}

Channel read_channel(Rest& rest, Size size, const RawMaterial& raw) {
  constexpr const char* what = "channels";
  const std::uint32_t number_bytes = rest.u8(what);
  if (number_bytes != 2 && number_bytes != 4 && number_bytes != 8)
    throw Failure(NOOK_ERROR_BAD_FILE, "the .btf file has numbers of %u bytes, need 2, 4 or 8", number_bytes);
  const std::uint64_t components = rest.u32(what), rows = rest.u32(what), columns = rest.u32(what);
  const std::uint64_t pairs = std::uint64_t(raw.lights.size()) * raw.views.size(),
                      texels = std::uint64_t(size.width) * size.height;
  const bool by_pairs = rows == pairs && columns == texels;
  if (components == 0 || !(by_pairs || (rows == texels && columns == pairs)))
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "a channel of the .btf file has %llu components, %llu rows and %llu columns; need one or "
                  "more components, %llu rows and %llu columns",
                  static_cast<unsigned long long>(components), static_cast<unsigned long long>(rows),
                  static_cast<unsigned long long>(columns), static_cast<unsigned long long>(pairs),
                  static_cast<unsigned long long>(texels));
  rest.take(components * number_bytes, "singular values");
  const auto matrix = [&](std::uint64_t count) {
    // Divides instead of multiplying, because the product of the sizes in a damaged file may exceed 64 bits.
    const bool fits = count <= rest.size() / (components * number_bytes);
    return Rows{rest.take(fits ? count * components * number_bytes : UINT64_MAX, "matrices"), number_bytes,
                std::size_t(components)};
  };
  const Rows left = matrix(rows), right = matrix(columns);
  return {all_rows(by_pairs ? left : right, std::size_t(pairs)),
          middle_rows(by_pairs ? right : left, size, raw)};
}

void decode_view(std::size_t view, const std::array<Channel, 3>& channels, const ColourModel& colour,
                 bool has_cosine, RawMaterial& raw) {
  const std::size_t lights = raw.lights.size(), texels = raw.texels();
  std::array<Matrix, 3> values;  // lights x texels
  for (std::size_t c = 0; c < 3; ++c)
    values[c] = channels[c].pairs.middleRows(Eigen::Index(view * lights), Eigen::Index(lights)) *
                channels[c].texels.transpose();
  for (std::size_t l = 0; l < lights; ++l) {
    const float cosine = has_cosine ? 1 : raw.lights[l].z;
    for (std::size_t t = 0; t < texels; ++t) {
      const auto at = [&](std::size_t c) { return values[c](Eigen::Index(l), Eigen::Index(t)); };
      const Eigen::RowVector3f rgb = cosine * to_rgb(colour, {at(0), at(1), at(2)});
      for (std::size_t c = 0; c < 3; ++c)
        raw.btf[((3 * l + c) * raw.views.size() + view) * texels + t] = rgb[Eigen::Index(c)];
    }
  }
}

}  // namespace

RawMaterial read_btf_file(std::span<const std::byte> bytes, std::uint32_t texels, std::size_t most_bytes) {
  Rest rest(bytes);
  const bool rotated = read_signature(rest, bytes);
  const bool has_cosine = read_head(rest);
  RawMaterial raw;
  read_directions(rest, raw);
  const Size size = read_size(rest, rotated);
  if (texels > std::min(size.width, size.height))
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "a square of %u texels is larger than the image (%u x %u); use a smaller one", texels,
                  size.width, size.height);
  raw.width = texels ? texels : size.width;
  raw.height = texels ? texels : size.height;
  const double values = double(raw.light_rows()) * double(raw.views.size()) * double(raw.texels());
  if (values > double(most_bytes / sizeof(float)))
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "%zu lights, %zu views and %u x %u texels take %.1f GiB as floats, which is too much; "
                  "choose a smaller square (--texels)",
                  raw.lights.size(), raw.views.size(), raw.width, raw.height,
                  values * sizeof(float) / double(1 << 30));
  const ColourModel colour = read_colour_model(rest);
  std::array<Channel, 3> channels;
  for (Channel& channel : channels) channel = read_channel(rest, size, raw);
  if (rest.size() != 0)
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "the .btf file has %zu bytes after its last channel (need 0); download the file again",
                  rest.size());
  raw.btf.resize(std::size_t(values));
  tbb::parallel_for(std::size_t{0}, raw.views.size(),
                    [&](std::size_t v) { decode_view(v, channels, colour, has_cosine, raw); });
  round_to_halves(raw);
  check_raw_material(raw);
  return raw;
}

}  // namespace nook::bake::material

#include <cmath>
#include <functional>
#include <limits>
#include <string>

#include "sdk/src/core/floats.h"
#include "sdk/src/nnao/exact_packing.h"
#include "sdk/src/nnao/projection_check.h"
#include "sdk/src/nnao/recording_file.h"
#include "tests/catch.h"
#include "tests/nnao/network_sample.h"
#include "tests/nnao/recording_sample.h"

using namespace nook;
using namespace nook::nnao;
using nook::test::sample_recording;

namespace {

nook_result read_result(std::span<const std::byte> bytes) {
  try {
    read_recording(bytes);
  } catch (const Failure& failure) {
    return failure.code();
  }
  return NOOK_OK;
}

std::vector<std::uint32_t> bits(const Vector<float>& values) {
  std::vector<std::uint32_t> out;
  for (const float value : values) out.push_back(bit_cast<std::uint32_t>(value));
  return out;
}

ExactPacking round_trip(const Vector<float>& values) {
  ByteWriter out;
  write_exact(out, values);
  CHECK(out.bytes().size() == 2 + values.size() * exact_packing(values).bytes());
  Vector<float> read;
  read_exact({out.bytes(), "TEST"}, std::uint32_t(values.size()), read);
  CHECK(bits(read) == bits(values));
  return exact_packing(values);
}

constexpr float infinite = std::numeric_limits<float>::infinity(),
                nan_number = std::numeric_limits<float>::quiet_NaN();

// glFrustum's or glOrtho's third row, and what depth a surface at a distance gets.
struct Lens {
  float projection[16] = {};
  ClipRange clip = ClipRange::negative_one_to_one;

  Lens(bool perspective, float near_m, float far_m, bool reversed, ClipRange range) : clip(range) {
    projection[0] = projection[5] = 1.3f;
    // ndc is first at near and second at far.
    const float low = range == ClipRange::zero_to_one ? 0.0f : -1.0f;
    const float first = reversed ? 1 : low, second = reversed ? low : 1;
    if (perspective) {
      // ndc = a + b / depth.
      const float b = std::isinf(far_m) ? (first - second) * near_m
                                        : (first - second) * near_m * far_m / (far_m - near_m);
      const float a = first - b / near_m;
      projection[10] = -a;
      projection[11] = -1;
      projection[14] = b;
    } else {
      // ndc = a + b depth.
      const float b = (second - first) / (far_m - near_m);
      projection[10] = -b;
      projection[14] = first - b * near_m;
      projection[15] = 1;
    }
  }
  float stored(double depth) const {
    const double ndc = (-double(projection[10]) * depth + projection[14]) /
                       (-double(projection[11]) * depth + projection[15]);
    return float(clip == ClipRange::zero_to_one ? ndc : 0.5 * ndc + 0.5);
  }
};

}  // namespace

TEST_CASE("numbers of few bits are packed, and every number comes back with its bits") {
  for (const std::uint32_t bits_of : {8u, 10u, 16u, 24u}) {
    const std::uint32_t largest = (1u << bits_of) - 1, step = bits_of == 24 ? 401 : 1;
    Vector<float> divided, multiplied, wide;
    for (std::uint32_t i = 0; i <= largest; i += step) {
      divided.push_back(float(i) / float(largest));
      multiplied.push_back(float(i) * (1.0f / float(largest)));
      wide.push_back(float(double(i) * (1.0 / double(largest))));
    }
    INFO(bits_of);
    CHECK(round_trip(divided).bits == bits_of);
    // A product of floats has fewer bits than 24, so that integers run together.
    CHECK(round_trip(multiplied).bits == (bits_of == 24 ? 32 : bits_of));
    CHECK(round_trip(wide).bits == bits_of);
  }
  Vector<float> halves, floats;
  for (std::uint32_t i = 0; i < 0x7c00; i += 3) halves.push_back(from_half(std::uint16_t(i | (i % 2) << 15)));
  for (int i = 0; i < 100; ++i) floats.push_back(std::sin(float(i)));
  CHECK(round_trip(halves) == packed_as_halves);
  CHECK(round_trip(floats) == packed_as_floats);
  CHECK(round_trip({0.0f, 1.0f}).bits == 8);
  CHECK(round_trip({-0.0f, 1.0f}) == packed_as_halves);
  CHECK(round_trip({infinite, -infinite}) == packed_as_halves);
  // The payload of a NaN stays.
  CHECK(round_trip({bit_cast<float>(0x7fc00001u), 0.5f}) == packed_as_floats);
}

TEST_CASE("a recorded frame comes back from its file bit for bit") {
  for (const bool everything : {true, false}) {
    Recording recording = sample_recording(9, 7, everything);
    recording.depth[4] = nan_number;
    recording.depth[5] = -infinite;
    const std::vector<std::byte> file = write_recording(recording);
    const Recording read = read_recording(file);
    CHECK(write_recording(read) == file);
    CHECK(bits(read.depth) == bits(recording.depth));
    CHECK(bits(read.normals) == bits(recording.normals));
    CHECK(bits(read.layer) == bits(recording.layer));
    CHECK(bits(read.ao) == bits(recording.ao));
    CHECK(std::ranges::equal(read.frame.projection, recording.frame.projection));
    CHECK(read.frame.intensity == recording.frame.intensity);
    CHECK(read.frame.layer == recording.frame.layer);
    CHECK(read.pass.taps == 16);
    CHECK(read.network == recording.network);
    CHECK(read.note == recording.note);
    CHECK(read.library_version == NOOK_VERSION);
    CHECK(recorded_network(read).embedded);
  }
}

TEST_CASE("a recorded frame cut or flipped at any byte is refused") {
  const std::vector<std::byte> good = write_recording(sample_recording());
  for (std::size_t i = 0; i < good.size(); ++i) {
    const std::vector<std::byte> cut(good.begin(), good.begin() + std::ptrdiff_t(i));
    REQUIRE(read_result(cut) == NOOK_ERROR_BAD_FILE);
    auto flipped = good;
    flipped[i] ^= std::byte{0x81};
    REQUIRE(read_result(flipped) != NOOK_OK);
  }
}

TEST_CASE("a recorded frame flipped with its checksum repaired is refused or sound") {
  const std::vector<std::byte> good = write_recording(sample_recording());
  std::size_t refused = 0;
  for (std::size_t i = 0; i < good.size(); ++i)
    for (const unsigned flip : {0x01u, 0x40u, 0x80u, 0xffu}) {
      auto file = good;
      file[i] ^= std::byte(flip);
      repair_checksum(file);
      try {
        const Recording read = read_recording(file);
        check_recording(read);
        const std::vector<float> depths = view_depths(read);
        REQUIRE(view_normals(read, depths).size() == read.pixels());
        recorded_network(read);
      } catch (const Failure& failure) {
        REQUIRE((failure.code() == NOOK_ERROR_BAD_FILE || failure.code() == NOOK_ERROR_FILE_VERSION));
        ++refused;
      }
    }
  CHECK(refused > 0);
}

TEST_CASE("a recorded frame of a size that its bytes do not hold allocates nothing for it") {
  // 16384 x 16384 pixels in a file of some hundred bytes; width and height follow the library's version.
  Recording recording = sample_recording(4, 4, false);
  std::vector<std::byte> file = write_recording(recording);
  const std::size_t head = 40 + 24 * 5;
  for (const std::size_t at : {head + 4, head + 8}) {
    REQUIRE(file[at] == std::byte{4});
    file[at] = std::byte{0};
    file[at + 1] = std::byte{0x40};
  }
  repair_checksum(file);
  struct Bounded final : Memory {
    void* do_allocate(std::size_t bytes, std::size_t alignment) override {
      REQUIRE(bytes < 100000);
      return default_memory()->allocate(bytes, alignment);
    }
    void do_deallocate(void* memory, std::size_t bytes, std::size_t alignment) override {
      default_memory()->deallocate(memory, bytes, alignment);
    }
  } bounded;
  try {
    read_recording(file, &bounded);
    FAIL();
  } catch (const Failure& failure) {
    CHECK(failure.code() == NOOK_ERROR_BAD_FILE);
    CHECK(std::string(failure.what()).find("DPTH is too short") != std::string::npos);
  }
}

TEST_CASE("a frame that no pass draws is not recorded, and the text names the number") {
  struct Case {
    const char* text;
    std::function<void(Recording&)> spoil;
  };
  const Case cases[] = {
      {"width and height", [](Recording& r) { r.width = 0; }},
      {"width and height", [](Recording& r) { r.height = 16385; }},
      {"depth has the wrong size", [](Recording& r) { r.depth.pop_back(); }},
      {"normals has the wrong size", [](Recording& r) { r.normals.push_back(0); }},
      {"layer_texels has the wrong size", [](Recording& r) { r.layer.clear(); }},
      {"ao is out of range", [](Recording& r) { r.ao[3] = nan_number; }},
      {"ao is out of range", [](Recording& r) { r.ao[3] = 1.01f; }},
      {"radius", [](Recording& r) { r.frame.radius = 0; }},
      {"radius", [](Recording& r) { r.frame.radius = nan_number; }},
      {"max_radius_px", [](Recording& r) { r.frame.max_radius_px = 0.5f; }},
      {"min_radius_px", [](Recording& r) { r.frame.min_radius_px = -1; }},
      {"fade_begin", [](Recording& r) { r.frame.fade_begin = -1; }},
      {"fade_end", [](Recording& r) { r.frame.fade_begin = r.frame.fade_end = 2; }},
      {"intensity", [](Recording& r) { r.frame.intensity = 17; }},
      {"power", [](Recording& r) { r.frame.power = 0; }},
      {"sky_depth", [](Recording& r) { r.frame.sky_depth = -1; }},
      {"normal_scale", [](Recording& r) { r.frame.normal_scale = 0; }},
      {"normal_matrix", [](Recording& r) { r.frame.normal_matrix[0] = 0; }},
      {"projection[3]", [](Recording& r) { r.frame.projection[3] = infinite; }},
      {"projection[4]", [](Recording& r) { r.frame.projection[4] = 1; }},
      {"depth_kind", [](Recording& r) { r.frame.depth_kind = 2; }},
      {"clip", [](Recording& r) { r.frame.clip = -1; }},
      {"view", [](Recording& r) { r.frame.view = 3; }},
      {"taps", [](Recording& r) { r.pass.taps = 17; }},
      {"blur", [](Recording& r) { r.pass.blur = 3; }},
      {"blur_sharpness", [](Recording& r) { r.pass.blur_sharpness = -1; }},
      {"path", [](Recording& r) { r.pass.path = 3; }},
      {"note has a control character", [](Recording& r) { r.note = "\x1b[2J"; }},
      {"renderer is too long", [](Recording& r) { r.renderer.assign(1001, 'x'); }},
  };
  for (const auto& [text, spoil] : cases) {
    Recording recording = sample_recording();
    spoil(recording);
    INFO(text);
    try {
      write_recording(recording);
      FAIL_CHECK("it was written");
    } catch (const Failure& failure) {
      CHECK(failure.code() == NOOK_ERROR_INVALID_ARGUMENT);
      CHECK(std::string(failure.what()).find(text) != std::string::npos);
    }
  }
}

TEST_CASE("stored depth gives the distance under every projection, and the far plane is not a surface") {
  for (const bool perspective : {true, false})
    for (const bool reversed : {true, false})
      for (const ClipRange clip : {ClipRange::negative_one_to_one, ClipRange::zero_to_one})
        for (const float far_m : {40.0f, infinite}) {
          if (!perspective && std::isinf(far_m)) continue;
          const Lens lens(perspective, 0.2f, far_m, reversed, clip);
          check_projection(lens.projection, DepthKind::hardware, clip);
          const DepthDecode decode = depth_decode({lens.projection, DepthKind::hardware, clip, 0});
          INFO(perspective << reversed << int(clip) << far_m);
          // Depth of 24 bits and more: a float near 1 has a step of 6e-8, which at 10 m and a near plane of
          // 0.2 m is 3e-5 m; the coefficients are rounded to floats as well.
          for (const double depth : {0.25, 1.0, 3.0, 10.0})
            CHECK(std::abs(view_depth(decode, perspective, lens.stored(depth)) - depth) < 3e-4 * depth);
          CHECK(std::isinf(view_depth(decode, perspective, reversed ? 0.0f : 1.0f)));
          CHECK(std::isinf(view_depth(decode, perspective, nan_number)));
        }
  const Lens lens(true, 0.1f, 10, false, ClipRange::negative_one_to_one);
  const DepthDecode linear =
      depth_decode({lens.projection, DepthKind::linear, ClipRange::negative_one_to_one, 50});
  CHECK(view_depth(linear, true, 3.25f) == 3.25f);
  for (const float none : {50.0f, 51.0f, 0.0f, -1.0f, infinite, nan_number})
    CHECK(std::isinf(view_depth(linear, true, none)));
}

TEST_CASE("logarithmic depth gives the distance, and 1 is not a surface") {
  const Lens lens(true, 0.1f, 10, false, ClipRange::negative_one_to_one);
  for (const double scale : {0.01, 1.0, 1000.0})
    for (const double near_m : {0.0, 0.2})
      for (const double far_m : {10.0, 1e9}) {
        const DepthDecode decode =
            depth_decode({lens.projection, DepthKind::logarithmic, ClipRange::negative_one_to_one, 0,
                          float(scale), float(near_m), float(far_m)});
        INFO(scale << " " << near_m << " " << far_m);
        // The stored value is rounded to 2^-25, times the natural logarithm of the range; the relative error
        // of 1 + C w is the product. exp2 has some steps of 1.2e-7 more.
        const double step = std::log(1 + scale * far_m) * 6e-8 + 5e-7;
        for (const double depth : {0.25, 1.0, 3.0, 9.0}) {
          const auto stored =
              float(std::log2(1 + scale * (depth - near_m)) / std::log2(1 + scale * (far_m - near_m)));
          CHECK(std::abs(view_depth(decode, true, stored) - depth) < step * (depth + 1 / scale));
        }
        CHECK(std::isinf(view_depth(decode, true, 1.0f)));
        CHECK(std::isinf(view_depth(decode, true, nan_number)));
      }
}

TEST_CASE("a recording of the first format version has its radius in metres") {
  Recording recording = sample_recording();
  recording.frame.radius_kind = 1;
  CHECK(read_recording(write_recording(recording)).frame.radius_kind == 1);
  recording.frame.radius = 1.5f;
  CHECK_THROWS_AS(write_recording(recording), Failure);
  recording = sample_recording();
  std::vector<std::byte> bytes = write_recording(recording);
  // The head is the first section, and its size stands at byte 56; version 1 ends 13 bytes earlier.
  bytes[8] = std::byte{1};
  bytes[56] = std::byte(std::to_integer<int>(bytes[56]) - 13);
  repair_checksum(bytes);
  CHECK(read_recording(bytes).frame.radius == recording.frame.radius);
}

TEST_CASE("a recording of the second format version has neither a minimum of its radius nor a fade") {
  Recording recording = sample_recording();
  recording.frame.min_radius_px = 12;
  recording.frame.fade_begin = 3;
  recording.frame.fade_end = 40;
  std::vector<std::byte> bytes = write_recording(recording);
  const RecordedFrame read = read_recording(bytes).frame;
  CHECK((read.min_radius_px == 12 && read.fade_begin == 3 && read.fade_end == 40));
  bytes[8] = std::byte{2};
  bytes[56] = std::byte(std::to_integer<int>(bytes[56]) - 12);
  repair_checksum(bytes);
  const RecordedFrame old = read_recording(bytes).frame;
  CHECK((old.min_radius_px == 0 && old.fade_begin == 0 && old.fade_end == 0));
  CHECK(old.radius == recording.frame.radius);
}

TEST_CASE("normals of a recording are the host's in view space, or come from depth where it has none") {
  // A plane that faces the viewer at 2 m: every normal is +z.
  Recording recording = sample_recording(6, 5, false);
  recording.frame.depth_kind = 1;
  recording.depth.assign(recording.pixels(), 2.0f);
  const std::vector<float> depths = view_depths(recording);
  for (const Vec3 n : view_normals(recording, depths)) CHECK(length(n - Vec3{0, 0, 1}) < 1e-5f);
  // World space with z up: (0, 0, 1) there is (0, 1, 0) in view space. It is stored as (n + 1) / 2.
  recording.normals.clear();
  for (std::size_t i = 0; i < recording.pixels(); ++i)
    for (const float c : {0.5f, 0.5f, 1.0f}) recording.normals.push_back(i == 7 ? 0.5f : c);
  recording.frame.normal_scale = 2;
  recording.frame.normal_bias = -1;
  const float turn[9] = {1, 0, 0, 0, 0, -1, 0, 1, 0};
  std::ranges::copy(turn, recording.frame.normal_matrix);
  const std::vector<Vec3> normals = view_normals(recording, depths);
  CHECK(length(normals[3] - Vec3{0, 1, 0}) < 1e-6f);
  // Nothing was drawn into this pixel.
  CHECK(length(normals[7] - Vec3{0, 0, 1}) < 1e-5f);
}

TEST_CASE("a recording with the network of another library is read, and says that it cannot be evaluated") {
  Recording recording = sample_recording();
  const auto own = write_network(test::sample_network(NetworkForm::horizon));
  recording.network.assign(own.begin(), own.end());
  CHECK((recorded_network(recording).readable && !recorded_network(recording).embedded));
  recording.network[recording.network.size() / 2] ^= std::byte{1};
  const Recording read = read_recording(write_recording(recording));
  CHECK(!recorded_network(read).readable);
  recording.network.clear();
  CHECK(!recorded_network(read_recording(write_recording(recording))).readable);
}

// Means over frames: the reference, cuts, what was not seen before, motion vectors, noise, bad frames.
#include <nook/experimental/nook_stages.h>
#include <algorithm>
#include <numeric>

#include "sdk/src/nnao/filter.h"
#include "sdk/src/nnao/history.h"
#include "tests/gl/nnao_images.h"
#include "tests/gl/test_context.h"

using namespace nook;
using namespace nook::test;

namespace {

constexpr float step = 1.0f / 255;  // of the 8 bits that AO is kept in
constexpr int width = 60, height = 40;
constexpr float radius = 0.8f, sharpness = 16;

struct Sequence : NnaoFixture {
  explicit Sequence(platform::Context& made_in, int half = 0) : NnaoFixture(made_in) {
    PassDesc desc = pass_desc(width, height);
    desc.taps = 9;
    desc.blur = 0;
    desc.blur_sharpness = sharpness;
    desc.half_resolution = half;
    desc.max_history_frames = 8;
    pass = create_pass(gl, desc, network);
  }
  ~Sequence() { nook_nnao_destroy(&pass); }

  ScreenFrame frame(const Picture& picture) {
    return frame_desc(camera, width, height, depth_of(camera, picture), normals_of(picture), radius);
  }
  std::vector<float> draw(const ScreenFrame& drawn) {
    NOOK_OK_OR_FAIL(nook_nnao_render(pass, &drawn, &drawn));
    return own_ao(context.gl(), pass, width, height);
  }

  nnao::Network network = mild_network(nnao::NetworkForm::horizon);
  Camera camera = plain_camera(float(width) / height);
  nook_nnao pass = nullptr;
};

std::vector<Surface> moved(std::vector<Surface> scene, Vec3 by) {
  for (Surface& surface : scene) {
    if (surface.ball)
      surface.normal_or_centre += by;
    else
      surface.offset_or_radius += dot(surface.normal_or_centre, by);
  }
  return scene;
}

// The AO of one frame in 8 bits, and the edges.
struct Raw {
  std::vector<float> ao;
  std::vector<std::uint8_t> edges;
};

Raw raw_of(const nnao::Network& network, const Picture& picture, std::uint32_t frame) {
  Raw raw;
  const nnao::View view = picture.view();
  for (std::uint32_t y = 0; y < picture.height; ++y)
    for (std::uint32_t x = 0; x < picture.width; ++x) {
      if (!view.has_surface(x, y)) {
        raw.ao.push_back(1);
        raw.edges.push_back(0);
        continue;
      }
      const float ao =
          nnao::evaluate_unclamped(network, view, view.normal[view.at(x, y)], {radius, 0.25f * height, 9}, x,
                                   y, nnao::noise_of_frame(nnao::tap_noise(x, y), frame));
      raw.ao.push_back(std::round(255 * std::clamp(ao, 0.0f, 1.0f)) * step);
      raw.edges.push_back(nnao::packed_edges(nnao::neighbours_of(view, x, y, radius / sharpness).connected));
    }
  return raw;
}

Mat3x4 translation(Vec3 by) {
  Mat3x4 m;
  m.m[3] = by.x;
  m.m[7] = by.y;
  m.m[11] = by.z;
  return m;
}

double share_beyond(const std::vector<float>& a, const std::vector<float>& b, float bound) {
  double count = 0;
  for (std::size_t i = 0; i < a.size(); ++i) count += std::abs(a[i] - b[i]) > bound;
  return count / double(a.size());
}

}  // namespace

TEST_CASE("nnao: a mean over frames is the reference's, for still and for moving cameras") {
  NOOK_NEED_CONTEXT(context);
  for (const Vec3 by : {Vec3{}, Vec3{0.02f, 0.01f, 0.03f}, Vec3{-0.11f, 0, 0}}) {
    Sequence sequence(context);
    std::vector<float> ao, frames;
    Picture before;
    for (std::uint32_t f = 0; f < 6; ++f) {
      // The camera moves against the scene.
      const Picture picture = look(sequence.camera, moved(still_life(), float(f) * by), width, height);
      ScreenFrame frame = sequence.frame(picture);
      // The pass forms the same translation from two views, within float rounding: far below a pixel.
      const Mat3x4 earlier_from_view = translation(-by);
      frame.view[12] = float(f) * by.x;
      frame.view[13] = float(f) * by.y;
      frame.view[14] = float(f) * by.z;
      const std::vector<float> found = sequence.draw(frame);
      const Raw raw = raw_of(sequence.network, picture, f);
      const nnao::History history{before.width, before.height, before.rays,      before.depth,
                                  ao,           frames,        earlier_from_view};
      std::vector<float> mean, count;
      for (std::uint32_t y = 0; y < picture.height; ++y)
        for (std::uint32_t x = 0; x < picture.width; ++x) {
          const nnao::MeanAo texel = nnao::accumulated(
              {picture.view(), raw.ao, raw.edges, {}, 9, radius / sharpness}, history, x, y, f == 0 ? 1 : 8);
          mean.push_back(texel.ao);
          count.push_back(texel.frames);
        }
      INFO("frame " << f << ", the camera moves by " << by.x << " " << by.y << " " << by.z);
      // 8 bits, and the sixteenth of a step that the kept mean rounds to. A tap or a depth on the border of
      // two answers goes another way for a few texels, see nnao_agreement_test.cpp, and stays so in the mean.
      CHECK(share_beyond(found, mean, 1.1f * step) < 0.01);
      ao = std::move(mean);
      frames = std::move(count);
      before = picture;
    }
    // Whatever stays in view has a mean of all frames.
    CHECK(std::ranges::count(frames, 6.0f) > (length(by) > 0.1f ? 1000 : 1400));
  }
}

TEST_CASE("nnao: the first frame and the frame after a cut do not use the history") {
  NOOK_NEED_CONTEXT(context);
  for (const int half : {0, 1}) {
    Sequence sequence(context, half);
    const Picture one = look(sequence.camera, still_life(), width, height);
    const Picture other = look(sequence.camera, moved(still_life(), {0.6f, 0.2f, 0.5f}), width, height);
    nook_nnao plain = sequence.pass_of(9, half, 0, &sequence.network);
    const ScreenFrame alone = sequence.frame(one);
    NOOK_OK_OR_FAIL(nook_nnao_render(plain, &alone, &alone));
    CHECK(sequence.draw(sequence.frame(one)) == own_ao(context.gl(), plain, width, height));
    sequence.draw(sequence.frame(one));
    ScreenFrame cut = sequence.frame(other);
    cut.reset = 1;
    const std::vector<float> after = sequence.draw(cut);
    // The reference of the fourth frame.
    if (half == 0) CHECK(share_beyond(after, raw_of(sequence.network, other, 2).ao, 1.1f * step) < 0.005);
    // Another size of the viewport is a cut as well.
    ScreenFrame smaller = sequence.frame(one);
    smaller.viewport[2] = width / 2;
    smaller.viewport[3] = height;
    NOOK_OK_OR_FAIL(nook_nnao_render(sequence.pass, &smaller, &smaller));
  }
}

TEST_CASE("nnao: the noise of a mean over frames falls, and a flat wall keeps its AO") {
  NOOK_NEED_CONTEXT(context);
  Sequence sequence(context);
  const Picture picture = look(sequence.camera, still_life(), width, height);
  std::vector<float> first = sequence.draw(sequence.frame(picture)), last;
  for (int f = 1; f < 16; ++f) last = sequence.draw(sequence.frame(picture));
  // The truth of the noise's mean: many frames of the reference.
  std::vector<double> wanted(first.size());
  constexpr std::uint32_t many = 64;
  for (std::uint32_t f = 0; f < many; ++f) {
    const Raw raw = raw_of(sequence.network, picture, f);
    for (std::size_t i = 0; i < wanted.size(); ++i) wanted[i] += double(raw.ao[i]) / many;
  }
  double noise_first = 0, noise_last = 0;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    noise_first += (double(first[i]) - wanted[i]) * (double(first[i]) - wanted[i]);
    noise_last += (double(last[i]) - wanted[i]) * (double(last[i]) - wanted[i]);
  }
  INFO("squared noise of a frame " << noise_first << ", of the mean of eight " << noise_last);
  // A moving mean over eight independent frames has an eighth of the variance; frames that follow R2 have
  // less, and the clamp to the likely range leaves some.
  CHECK(noise_last < 0.3 * noise_first);
}

TEST_CASE("nnao: a surface that was hidden before starts without history, and leaves no trail") {
  NOOK_NEED_CONTEXT(context);
  Sequence sequence(context);
  const std::vector<Surface> wall{plane_through({0, 0, -4}, {0, 0, 1})};
  std::vector<Surface> with_ball = wall;
  with_ball.push_back(ball({0, 0, -2.5f}, 0.4f));
  for (int f = 0; f < 5; ++f) sequence.draw(sequence.frame(look(sequence.camera, with_ball, width, height)));
  const Picture empty = look(sequence.camera, wall, width, height);
  const std::vector<float> after = sequence.draw(sequence.frame(empty));
  // The wall is open everywhere at once, also where the ball darkened it.
  for (const float ao : after) CHECK(ao > 1 - 1.5f * step);
}

TEST_CASE("nnao: motion vectors carry the mean with a surface") {
  NOOK_NEED_CONTEXT(context);
  // The scene moves by three pixels under an orthographic camera; motion in pixels and in texture
  // coordinates.
  const Camera parallel = cameras(float(width) / height)[6];
  for (const bool in_pixels : {true, false}) {
    Sequence with(context), without(context);
    with.camera = without.camera = parallel;
    const Picture probe = look(parallel, still_life(), width, height);
    const float pixel_m = std::abs(probe.rays.x_scale);
    const float moved_px = in_pixels ? 3.0f : 3.0f / width;
    std::vector<float> motion;
    for (int i = 0; i < width * height; ++i) motion.insert(motion.end(), {moved_px, 0});
    double off_with = 0, off_without = 0;
    for (int f = 0; f < 5; ++f) {
      const Picture picture =
          look(parallel, moved(still_life(), {3 * pixel_m * float(f), 0, 0}), width, height);
      ScreenFrame frame = with.frame(picture);
      frame.motion_vectors = with.textures.floats(GL_RG32F, 2, width, height, motion);
      if (!in_pixels) {
        frame.motion_vector_scale[0] = width;
        frame.motion_vector_scale[1] = height;
      }
      const std::vector<float> found = with.draw(frame), lost = without.draw(without.frame(picture));
      if (f < 4) continue;
      std::vector<double> wanted(found.size());
      for (std::uint32_t k = 0; k < 32; ++k) {
        const Raw raw = raw_of(with.network, picture, k);
        for (std::size_t i = 0; i < wanted.size(); ++i) wanted[i] += double(raw.ao[i]) / 32;
      }
      for (int y = 0; y < height; ++y)
        for (int x = 16; x < width; ++x) {  // on the left things came into view
          const std::size_t i = std::size_t(y) * width + std::size_t(x);
          off_with += std::abs(double(found[i]) - wanted[i]);
          off_without += std::abs(double(lost[i]) - wanted[i]);
        }
    }
    INFO("in pixels " << in_pixels << ": off by " << off_with << " with motion, " << off_without
                      << " without");
    CHECK(off_with < 0.85 * off_without);
  }
}

TEST_CASE("nnao: bad descriptions of means over frames are refused with their field") {
  NOOK_NEED_CONTEXT(context);
  Sequence sequence(context);
  PassDesc desc = pass_desc(3840, 2160);
  std::uint64_t bytes = 0;
  desc.max_history_frames = 8;
  NOOK_OK_OR_FAIL(nook_nnao_memory(&desc, &bytes));
  CHECK(bytes == std::uint64_t{3840} * 2160 * 21);
  desc.bent_normals = 1;
  CHECK(nook_nnao_memory(&desc, &bytes) == NOOK_ERROR_INVALID_ARGUMENT);
  desc.bent_normals = 0;
  for (const int frames : {-1, 1, 65}) {
    desc.max_history_frames = frames;
    CHECK(nook_nnao_memory(&desc, &bytes) == NOOK_ERROR_INVALID_ARGUMENT);
    CHECK(std::string(nook_last_message()).find("max_history_frames") != std::string::npos);
  }
  const Picture picture = look(sequence.camera, still_life(), width, height);
  const auto refused = [&](const ScreenFrame& frame, const char* field) {
    CHECK(nook_nnao_render(sequence.pass, &frame, &frame) == NOOK_ERROR_INVALID_ARGUMENT);
    INFO(nook_last_message());
    CHECK(std::string(nook_last_message()).find(field) != std::string::npos);
  };
  ScreenFrame frame = sequence.frame(picture);
  frame.view[5] = std::nanf("");
  refused(frame, "frame.view");
  frame = sequence.frame(picture);
  frame.motion_vector_scale[1] = std::numeric_limits<float>::infinity();
  refused(frame, "motion_vector_scale");
  frame = sequence.frame(picture);
  frame.reset = 2;
  refused(frame, "reset");
  frame = sequence.frame(picture);
  // OpenGL ES 3.0 does not tell the sizes of textures.
  if (!context.is_es() || version_of(context) >= 31) {
    frame.motion_vectors = sequence.textures.floats(GL_RG32F, 2, width / 2, height, {});
    refused(frame, "motion_vectors");
  }
  frame.motion_vectors = 123456;
  refused(frame, "motion_vectors");
  // Motion that is not a number, and motion out of the image, use no history.
  frame = sequence.frame(picture);
  std::vector<float> motion;
  for (int i = 0; i < width * height; ++i)
    motion.insert(motion.end(), {i % 2 ? std::nanf("") : 1e30f, i % 3 ? 0.0f : std::nanf("")});
  sequence.draw(sequence.frame(picture));
  frame.motion_vectors = sequence.textures.floats(GL_RG32F, 2, width, height, motion);
  const std::vector<float> found = sequence.draw(frame);
  CHECK(share_beyond(found, raw_of(sequence.network, picture, 1).ao, 1.1f * step) < 0.005);
}

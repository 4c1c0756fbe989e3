#include "sdk/src/nnao/recording_file.h"

#include "sdk/src/core/failure.h"
#include "sdk/src/nnao/exact_packing.h"

namespace nook::nnao {
namespace {

// Calls visit(field) for every 32-bit float of the frame's settings, in the order of the file.
template <class Frame, class Visit>
void visit_numbers(Frame& frame, Visit&& visit) {
  visit(frame.sky_depth);
  visit(frame.normal_scale);
  visit(frame.normal_bias);
  for (auto& value : frame.normal_matrix) visit(value);
  for (auto& value : frame.projection) visit(value);
  visit(frame.radius);
  visit(frame.max_radius_px);
  visit(frame.intensity);
  visit(frame.power);
}

template <class Recorded, class Visit>
void visit_texts(Recorded& recording, Visit&& visit) {
  visit(recording.vendor);
  visit(recording.renderer);
  visit(recording.driver_version);
  visit(recording.note);
}

void read_head(ByteReader in, std::uint32_t version, Recording& recording) {
  recording.library_version = in.u32();
  recording.width = in.u32();
  recording.height = in.u32();
  RecordedFrame& frame = recording.frame;
  for (std::int32_t* choice : {&frame.depth_kind, &frame.clip, &frame.layer, &frame.view})
    *choice = std::int32_t(in.u8());
  visit_numbers(frame, [&](float& value) { value = in.f32(); });
  if (version > 1) frame.radius_kind = std::int32_t(in.u8());
  if (version > 2)
    for (float* number : {&frame.min_radius_px, &frame.fade_begin, &frame.fade_end}) *number = in.f32();
  in.check_end();
  const std::uint32_t most = max_recorded_size_px;
  if (recording.width < 1 || recording.height < 1 || recording.width > most || recording.height > most)
    throw Failure(
        NOOK_ERROR_BAD_FILE,
        "the size of the frame is out of range (got %u x %u, need 1 x 1 to %u x %u); record it again",
        recording.width, recording.height, most, most);
}

void read_pass(ByteReader in, RecordedPass& pass) {
  pass.taps = std::int32_t(in.u32());
  for (std::int32_t* choice : {&pass.half_resolution, &pass.blur, &pass.path})
    *choice = std::int32_t(in.u8());
  pass.blur_sharpness = in.f32();
  in.check_end();
}

void read_texts(ByteReader in, Recording& recording) {
  visit_texts(recording, [&](String& text) { text = in.text(in.u32()); });
  in.check_end();
}

}  // namespace

std::vector<std::byte> write_recording(const Recording& recording) {
  check_recording(recording);
  const RecordedFrame& frame = recording.frame;
  const RecordedPass& pass = recording.pass;
  std::vector<ContainerSection> sections;
  ByteWriter head, settings, network, texts;
  for (const std::uint32_t value : {recording.library_version, recording.width, recording.height})
    head.u32(value);
  for (const std::int32_t choice : {frame.depth_kind, frame.clip, frame.layer, frame.view})
    head.u8(std::uint32_t(choice));
  visit_numbers(frame, [&](float value) { head.f32(value); });
  head.u8(std::uint32_t(frame.radius_kind));
  for (const float number : {frame.min_radius_px, frame.fade_begin, frame.fade_end}) head.f32(number);
  sections.push_back({four_letters("HEAD"), head.bytes()});
  settings.u32(std::uint32_t(pass.taps));
  for (const std::int32_t choice : {pass.half_resolution, pass.blur, pass.path})
    settings.u8(std::uint32_t(choice));
  settings.f32(pass.blur_sharpness);
  sections.push_back({four_letters("PASS"), settings.bytes()});
  const std::pair<FourLetters, const Vector<float>*> images[] = {{four_letters("DPTH"), &recording.depth},
                                                                 {four_letters("NORM"), &recording.normals},
                                                                 {four_letters("LAYR"), &recording.layer},
                                                                 {four_letters("AOCC"), &recording.ao}};
  for (const auto& [name, values] : images) {
    if (values->empty()) continue;
    ByteWriter image;
    write_exact(image, *values);
    sections.push_back({name, image.bytes()});
  }
  sections.push_back(
      {four_letters("NETW"), std::vector<std::byte>(recording.network.begin(), recording.network.end())});
  visit_texts(recording, [&](const String& text) {
    texts.u32(std::uint32_t(text.size()));
    texts.text(text);
  });
  sections.push_back({four_letters("TEXT"), texts.bytes()});
  return write_container(recording_kind, sections);
}

Recording read_recording(std::span<const std::byte> bytes, Memory* memory) {
  const Container file(bytes, recording_kind);
  Recording recording(memory);
  read_head(file.section("HEAD"), file.version(), recording);
  read_pass(file.section("PASS"), recording.pass);
  const auto pixels = std::uint32_t(recording.pixels());
  read_exact(file.section("DPTH"), pixels, recording.depth);
  if (file.has("NORM")) read_exact(file.section("NORM"), 3 * pixels, recording.normals);
  if (file.has("LAYR")) read_exact(file.section("LAYR"), 2 * pixels, recording.layer);
  if (file.has("AOCC")) read_exact(file.section("AOCC"), pixels, recording.ao);
  ByteReader network = file.section("NETW");
  recording.network.reserve(network.remaining());
  while (network.remaining()) recording.network.push_back(std::byte(network.u8()));
  read_texts(file.section("TEXT"), recording);
  try {
    check_recording(recording);
  } catch (const Failure& failure) {
    throw Failure(NOOK_ERROR_BAD_FILE, "%s; record it again", failure.what());
  }
  return recording;
}

}  // namespace nook::nnao

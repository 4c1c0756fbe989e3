// Recorded frames through the C interface: bad parameters, structs of other releases, memory.
#include <nook/experimental/nook_recording.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/abi/growing_struct.h"
#include "tests/abi/host.h"

using namespace nook::test;

namespace {

constexpr nook_result invalid = NOOK_ERROR_INVALID_ARGUMENT;

bool last_is(const char* start, const char* part) {
  const std::string text = nook_last_message();
  return text.rfind(start, 0) == 0 && text.find(part) != std::string::npos;
}

// A frame of a host with another graphics interface.
struct Frame {
  static constexpr int width = 5, height = 4;
  std::vector<float> depth = std::vector<float>(width * height, 0.97f),
                     normals = std::vector<float>(3 * width * height, 0.5f),
                     layer = std::vector<float>(2 * width * height, 0.25f),
                     ao = std::vector<float>(width * height, 0.75f);
  nook_nnao_recording_desc desc{};

  Frame() {
    nook_nnao_recording_desc_init(&desc);
    desc.width = width;
    desc.height = height;
    desc.depth = depth.data();
    desc.normals = normals.data();
    desc.layer_texels = layer.data();
    desc.layer = 2;
    desc.ao = ao.data();
    desc.radius = 0.5f;
    const float projection[16] = {1.5f, 0, 0, 0, 0, 1.5f, 0, 0, 0, 0, -1, -1, 0, 0, -0.2f, 0};
    std::copy_n(projection, 16, desc.projection);
    desc.vendor = "a vendor with a name that is not short";
    desc.renderer = "a renderer with a name that is not short";
    desc.driver_version = "a version with a name that is not short";
    desc.note = "a remark that is longer than a short string";
  }
};

// A context and a recording.
struct RecordedStage {
  Host host;
  Frame frame;
  nook_context context = nullptr;
  nook_nnao_recording recording = nullptr;

  RecordedStage() {
    const nook_context_desc desc = host.context_desc();
    nook_context_create(&desc, &context);
    REQUIRE(nook_nnao_recording_create(context, &frame.desc, &recording) == NOOK_OK);
  }
  ~RecordedStage() {
    nook_nnao_recording_destroy(&recording);
    nook_context_destroy(&context);
  }
  RecordedStage(const RecordedStage&) = delete;
  RecordedStage& operator=(const RecordedStage&) = delete;
};

nook_result run_everything(Host& host) {
  const Frame frame;
  nook_result first_failure = NOOK_OK;
  const auto note = [&](nook_result result) {
    if (first_failure == NOOK_OK) first_failure = result;
    return result == NOOK_OK;
  };
  const nook_context_desc context_desc = host.context_desc();
  nook_context context = nullptr;
  nook_nnao_recording recording = nullptr, loaded = nullptr;
  std::vector<unsigned char> file(8192);
  std::size_t size = file.size();
  if (note(nook_context_create(&context_desc, &context)) &&
      note(nook_nnao_recording_create(context, &frame.desc, &recording)) &&
      note(nook_nnao_recording_save(recording, file.data(), &size)) &&
      note(nook_nnao_recording_load(context, file.data(), size, &loaded))) {
  }
  nook_context_destroy(&context);
  nook_nnao_recording_destroy(&loaded);
  nook_nnao_recording_destroy(&recording);
  return first_failure;
}

}  // namespace

TEST_CASE("recorded frames: what is read from a file makes an equal one") {
  const RecordedStage stage;
  std::size_t size = 0;
  REQUIRE(nook_nnao_recording_save(stage.recording, nullptr, &size) == NOOK_OK);
  std::vector<unsigned char> file(size), again(size);
  std::size_t room = size - 1;
  CHECK(nook_nnao_recording_save(stage.recording, file.data(), &room) == invalid);
  CHECK(room == size);
  REQUIRE(nook_nnao_recording_save(stage.recording, file.data(), &size) == NOOK_OK);
  nook_nnao_recording loaded = nullptr, made = nullptr;
  REQUIRE(nook_nnao_recording_load(stage.context, file.data(), size, &loaded) == NOOK_OK);
  nook_nnao_recording_desc desc{};
  desc.struct_size = sizeof desc;
  REQUIRE(nook_nnao_recording_describe(loaded, &desc) == NOOK_OK);
  const Frame& frame = stage.frame;
  CHECK(desc.width == Frame::width);
  CHECK(desc.height == Frame::height);
  CHECK(desc.radius == 0.5f);
  CHECK(desc.taps == 9);
  CHECK(desc.network != nullptr);
  CHECK(desc.library_version == nook_version());
  CHECK(desc.renderer == std::string(frame.desc.renderer));
  CHECK(std::equal(frame.depth.begin(), frame.depth.end(), desc.depth));
  CHECK(std::equal(frame.ao.begin(), frame.ao.end(), desc.ao));
  REQUIRE(nook_nnao_recording_create(stage.context, &desc, &made) == NOOK_OK);
  REQUIRE(nook_nnao_recording_save(made, again.data(), &size) == NOOK_OK);
  CHECK(again == file);
  nook_nnao_recording_destroy(&made);
  nook_nnao_recording_destroy(&loaded);
}

TEST_CASE("recorded frames: structs of every release") {
  check_init<nook_nnao_recording_desc>(nook_desc_init, NOOK_DESC_NNAO_RECORDING);
  const RecordedStage stage;
  check_use(stage.frame.desc, [&](const nook_nnao_recording_desc* desc) {
    nook_nnao_recording recording = nullptr;
    const nook_result result = nook_nnao_recording_create(stage.context, desc, &recording);
    nook_nnao_recording_destroy(&recording);
    return result;
  });
  check_info<nook_nnao_recording_desc>(
      [&](nook_nnao_recording_desc* desc) { return nook_nnao_recording_describe(stage.recording, desc); });
}

TEST_CASE("recorded frames: bad parameters name their field") {
  const RecordedStage stage;
  nook_nnao_recording recording = nullptr;
  const auto refused = [&](auto&& change, const char* part, nook_result code = invalid) {
    Frame frame;
    change(frame.desc);
    INFO(part);
    CHECK(nook_nnao_recording_create(stage.context, &frame.desc, &recording) == code);
    CHECK(recording == nullptr);
    CHECK(last_is("nook_nnao_recording_create: ", part));
  };
  using Desc = nook_nnao_recording_desc;
  refused([](Desc& d) { d.width = 0; }, "desc.width and desc.height");
  refused([](Desc& d) { d.height = 20000; }, "got 5 x 20000");
  refused([](Desc& d) { d.depth = nullptr; }, "desc.depth");
  refused([](Desc& d) { d.layer_texels = nullptr; }, "layer_texels");
  refused([](Desc& d) { d.layer = 5; }, "layer is unknown (got 5, need 0 to 4)");
  refused([](Desc& d) { d.radius = NAN; }, "radius");
  refused([](Desc& d) { d.projection[5] = 0; }, "projection");
  refused([](Desc& d) { d.taps = 10; }, "got 10, need 9, 16");
  refused([](Desc& d) { d.network_size = 4; }, "desc.network is NULL");
  const std::vector<unsigned char> no_network(100, 7);
  refused(
      [&](Desc& d) {
        d.network = no_network.data();
        d.network_size = no_network.size();
      },
      "not \"NOOK\"", NOOK_ERROR_BAD_FILE);
  const std::string long_text(1001, 'x');
  refused([&](Desc& d) { d.note = long_text.c_str(); }, "desc.note is too long");
  refused([](Desc& d) { d.note = "\a"; }, "note has a control character");

  const Frame& frame = stage.frame;
  std::size_t size = 0;
  CHECK(nook_nnao_recording_create(nullptr, &frame.desc, &recording) == invalid);
  CHECK(nook_nnao_recording_create(stage.context, &frame.desc, nullptr) == invalid);
  CHECK(nook_nnao_recording_load(stage.context, nullptr, 5, &recording) == invalid);
  CHECK(nook_nnao_recording_load(stage.context, no_network.data(), 100, &recording) == NOOK_ERROR_BAD_FILE);
  CHECK(nook_nnao_recording_save(nullptr, nullptr, &size) == invalid);
  CHECK(nook_nnao_recording_save(stage.recording, nullptr, nullptr) == invalid);
  CHECK(nook_nnao_recording_describe(nullptr, nullptr) == invalid);
}

TEST_CASE("recorded frames: every allocation may be refused, and all memory comes back") {
  Host counting;
  REQUIRE(run_everything(counting) == NOOK_OK);
  CHECK(counting.blocks == 0);
  const int allocations = counting.allocations;
  CHECK(allocations > 18);
  for (int refused = 0; refused < allocations; ++refused) {
    Host host;
    host.refuse_at = refused;
    CHECK(run_everything(host) == NOOK_ERROR_OUT_OF_MEMORY);
    CHECK(host.blocks == 0);
  }
}

// Material jobs, judged by what the runtime decodes from their files.
#include <nook/nook_material.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <vector>

#include "tests/bakers/api/handles.h"
#include "tests/bakers/relief_in_file.h"
#include "tests/catch.h"

namespace {

constexpr std::uint32_t lights = 5, views = 6, width = 6, height = 4;

// Along the normal, and round it at 45 degrees.
std::vector<float> fan(std::uint32_t count) {
  std::vector<float> directions{0, 0, 1};
  for (std::uint32_t i = 1; i < count; ++i) {
    const float phi = 6.2831853f * float(i) / float(count - 1);
    directions.insert(directions.end(),
                      {std::sqrt(0.5f) * std::cos(phi), std::sqrt(0.5f) * std::sin(phi), std::sqrt(0.5f)});
  }
  return directions;
}

float planted(std::uint32_t light, std::uint32_t view, std::uint32_t x, std::uint32_t y,
              std::uint32_t channel) {
  return 0.2f + 0.1f * float(channel) + 0.05f * float(x) + 0.15f * float(y * y % 3) + 0.02f * float(light) +
         0.03f * float(view % 2) * float((x + y) % 2);
}
// The lower half has holes: a column of each other row.
bool met(std::uint32_t x, std::uint32_t y) {
  return y != 0 || x % 3 != 1;
}

struct Measured {
  std::vector<float> light_set = fan(lights), view_set = fan(views), btf, coverage;
  nook_bake_material_desc desc;

  Measured() {
    for (std::uint32_t l = 0; l < lights; ++l)
      for (std::uint32_t v = 0; v < views; ++v)
        for (std::uint32_t y = 0; y < height; ++y)
          for (std::uint32_t x = 0; x < width; ++x)
            for (std::uint32_t c = 0; c < 3; ++c)
              btf.push_back(met(x, y) ? planted(l, v, x, y, c) : std::numeric_limits<float>::quiet_NaN());
    for (std::uint32_t v = 0; v < views; ++v)
      for (std::uint32_t y = 0; y < height; ++y)
        for (std::uint32_t x = 0; x < width; ++x) coverage.push_back(met(x, y) ? 1.0f : 0.0f);
    nook_bake_material_desc_init(&desc);
    desc.light_count = lights;
    desc.view_count = views;
    desc.width = desc.rank_x = desc.votf_rank_x = width;
    desc.height = desc.rank_y = desc.votf_rank_y = height;
    desc.rank_light = 3 * lights;
    desc.rank_view = views;
    desc.method = NOOK_BAKE_METHOD_N_SVD;
  }
  nook_result start(nook_bake_job* job) {
    desc.btf = btf.data();
    desc.coverage = coverage.data();
    desc.lights = light_set.data();
    desc.views = view_set.data();
    return nook_bake_start_material(&desc, job);
  }
};

nook_bake_material_desc small_weave() {
  nook_bake_material_desc desc;
  nook_bake_material_desc_init(&desc);
  desc.meso = "weave";
  desc.light_count = desc.view_count = 12;
  desc.width = desc.height = 12;
  desc.bounces = 1;
  desc.bounce_rays = 2;
  CHECK(desc.view_map_side == 64);
  CHECK(desc.bits == 8);
  desc.view_map_side = 8;
  return desc;
}

std::vector<char> file_of(const Job& job) {
  const nook_result result = nook_bake_job_wait(job.get());
  INFO(nook_bake_last_message());
  REQUIRE(result == NOOK_OK);
  const void* bytes = nullptr;
  std::size_t size = 0;
  REQUIRE(nook_bake_job_file(job.get(), &bytes, &size) == NOOK_OK);
  const char* first = static_cast<const char*>(bytes);
  return {first, first + size};
}

Job start(const nook_bake_material_desc& desc) {
  nook_bake_job job = nullptr;
  const nook_result result = nook_bake_start_material(&desc, &job);
  INFO(nook_bake_last_message());
  CHECK(result == NOOK_OK);
  return Job(job);
}

bool refused(const nook_bake_material_desc& desc, const char* text) {
  nook_bake_job job = nullptr;
  const nook_result result = nook_bake_start_material(&desc, &job);
  INFO(nook_bake_last_message());
  CHECK(job == nullptr);
  nook_bake_job_destroy(&job);
  return result == NOOK_ERROR_INVALID_ARGUMENT && message_has(text);
}

// Loads a file with the runtime and decodes samples.
std::vector<nook_material_value> decode(const std::vector<char>& file,
                                        const std::vector<nook_material_pixel>& samples) {
  nook_context_desc context_desc;
  nook_context context = nullptr;
  nook_material material = nullptr;
  REQUIRE(nook_context_desc_init(&context_desc) == NOOK_OK);
  REQUIRE(nook_context_create(&context_desc, &context) == NOOK_OK);
  REQUIRE(nook_material_load(context, file.data(), file.size(), nullptr, &material) == NOOK_OK);
  std::vector<nook_material_value> values(samples.size());
  CHECK(nook_material_evaluate(material, samples.data(), std::uint32_t(samples.size()), 1, values.data()) ==
        NOOK_OK);
  nook_material_destroy(&material);
  nook_context_destroy(&context);
  return values;
}

}  // namespace

TEST_CASE("measured data come back at their texels, colours and directions, and gaps as gaps") {
  Measured measured;
  nook_bake_job handle = nullptr;
  const nook_result result = measured.start(&handle);
  INFO(nook_bake_last_message());
  REQUIRE(result == NOOK_OK);
  const Job job(handle);
  // Copied: what the caller does with them afterwards does not matter.
  measured.btf.assign(measured.btf.size(), 1e30f);
  const std::vector<char> file = file_of(job);
  std::vector<nook_material_pixel> samples;
  for (std::uint32_t y = 0; y < height; ++y)
    for (std::uint32_t x = 0; x < width; ++x) {
      // The third light and the fifth view.
      nook_material_pixel s{
          {(float(x) + 0.5f) / float(width), (float(y) + 0.5f) / float(height)}, {}, {}, {}, {}};
      for (std::size_t i = 0; i < 3; ++i) {
        s.light[i] = measured.light_set[3 * 2 + i];
        s.view[i] = measured.view_set[3 * 4 + i];
      }
      samples.push_back(s);
    }
  const std::vector<nook_material_value> values = decode(file, samples);
  for (std::uint32_t y = 0; y < height; ++y)
    for (std::uint32_t x = 0; x < width; ++x) {
      const nook_material_value& value = values[y * width + x];
      INFO("texel " << x << " " << y);
      CHECK((value.visibility > 0.5f) == met(x, y));
      for (std::uint32_t c = 0; c < 3 && met(x, y); ++c)
        // Cells of the light map are 1/32 wide; round the outermost lights some lie beyond, where the cosine
        // over theirs is up to 3 % less.
        CHECK(std::fabs(value.radiance[c] - planted(2, 4, x, y, c)) < 0.03f * value.radiance[c]);
    }
  const char* report = nullptr;
  REQUIRE(nook_bake_job_report(job.get(), &report) == NOOK_OK);
  const auto json = nlohmann::json::parse(report);
  CHECK(json["method"] == "N-SVD");
  // Full ranks: what is left are the steps of 511 to the largest number of rows and light basis.
  CHECK(json["se_db"].get<double>() > 45);
  CHECK(json["votf_error_texels_distance"] == 0);
  CHECK(json["recipe"]["source"]["measured"] == true);
}

TEST_CASE("a neural material is a job as the others are") {
  Measured measured;
  measured.desc.method = NOOK_BAKE_METHOD_NEURAL;
  CHECK((measured.desc.neural_channels == 16 && measured.desc.neural_steps == 8000));
  measured.desc.neural_channels = 8;
  measured.desc.neural_steps = 400;
  measured.desc.mixture = 1;  // of the one cluster of the VOTF
  nook_bake_job handle = nullptr;
  const nook_result result = measured.start(&handle);
  INFO(nook_bake_last_message());
  REQUIRE(result == NOOK_OK);
  const Job job(handle);
  const std::vector<char> file = file_of(job);
  const char* report = nullptr;
  REQUIRE(nook_bake_job_report(job.get(), &report) == NOOK_OK);
  const auto json = nlohmann::json::parse(report);
  CHECK(json["method"] == "neural");
  CHECK(json["recipe"]["compression"]["channels"] == 8);
  CHECK(json["votf_error_texels_distance"] == 0);
  // A twentieth of the usual steps: the mean of all texels has about 8 dB.
  CHECK(json["se_db"].get<double>() > 15);
  nook_material_pixel pixel{{0.4f, 0.6f}, {}, {}, {0, 0, 1}, {0, 0, 1}};
  CHECK(decode(file, {pixel})[0].radiance[2] > 0.1f);

  measured.desc.neural_channels = 10;
  CHECK(measured.start(&handle) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(message_has("channels of a neural material is 10"));
  measured.desc.neural_channels = 8;
  measured.desc.neural_steps = 0;
  CHECK(measured.start(&handle) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(message_has("training steps is 0"));
}

TEST_CASE("a built-in structure: the same bytes on any number of threads, another seed another file") {
  nook_bake_material_desc desc = small_weave();
  desc.threads = 1;
  const std::vector<char> one = file_of(start(desc));
  desc.threads = 2;
  CHECK(file_of(start(desc)) == one);
  desc.seed = 2;
  CHECK(file_of(start(desc)) != one);
}

TEST_CASE("a material job goes through its stages and stops where it is cancelled") {
  struct Watch {
    std::vector<std::string> stages;
    std::string stop_at;
    static std::int32_t call(void* user, const nook_bake_progress* progress) {
      Watch& w = *static_cast<Watch*>(user);
      if (w.stages.empty() || w.stages.back() != progress->stage) w.stages.push_back(progress->stage);
      return progress->stage != w.stop_at;
    }
  };
  nook_bake_material_desc desc = small_weave();
  desc.progress = Watch::call;
  Watch all;
  desc.progress_user = &all;
  file_of(start(desc));
  CHECK(all.stages == std::vector<std::string>{"ray tracing", "compressing colours", "making the view map",
                                               "compressing visibility", "making the view map"});
  for (const char* stage :
       {"ray tracing", "compressing colours", "making the view map", "compressing visibility"}) {
    Watch stopped;
    stopped.stop_at = stage;
    desc.progress_user = &stopped;
    const Job job = start(desc);
    CHECK(nook_bake_job_wait(job.get()) == NOOK_ERROR_CANCELLED);
    const void* bytes = nullptr;
    std::size_t size = 0;
    CHECK(nook_bake_job_file(job.get(), &bytes, &size) == NOOK_ERROR_CANCELLED);
  }
}

namespace {

// A striped plane 0.3 tiles over z = 0, which a view moves by the tangent of its tilt.
struct Stripes {
  static constexpr std::uint32_t count = 9, across = 32, along = 4;
  static constexpr float lift = 0.3f;
  std::vector<float> directions = fan(count), btf;
  std::vector<float> heights = std::vector<float>(across * along, lift);
  nook_bake_material_desc desc;

  static float paint(float x) { return 0.5f + 0.3f * std::cos(2 * 6.2831853f * x); }
  static float seen(float u, const float* view) { return paint(u + lift * view[0] / view[2]); }

  Stripes() {
    for (std::uint32_t l = 0; l < count; ++l)
      for (std::uint32_t v = 0; v < count; ++v)
        for (std::uint32_t texel = 0; texel < across * along; ++texel)
          btf.insert(btf.end(), 3, seen((float(texel % across) + 0.5f) / float(across), &directions[3 * v]));
    nook_bake_material_desc_init(&desc);
    CHECK(desc.relief == 0);
    desc.light_count = desc.view_count = count;
    desc.lights = desc.views = directions.data();
    desc.btf = btf.data();
    desc.width = desc.rank_x = across;
    desc.height = desc.rank_y = along;
    desc.rank_light = 4;
    desc.rank_view = 8;
    desc.method = NOOK_BAKE_METHOD_N_SVD;
  }

  // The largest error in a view between two of the samples.
  static float error_between(const std::vector<char>& file) {
    const float half = std::sqrt(0.5f), phi = 6.2831853f / 16;
    std::vector<nook_material_pixel> samples;
    for (std::uint32_t x = 0; x < across; ++x)
      samples.push_back({{(float(x) + 0.5f) / float(across), 0.125f},
                         {},
                         {},
                         {half * std::cos(phi), half * std::sin(phi), half},
                         {0, 0, 1}});
    const std::vector<nook_material_value> values = decode(file, samples);
    float worst = 0;
    for (std::uint32_t x = 0; x < across; ++x)
      worst = std::max(worst, std::abs(values[x].radiance[1] - seen(samples[x].uv[0], samples[x].view)));
    return worst;
  }
};

}  // namespace

TEST_CASE("stripes on a plane of known height stay sharp between the sampled views") {
  Stripes stripes;
  // The views beside it show the stripes 0.02 tiles before and behind, of waves of 0.5.
  CHECK(Stripes::error_between(file_of(start(stripes.desc))) > 0.06f);
  stripes.desc.relief = 1;
  stripes.desc.heights = stripes.heights.data();
  const Job job = start(stripes.desc);
  // Copied, too.
  stripes.heights.assign(stripes.heights.size(), 0.0f);
  // Two linear filters of waves of 16 texels leave up to 2 (2 pi / 16)^2 / 8 of 0.3.
  CHECK(Stripes::error_between(file_of(job)) < 0.013f);
  const char* report = nullptr;
  REQUIRE(nook_bake_job_report(job.get(), &report) == NOOK_OK);
  CHECK(nlohmann::json::parse(report)["recipe"]["compression"]["relief"] == "known");

  stripes.heights[5] = 1.5f;
  stripes.desc.heights = stripes.heights.data();
  CHECK(refused(stripes.desc, "got 1.5"));
  stripes.desc.relief = 0;
  CHECK(refused(stripes.desc, "desc.relief is 0; set desc.relief to 1"));
  stripes.desc.relief = 3;
  CHECK(refused(stripes.desc, "desc.relief is out of range (got 3, need 0 to 1)"));
}

TEST_CASE("known heights are in the file at their texels") {
  // Waves of other heights along x and y, none of them symmetric, which no view up to 45 degrees hides from
  // itself: their slopes are 0.31 and 0.19.
  constexpr std::uint32_t count = 9, across = 24, along = 16;
  constexpr float turn = 6.2831853f;
  const auto height_at = [](float x, float y) {
    return 0.05f * std::cos(turn * (x - 0.15f)) + 0.03f * std::sin(turn * y);
  };
  const auto middle = [](std::uint32_t i, std::uint32_t side) { return (float(i) + 0.5f) / float(side); };
  const std::vector<float> directions = fan(count);
  std::vector<float> btf, heights;
  for (std::uint32_t y = 0; y < along; ++y)
    for (std::uint32_t x = 0; x < across; ++x)
      heights.push_back(height_at(middle(x, across), middle(y, along)));
  for (std::uint32_t l = 0; l < count; ++l)
    for (std::uint32_t v = 0; v < count; ++v)
      for (std::uint32_t texel = 0; texel < across * along; ++texel) {
        const float x = middle(texel % across, across), y = middle(texel / across, along);
        const float* view = &directions[3 * v];
        float z = 0;  // a contraction, so that it converges
        for (int i = 0; i < 30; ++i) z = height_at(x + z * view[0] / view[2], y + z * view[1] / view[2]);
        const float u = x + z * view[0] / view[2], w = y + z * view[1] / view[2];
        btf.insert(btf.end(), 3,
                   0.5f + 0.2f * std::cos(turn * (2 * u + w)) + 0.15f * std::sin(turn * (w - u)));
      }
  nook_bake_material_desc desc;
  nook_bake_material_desc_init(&desc);
  desc.light_count = desc.view_count = count;
  desc.lights = desc.views = directions.data();
  desc.btf = btf.data();
  desc.heights = heights.data();
  desc.relief = 1;
  desc.width = desc.rank_x = across;
  desc.height = desc.rank_y = along;
  desc.rank_light = 4;
  desc.rank_view = 8;
  desc.method = NOOK_BAKE_METHOD_N_SVD;
  const ReliefInFile relief = relief_in_file(file_of(start(desc)));
  REQUIRE(relief.levels.size() == heights.size());
  const auto [low, high] = std::minmax_element(heights.begin(), heights.end());
  for (std::size_t i = 0; i < heights.size(); ++i) {
    INFO("texel " << i % across << " " << i / across);
    // Smoothed over at most two texels. This takes 27 % from waves of 16 texels and 13 % from waves of 24
    // texels: 10 of 255 levels. Those along another axis or direction are off by more than 90.
    CHECK(std::abs(float(relief.levels[i]) - 255 * (heights[i] - *low) / (*high - *low)) < 12);
  }
}

TEST_CASE("a job finds a relief, of a structure's own heights too, and stops while it looks") {
  struct Watch {
    std::vector<std::string> stages;
    bool stops = false;
    static std::int32_t call(void* user, const nook_bake_progress* progress) {
      Watch& w = *static_cast<Watch*>(user);
      if (w.stages.empty() || w.stages.back() != progress->stage) w.stages.push_back(progress->stage);
      return !(w.stops && std::string(progress->stage) == "finding the relief");
    }
  };
  // Measured data without heights, whose relief is searched for, and a structure, whose heights are known.
  Stripes stripes;
  for (nook_bake_material_desc desc : {stripes.desc, small_weave()}) {
    Watch watch;
    desc.progress = Watch::call;
    desc.progress_user = &watch;
    desc.relief = 1;
    const Job finished = start(desc);
    const std::vector<char> file = file_of(finished);
    const char* report = nullptr;
    REQUIRE(nook_bake_job_report(finished.get(), &report) == NOOK_OK);
    CHECK(nlohmann::json::parse(report)["recipe"]["compression"]["relief"] ==
          (desc.meso ? "known" : "estimated"));
    CHECK(relief_in_file(file).moves());
    const std::size_t first = desc.meso ? 1 : 0;  // a structure is traced before
    REQUIRE(watch.stages.size() > first + 1);
    CHECK(watch.stages[first] == "finding the relief");
    CHECK(watch.stages[first + 1] == "compressing colours");
    watch.stops = true;
    const Job job = start(desc);
    CHECK(nook_bake_job_wait(job.get()) == NOOK_ERROR_CANCELLED);
  }
}

TEST_CASE("the paper's form of a material has half floats, no view map and the paper's mapping") {
  nook_bake_material_desc desc = small_weave();
  desc.form = NOOK_FORM_PAPER;
  const std::vector<char> paper = file_of(start(desc));
  desc.form = NOOK_FORM_DEFAULT;
  desc.bits = 16;
  desc.view_map_side = 0;
  CHECK(file_of(start(desc)) != paper);  // the mapping is another
  desc.visibility_threshold = 0.05f;
  desc.visibility_weight = 12;
  CHECK(file_of(start(desc)) == paper);
  desc.form = NOOK_FORM_PAPER;
  desc.relief = 1;
  CHECK(refused(desc, "desc.form is NOOK_FORM_PAPER"));
  desc.relief = 0;
  desc.method = NOOK_BAKE_METHOD_NEURAL;
  CHECK(refused(desc, "desc.form is NOOK_FORM_PAPER"));
  desc.form = 2;
  CHECK(refused(desc, "desc.form is unknown (got 2)"));
}

TEST_CASE("if input cannot be baked to a material, the message names the cause") {
  nook_bake_material_desc desc = small_weave();
  desc.meso = "marble";
  CHECK(refused(desc, "marble"));
  desc = small_weave();
  desc.method = 7;
  CHECK(refused(desc, "desc.method"));
  desc = small_weave();
  desc.rank_light = 4;
  CHECK(refused(desc, "give all of them, or none"));
  desc.rank_view = desc.rank_x = 4;
  desc.rank_y = 13;
  CHECK(refused(desc, "the y rank is 13"));
  desc = small_weave();
  desc.width = 0;
  CHECK(refused(desc, "desc.width"));
  desc = small_weave();
  desc.light_count = desc.view_count = desc.width = desc.height = 1024;
  CHECK(refused(desc, "MiB"));
  desc = small_weave();
  desc.votf_rank_x = desc.votf_rank_y = 13;
  CHECK(refused(desc, "the VOTF's x rank is 13"));
  desc.method = NOOK_BAKE_METHOD_NEURAL;
  CHECK(refused(desc, "the VOTF's x rank is 13"));
  desc.visibility = NOOK_MATERIAL_VISIBILITY_NONE;
  desc.view_map_side = 1;  // of the VOTF alone
  CHECK(nook_bake_job_cancel(start(desc).get()) == NOOK_OK);
  desc = small_weave();
  desc.method = NOOK_BAKE_METHOD_NEURAL;
  desc.view_map_side = 1;
  CHECK(refused(desc, "the view map has 1 cells"));
  desc = small_weave();
  desc.method = NOOK_BAKE_METHOD_NEURAL;
  desc.clusters = 2;
  desc.mixture = 8;
  CHECK(refused(desc, "the mixture K is 8"));
  desc = small_weave();
  desc.method = NOOK_BAKE_METHOD_NEURAL;
  desc.visibility_threshold = -1;
  CHECK(refused(desc, "threshold -1"));
  const float one = 1;
  desc = small_weave();
  desc.btf = &one;
  CHECK(refused(desc, "either desc.meso or the measured data"));

  Measured measured;
  nook_bake_job job = nullptr;
  measured.coverage.assign(measured.coverage.size(), 1.0f);
  // Light 0, view 0, row 0, column 1 is a gap, which is not a number.
  CHECK(measured.start(&job) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(message_has("texel (1, 0) is not a finite number"));
  measured = Measured();
  measured.coverage[3] = 1.5f;
  CHECK(measured.start(&job) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(message_has("desc.coverage of view 0 at texel (3, 0)"));
  measured = Measured();
  measured.view_set[5] = 0;
  CHECK(measured.start(&job) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(message_has("not a unit vector"));
  measured = Measured();
  measured.desc.light_count = lights;
  measured.desc.lights = nullptr;
  measured.desc.btf = measured.btf.data();
  CHECK(refused(measured.desc, "desc.lights is NULL"));
  CHECK(nook_bake_start_material(&desc, nullptr) == NOOK_ERROR_INVALID_ARGUMENT);
}

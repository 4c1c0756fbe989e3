#include "bakers/measure/composite/composite.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "bakers/measure/composite/shipped_pass.h"
#include "bakers/measure/nnao/network_pass.h"
#include "bakers/raytrace/random.h"
#include "bakers/world/posed_casters.h"
#include "sdk/src/core/failure.h"

namespace nook::measure {
namespace {

using namespace bake;
using Json = nlohmann::ordered_json;

constexpr float changed_by = 0.01f;

// The AO values of one pixel. Each rule for combining the two passes uses some of them.
struct Parts {
  float screen = 1;                     // the screen pass, with the characters in its depth buffer
  float room = 1;                       // the screen pass, without the characters in its depth buffer
  float world = 1;                      // the world pass, which evaluates the characters' casters
  float shipped = 1, shipped_half = 1;  // both passes together, with the world pass at full and at half
                                        // resolution
};

float overlapping(float a, float b, float power) {
  const float x = std::pow(1 - a, power) + std::pow(1 - b, power);
  return std::max(0.0f, 1 - std::pow(x, 1 / power));
}

struct Rule {
  const char* name;
  float (*value)(const Parts&);
};
constexpr Rule rules[] = {
    {"none", [](const Parts&) { return 1.0f; }},
    {"screen", [](const Parts& p) { return p.screen; }},
    {"screen without characters", [](const Parts& p) { return p.room; }},
    {"world", [](const Parts& p) { return p.world; }},
    {"product", [](const Parts& p) { return p.screen * p.world; }},
    {"minimum", [](const Parts& p) { return std::min(p.screen, p.world); }},
    {"mask, product", [](const Parts& p) { return p.room * p.world; }},
    {"mask, minimum", [](const Parts& p) { return std::min(p.room, p.world); }},
    {"mask, sum", [](const Parts& p) { return std::max(0.0f, p.room + p.world - 1); }},
    {"mask, between sum and minimum", [](const Parts& p) { return overlapping(p.room, p.world, 1.4f); }},
    {"nook", [](const Parts& p) { return p.shipped; }},
    {"nook, half resolution", [](const Parts& p) { return p.shipped_half; }},
};
constexpr std::size_t rule_count = std::size(rules);

struct Sums {
  double pixels = 0, error2[rule_count] = {}, bias[rule_count] = {};
};

struct RoomSums {
  Sums darkened, elsewhere;
};

void add(Sums& to, const Sums& from) {
  to.pixels += from.pixels;
  for (std::size_t r = 0; r < rule_count; ++r) {
    to.error2[r] += from.error2[r];
    to.bias[r] += from.bias[r];
  }
}

std::vector<float> caster_ao(const RoomPixels& pixels, std::span<const Capsule> casters) {
  std::vector<float> ao(pixels.pixel.size());
  tbb::parallel_for(std::size_t(0), ao.size(), [&](std::size_t i) {
    ao[i] = open_share(casters, pixels.position[i], pixels.normal[i]);
  });
  return ao;
}

// Returns the view without the figures, for a pass that must not see them.
bake::nnao::TracedView without_figures(const RoomView& view) {
  bake::nnao::TracedView masked = view.view;
  for (std::size_t i = 0; i < masked.depth.size(); ++i)
    if (view.is_figure[i]) masked.depth[i] = std::numeric_limits<float>::infinity();
  return masked;
}

class ScreenPass {
 public:
  ScreenPass(platform::Context& context, const NookGl& gl, const CompositeStudy& study)
      : context_(context),
        pass_(gl, int(study.width), int(study.height), {study.taps}, {}, 16),
        radius_(study.truth.radius),
        max_radius_px_(0.25f * float(study.height)) {}

  std::vector<float> ao(const bake::nnao::TracedView& view) {
    const GpuView images(context_.gl(), view);
    AoRequest request;
    request.radius = radius_;
    request.max_radius_px = max_radius_px_;
    return read_red(context_.gl(), pass_.draw(images, request, true), images.width, images.height);
  }

 private:
  platform::Context& context_;
  NetworkPass pass_;
  float radius_, max_radius_px_;
};

struct Passes {
  ScreenPass screen;
  ShippedPass full, half;
};

// Draws three panels: ray tracing, Nook, and the screen pass alone.
void write_picture(const std::filesystem::path& file, const RoomView& view, Passes& passes) {
  const RoomPixels& p = view.pixels;
  std::vector<float> traced(view.view.depth.size(), 1.0f);
  for (std::size_t i = 0; i < p.pixel.size(); ++i)
    traced[p.pixel[i]] = 0.5f * (p.together[0][i] + p.together[1][i]);
  const std::vector<float> panels[] = {traced, passes.full.ao(view), passes.screen.ao(view.view)};
  write_room_picture(file, view, panels);
}

RoomSums sums_of(const RoomView& view, Passes& passes, std::span<const Capsule> casters) {
  const std::vector<float> screen = passes.screen.ao(view.view),
                           room = passes.screen.ao(without_figures(view)), full = passes.full.ao(view),
                           half = passes.half.ao(view);
  const RoomPixels& p = view.pixels;
  const std::vector<float> world = caster_ao(p, casters);
  RoomSums sums;
  for (std::size_t i = 0; i < p.pixel.size(); ++i) {
    const float change = 0.5f * (p.room[0][i] + p.room[1][i] - p.together[0][i] - p.together[1][i]);
    Sums& s = change > changed_by ? sums.darkened : sums.elsewhere;
    const Parts parts{screen[p.pixel[i]], room[p.pixel[i]], world[i], full[p.pixel[i]], half[p.pixel[i]]};
    s.pixels += 1;
    for (std::size_t r = 0; r < rule_count; ++r) {
      const double first = double(rules[r].value(parts)) - double(p.together[0][i]),
                   second = double(rules[r].value(parts)) - double(p.together[1][i]);
      s.error2[r] += first * second;
      s.bias[r] += 0.5 * (first + second);
    }
  }
  return sums;
}

void add_rows(Json& rows, const std::string& room, const RoomSums& sums) {
  for (const auto& [region, s] : {std::pair{"darkened", &sums.darkened}, {"elsewhere", &sums.elsewhere}})
    for (std::size_t r = 0; r < rule_count; ++r) {
      Json row;
      row["surface"] = "scene";
      row["scene"] = room;
      row["region"] = region;
      row["method"] = rules[r].name;
      row["mse"] = s->error2[r] / std::max(s->pixels, 1.0);
      row["over_screen"] = s->error2[r] / std::max(s->error2[1], 1e-30);
      row["bias"] = s->bias[r] / std::max(s->pixels, 1.0);
      row["pixels"] = s->pixels;
      rows.push_back(row);
    }
}

}  // namespace

Json composite_rows(platform::Context& context, std::span<const MeasuredRoom> rooms, const SkinnedMesh& mesh,
                    const CharacterModel& model, std::span<const std::byte> model_bytes,
                    std::span<const Pose> poses, const CompositeStudy& study,
                    const CompositeProgress& progress) {
  if (model.world_casters.empty())
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "the model has no world casters; bake the character again");
  const NookGl gl(context);
  const auto shipped = [&](bool half) {
    return ShippedPass(context.gl(), gl, model_bytes, int(study.width), int(study.height), study.taps, half,
                       study.truth.radius);
  };
  Passes passes{{context, gl, study}, shipped(false), shipped(true)};
  Json rows = Json::array();
  RoomSums total;
  std::size_t done = 0;
  for (const MeasuredRoom& measured : rooms) {
    const std::vector<Figure> figures =
        stand_in_room(measured.soup, mesh, poses, study.figures, study.truth.seed);
    const PopulatedRoom room = populated(measured.soup, mesh, figures);
    const std::vector<bake::nnao::Camera> cameras =
        cameras_at(room, figures, study.views, study.width, study.height, mix_bits(study.truth.seed));
    if (cameras.empty())
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                    "%s has too little space for characters and a camera (placed %zu characters); need level "
                    "ground with 2 m of free height; the scene must be in metres with +y up",
                    measured.name.c_str(), figures.size());
    std::vector<Capsule> casters;
    for (const Figure& figure : figures) {
      const std::vector<Capsule> own =
          posed({model.world_casters.data(), model.world_casters.size()}, figure.pose, CasterUse::ao);
      casters.insert(casters.end(), own.begin(), own.end());
    }
    passes.full.pose(figures);
    passes.half.pose(figures);
    const RayScene all(room.soup);
    RoomSums sums;
    for (const bake::nnao::Camera& camera : cameras) {
      if (progress && !progress(done++, rooms.size() * study.views))
        throw Failure(NOOK_ERROR_CANCELLED, "cancelled while measuring rooms");
      RoomTruth truth = study.truth;
      truth.seed = mix_bits(study.truth.seed + done);
      const RoomView view = trace_room_view(room, all, camera, truth);
      const RoomSums s = sums_of(view, passes, casters);
      if (!study.images.empty() && &camera == &cameras.front()) {
        truth.every = 1;
        write_picture(study.images / (measured.name + ".png"), trace_room_view(room, all, camera, truth),
                      passes);
      }
      add(sums.darkened, s.darkened);
      add(sums.elsewhere, s.elsewhere);
    }
    add_rows(rows, measured.name, sums);
    add(total.darkened, sums.darkened);
    add(total.elsewhere, sums.elsewhere);
  }
  if (rooms.size() > 1) add_rows(rows, "all", total);
  return rows;
}

}  // namespace nook::measure

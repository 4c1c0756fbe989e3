#include "cli/nnao/tuning.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <deque>
#include <string>

#include "cli/nnao/peer_pass.h"
#include "core/failure.h"

namespace nook::cli {
namespace {

constexpr float radius_scales[] = {0.63f, 0.8f, 1.0f, 1.26f, 1.6f, 2.0f, 2.5f};
constexpr float powers[] = {0.63f, 0.8f, 1.0f, 1.26f, 1.6f, 2.0f, 2.5f, 3.2f};

std::vector<float> shapes_of(Peer peer) {
  switch (peer) {
    case Peer::ssao:
      return {};
    case Peer::ssao_plus:
      return {0.01f, 0.03f, 0.06f, 0.1f};
    case Peer::hbao:
      return {0.0f, 0.05f, 0.1f, 0.2f, 0.35f};
    case Peer::gtao:
      return {0.0f, 0.2f, 0.4f, 0.6f, 0.8f, 0.95f};
    default:
      return {0.1f, 0.2f, 0.35f, 0.6f, 1.0f, 1.6f};
  }
}

struct Search {
  const GladGLContext& gl;
  std::span<const MeasuredView> views;
  std::deque<GpuView> images;
  PeerPass pass;

  double mse(const PeerMethod& method) {
    double sum = 0, count = 0;
    for (std::size_t v = 0; v < views.size(); ++v) {
      AoRequest request;
      request.radius = views[v].radius;
      request.max_radius_px = 0.5f * float(images[v].height);
      const std::vector<float> ao =
          read_red(gl, pass.draw(method, images[v], request, true), images[v].width, images[v].height);
      for (std::size_t i = 0; i < ao.size(); ++i) {
        if (!std::isfinite(views[v].view.depth[i])) continue;
        const double error = double(ao[i]) - double(views[v].truth[i]);
        sum += error * error;
        count += 1;
      }
    }
    return sum / count;
  }

  // Whether a candidate is better than `best`, which then is the best of them.
  bool improve(TunedPeer& best, const std::vector<PeerTuning>& candidates) {
    bool better = false;
    for (const PeerTuning& candidate : candidates) {
      const PeerMethod tried{best.method.peer, best.method.taps, candidate};
      const double tried_mse = mse(tried);
      if (!(tried_mse < best.mse)) continue;
      best = {tried, tried_mse};
      better = true;
    }
    return better;
  }
};

// The middle of its shapes, its own radius and contrast.
PeerTuning untuned(Peer peer) {
  const std::vector<float> shapes = shapes_of(peer);
  return {1, 1, shapes.empty() ? 0 : shapes[shapes.size() / 2], false};
}

// A larger radius, less contrast and more thickness darken alike, so that valleys lie across the grid.
std::vector<PeerTuning> all_radii_and_powers(const PeerTuning& tuning) {
  std::vector<PeerTuning> candidates;
  for (const float radius_scale : radius_scales)
    for (const float power : powers)
      candidates.push_back({radius_scale, power, tuning.shape, tuning.equal_weights});
  return candidates;
}

std::vector<PeerTuning> all_shapes(Peer peer, const PeerTuning& tuning) {
  std::vector<PeerTuning> candidates;
  for (const float shape : shapes_of(peer)) {
    candidates.push_back({tuning.radius_scale, tuning.power, shape, tuning.equal_weights});
    if (peer == Peer::bitmask)
      candidates.push_back({tuning.radius_scale, tuning.power, shape, !tuning.equal_weights});
  }
  return candidates;
}

bool is_near(std::span<const float> grid, float a, float b) {
  return std::abs(std::ranges::find(grid, a) - std::ranges::find(grid, b)) <= 1;
}

// What lies next to it on the grid, across as well.
std::vector<PeerTuning> neighbours(Peer peer, const PeerTuning& tuning) {
  std::vector<float> shapes = shapes_of(peer);
  if (shapes.empty()) shapes = {tuning.shape};
  std::vector<PeerTuning> candidates;
  for (const float radius_scale : radius_scales)
    for (const float power : powers)
      for (const float shape : shapes)
        if (is_near(radius_scales, radius_scale, tuning.radius_scale) &&
            is_near(powers, power, tuning.power) && is_near(shapes, shape, tuning.shape))
          candidates.push_back({radius_scale, power, shape, tuning.equal_weights});
  return candidates;
}

// before: what this search found for other numbers of taps; it ends in the nearest of several valleys.
TunedPeer tune(Search& search, Peer peer, int taps, std::span<const TunedPeer> before) {
  const PeerMethod start{peer, taps, untuned(peer)};
  TunedPeer best{start, search.mse(start)};
  std::vector<PeerTuning> found;
  for (const TunedPeer& tuned : before)
    if (tuned.method.peer == peer) found.push_back(tuned.method.tuning);
  search.improve(best, found);
  search.improve(best, all_radii_and_powers(best.method.tuning));
  search.improve(best, all_shapes(peer, best.method.tuning));
  // Each step goes down a finite grid.
  while (search.improve(best, neighbours(peer, best.method.tuning))) {
  }
  return best;
}

}  // namespace

std::vector<TunedPeer> tune_peers(platform::Context& context, std::span<const MeasuredView> views,
                                  std::span<const PeerMethod> methods,
                                  const std::function<bool(std::size_t, std::size_t)>& progress) {
  const GladGLContext& gl = context.gl();
  Search search{gl,
                views,
                {},
                PeerPass(gl, int(views.front().view.camera.width), int(views.front().view.camera.height))};
  for (const MeasuredView& view : views) search.images.emplace_back(gl, view.view);
  std::vector<TunedPeer> tuned;
  for (const PeerMethod& method : methods) {
    tuned.push_back(tune(search, method.peer, method.taps, tuned));
    if (!progress(tuned.size(), methods.size()))
      throw Failure(NOOK_ERROR_CANCELLED, "cancelled while tuning");
  }
  return tuned;
}

std::string tuning_line(const PeerMethod& method) {
  constexpr const char* names[] = {"ssao", "ssao_plus", "hbao", "gtao", "bitmask"};
  char text[120];
  std::snprintf(text, sizeof text, "    {Peer::%s, %d, {%.2ff, %.2ff, %.2ff, %s}},\n",
                names[int(method.peer)], method.taps, double(method.tuning.radius_scale),
                double(method.tuning.power), double(method.tuning.shape),
                method.tuning.equal_weights ? "true" : "false");
  return text;
}

}  // namespace nook::cli

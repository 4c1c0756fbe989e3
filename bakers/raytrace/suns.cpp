#include "bakers/raytrace/suns.h"

namespace nook::bake {
namespace {

MapView view_of(const Environment& environment) {
  return {MapLayout::latlong, environment.width(), environment.height(), environment.rgb()};
}

struct Split {
  Vector<float> sky;
  Vector<Sun> suns;
};

Split split(const Environment& environment, std::size_t max_count) {
  Split out{Vector<float>(environment.rgb().begin(), environment.rgb().end()), Vector<Sun>()};
  out.suns = take_suns(view_of(environment), out.sky, default_memory(), max_count);
  return out;
}

}  // namespace

double sun_limit(const Environment& environment) {
  return nook::sun_limit(view_of(environment), default_memory());
}

Environment without_suns(const Environment& environment, std::size_t max_count) {
  const Split parts = split(environment, max_count);
  return Environment(environment.width(), environment.height(), {parts.sky.begin(), parts.sky.end()});
}

std::vector<Sun> find_suns(const Environment& environment, std::size_t max_count) {
  const Split parts = split(environment, max_count);
  return {parts.suns.begin(), parts.suns.end()};
}

}  // namespace nook::bake

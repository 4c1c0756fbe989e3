#include "bakers/material/meso_surface.h"

#include "sdk/src/core/failure.h"

namespace nook::bake::material {
namespace {

struct Builtin {
  MesoParameters parameters;
  MesoSurface (*make)(const MesoParameters&);
};

const std::array<Builtin, 3>& builtins() {
  static const std::array<Builtin, 3> all{
      Builtin{{"fiber", 10, 0.04f, 0.16f, 0.06f, 1, 1}, make_fiber},
      Builtin{{"roughhole", 2, 0.18f, 0.12f, 0.03f, 1, 1}, make_rough_hole},
      Builtin{{"weave", 4, 0.1f, 0.09f, 0.12f, 1, 1}, make_weave}};
  return all;
}

const Builtin& builtin(std::string_view name) {
  std::string known;
  for (const Builtin& b : builtins()) {
    if (b.parameters.name == name) return b;
    known += (known.empty() ? "" : ", ") + b.parameters.name;
  }
  throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "there is no meso-structure '%.60s'; use one of %s",
                std::string(name).c_str(), known.c_str());
}

}  // namespace

std::vector<std::string_view> meso_names() {
  std::vector<std::string_view> names;
  for (const Builtin& b : builtins()) names.push_back(b.parameters.name);
  return names;
}

MesoParameters meso_parameters(std::string_view name) {
  return builtin(name).parameters;
}

MesoSurface make_meso_surface(const MesoParameters& p) {
  const Builtin& b = builtin(p.name);
  const auto check = [&](bool fine, const char* what, double got, const char* range) {
    if (!fine)
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "%s of %s is %g; it must be %s", what, p.name.c_str(), got,
                    range);
  };
  check(p.count >= 1 && p.count <= 1000, "the count", p.count, "1 to 1000");
  check(p.radius > 0 && p.radius <= 0.5f, "the radius", double(p.radius), "above 0 and at most 0.5 tiles");
  check(p.thickness > 0 && p.thickness <= 1, "the thickness", double(p.thickness),
        "above 0 and at most 1 tile");
  check(p.roughness >= 0 && p.roughness <= 0.5f, "the roughness", double(p.roughness), "0 to 0.5");
  check(p.detail >= 0.1f && p.detail <= 4, "the detail", double(p.detail), "0.1 to 4");
  return b.make(p);
}

}  // namespace nook::bake::material

// Casters as text for other engines: what is written is read back and compared with the model.
#include "bakers/measure/world/caster_export.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <regex>

#include "sdk/src/core/failure.h"
#include "tests/catch.h"
#include "tests/character/model_sample.h"

using namespace nook;
using namespace nook::measure;
using namespace nook::test;

namespace {

// Four digits of centimetres, five of inches, six digits of metres.
constexpr float rounding_m = 2e-6f;

CharacterModel model_with_joints() {
  CharacterModel model = sample_model();
  Numbers numbers(8);
  add_world_casters(model, numbers);
  model.bind.bones.clear();
  for (std::size_t b = 0; b < model.bone_count(); ++b) {
    BoneBind bone;
    const float angle = numbers.between(-3, 3), c = std::cos(angle), s = std::sin(angle);
    bone.node_from_rest = {{c, 0, s, 0.1f * float(b), 0, 1, 0, -0.2f, -s, 0, c, 0.3f}};
    model.bind.bones.push_back(bone);
  }
  return model;
}

std::vector<std::smatch> matches(const std::string& text, const char* pattern) {
  const std::regex regex(pattern);
  std::vector<std::smatch> found;
  for (std::sregex_iterator i(text.begin(), text.end(), regex), end; i != end; ++i) found.push_back(*i);
  return found;
}

float number(const std::smatch& match, std::size_t group) {
  return std::stof(match[group].str());
}

struct Written {
  std::string joint;
  Capsule capsule;  // in the joint's space, metres
};

// A capsule has two ends, which may be exchanged.
bool is_same(const Capsule& x, const Capsule& y, float slack) {
  const auto near = [&](Vec3 a, Vec3 b) { return length(a - b) < slack; };
  const bool radii = std::abs(x.radius_a - y.radius_a) < slack;
  return radii && ((near(x.a, y.a) && near(x.b, y.b)) || (near(x.a, y.b) && near(x.b, y.a)));
}

void check_written(const CharacterModel& model, CasterFormat format, const std::vector<Written>& written,
                   float slack) {
  const std::vector<Capsule> wanted = engine_capsules(model, format, CasterRadii::ao);
  REQUIRE(written.size() == wanted.size());
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const std::uint32_t bone = model.world_casters[i].bone;
    const Mat3x4& m = model.bind.bones[bone].node_from_rest;
    const Capsule c{transform_point(m, wanted[i].a), transform_point(m, wanted[i].b), wanted[i].radius_a,
                    wanted[i].radius_b};
    int found = 0;
    for (const Written& w : written)
      found += w.joint == model.bone_names[bone].c_str() && is_same(w.capsule, c, slack);
    CHECK(found >= 1);
  }
}

}  // namespace

TEST_CASE("export: Unreal's bodies have the capsules") {
  const CharacterModel model = model_with_joints();
  const std::string text = export_casters(model, CasterFormat::unreal, CasterRadii::ao);
  std::vector<Written> written;
  for (const std::smatch& body : matches(text, "SphylElems=\\((.*)\\)\\)\\n   BoneName=\"([^\"]*)\"")) {
    const std::string capsules = body[1];
    for (const std::smatch& c :
         matches(capsules,
                 "Center=\\(X=([-.0-9]+),Y=([-.0-9]+),Z=([-.0-9]+)\\),Rotation=\\(Pitch=([-.0-9]+),"
                 "Yaw=([-.0-9]+),Roll=0.0000\\),Radius=([-.0-9]+),Length=([-.0-9]+)")) {
      // Unreal's axes to the file's: y and z exchanged, centimetres.
      const float pitch = number(c, 4) * std::numbers::pi_v<float> / 180,
                  yaw = number(c, 5) * std::numbers::pi_v<float> / 180;
      const Vec3 axis{-std::sin(pitch) * std::cos(yaw), -std::sin(pitch) * std::sin(yaw), std::cos(pitch)};
      const Vec3 middle{number(c, 1), number(c, 2), number(c, 3)};
      const auto metres = [](Vec3 p) { return 0.01f * Vec3{p.x, p.z, p.y}; };
      const float half = 0.5f * number(c, 7), radius = 0.01f * number(c, 6);
      written.push_back(
          {body[2], {metres(middle - half * axis), metres(middle + half * axis), radius, radius}});
    }
  }
  check_written(model, CasterFormat::unreal, written, 4 * rounding_m);
}

TEST_CASE("export: Source 2's list has the capsules") {
  const CharacterModel model = model_with_joints();
  const std::string text = export_casters(model, CasterFormat::source2, CasterRadii::ao);
  std::vector<Written> written;
  const char* const vector = "\\[ ([-.0-9]+), ([-.0-9]+), ([-.0-9]+) \\]\\s*";
  const std::string pattern = std::string("parent_bone = \"([^\"]*)\"\\s*radius = ([-.0-9]+)\\s*point0 = ")
                                  .append(vector)
                                  .append("point1 = ")
                                  .append(vector);
  for (const std::smatch& c : matches(text, pattern.c_str())) {
    const auto point = [&](std::size_t first) {
      return 0.0254f * Vec3{number(c, first), number(c, first + 1), number(c, first + 2)};
    };
    const float radius = 0.0254f * number(c, 2);
    written.push_back({c[1], {point(3), point(6), radius, radius}});
  }
  check_written(model, CasterFormat::source2, written, 2 * rounding_m);
}

TEST_CASE("export: glTF's extras are the casters themselves") {
  const CharacterModel model = model_with_joints();
  const auto json = nlohmann::json::parse(export_casters(model, CasterFormat::gltf, CasterRadii::ao));
  // Every file needs its asset. These are the members that the specification knows at the top and we write.
  CHECK(json.at("asset").at("version") == "2.0");
  for (const auto& [name, value] : json.items()) CHECK((name == "asset" || name == "extras"));
  std::vector<Written> written;
  for (const auto& c : json["extras"]["nook_world_casters"]) {
    const auto point = [&](const char* name) {
      return Vec3{c[name][0].get<float>(), c[name][1].get<float>(), c[name][2].get<float>()};
    };
    const float scale = c["ao_scale"].get<float>();
    written.push_back(
        {c["joint"],
         {point("a"), point("b"), scale * c["radius_a"].get<float>(), scale * c["radius_b"].get<float>()}});
  }
  check_written(model, CasterFormat::gltf, written, 10 * rounding_m);
  const ExportError none = export_error(model, CasterFormat::gltf, CasterRadii::ao);
  CHECK(none.rms == 0);
  CHECK(none.largest == 0);
}

TEST_CASE("export: the error of capsules of one radius is small, and stands in the text") {
  const CharacterModel model = model_with_joints();
  const ExportError error = export_error(model, CasterFormat::unreal, CasterRadii::ao);
  CHECK(error.rms > 0);
  // Radii of one capsule differ by a half at most in this model.
  CHECK(error.over_none < 0.05);
  const std::string text = export_casters(model, CasterFormat::unreal, CasterRadii::ao);
  const auto stated = matches(text, "rms ([.0-9]+), at most ([.0-9]+)");
  REQUIRE(stated.size() == 1);
  CHECK(std::abs(double(number(stated[0], 1)) - error.rms) < 1e-5);
  CHECK(std::abs(double(number(stated[0], 2)) - error.largest) < 1e-5);
}

TEST_CASE("export: models without casters or without joints are refused") {
  CharacterModel model = model_with_joints();
  model.bind.bones.clear();
  CHECK_THROWS_AS(export_casters(model, CasterFormat::gltf, CasterRadii::ao), Failure);
  model = model_with_joints();
  model.world_casters.clear();
  CHECK_THROWS_AS(export_casters(model, CasterFormat::unreal, CasterRadii::ao), Failure);
}

#include "bakers/lab/tool/nnao_scenes.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "bakers/tool/command_end.h"
#include "bakers/tool/command_files.h"
#include "platform/progress_bar.h"
#include "sdk/src/core/geometry.h"

namespace nook::lab {

using namespace measure;
using namespace tool;
using Json = nlohmann::json;

namespace {

constexpr float degree = 0.017453293f;                           // radians
constexpr float smallest_radius = 1e-3f, largest_radius = 1e3f;  // AO radii, metres

[[noreturn]] void refuse(const std::string& text) {
  throw ToolError(exit_bad_arguments, "evaluate nnao: " + text);
}

// The value of an option that applies to one scene or to all scenes.
struct Word {
  std::string scene, value;
};

Word split(const std::string& text) {
  const std::size_t colon = text.rfind(':');
  if (colon == std::string::npos) return {"", text};
  return {text.substr(0, colon), text.substr(colon + 1)};
}

GivenCamera parse_camera(const std::string& text) {
  float v[7];
  int used = 0;
  const int count =
      std::sscanf(text.c_str(), "%f,%f,%f,%f,%f,%f,%f%n", v, v + 1, v + 2, v + 3, v + 4, v + 5, v + 6, &used);
  const bool is_whole = count == 7 && std::size_t(used) == text.size();
  const Vec3 eye{v[0], v[1], v[2]}, target{v[3], v[4], v[5]};
  if (!is_whole || !is_place(eye) || !is_place(target) || !(v[6] >= 1 && v[6] <= 170) || eye == target)
    refuse(
        "--camera: got " + text +
        ", need ox,oy,oz,tx,ty,tz,fov: seven numbers, the eye apart from the target, metres up to 1e6, fov 1 "
        "to 170 degrees");
  return {eye, target, v[6] * degree, {}, 0};
}

float parse_radius(const std::string& text) {
  float radius = 0;
  int used = 0;
  if (std::sscanf(text.c_str(), "%f%n", &radius, &used) != 1 || std::size_t(used) != text.size() ||
      !(radius >= smallest_radius && radius <= largest_radius))
    refuse("--radius: got " + text + ", need 0.001 to 1000 metres");
  return radius;
}

// Calls visit(scene, value) for every scene to which the word applies.
template <class Visit>
void apply(std::vector<SceneRequest>& scenes, const std::string& option, const std::string& text,
           const Visit& visit) {
  const Word word = split(text);
  bool known = word.scene.empty();
  for (SceneRequest& scene : scenes)
    if (word.scene.empty() || word.scene == scene.name) {
      visit(scene, word.value);
      known = true;
    }
  if (!known) refuse(option + ": there is no scene of this name (got " + word.scene + ")");
}

std::vector<SceneRequest> parse_scenes(const SceneWords& words) {
  std::vector<SceneRequest> scenes;
  for (const std::filesystem::path& file : words.files)
    scenes.push_back({file.stem().string(), file, 0.5f, {}, words.reading, {}});
  if (words.thin) scenes.push_back({"thin", {}, 0.5f, {}, words.reading, {}});
  for (std::size_t i = 0; i < scenes.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (scenes[i].name == scenes[j].name)
        refuse("two scenes have the same name (got " + scenes[i].name + ")");
  for (const std::string& text : words.radii)
    apply(scenes, "--radius", text,
          [](SceneRequest& scene, const std::string& value) { scene.radius = parse_radius(value); });
  for (const std::string& text : words.cameras)
    apply(scenes, "--camera", text, [](SceneRequest& scene, const std::string& value) {
      scene.cameras.push_back(parse_camera(value));
    });
  return scenes;
}

// Splits NAME:TAPS and returns the taps. Returns 0 if the text does not have this form.
int split_taps(const std::string& text, std::string& name) {
  const std::size_t colon = text.rfind(':');
  if (colon == std::string::npos || colon == 0) return 0;
  name = text.substr(0, colon);
  return std::atoi(text.c_str() + colon + 1);
}

// Parses METHOD:TAPS,METHOD:TAPS.
MethodRatio parse_ratio(const std::string& text) {
  const std::size_t comma = text.find(',');
  MethodRatio ratio;
  if (comma != std::string::npos) {
    ratio.taps = split_taps(text.substr(0, comma), ratio.method);
    ratio.over_taps = split_taps(text.substr(comma + 1), ratio.over);
  }
  if (ratio.taps < 1 || ratio.over_taps < 1)
    throw ToolError(exit_bad_arguments,
                    "evaluate nnao: --ratio: got " + text + ", need METHOD:TAPS,METHOD:TAPS");
  return ratio;
}

// A list of test views: the scenes of each source with their cameras, and the ratios to report.
struct ViewsFile {
  std::string size;        // WxH; empty: not stated
  std::uint32_t rays = 0;  // 0: not stated
  std::vector<SceneRequest> scenes;
  std::vector<MethodRatio> ratios;
};

[[noreturn]] void refuse_list(const std::string& text) {
  throw ToolError(exit_bad_input, text);
}

Vec3 read_place(const Json& numbers, const std::string& what) {
  const auto v = numbers.get<std::vector<float>>();
  if (v.size() != 3 || !is_place({v[0], v[1], v[2]}))
    refuse_list(what + ": got " + numbers.dump() + ", need three numbers, metres up to 1e6");
  return {v[0], v[1], v[2]};
}

float read_radius(const Json& json, const std::string& what) {
  const float radius = json.at("radius").get<float>();
  if (!(radius >= smallest_radius && radius <= largest_radius))
    refuse_list(what + ": got a radius of " + json.at("radius").dump() + ", need 0.001 to 1000 metres");
  return radius;
}

GivenCamera read_camera(const Json& json, const std::string& scene) {
  GivenCamera camera;
  camera.name = json.at("name").get<std::string>();
  const std::string what = scene + ", camera " + camera.name;
  camera.eye = read_place(json.at("eye"), what);
  camera.target = read_place(json.at("target"), what);
  const float fov = json.at("fov").get<float>();
  if (!(fov >= 1 && fov <= 170) || camera.eye == camera.target)
    refuse_list(what + ": need a target apart from the eye and a fov of 1 to 170 degrees");
  camera.fov = fov * degree;
  if (json.contains("radius")) camera.radius = read_radius(json, what);
  return camera;
}

SceneRequest read_scene(const Json& json, const std::string& source, const std::filesystem::path& folder) {
  SceneRequest scene;
  scene.name = json.at("name").get<std::string>();
  if (scene.name.empty() || scene.name.find_first_of("/\\") != std::string::npos)
    refuse_list("a scene has a name that no file can have (got " + scene.name + ")");
  scene.file = folder / (scene.name + ".glb");
  scene.source = source;
  scene.radius = read_radius(json, scene.name);
  for (const Json& camera : json.at("cameras")) scene.cameras.push_back(read_camera(camera, scene.name));
  if (scene.cameras.empty()) refuse_list(scene.name + " has no camera");
  return scene;
}

ViewsFile read_document(const Json& document, const std::filesystem::path& folder) {
  ViewsFile views;
  views.size = document.value("size", "");
  views.rays = document.value("rays", 0u);
  for (const Json& source : document.at("sources"))
    for (const Json& scene : source.at("scenes"))
      views.scenes.push_back(read_scene(scene, source.at("name").get<std::string>(), folder));
  if (views.scenes.empty()) refuse_list("it has no scene");
  for (const Json& ratio : document.value("ratios", Json::array()))
    views.ratios.push_back(parse_ratio(ratio.get<std::string>()));
  return views;
}

// Reads a list of test views. `folder` must contain each scene as NAME.glb.
ViewsFile read_views_file(const std::filesystem::path& path, const std::filesystem::path& folder) {
  const std::vector<std::byte> bytes = read_any_file(path);
  const auto* const text = reinterpret_cast<const char*>(bytes.data());
  try {
    return read_document(Json::parse(text, text + bytes.size()), folder);
  } catch (const nlohmann::json::exception& fault) {
    refuse_list(path.string() + ": " + fault.what());
  } catch (const ToolError& fault) {
    refuse_list(path.string() + ": " + fault.what());
  }
}

void keep_sources(std::vector<SceneRequest>& scenes, const std::vector<std::string>& sources) {
  for (const std::string& source : sources)
    if (std::ranges::find(scenes, source, &SceneRequest::source) == scenes.end())
      throw ToolError(exit_bad_arguments, "evaluate nnao: --sources: the list has no scene from " + source);
  if (!sources.empty())
    std::erase_if(scenes, [&](const SceneRequest& scene) {
      return std::ranges::find(sources, scene.source) == sources.end();
    });
}

}  // namespace

Work read_work(EvaluateNnaoOptions& options) {
  Work work;
  work.scenes = parse_scenes(options.scenes);
  if (!options.views.empty()) {
    ViewsFile file = read_views_file(options.views, options.folder);
    if (!file.size.empty() && !options.sized) parse_size(file.size, options.truth);
    if (file.rays > 0 && !options.rays_given) options.truth.rays = file.rays;
    keep_sources(file.scenes, options.sources);
    work.scenes.insert(work.scenes.begin(), file.scenes.begin(), file.scenes.end());
    work.ratios = std::move(file.ratios);
  }
  for (const std::string& text : options.ratios) work.ratios.push_back(parse_ratio(text));
  return work;
}

std::vector<MeasuredView> traced_views(const SceneRequest& scene, const EvaluateNnaoOptions& options) {
  platform::ProgressBar bar(options.common.quiet);
  const std::string label = scene.name + ", ray tracing";
  return naming_file(scene.file, [&] {
    return trace_views(scene, options.truth, options.placed_cameras, options.references,
                       [&](std::size_t done, std::size_t total) {
                         bar.show(label, "views", done, total);
                         return !interrupted();
                       });
  });
}

std::vector<MeasuredView> traced_views(const Work& work, const EvaluateNnaoOptions& options) {
  if (!options.references.empty()) std::filesystem::create_directories(options.references);
  std::vector<MeasuredView> views;
  for (const SceneRequest& scene : work.scenes)
    for (MeasuredView& view : traced_views(scene, options)) views.push_back(std::move(view));
  return views;
}

void add_conditions(nlohmann::ordered_json& report, const EvaluateNnaoOptions& options,
                    platform::Context& context) {
  report["rays"] = options.truth.rays;
  report["opengl"] = context.version();
  report["seed"] = options.common.seed;
}

float max_radius_px(const EvaluateNnaoOptions& options) {
  return options.max_radius_px > 0 ? options.max_radius_px : 0.5f * float(options.truth.height);
}

}  // namespace nook::lab

#include "bakers/measure/report/pages.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "bakers/character/pose_sets.h"
#include "bakers/measure/character/character_error.h"
#include "bakers/measure/report/advice.h"
#include "bakers/measure/report/body_findings.h"
#include "bakers/measure/report/html.h"
#include "bakers/measure/report/report_pictures.h"
#include "sdk/src/core/failure.h"

namespace nook::report {
namespace {

using namespace bake;
using namespace measure;

constexpr std::size_t shown_clips = 3, shown_places = 4, listed_joints = 20, listed_clips = 40;
constexpr std::size_t turnable_bytes = 5'000'000;
constexpr const char* side_names[8] = {"the front", "the front left", "the left",  "the back left",
                                       "the back",  "the back right", "the right", "the front right"};

struct Poses {
  std::vector<Pose> poses;
  std::vector<ClipPoses> clips;
  std::string protocol;
};

std::size_t pose_budget(const BakedCharacter& baked, const BodySettings& settings) {
  const std::uint64_t rays_of_pose = std::uint64_t(settings.rays) * baked.character.mesh.vertex_count();
  return std::size_t(
      std::clamp<std::uint64_t>(settings.max_rays / std::max<std::uint64_t>(rays_of_pose, 1), 4, 400));
}

std::vector<std::size_t> shown_motion(const ImportedCharacter& character, const Recipe* recipe,
                                      std::string& protocol) {
  const std::vector<std::size_t> all = motion_clips(character);
  std::vector<std::size_t> unseen;
  for (const std::size_t clip : all)
    if (!recipe || std::ranges::find(recipe->clips, clip) == recipe->clips.end()) unseen.push_back(clip);
  protocol = unseen.empty() ? "poses from clips that were all part of the bake"
                            : "poses from clips that were not part of the bake";
  return unseen.empty() ? all : unseen;
}

Poses choose(const BakedCharacter& baked, const Recipe* recipe, const BodySettings& settings) {
  const ImportedCharacter& character = baked.character;
  Poses chosen;
  const std::size_t budget = pose_budget(baked, settings);
  std::vector<std::size_t> clips = shown_motion(character, recipe, chosen.protocol);
  if (clips.empty()) {
    chosen.protocol = "poses of the bake";
    if (recipe) chosen.poses = recipe_poses(character, *recipe);
    if (chosen.poses.empty()) {
      chosen.protocol = "the rest pose";
      chosen.poses.push_back(rest_pose(character));
    }
    thin_out(chosen.poses, budget);
    return chosen;
  }
  // If there are more clips than poses, takes clips that are evenly spread over all clips.
  if (clips.size() > budget) {
    const std::size_t count = clips.size();
    for (std::size_t i = 0; i < budget; ++i) clips[i] = clips[(2 * i + 1) * count / (2 * budget)];
    clips.resize(budget);
  }
  const std::size_t samples = settings.samples_per_clip > 0
                                  ? settings.samples_per_clip
                                  : std::clamp<std::size_t>(budget / clips.size(), 1, 20);
  chosen.poses = clip_poses(character, clips, samples);
  for (std::size_t c = 0; c < clips.size(); ++c)
    chosen.clips.push_back({character.clips[clips[c]].name, c * samples, samples});
  return chosen;
}

MeasuredBody measured_body(const BakedCharacter& baked, Poses chosen, AoTargets truth) {
  MeasuredBody body{std::move(chosen.poses), std::move(chosen.clips), {}, std::move(truth)};
  body.model.resize(body.poses.size());
  tbb::parallel_for(std::size_t(0), body.poses.size(),
                    [&](std::size_t t) { body.model[t] = predict_ao(baked.model, body.poses[t]); });
  return body;
}

double share_of(const BodyFindings& found, std::size_t name) {
  const std::string wanted = part_names()[name];
  for (const NamedError& part : found.parts)
    if (part.name == wanted) return part.error.square / found.all.square;
  return 0;
}

Measures measures_of(const BakedCharacter& baked, const Recipe* recipe, const BodyFindings& found,
                     const CharacterEvaluation& evaluation, std::size_t poses) {
  Measures m;
  const bool has_error = found.all.square > 0;
  m.value["rms_visible"] = std::sqrt(evaluation.model.mse_visible);
  m.value["poses"] = double(poses);
  m.value["too_dark"] = -found.bias;
  m.value["too_bright"] = found.bias;
  m.value["hidden_share"] = 1 - evaluation.visible_share;
  m.value["noise_share"] = evaluation.noise_floor_mse / evaluation.model.mse;
  m.value["world_casters"] = double(baked.model.world_casters.size());
  if (!baked.model.static_ao.empty())
    m.value["ratio_to_static"] = evaluation.model.mse_visible / evaluation.static_bake.mse_visible;
  if (has_error) {
    m.value["hands_share"] = share_of(found, 0);
    m.value["feet_share"] = share_of(found, 1);
    m.value["head_share"] = share_of(found, 2);
  }
  if (found.clips.size() >= 3) {
    m.value["worst_clip_ratio"] =
        found.clips.front().error.rms() / found.clips[found.clips.size() / 2].error.rms();
    m.name["clip"] = found.clips.front().name;
  }
  if (recipe) {
    m.value["source_changed"] = reads_other_content(*recipe, baked.character) ? 1 : 0;
    m.value["draft"] = recipe->preset == Preset::draft ? 1 : 0;
    if (!motion_clips(baked.character).empty()) m.value["fitted_clips"] = double(recipe->clips.size());
  }
  return m;
}

Html sides(const SkinnedMesh& mesh, const BodyFindings& found) {
  const std::vector<Picture> pictures = eight_sides(mesh, found.vertex_rms);
  Html html;
  for (std::size_t side = 0; side < pictures.size(); ++side) {
    std::string alternative = "The body from ";
    alternative.append(side_names[side])
        .append(" in its rest pose, each point in the colour of its typical error");
    html += figure(pictures[side], alternative, Html("from ") + text(side_names[side]));
  }
  return html;
}

Html named_errors(const std::vector<NamedError>& errors, const BodyFindings& found, Markup what,
                  std::size_t most) {
  std::vector<std::vector<Html>> rows{
      {Html(what), Html("share of the visible error"), Html("share of the surface"), Html("typical error")}};
  for (const NamedError& e : errors) {
    if (rows.size() > most) break;
    rows.push_back({text(e.name), share_bar(found.all.square > 0 ? e.error.square / found.all.square : 0),
                    percent(e.error.weight / found.all.weight), number(e.error.rms())});
  }
  return table(rows);
}

Html clip_table(const BodyFindings& found) {
  std::vector<std::vector<Html>> rows{{Html("clip"), Html("typical error"), Html("worst pose")}};
  for (const ClipError& clip : found.clips) {
    if (rows.size() > listed_clips) break;
    rows.push_back({text(clip.name), number(clip.error.rms()), number(clip.worst_rms)});
  }
  return found.clips.empty() ? Html() : table(rows);
}

// Chooses the poses for the pictures: the worst pose of each of the worst clips. If there are no clips,
// chooses consecutive poses.
std::vector<NamedPose> shown_poses(const MeasuredBody& body, const BodyFindings& found) {
  std::vector<NamedPose> poses;
  for (const ClipError& clip : found.clips)
    if (poses.size() < shown_clips) poses.push_back({clip.worst_pose, clip.name});
  if (!poses.empty()) return poses;
  const std::size_t count = std::min(shown_clips, body.poses.size());
  for (std::size_t i = 0; i < count; ++i)
    poses.push_back({(2 * i + 1) * body.poses.size() / (2 * count), "pose " + std::to_string(i + 1)});
  return poses;
}

Html pose_pictures(const SkinnedMesh& mesh, const MeasuredBody& body, const std::vector<NamedPose>& poses) {
  Html html;
  for (const NamedPose& shown : poses) {
    std::string alternative = "The body in a pose of ";
    alternative.append(shown.name).append(": ray traced, from the model, and the difference");
    html += element("h3", text(shown.name)) +
            figure(compare_pose(mesh, body, shown.pose, {}), alternative,
                   Html("Left: ray traced. Middle: from the model. Right: the difference. Look where the "
                        "right picture is not violet."));
  }
  return html;
}

Html places(const SkinnedMesh& mesh, const MeasuredBody& body, const BodyFindings& found) {
  Html html;
  for (const Place& place : found.places) {
    const std::string where = place.joint.empty() ? "a joint without a name" : place.joint;
    std::string alternative = "The surface at ";
    alternative.append(where)
        .append(": ray traced, from the model, and the difference; typical error ")
        .append(number(place.rms).code());
    html +=
        element("h3", Html("At ") + text(where)) +
        figure(
            compare_pose(mesh, body, place.worst_pose, place.vertices), alternative,
            percent(place.share) +
                Html(" of the visible error of the whole body; typical error of this place in this pose: ") +
                number(place.rms) + Html("."));
  }
  return html;
}

std::vector<NamedPose> turned_poses(const MeasuredBody& body, const BodyFindings& found) {
  std::vector<NamedPose> poses = shown_poses(body, found);
  for (NamedPose& pose : poses) pose.name.append(", worst pose");
  // Also shows the clip with the median error, as a typical clip.
  if (found.clips.size() > shown_clips) {
    const ClipPoses* middle = nullptr;
    for (const ClipPoses& clip : body.clips)
      if (clip.name == found.clips[found.clips.size() / 2].name) middle = &clip;
    if (middle)
      poses.push_back({middle->first + middle->count / 2, middle->name + ", a clip with a median error"});
  }
  return poses;
}

Html lead(const CharacterEvaluation& e, const std::string& protocol, std::size_t pose_count,
          bool has_static) {
  Html html = Html("Where the body is visible, its AO is typically wrong by <strong>") +
              number(std::sqrt(e.model.mse_visible)) + Html("</strong> of the way from dark (0) to open (1)");
  if (has_static)
    html += Html("; AO baked once into a texture is wrong by <strong>") +
            number(std::sqrt(e.static_bake.mse_visible)) + Html("</strong>");
  return html + Html(". Measured in ") + text(std::to_string(pose_count)) + Html(" poses (") +
         text(protocol) + Html(") with ") + text(std::to_string(e.rays)) +
         Html(" rays for each vertex; the noise of these rays is ") + number(std::sqrt(e.noise_floor_mse)) +
         Html(".");
}

Html warnings_of(const ImportedCharacter& character) {
  if (character.warnings.empty()) return {};
  Html items;
  for (const std::string& warning : character.warnings) items += element("li", text(warning));
  return Html("<section id=\"import\"><h2>Notes of the import</h2>\n") + element("ul", items) +
         Html("</section>\n");
}

}  // namespace

PageParts body_parts(const BakedCharacter& baked, const BodySettings& settings,
                     const StageProgress& progress) {
  const SkinnedMesh& mesh = baked.character.mesh;
  const std::optional<Recipe> recipe = stored_recipe(baked);
  const Recipe* known = recipe ? &*recipe : nullptr;
  Poses chosen = choose(baked, known, settings);
  const std::string protocol = chosen.protocol;
  CharacterEvaluation evaluation =
      evaluate_character(mesh, baked.model, chosen.poses, settings.rays, evaluation_ray_seed(settings.seed),
                         progress("ray tracing"));
  const MeasuredBody body = measured_body(baked, std::move(chosen), std::move(evaluation.truth));
  const BodyFindings found = find_errors(mesh, body, shown_places);
  const Measures measures = measures_of(baked, known, found, evaluation, body.poses.size());
  const Progress drawing = progress("drawing");
  const auto step = [&](std::size_t done) {
    if (!drawing(done, 4)) throw Failure(NOOK_ERROR_CANCELLED, "cancelled while drawing");
  };
  step(0);
  const Html drawn_sides = sides(mesh, found);
  step(1);
  const Html drawn_poses = pose_pictures(mesh, body, shown_poses(body, found));
  step(2);
  const Html drawn_places = places(mesh, body, found);
  step(3);
  const Turnable turn = turnable_body(mesh, body, turned_poses(body, found), turnable_bytes);
  step(4);

  const bool has_clips = !found.clips.empty();
  PageParts parts;
  parts.lead = lead(evaluation, protocol, body.poses.size(), !baked.model.static_ao.empty());
  parts.advice = advice_list(Subject::body, measures);
  parts.sections = fill(
      "body.html",
      {{"scale", error_scale(double(error_end), "error of AO, which has no unit")},
       {"sides", drawn_sides},
       {"parts", named_errors(found.parts, found, "part", part_names().size())},
       {"joints", named_errors(found.joints, found, "joint", listed_joints)},
       {"clips_title", has_clips ? Html("Worst clips") : Html("Poses")},
       {"clips_text",
        has_clips ? Html("Errors are weighted by area, over the visible surface. The pictures show the worst "
                         "pose of each of the worst clips, from the side that sees most of the error.")
                  : Html("The file has no clip that shows motion, so these are poses from the bake.")},
       {"clips", clip_table(found)},
       {"clip_pictures", drawn_poses},
       {"places", drawn_places.empty() ? Html("<p>No error is visible.</p>\n") : drawn_places},
       {"turn", turn.section}});
  parts.sections += warnings_of(baked.character);
  parts.scripts = turn.scripts;
  return parts;
}

}  // namespace nook::report

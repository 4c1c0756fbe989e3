// Measures temporally accumulated AO, for a camera that moves through scenes and for walking characters.
#include <filesystem>
#include <optional>

#include "bakers/lab/nnao/built_in_scenes.h"
#include "bakers/lab/nnao/mover_comparison.h"
#include "bakers/lab/nnao/sequence_comparison.h"
#include "bakers/lab/nnao/view_pictures.h"
#include "bakers/lab/tool/nnao_scenes.h"
#include "bakers/tool/command_end.h"
#include "bakers/tool/command_files.h"
#include "bakers/tool/evaluate_nnao.h"
#include "platform/output_file.h"
#include "platform/progress_bar.h"
#include "sdk/src/core/failure.h"

namespace nook::lab {

using namespace measure;
using namespace tool;
using Json = nlohmann::ordered_json;

Json evaluate_sequences(EvaluateNnaoOptions& options) {
  const Work work = read_work(options);
  options.truth.path.frames = sequence_frames;
  std::optional<platform::OutputFile> markdown;
  if (!options.markdown.empty()) markdown.emplace(options.markdown);
  if (!options.references.empty()) std::filesystem::create_directories(options.references);
  const auto context = make_context();
  AoRequest request;
  request.max_radius_px = max_radius_px(options);
  std::vector<SequenceView> measured;
  // Scenes are processed one by one, because the frames of all scenes together take a gigabyte.
  for (const SceneRequest& scene : work.scenes) {
    const std::vector<MeasuredView> views = traced_views(scene, options);
    platform::ProgressBar bar(options.common.quiet);
    for (std::size_t v = 0; v < views.size(); ++v) {
      bar.show(scene.name + ", measuring", "views", v, views.size());
      if (interrupted()) throw Failure(NOOK_ERROR_CANCELLED, "cancelled while measuring");
      measured.push_back(measure_sequence(*context, views[v], request));
    }
    bar.show(scene.name + ", measuring", "views", views.size(), views.size());
  }
  Json report = sequence_report(measured, options.common.seed);
  if (markdown) markdown->commit(sequence_markdown(report));
  report["step_px"] = options.truth.path.step_px;
  add_conditions(report, options, *context);
  return report;
}

namespace {

// Measures the shots of a character, with a static camera and with a moving camera.
class Shots {
 public:
  Shots(const std::filesystem::path& file, const EvaluateNnaoOptions& options)
      : name_(file.stem().string()), options_(options) {
    naming_file(file, [&] {
      character_ = bake::import_gltf(file, options.scenes.reading);
      clip_ = walking_clip(character_, options.clip);
    });
  }

  std::size_t count() const { return 2 * shots_.size(); }
  const std::string& clip() const { return character_.clips[clip_].name; }

  MeasuredMover measure(platform::Context& context, std::size_t index) const {
    const MoverShot& shot = shots_[index / 2];
    const bool camera_moves = index % 2 != 0;
    TruthSettings truth = options_.truth;
    truth.path.frames = mover_frames;
    if (!camera_moves) truth.path.step_px = 0;
    WalkSettings walk;
    walk.frames = mover_frames;
    walk.heading = shot.heading;
    walk.speed_mps = options_.walk_speed;
    // Each shot uses a different part of the clip.
    walk.phase = (float(index) + 0.5f) / float(count());
    MoverView view = trace_mover(
        mover_stage(), walking_body(character_, clip_, walk),
        bake::nnao::look_at(shot.eye, shot.target, 0, shot.fov, truth.width, truth.height), truth);
    AoRequest request;
    request.max_radius_px = max_radius_px(options_);
    std::vector<std::vector<float>> images;
    MeasuredMover measured =
        measure_mover(context, view, request, options_.images.empty() ? nullptr : &images);
    measured.character = name_;
    measured.shot = shot.name;
    measured.camera_moves = camera_moves;
    if (!options_.images.empty())
      platform::write_image(
          options_.images / (name_ + "_" + shot.name + (camera_moves ? "_moving" : "") + ".png"),
          make_sheet(view.measured, images));
    return measured;
  }

 private:
  std::string name_;
  const EvaluateNnaoOptions& options_;
  bake::ImportedCharacter character_;
  std::size_t clip_ = 0;
  std::array<MoverShot, 4> shots_ = mover_shots();
};

}  // namespace

Json evaluate_movers(const EvaluateNnaoOptions& options) {
  std::optional<platform::OutputFile> markdown;
  if (!options.markdown.empty()) markdown.emplace(options.markdown);
  const auto context = make_context();
  std::vector<MeasuredMover> measured;
  Json clips = Json::object();
  for (const std::filesystem::path& file : options.movers) {
    const Shots shots(file, options);
    clips[file.stem().string()] = shots.clip();
    platform::ProgressBar bar(options.common.quiet);
    for (std::size_t i = 0; i < shots.count(); ++i) {
      bar.show(file.stem().string(), "views", i, shots.count());
      if (interrupted()) throw Failure(NOOK_ERROR_CANCELLED, "cancelled while measuring");
      measured.push_back(shots.measure(*context, i));
    }
    bar.show(file.stem().string(), "views", shots.count(), shots.count());
  }
  Json report = mover_report(measured, options.common.seed);
  if (markdown) markdown->commit(mover_markdown(report));
  report["clips"] = clips;
  report["walk_speed"] = options.walk_speed;
  report["step_px"] = options.truth.path.step_px;
  add_conditions(report, options, *context);
  return report;
}

}  // namespace nook::lab

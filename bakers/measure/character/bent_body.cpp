#include "bakers/measure/character/bent_body.h"

#include "bakers/import/skinned_mesh.h"
#include "bakers/measure/character/evaluate.h"
#include "sdk/src/core/failure.h"

namespace nook::measure {
namespace {

Vec3 skinned(const bake::SkinWeights& weights, const bake::Pose& pose, Vec3 v) {
  Vec3 sum;
  for (int b = 0; b < bake::SkinWeights::max_bones; ++b)
    if (weights.weight[b] > 0) sum += weights.weight[b] * transform_vector(pose[weights.bone[b]], v);
  return sum;
}

}  // namespace

BentBody bent_body(const bake::SkinnedMesh& mesh, const CharacterModel& model, const bake::Pose& pose) {
  if (model.occluded.empty())
    throw Failure(NOOK_ERROR_UNSUPPORTED,
                  "the model was baked without bent normals; add them with `nook bake bent`");
  BentBody body;
  bake::skin_positions(mesh, pose, body.position);
  bake::vertex_normals(mesh.triangle, body.position, body.normal);
  body.ao = bake::predict_ao(model, pose);
  for (std::size_t v = 0; v < body.position.size(); ++v)
    body.bent.push_back(
        bent_normal(body.normal[v], skinned(mesh.weights[v], pose, model.occluded[v].at(body.ao[v]))));
  return body;
}

}  // namespace nook::measure

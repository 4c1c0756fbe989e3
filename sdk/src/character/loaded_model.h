// A model as the runtime holds it: shared and immutable, with what is worth deriving once from its data.
#pragma once

#include "character/model.h"
#include "core/ref.h"

namespace nook {

struct LoadedModel : RefCounted {
  explicit LoadedModel(CharacterModel loaded);

  CharacterModel model;
  // Largest sum of alpha over a vertex: by how much a change of every shadow can change an AO.
  float max_alpha_sum = 0;
  // True if welded vertices are numbered as they first occur in file order, as the bakers number them: AO in
  // file order is then computed in runs.
  bool in_file_order = true;
};

}  // namespace nook

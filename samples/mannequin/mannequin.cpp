#include "mannequin.h"

#include "body_mesh.h"
#include "clips.h"
#include "glb_writer.h"
#include "skeleton.h"
#include "skin_weights.h"

namespace nook_samples::mannequin {

std::vector<unsigned char> make_mannequin_glb() {
  const Skeleton skeleton;
  const TriangleMesh mesh = make_body_mesh();
  return write_glb(mesh, make_skin_weights(mesh, skeleton), skeleton, all_clips());
}

}  // namespace nook_samples::mannequin

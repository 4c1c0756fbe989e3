#include "samples/mannequin/mannequin.h"

#include "samples/mannequin/body_mesh.h"
#include "samples/mannequin/clips.h"
#include "samples/mannequin/glb_writer.h"
#include "samples/mannequin/skeleton.h"
#include "samples/mannequin/skin_weights.h"

namespace nook_samples::mannequin {

std::vector<unsigned char> make_mannequin_glb() {
  const Skeleton skeleton;
  const TriangleMesh mesh = make_body_mesh();
  return write_glb(mesh, make_skin_weights(mesh, skeleton), skeleton, all_clips());
}

}  // namespace nook_samples::mannequin

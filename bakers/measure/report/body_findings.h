// Finds the clips, body parts, joints and places of a character in which the error of its model is large.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "bakers/import/skinned_mesh.h"
#include "bakers/raytrace/ambient_occlusion.h"

namespace nook::report {

// Consecutive poses of one clip.
struct ClipPoses {
  std::string name;
  std::size_t first = 0, count = 0;
};

// The AO of the model and of ray tracing for every pose and welded vertex.
struct MeasuredBody {
  std::vector<bake::Pose> poses;
  std::vector<ClipPoses> clips;           // may be empty
  std::vector<std::vector<float>> model;  // pose by pose
  bake::AoTargets truth;

  float traced(std::size_t pose, std::size_t vertex) const {
    return float(truth.row(pose)[vertex]) * bake::AoTargets::scale;
  }
};

// Squared errors of the vertex-poses whose ray-traced AO is not black, weighted by the vertices' area in the
// rest pose.
struct SeenError {
  double square = 0, weight = 0;
  void add(double error, double area) {
    square += area * error * error;
    weight += area;
  }
  double rms() const;
};

struct NamedError {
  std::string name;
  SeenError error;
};

struct ClipError {
  std::string name;
  SeenError error;
  std::size_t worst_pose = 0;
  double worst_rms = 0;
};

// A region of the surface. Its size is about a twentieth of the body's size.
struct Place {
  std::vector<std::uint32_t> vertices;
  std::string joint;           // the joint that moves the largest part of the place
  std::size_t worst_pose = 0;  // the pose in which the place has the largest error
  double rms = 0;              // error in the worst pose
  double share = 0;            // this place's fraction of the whole body's error
};

struct BodyFindings {
  SeenError all;
  double bias = 0;                // mean of (model - ray traced) over visible vertices
  std::vector<float> vertex_rms;  // over the poses in which the vertex is visible
  std::vector<ClipError> clips;   // worst first
  std::vector<NamedError> parts;  // largest share first
  std::vector<NamedError> joints;
  std::vector<Place> places;
};

BodyFindings find_errors(const bake::SkinnedMesh& mesh, const MeasuredBody& body, std::size_t max_places);

// Returns the names of the body parts that advice uses: hands, feet, head, arms, legs, trunk, other.
std::vector<std::string> part_names();

}  // namespace nook::report

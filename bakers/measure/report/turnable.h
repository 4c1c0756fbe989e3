// A body in several poses as data for the page's WebGL 2 view.
#pragma once

#include <span>
#include <string>

#include "bakers/measure/report/body_findings.h"
#include "bakers/measure/report/html.h"

namespace nook::report {

struct Turnable {
  Html section;  // the view's elements, or a sentence where the body is too large
  Html scripts;
};

struct NamedPose {
  std::size_t pose = 0;
  std::string name;
};

// Takes as many of the poses, from the first, as fit into max_bytes of the page.
Turnable turnable_body(const bake::SkinnedMesh& mesh, const MeasuredBody& body,
                       std::span<const NamedPose> poses, std::size_t max_bytes);

}  // namespace nook::report

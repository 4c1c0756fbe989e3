// The pictures of the comparison's sheets: a group of the crowd with values that are given at its vertices.
#pragma once

#include "bakers/measure/crowd/subject.h"
#include "samples/crowd/frames.h"

namespace crowd {

class Panels final : public nook::measure::crowd::PanelRenderer {
 public:
  // The stage and the poses must outlive this object.
  Panels(const Stage& stage, const std::vector<Bones>& poses) : stage_(stage), poses_(poses) {}

  platform::Image draw(const nook::measure::crowd::Group& group,
                       const nook::measure::crowd::AoPanel& panel) override;
  platform::Image draw(const nook::measure::crowd::Group& group,
                       const nook::measure::crowd::IrradiancePanel& panel) override;

 private:
  std::vector<DrawnInstance> instances_of(const nook::measure::crowd::Group& group) const;

  const Stage& stage_;
  const std::vector<Bones>& poses_;
};

}  // namespace crowd

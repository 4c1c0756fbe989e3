#include "bakers/measure/report/advice.h"

#include <cmath>
#include <set>

#include "tests/catch.h"

using namespace nook::report;

namespace {

std::vector<std::string> given_for(Subject subject, const Measures& measures) {
  std::vector<std::string> names;
  for (const Advice& advice : advise(subject, measures)) names.push_back(advice.rule->measure);
  return names;
}

}  // namespace

TEST_CASE("each rule holds at its threshold, not before it, and not for another subject") {
  for (const Rule& rule : advice_rules()) {
    INFO(rule.measure << ' ' << rule.threshold);
    const double outwards =
        (rule.bound == Bound::at_least ? -1 : 1) * (std::fabs(rule.threshold) * 1e-6 + 1e-9);
    Measures at, before;
    at.value[rule.measure] = rule.threshold;
    before.value[rule.measure] = rule.threshold + outwards;
    const auto counts = [&](const Measures& measures) {
      int count = 0;
      for (const Advice& advice : advise(rule.subject, measures))
        count += advice.rule->threshold == rule.threshold && advice.rule->bound == rule.bound ? 1 : 0;
      return count;
    };
    CHECK(counts(at) == 1);
    CHECK(counts(before) == 0);
  }
}

TEST_CASE("advice fills in its numbers and names, and says nothing of what was not measured") {
  Measures measures;
  CHECK(advise(Subject::body, measures).empty());
  measures.value["hands_share"] = 0.4;
  measures.value["worst_clip_ratio"] = 2.5;
  measures.name["clip"] = "<b>";
  const std::vector<Advice> given = advise(Subject::body, measures);
  REQUIRE(given.size() == 2);
  CHECK(given[0].words.find("40 % of the visible error is on the hands.") == 0);
  CHECK(given[1].words.find("The error in the clip <b> is 2.5 times") == 0);
  const std::string list = advice_list(Subject::body, measures).code();
  CHECK(list.find("&lt;b&gt;") != std::string::npos);
  CHECK(list.find("<code>--clips</code>") != std::string::npos);
  measures.value["hands_share"] = std::nan("");
  CHECK(given_for(Subject::body, measures) == std::vector<std::string>{"worst_clip_ratio"});
}

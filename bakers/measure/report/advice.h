// Advice that follows from measured numbers, by rules with thresholds that stand in one table
// (advice_rules.inl).
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "bakers/measure/report/html.h"

namespace nook::report {

enum class Subject { body, probes, material, transfer, frame };
enum class Bound { at_least, at_most };

struct Rule {
  Subject subject;
  const char* measure;  // a key of Measures::value
  Bound bound;
  double threshold;
  const char* meaning;  // of the measure, for the reader
  const char* advice;   // {name} is one of Measures::name, {percent} and {value} are the measure
};

// Measured numbers. A rule whose measure is not here says nothing.
struct Measures {
  std::map<std::string, double, std::less<>> value;
  std::map<std::string, std::string, std::less<>> name;
};

struct Advice {
  const Rule* rule = nullptr;
  std::string words;
};

std::vector<Rule> advice_rules();

// Those of the rules that hold, in the table's order. Measures that are not finite say nothing.
std::vector<Advice> advise(Subject subject, const Measures& measures);

// A list, each with its rule in small print; a sentence where there is none.
Html advice_list(Subject subject, const Measures& measures);

}  // namespace nook::report

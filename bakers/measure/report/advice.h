// Derives advice from measured numbers. The rules and their thresholds are in one table (advice_rules.inl).
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
  const char* meaning;  // what the measure means to the reader
  const char* advice;   // {name} stands for an entry of Measures::name, {percent} and {value} for the measure
};

// Measured numbers. A rule gives no advice if its measure is missing.
struct Measures {
  std::map<std::string, double, std::less<>> value;
  std::map<std::string, std::string, std::less<>> name;
};

struct Advice {
  const Rule* rule = nullptr;
  std::string words;
};

std::vector<Rule> advice_rules();

// Returns the rules that hold, in the table's order. A measure that is not finite gives no advice.
std::vector<Advice> advise(Subject subject, const Measures& measures);

// Returns a list with each rule in small print, or a sentence if there is no advice.
Html advice_list(Subject subject, const Measures& measures);

}  // namespace nook::report

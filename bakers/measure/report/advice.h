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
  const char* advice;  // {name} is replaced by an entry of Measures::name; {percent} and {value} are replaced
                       // by the measure
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

// Returns the advice of the rules that apply, in the order of the table. A measure that is not finite gives
// no advice.
std::vector<Advice> advise(Subject subject, const Measures& measures);

// Returns the advice as a list, in which the rule behind each entry is in small print. If there is no advice,
// returns a sentence that says so.
Html advice_list(Subject subject, const Measures& measures);

}  // namespace nook::report

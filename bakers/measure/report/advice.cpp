#include "bakers/measure/report/advice.h"

#include <cmath>
#include <cstdio>

namespace nook::report {
namespace {

constexpr Rule rules[] = {
#define RULE(subject, measure, bound, threshold, meaning, advice) \
  {Subject::subject, measure, Bound::bound, threshold, meaning, advice},
#include "bakers/measure/report/advice_rules.inl"
#undef RULE
};

std::string plain(double value, const char* format) {
  char shown[40];
  std::snprintf(shown, sizeof shown, format, value);
  return shown;
}

std::string word_for(std::string_view key, double value, const Measures& measures) {
  if (key == "value") return plain(value, std::fabs(value) >= 100 ? "%.0f" : "%.2g");
  if (key == "percent") return plain(100 * value, "%.0f %%");
  if (key == "oneover") return plain(1 / value, "%.2g");
  const auto name = measures.name.find(key);
  return name == measures.name.end() ? std::string() : name->second;
}

std::string words_of(const Rule& rule, double value, const Measures& measures) {
  std::string words;
  std::string_view rest = rule.advice;
  for (std::size_t open; (open = rest.find('{')) != std::string_view::npos;) {
    const std::size_t close = rest.find('}', open);
    words.append(rest.substr(0, open))
        .append(word_for(rest.substr(open + 1, close - open - 1), value, measures));
    rest.remove_prefix(close + 1);
  }
  return words.append(rest);
}

bool holds(const Rule& rule, double value) {
  if (!std::isfinite(value)) return false;
  return rule.bound == Bound::at_least ? value >= rule.threshold : value <= rule.threshold;
}

// Shows text between backticks as code.
Html with_code(std::string_view words) {
  Html html;
  bool is_code = false;
  for (;;) {
    const std::size_t accent = words.find('`');
    const Html piece = text(words.substr(0, accent));
    html += is_code ? Html("<code>") + piece + Html("</code>") : piece;
    if (accent == std::string_view::npos) return html;
    words.remove_prefix(accent + 1);
    is_code = !is_code;
  }
}

}  // namespace

std::vector<Rule> advice_rules() {
  return {std::begin(rules), std::end(rules)};
}

std::vector<Advice> advise(Subject subject, const Measures& measures) {
  std::vector<Advice> given;
  for (const Rule& rule : rules) {
    const auto measure = measures.value.find(std::string_view(rule.measure));
    if (rule.subject == subject && measure != measures.value.end() && holds(rule, measure->second))
      given.push_back({&rule, words_of(rule, measure->second, measures)});
  }
  return given;
}

Html advice_list(Subject subject, const Measures& measures) {
  const std::vector<Advice> given = advise(subject, measures);
  if (given.empty()) return Html("<p>No measured value is beyond a threshold, so there is no advice.</p>\n");
  Html items;
  for (const Advice& advice : given) {
    const double value = measures.value.find(std::string_view(advice.rule->measure))->second;
    items += element(
        "li", with_code(advice.words) + Html("<small>") + text(advice.rule->meaning) + Html(": ") +
                  number(value) +
                  (advice.rule->bound == Bound::at_least ? Html("; this advice appears from this value on: ")
                                                         : Html("; this advice appears up to this value: ")) +
                  number(advice.rule->threshold) + Html("</small>"));
  }
  return Html("<ul class=\"advice\">\n") + items + Html("</ul>\n");
}

}  // namespace nook::report

#include "bakers/tool/command_line.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cstdint>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>

#include "bakers/tool/bake_survey.h"
#include "bakers/tool/command_end.h"
#include "platform/input_file.h"
#include "sdk/src/core/failure.h"

namespace nook::tool {
namespace {

// The name of the checks that fault_of_whole_number makes.
constexpr const char* whole_number_check = "whole number";

void leave_range_of_type(CLI::Option& option) {
  try {
    option.get_validator(whole_number_check)->active(false);
  } catch (const CLI::OptionNotFound&) {
  }
}

// Rejects numbers that a conversion to an unsigned type would silently change. For example, -1 would become
// the largest number.
std::string fault_of_whole_number(const std::string& text, std::uint64_t low, std::uint64_t high) {
  std::uint64_t number = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  if (error == std::errc() && stop == end && number >= low && number <= high) return "";
  return "\"" + text + "\" is not a whole number from " + std::to_string(low) + " to " + std::to_string(high);
}

}  // namespace

Check::Check(const CLI::Validator& validator)
    : validator_(std::make_shared<const CLI::Validator>(validator)) {}

std::string Check::operator()(const std::string& text) const {
  return validator()(text);
}

Check Check::operator|(const Check& other) const {
  return Check(validator() | other.validator());
}

template <class T>
Check in_range(T low, T high) {
  CLI::Range range(low, high);
  if constexpr (std::is_integral_v<T>) {
    if (std::cmp_greater_equal(low, 0)) {
      CLI::Validator whole(
          [low, high](std::string& text) {
            return fault_of_whole_number(text, std::uint64_t(low), std::uint64_t(high));
          },
          range.get_description(), whole_number_check);
      return Check(whole);
    }
  }
  return Check(range);
}
template Check in_range(int, int);
template Check in_range(unsigned, unsigned);
template Check in_range(float, float);
template Check in_range(double, double);

Check one_of(const std::vector<std::string>& names) {
  return Check(CLI::IsMember(names));
}
Check one_of_numbers(const std::vector<int>& numbers) {
  return Check(CLI::IsMember(numbers));
}
Check positive_number() {
  return Check(CLI::PositiveNumber);
}
Check non_negative_number() {
  return Check(CLI::NonNegativeNumber);
}
Check existing_file() {
  return Check(CLI::ExistingFile);
}

Option Option::required() const {
  return Option(option_->required());
}
Option Option::check(const Check& check) const {
  // Messages must name the option's own range, so the check for the range of its type is turned off.
  if (check.validator().get_name() == whole_number_check) leave_range_of_type(*option_);
  return Option(option_->check(check.validator()));
}
Option Option::check(const std::function<std::string(const std::string&)>& fault) const {
  return Option(option_->check(fault));
}
Option Option::each(const std::function<void(std::string)>& seen) const {
  return Option(option_->each(seen));
}
Option Option::capture_default_str() const {
  return Option(option_->capture_default_str());
}
Option Option::default_str(const std::string& text) const {
  return Option(option_->default_str(text));
}
Option Option::type_name(const std::string& name) const {
  return Option(option_->type_name(name));
}
Option Option::delimiter(char between) const {
  return Option(option_->delimiter(between));
}
Option Option::one_each() const {
  return Option(option_->allow_extra_args(false));
}
Option Option::expected(int count) const {
  return Option(option_->expected(count));
}
Option Option::expected(int least, int most) const {
  return Option(option_->expected(least, most));
}
Option Option::needs(Option other) const {
  return Option(option_->needs(other.option_));
}
Option Option::excludes(Option other) const {
  return Option(option_->excludes(other.option_));
}
Option Option::number_of(const std::map<std::string, int>& numbers) const {
  // CLI11 would also print the enum values, which mean nothing to users.
  std::string names;
  for (const auto& [name, number] : numbers) names += (names.empty() ? "{" : ",") + name;
  return Option(option_->transform(CLI::CheckedTransformer(numbers).description(names + "}")));
}

Command Command::add_subcommand(const char* name, const std::string& help) const {
  return Command(*app_->add_subcommand(name, help), survey_);
}

namespace {

struct NamedCopy {
  std::unique_ptr<platform::InputCopy> copy;
  std::string named;  // the name that the user gave
};
using InputCopies = std::vector<NamedCopy>;

constexpr std::uint64_t max_stream_bytes = std::uint64_t{1} << 32;

template <class Path>
void copy_stream(Path& path, InputCopies& copies) {
  if (!platform::is_stream(path)) return;
  try {
    copies.push_back({std::make_unique<platform::InputCopy>(path, max_stream_bytes, file_events(true)),
                      std::filesystem::path(path).string()});
  } catch (const platform::Stopped&) {
    throw;
  } catch (const std::runtime_error& error) {
    throw ToolError(exit_bad_input, error.what());
  }
  path = copies.back().copy->path();
}

template <class Path>
void copy_stream(std::vector<Path>& paths, InputCopies& copies) {
  for (Path& path : paths) copy_stream(path, copies);
}

// In a message, replaces the names of temporary copies by the names that the user gave.
std::string without_copies(std::string text, const InputCopies& copies) {
  for (const NamedCopy& each : copies) {
    const std::string path = each.copy->path().string();
    for (std::size_t at = text.find(path); at != std::string::npos;
         at = text.find(path, at + each.named.size()))
      text.replace(at, path.size(), each.named);
  }
  return text;
}

// Rejects an empty name, which a script passes if its variable is not set. Also rejects "-", which many
// programs accept as the name of a stream.
std::string fault_of_path(const std::string& path) {
  if (path.empty()) return "the name of a file is empty";
  return path == "-" ? "\"-\" is not a file; use /dev/stdin or /dev/stdout for the streams, and ./- for a "
                       "file with this name"
                     : "";
}

template <class T>
constexpr bool is_path =
    std::is_same_v<T, std::filesystem::path> || std::is_same_v<T, std::vector<std::filesystem::path>>;
// Returns the largest number that an option of type T accepts if T is an unsigned integer, and 0 for other
// types.
template <class T>
constexpr std::uint64_t largest_number = 0;
template <>
constexpr std::uint64_t largest_number<unsigned> = std::numeric_limits<unsigned>::max();
template <>
constexpr std::uint64_t largest_number<std::uint64_t> = std::numeric_limits<std::uint64_t>::max();
template <class T>
constexpr std::uint64_t largest_number<std::optional<T>> = largest_number<T>;
template <class T>
constexpr std::uint64_t largest_number<std::vector<T>> = largest_number<T>;

}  // namespace

struct Command::Inputs {
  std::vector<std::function<void(InputCopies&)>> copy;
};

Command::Command(CLI::App& app, const BakeSurvey* survey)
    : app_(&app), survey_(survey), inputs_(std::make_shared<Inputs>()) {}

template <class T>
void Command::reads(T& value) const {
  inputs_->copy.push_back([&value](InputCopies& copies) { copy_stream(value, copies); });
}
template void Command::reads(std::string&) const;
template void Command::reads(std::filesystem::path&) const;
template void Command::reads(std::vector<std::filesystem::path>&) const;

void Command::callback(const std::function<void()>& run) const {
  app_->callback([run, inputs = inputs_, survey = survey_] {
    if (survey && !survey->found) return;
    InputCopies copies;
    for (const auto& copy : inputs->copy) copy(copies);
    try {
      run();
    } catch (const ToolError& error) {
      if (copies.empty()) throw;
      throw ToolError(error.code(), without_copies(error.what(), copies));
    } catch (const Failure& failure) {
      if (copies.empty()) throw;
      throw ToolError(exit_code_of(failure.code()), without_copies(failure.what(), copies));
    }
  });
}

// The value of the pose option of `nook evaluate casters`: two clips, a position and an angle.
using TwoNamesFourNumbers = std::tuple<std::string, std::string, float, float, float, float>;

template <class T>
requires(!std::is_enum_v<T>) Option Command::add_option(const char* names, T& value, const std::string& help)
const {
  CLI::Option* const added = app_->add_option(names, value, help);
  const Option option(added);
  if constexpr (is_path<T>) option.check([](const std::string& path) { return fault_of_path(path); });
  if constexpr (largest_number<T> != 0) {
    added->check([](const std::string& text) { return fault_of_whole_number(text, 0, largest_number<T>); },
                 "", whole_number_check);
  }
  return option;
}
template Option Command::add_option(const char*, std::string&, const std::string&) const;
template Option Command::add_option(const char*, std::filesystem::path&, const std::string&) const;
template Option Command::add_option(const char*, int&, const std::string&) const;
template Option Command::add_option(const char*, unsigned&, const std::string&) const;
template Option Command::add_option(const char*, std::uint64_t&, const std::string&) const;
template Option Command::add_option(const char*, float&, const std::string&) const;
template Option Command::add_option(const char*, double&, const std::string&) const;
template Option Command::add_option(const char*, std::optional<unsigned>&, const std::string&) const;
template Option Command::add_option(const char*, std::optional<float>&, const std::string&) const;
template Option Command::add_option(const char*, std::vector<std::string>&, const std::string&) const;
template Option Command::add_option(const char*, std::vector<std::filesystem::path>&,
                                    const std::string&) const;
template Option Command::add_option(const char*, std::vector<unsigned>&, const std::string&) const;
template Option Command::add_option(const char*, std::vector<float>&, const std::string&) const;
template Option Command::add_option(const char*, std::vector<double>&, const std::string&) const;
template Option Command::add_option(const char*, TwoNamesFourNumbers&, const std::string&) const;

Option Command::add_option_function(const char* names, const std::function<void(const std::string&)>& set,
                                    const std::string& help) const {
  return Option(app_->add_option_function<std::string>(names, set, help));
}
Option Command::add_flag(const char* names, bool& value, const std::string& help) const {
  return Option(app_->add_flag(names, value, help));
}
Option Command::add_flag_callback(const char* names, const std::function<void()>& set,
                                  const std::string& help) const {
  return Option(app_->add_flag_callback(names, set, help));
}

void run_words(std::vector<std::string> words, const std::function<void(Command)>& add,
               const BakeSurvey* survey) {
  CLI::App program;
  program.require_subcommand(1);
  add(Command(program, survey));
  std::reverse(words.begin(), words.end());  // CLI11 expects the arguments in reverse order
  try {
    program.parse(std::move(words));
  } catch (const CLI::ParseError& fault) {
    throw ToolError(exit_bad_arguments, fault.what());
  }
}

}  // namespace nook::tool

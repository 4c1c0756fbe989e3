// Wraps CLI11: commands and their options. CLI11's headers add four seconds to the compilation of each file
// that includes them. Therefore, only command_line.cpp, command_program.cpp and the main.cpp files of the
// programs include them.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

namespace CLI {
class App;
class Option;
class Validator;
}  // namespace CLI

namespace nook::tool {

// A condition on an option's text. The help text shows it.
class Check {
 public:
  explicit Check(const CLI::Validator& validator);
  const CLI::Validator& validator() const { return *validator_; }
  std::string operator()(const std::string& text) const;  // returns what is wrong, or nothing
  Check operator|(const Check& other) const;

 private:
  std::shared_ptr<const CLI::Validator> validator_;
};

// T is int, unsigned, float or double. The help text shows the name of the type.
template <class T>
Check in_range(T low, T high);
Check one_of(const std::vector<std::string>& names);
Check one_of_numbers(const std::vector<int>& numbers);
Check positive_number();
Check non_negative_number();
Check existing_file();

// A reference to an option of a command. Copies refer to the same option.
class Option {
 public:
  explicit Option(CLI::Option* option) : option_(option) {}

  Option required() const;
  Option check(const Check& check) const;
  // `fault` must return what is wrong with the text, or an empty text.
  Option check(const std::function<std::string(const std::string&)>& fault) const;
  // Calls `seen` for each text of the option.
  Option each(const std::function<void(std::string)>& seen) const;
  Option capture_default_str() const;  // the help text shows the variable's value as the default
  Option default_str(const std::string& text) const;
  Option type_name(const std::string& name) const;
  Option delimiter(char between) const;
  Option one_each() const;  // each time that a list option is given, it takes only one text
  Option expected(int count) const;
  Option expected(int least, int most) const;
  Option needs(Option other) const;
  Option excludes(Option other) const;
  // The texts of the option must be names in the map. Each name is converted to its number.
  Option number_of(const std::map<std::string, int>& numbers) const;

 private:
  CLI::Option* option_;
};

struct BakeSurvey;

// A reference to a command. Copies refer to the same command. Variables and functions that you pass must
// outlive the parsing.
class Command {
 public:
  // If `survey` is not null, bakes below this command are only described, not performed (bake_survey.h).
  explicit Command(CLI::App& app, const BakeSurvey* survey = nullptr);

  Command add_subcommand(const char* name, const std::string& help) const;
  void callback(const std::function<void()>& run) const;
  const BakeSurvey* survey() const { return survey_; }

  // command_line.cpp instantiates this template for these types T: text, paths, numbers, and vectors and
  // optionals of them.
  template <class T>
  requires(!std::is_enum_v<T>) Option add_option(const char* names, T& value, const std::string& help)
  const;
  // Adds an option that names one or more input files. T is text, a path or a vector of paths. If a file is a
  // pipe, it is read to its end before the command runs. The value of the option is then the name of a
  // temporary copy.
  template <class T>
  Option add_input(const char* names, T& value, const std::string& help) const {
    reads(value);
    return add_option(names, value, help);
  }
  // Like the function above, but passes the value to a function.
  template <class T>
  void reads(T& value) const;
  Option add_option_function(const char* names, const std::function<void(const std::string&)>& set,
                             const std::string& help) const;
  Option add_flag(const char* names, bool& value, const std::string& help) const;
  Option add_flag_callback(const char* names, const std::function<void()>& set,
                           const std::string& help) const;

  // Adds an option whose text must be a name in the map.
  template <class T>
  Option add_choice(const char* option_names, T& value, const std::map<std::string, T>& values,
                    const std::string& help) const {
    std::map<std::string, int> numbers;
    for (const auto& [name, of_name] : values) numbers[name] = int(of_name);
    return add_option_function(
               option_names, [&value](const std::string& number) { value = T(std::stoi(number)); }, help)
        .number_of(numbers)
        .type_name("ENUM");
  }

 private:
  struct Inputs;

  CLI::App* app_;
  const BakeSurvey* survey_;
  std::shared_ptr<Inputs> inputs_;
};

// Parses words like the arguments of a program, and runs the command that they name. `add` must add the
// commands. The commands receive the survey. Throws ToolError (bad arguments) if the words are invalid, and
// what the command throws.
void run_words(std::vector<std::string> words, const std::function<void(Command)>& add,
               const BakeSurvey* survey);

}  // namespace nook::tool

// The words of a call: CLI11 takes them apart, and here is said, in words of ours, what is wrong with one.
#pragma once

#include <CLI/CLI.hpp>
#include <initializer_list>
#include <string>

namespace sg::cmd {

// Parses a call. Throws a usage Error for an option that is not there (naming the nearest), for one without its value, with an
// empty one, with one that it does not take, or given twice, for more files than the command takes, and for what a check
// refuses; and what CLI11 throws for --help and --version.
void parse(CLI::App& app, int argc, char** argv);

// Whether the call has this option, by any of its names; not so where the command has none of that name.
bool given(const CLI::App& app, const std::string& option);

// Throws a usage Error "OPTION has no effect WHEN" for the first of the options that the call has.
void refuse(const CLI::App& app, std::initializer_list<const char*> options,
            const std::string& when);

// Options of which a call has one at most, each with what it does. The usage Error says that of those given, after the
// question, if there is one, that they answer.
struct Choice {
  const char* option;
  const char* does;
};
void at_most_one(const CLI::App& app, std::initializer_list<Choice> choices,
                 const std::string& question = "");
// The same where it has to have one.
void exactly_one(const CLI::App& app, std::initializer_list<Choice> choices,
                 const std::string& question);

}  // namespace sg::cmd

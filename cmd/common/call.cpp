#include "cmd/common/call.h"

#include <optional>
#include <span>
#include <vector>

#include "lib/text/error.h"
#include "lib/text/nearest.h"

namespace sg::cmd {
namespace {

struct Given {
  const CLI::Option* option;
  std::string name;  // as typed: -m or --method
};

struct Scan {
  const CLI::App& app;
  const CLI::App* job = nullptr;  // the subcommand, once the call has named it
  std::vector<Given> given = {};
  std::size_t files = 0;
};

const CLI::Option* find(const Scan& scan, const std::string& name) {
  const CLI::Option* found = scan.job ? scan.job->get_option_no_throw(name) : nullptr;
  return found ? found : scan.app.get_option_no_throw(name);
}

std::vector<std::string> option_names(const Scan& scan) {
  std::vector<std::string> names;
  for (const CLI::App* app : {scan.job, &scan.app}) {
    if (!app) continue;
    for (const CLI::Option* option : app->get_options()) {
      for (const auto& name : option->get_lnames()) names.push_back("--" + name);
      for (const auto& name : option->get_snames()) names.push_back("-" + name);
    }
  }
  return names;
}

[[noreturn]] void refuse_unknown(const Scan& scan, const std::string& name) {
  const auto jobs = scan.app.get_subcommands([](const CLI::App*) { return true; });
  const auto takes_it = [&](const CLI::App* job) { return job->get_option_no_throw(name); };
  if (!scan.job && std::ranges::any_of(jobs, takes_it))
    throw text::usage_error(name + " belongs behind a WORLD: sg-gen WORLD " + name + " ...");
  const std::string near = text::nearest(name, option_names(scan));
  throw text::usage_error(
      name + (near.empty() ? ": there is no such option" : ": did you mean " + near + "?"));
}

bool takes_value(const CLI::Option& option) {
  return option.get_items_expected_max() > 0;
}

// "FILE" of "-o,--output FILE".
std::string value_name(const CLI::Option& option) {
  const std::string& text = option.get_option_text();
  const std::string name = text.empty() ? option.get_type_name() : text;
  return name.substr(0, name.find_first_of(" |="));
}

void check_value(const Given& given, const std::string& value) {
  if (value.empty())
    throw text::usage_error(given.name + ": its value, " + value_name(*given.option) +
                            ", is empty");
}

void note(Scan& scan, const CLI::Option* option, const std::string& name) {
  for (const Given& before : scan.given) {
    if (before.option != option || !takes_value(*option) || option->get_expected_max() > 1)
      continue;
    throw text::usage_error(before.name == name
                                ? name + " is given twice"
                                : before.name + " and " + name + " are one option, given twice");
  }
  scan.given.push_back({option, name});
}

// Whether a word can only be an option: a value of ours may begin with a dash (-1), but is none of our options.
bool is_option(const Scan& scan, const std::string& word) {
  return word.size() > 1 && word[0] == '-' && find(scan, word.substr(0, word.find('='))) != nullptr;
}

// Takes the value of the last option off the words that follow it.
void take_value(const Scan& scan, std::span<const std::string>& words) {
  const Given& given = scan.given.back();
  const bool there = !words.empty() && !is_option(scan, words.front());
  if (given.option->get_items_expected_min() == 0 && (!there || words.front().starts_with('-')))
    return;
  if (!there)
    throw text::usage_error(given.name + ": its value, " + value_name(*given.option) +
                            ", is missing");
  check_value(given, words.front());
  words = words.subspan(1);
}

void scan_long(Scan& scan, const std::string& word, std::span<const std::string>& rest) {
  const auto equals = word.find('=');
  const std::string name = word.substr(0, equals);
  const CLI::Option* const option = find(scan, name);
  if (!option) refuse_unknown(scan, name);
  note(scan, option, name);
  if (equals == word.npos) {
    if (takes_value(*option)) take_value(scan, rest);
  } else if (takes_value(*option)) {
    check_value(scan.given.back(), word.substr(equals + 1));
  } else {
    throw text::usage_error(name + " takes no value");
  }
}

// -m VALUE, -mVALUE, and flags together, -qv.
void scan_short(Scan& scan, std::string word, std::span<const std::string>& rest) {
  const std::string as_long = "-" + word.substr(0, word.find('='));
  if (word.size() > 2 && find(scan, as_long))
    throw text::usage_error(word + ": did you mean " + as_long + "?");
  for (; word.size() > 1; word.erase(1, 1)) {
    const std::string name = word.substr(0, 2);
    const CLI::Option* const option = find(scan, name);
    if (!option) refuse_unknown(scan, scan.given.empty() || word.size() > 2 ? word : name);
    note(scan, option, name);
    if (!takes_value(*option)) continue;
    if (word.size() == 2) take_value(scan, rest);
    return;
  }
}

void scan_file(Scan& scan, const std::string& word) {
  const auto jobs = scan.app.get_subcommands([](const CLI::App*) { return true; });
  if (!jobs.empty() && !scan.job) {
    std::vector<std::string> names;
    for (const CLI::App* job : jobs) {
      names.push_back(job->get_name());
      if (names.back() == word) scan.job = job;
    }
    if (!scan.job) throw text::usage_error(text::no_such("world", word, names));
    return;
  }
  if (word.empty()) throw text::usage_error("a file's name is empty");
  std::size_t most = 0;
  for (const CLI::Option* option : scan.app.get_options()) {
    if (option->get_positional()) most += static_cast<std::size_t>(option->get_expected_max());
  }
  if (++scan.files > most) {
    throw text::usage_error(
        "'" + word + "' is one word too many" +
        (most == 0 ? ": no file is read" : "; an option's value stands right behind it"));
  }
}

Scan scanned(const CLI::App& app, std::span<const std::string> words) {
  Scan scan{app};
  bool options = true;
  while (!words.empty()) {
    const std::string word = words.front();
    words = words.subspan(1);
    if (options && word == "--") {
      options = false;
    } else if (options && word.starts_with("--")) {
      scan_long(scan, word, words);
    } else if (options && word.size() > 1 && word[0] == '-') {
      scan_short(scan, word, words);
    } else {
      scan_file(scan, word);
    }
    if (!scan.given.empty() && (scan.given.back().option == app.get_help_ptr())) break;
  }
  return scan;
}

// CLI11 names an option in full before a colon; here it is named as typed, and its value follows (options.h).
std::string in_our_words(const Scan& scan, const std::string& cause) {
  for (const Given& given : scan.given) {
    const std::string begin = given.option->get_name() + ": ";
    if (cause.starts_with(begin)) return given.name + " " + cause.substr(begin.size());
  }
  return cause;
}

}  // namespace

void parse(CLI::App& app, int argc, char** argv) {
  const std::vector<std::string> words(argv + 1, argv + argc);
  const Scan scan = scanned(app, words);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success&) {
    throw;
  } catch (const CLI::ParseError& error) {
    throw text::usage_error(in_our_words(scan, error.what()));
  }
}

bool given(const CLI::App& app, const std::string& option) {
  const CLI::Option* const found = app.get_option_no_throw(option);
  return found && found->count() > 0;
}

void refuse(const CLI::App& app, std::initializer_list<const char*> options,
            const std::string& when) {
  for (const char* option : options) {
    if (given(app, option)) throw text::usage_error(std::string(option) + " has no effect " + when);
  }
}

void at_most_one(const CLI::App& app, std::initializer_list<Choice> choices,
                 const std::string& question) {
  std::vector<std::string> said;
  for (const auto& [option, does] : choices) {
    if (given(app, option)) said.push_back(std::string(option) + " " + does);
  }
  if (said.size() < 2) return;
  throw text::usage_error((question.empty() ? "" : question + " ") + text::listed(said) +
                          ": give one of them");
}

void exactly_one(const CLI::App& app, std::initializer_list<Choice> choices,
                 const std::string& question) {
  at_most_one(app, choices, question);
  std::vector<std::string> options;
  for (const auto& [option, does] : choices) {
    if (given(app, option)) return;
    options.emplace_back(option);
  }
  throw text::usage_error(question + " Give one of " + text::listed(options));
}

}  // namespace sg::cmd

#include "cmd/common/complete.h"

#include <algorithm>

#include "lib/text/words.h"

namespace sg::cmd {
namespace {

// What the option's validators tell: words are lines of their names, which nobody else reads.
std::vector<std::string> told_words(CLI::Option& option) {
  std::vector<std::string> words;
  try {
    for (int k = 0;; ++k) {
      std::string_view rest = option.get_validator(k)->get_name();
      while (!rest.empty()) words.emplace_back(text::next_line(rest));
    }
  } catch (const CLI::OptionNotFound&) {  // beyond the last validator
  }
  return words;
}

bool is_file(const CLI::Option& option) {
  const std::string& text = option.get_option_text();
  const std::string what = text.empty() ? option.get_type_name() : text;
  return what.find("FILE") != what.npos || (option.get_positional() && option.get_lnames().empty());
}

bool takes_value(const CLI::Option& option) {
  return option.get_items_expected_max() > 0;
}

// What of `all` begins with the word, behind what is put in front.
void add_matching(const std::vector<std::string>& all, const std::string& word,
                  const std::string& front, std::vector<std::string>& out) {
  for (const auto& candidate : all) {
    if (candidate.starts_with(word)) out.push_back(front + candidate);
  }
}

// Values of an option that begin with `word`; of a list, its last part.
void add_values(CLI::Option& option, std::string word, std::string front,
                std::vector<std::string>& out) {
  const std::vector<std::string> words = told_words(option);
  if (words.empty()) {
    if (is_file(option)) out.emplace_back("*");
    return;
  }
  const auto comma = word.rfind(',');
  if (option.get_delimiter() == ',' && comma != word.npos) {
    front += word.substr(0, comma + 1);
    word = word.substr(comma + 1);
  }
  add_matching(words, word, front, out);
}

// A call as far as it goes.
struct Call {
  CLI::App& app;
  CLI::App* job = nullptr;      // the subcommand
  CLI::Option* open = nullptr;  // that wants its value
  std::size_t files = 0;

  CLI::Option* find(const std::string& name) const {
    CLI::Option* const own = job ? job->get_option_no_throw(name) : nullptr;
    return own ? own : app.get_option_no_throw(name);
  }
  std::vector<CLI::App*> jobs() const {
    return app.get_subcommands([](CLI::App*) { return true; });
  }

  void pass(const std::string& word) {
    if (open && (open->get_items_expected_min() > 0 || !word.starts_with('-'))) {
      open = nullptr;
    } else if (word.size() > 1 && word.starts_with('-')) {
      CLI::Option* const option = find(word);
      open = option && takes_value(*option) ? option : nullptr;
    } else if (!jobs().empty() && !job) {
      for (CLI::App* there : jobs()) job = there->get_name() == word ? there : job;
    } else {
      ++files;
    }
  }

  std::vector<std::string> names() const {
    std::vector<std::string> all;
    for (CLI::App* part : {job, &app}) {
      if (!part) continue;
      for (const CLI::Option* option : part->get_options()) {
        for (const auto& name : option->get_lnames()) all.push_back("--" + name);
        for (const auto& name : option->get_snames()) all.push_back("-" + name);
      }
    }
    std::ranges::sort(all);
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
  }
};

// WHAT, then FILE, the last of which may be several.
void add_positional(const Call& call, const std::string& word, std::vector<std::string>& out) {
  const auto positional =
      call.app.get_options([](const CLI::Option* option) { return option->get_positional(); });
  if (positional.empty()) return;
  add_values(*positional[std::min(call.files, positional.size() - 1)], word, "", out);
}

}  // namespace

CLI::Validator suggesting(CLI::Validator check, const std::vector<std::string>& words) {
  std::string name;
  for (const auto& word : words) name += word + '\n';
  check.name(std::move(name));
  return check;
}

CLI::Validator suggests(const std::vector<std::string>& words) {
  return suggesting({[](std::string&) { return std::string(); }, ""}, words);
}

std::vector<std::string> completions(CLI::App& app, std::span<const std::string> words) {
  std::vector<std::string> out;
  if (words.empty()) return out;
  Call call{app};
  for (const auto& word : words.first(words.size() - 1)) call.pass(word);
  const std::string& last = words.back();
  const bool dash = last.starts_with('-');
  if (call.open && (call.open->get_items_expected_min() > 0 || !dash)) {
    add_values(*call.open, last, "", out);
    return out;
  }
  const auto equals = last.find('=');
  if (dash && equals != last.npos) {
    CLI::Option* const option = call.find(last.substr(0, equals));
    if (option) add_values(*option, last.substr(equals + 1), last.substr(0, equals + 1), out);
  } else if (dash) {
    add_matching(call.names(), last, "", out);
  } else if (!call.jobs().empty() && !call.job) {
    std::vector<std::string> names;
    for (const CLI::App* job : call.jobs()) names.push_back(job->get_name());
    add_matching(names, last, "", out);
  } else {
    add_positional(call, last, out);
  }
  return out;
}

}  // namespace sg::cmd

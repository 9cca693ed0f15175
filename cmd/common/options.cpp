#include "cmd/common/options.h"

#include "lib/text/words.h"

namespace sg::cmd {

CLI::Validator at_least_one() {
  return {[](std::string& text) {
            const auto value = text::parse<Index>(text);
            return value && *value >= 1 ? std::string()
                                        : "wants a whole number of 1 or more, not '" + text + "'";
          },
          ""};
}

CLI::Validator one_of(const std::vector<std::string>& words) {
  return CLI::IsMember(words).description("");
}

void add_seed(CLI::App& app, std::uint64_t& seed, const std::string& what) {
  app.add_option("--seed", seed, what + " (default: " + std::to_string(seed) + ")")
      ->option_text("N");
}

CLI::Option* add_entry(CLI::App& app, Index& min_obs, const std::string& who) {
  return app
      .add_option(
          "--min-obs", min_obs,
          who + " enters with its\nM-th observation (default: " + std::to_string(min_obs) + ")")
      ->option_text("M")
      ->check(at_least_one());
}

CLI::Option* add_every(CLI::App& app, Index& every, const std::string& which) {
  return app.add_option("--every", every, which + " every K-th step, and the last")
      ->option_text("K")
      ->check(at_least_one());
}

void add_weights(CLI::App& app, std::string& weights, const std::string& of) {
  app.add_option("--weights", weights, of + ": unit (default),\ntranslation, rotation, dopt")
      ->option_text("KIND")
      ->check(one_of({"unit", "translation", "rotation", "dopt"}));
}

std::string wrapped_list(std::string first, const std::vector<std::string>& names,
                         std::string_view separator) {
  constexpr std::size_t width = 50;
  std::size_t line_end = width;
  for (const auto& name : names) {
    const std::string word = name + std::string(separator);
    if (first.size() + word.size() > line_end) {
      if (first.back() == ' ') first.pop_back();
      first += '\n';
      line_end = first.size() + width;
    }
    first += word;
  }
  first.resize(first.size() - separator.size());
  return first;
}

}  // namespace sg::cmd

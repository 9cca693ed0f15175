#include "cmd/common/options.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "cmd/common/complete.h"
#include "lib/text/nearest.h"
#include "lib/text/words.h"

namespace sg::cmd {
namespace {

constexpr double beyond_whole = 9e18;  // about where 64 bits end

std::string bound(const std::string& least, const std::string& most) {
  return most.empty() ? ": must be " + least + " or more"
                      : ": must be from " + least + " to " + most;
}

// A number, finite and perhaps whole; else why it is none.
std::string wrong_number(const std::string& text, bool whole_number) {
  const auto value = text::parse<double>(text);
  if (!value || !std::isfinite(*value)) return text + " is not a number";
  return whole_number && *value != std::floor(*value) ? text + " is not a whole number" : "";
}

}  // namespace

CLI::Validator whole(std::int64_t least, std::int64_t most) {
  return {[=](std::string& text) {
            const auto plain = text::parse<std::int64_t>(text);
            if (!plain) {
              if (std::string cause = wrong_number(text, true); !cause.empty()) return cause;
            }
            // 1e5 is as whole as 100000.
            const double value =
                plain ? static_cast<double>(*plain) : text::parse<double>(text).value_or(0);
            const std::int64_t number =
                plain ? *plain
                      : static_cast<std::int64_t>(std::clamp(value, -beyond_whole, beyond_whole));
            const bool too_large = number > most || value > beyond_whole;
            if (number < least || too_large)
              return text + bound(std::to_string(least),
                                  too_large || most < std::numeric_limits<Index>::max()
                                      ? std::to_string(most)
                                      : "");
            text = std::to_string(number);
            return std::string();
          },
          ""};
}

CLI::Validator number(double least, double most) {
  return {[=](std::string& text) {
            if (std::string cause = wrong_number(text, false); !cause.empty()) return cause;
            const double value = text::parse<double>(text).value_or(0);
            if (value >= least && value <= most) return std::string();
            return text + bound(text::format_number(least),
                                std::isfinite(most) ? text::format_number(most) : "");
          },
          ""};
}

CLI::Validator above_zero() {
  return {[](std::string& text) {
            std::string cause = wrong_number(text, false);
            if (cause.empty() && text::parse<double>(text).value_or(0) <= 0)
              cause = text + ": must be above 0";
            return cause;
          },
          ""};
}

CLI::Validator one_of(const std::vector<std::string>& words) {
  return suggesting({[words](std::string& text) {
                       return std::ranges::find(words, text) != words.end()
                                  ? std::string()
                                  : text + ": " + text::suggestion(text, words);
                     },
                     ""},
                    words);
}

CLI::Option* add_seed(CLI::App& app, std::uint64_t& seed, const std::string& what) {
  const CLI::Validator any{[](std::string& text) {
                             return text::parse<std::uint64_t>(text) ? std::string()
                                                                     : whole(0)(text);
                           },
                           ""};
  return app.add_option("--seed", seed, what + " (default: " + std::to_string(seed) + ")")
      ->option_text("N")
      ->transform(any);
}

void add_unused_seed(CLI::App& app) {
  static std::uint64_t unused = 1;
  add_seed(app, unused, "Draws nothing; taken for sweeps");
}

CLI::Option* add_entry(CLI::App& app, Index& min_obs, const std::string& who) {
  return app
      .add_option(
          "--min-obs", min_obs,
          who + " enters with its\nM-th observation (default: " + std::to_string(min_obs) + ")")
      ->option_text("M")
      ->transform(whole(1));
}

CLI::Option* add_every(CLI::App& app, Index& every, const std::string& which) {
  return app.add_option("--every", every, which + " every K-th step, and the last")
      ->option_text("K")
      ->transform(whole(1));
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

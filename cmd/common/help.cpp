#include "cmd/common/help.h"

namespace sg::cmd {
namespace {

constexpr std::size_t screen_width = 80;

// "-o,--output FILE"
std::string spelled(const CLI::Option& option) {
  std::string text;
  for (const auto& name : option.get_snames()) text += (text.empty() ? "-" : ",-") + name;
  for (const auto& name : option.get_lnames()) text += (text.empty() ? "--" : ",--") + name;
  return text + (option.get_option_text().empty() ? "" : " " + option.get_option_text());
}

class Help : public CLI::Formatter {
 public:
  std::string make_footer(const CLI::App* app) const override {
    std::string paragraph, line;
    for (const CLI::Option* option : app->get_options()) {
      if (!option->get_group().empty() || !option->nonpositional()) continue;
      // Two blanks part the names, and begin every line.
      const std::string name = "  " + spelled(*option);
      if (line.size() + name.size() > screen_width) {
        paragraph += line + "\n";
        line.clear();
      }
      line += name;
    }
    if (line.empty()) return CLI::Formatter::make_footer(app);
    return "The same everywhere, see sgtools(7):\n" + paragraph + line + "\n";
  }
};

}  // namespace

CLI::Option* shared(CLI::Option* option) {
  return option->group("");
}

std::shared_ptr<CLI::FormatterBase> help_formatter() {
  auto help = std::make_shared<Help>();
  help->column_width(28);
  return help;
}

}  // namespace sg::cmd

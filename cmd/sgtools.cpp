// sgtools: one door to all commands: sgtools COMMAND ... runs sg-COMMAND.
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <iterator>

#include "cmd/common/command.h"
#include "cmd/sgtools/versions.h"
#include "lib/text/nearest.h"

using namespace sg;

namespace {

struct Job {
  std::string_view name;  // "ec"
  std::string_view what;
};
// A row a command, as its manual page says it: Job{"ec", "elimination complexity of graphs"},
constexpr std::array jobs{
#include "commands.inc"
};

std::string help() {
  std::string text =
      "One door to all commands: sgtools COMMAND ... runs sg-COMMAND.\n"
      "Usage: sgtools COMMAND [ARGUMENTS...]\n\nCommands:\n";
  for (const Job& job : jobs) {
    text += "  " + std::string(job.name);
    text.append(10 - job.name.size(), ' ').append(job.what) += '\n';
  }
  return text +
         "\nsgtools COMMAND --help and man sg-COMMAND say more; man sgtools is the tour.\n"
         "sgtools --version tells the libraries that it was built with.\n";
}

// Where this program lies, the others do.
std::filesystem::path folder() {
  return std::filesystem::read_symlink("/proc/self/exe").parent_path();
}

const Job& find(std::string_view word) {
  if (word.starts_with("sg-")) word.remove_prefix(3);
  for (const Job& job : jobs) {
    if (job.name == word) return job;
  }
  throw text::usage_error(text::no_such("command", word, text::names_of(jobs)));
}

// Becomes the command: its name in messages, its status and its signals are its own.
[[noreturn]] void become(const Job& job, char** arguments) {
  const std::string name = "sg-" + std::string(job.name);
  const std::string path = folder() / name;
  std::string argv0 = name;
  arguments[0] = argv0.data();
  ::execv(path.c_str(), arguments);
  throw text::computation_error(path + ": " + std::strerror(errno));
}

void print(const std::string& text) {
  cmd::Output output("");
  output.write(text);
  output.commit();
}

}  // namespace

int main(int argc, char** argv) {
  cmd::Command command("sgtools", "One door to all commands.");
  const std::string word = argc > 1 ? argv[1] : "--help";
  // What parse() would take for options of its own belongs to the command that runs.
  std::array<char*, 1> alone{argv[0]};
  return cmd::run(command, 1, alone.data(), [&] {
    if (word == "--help" || word == "-h" || word == "help") return print(help());
    if (word == "--version") return print(sgtools::versions());
    if (word.starts_with('-'))
      throw text::usage_error(word + " is no command: options stand behind it");
    become(find(word), argv + 1);
  });
}

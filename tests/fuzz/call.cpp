// The calls of a command: any words end with a status of sgtools(7), with no more on standard error than a line of the command's
// own, and where the call is wrong with nothing on standard output.
//
// One target a command, whose sources are built into it with `main` named command_main. Bytes are words with a NUL behind each, as
// a call has them in memory. Where the work would begin, the call ends. libFuzzer speaks on a standard error of its own
// (-close_fd_mask=2), since this takes the process's.
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <boost/random/mersenne_twister.hpp>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include "cmd/common/command.h"
#include "lib/text/words.h"

int command_main(int argc, char** argv);

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

// What every command calls where it begins to work: sg::cmd::stage, by `ld --wrap`.
[[noreturn]] void begin_work(const std::string& /*name*/,
                             std::int64_t /*total*/) asm("__wrap_" STAGE_SYMBOL);
void begin_work(const std::string& /*name*/, std::int64_t /*total*/) {
  throw sg::cmd::Answer{""};
}

// sgtools would become another command; here none lies beside it.
extern "C" int execv(const char*, char* const*) noexcept {
  errno = ENOENT;
  return -1;
}

namespace {

using Words = std::vector<std::string>;

// A standard stream, taken for good.
struct Stream {
  explicit Stream(int descriptor) : file(::memfd_create("stream", 0)) { ::dup2(file, descriptor); }

  std::string take() const {
    std::string text(static_cast<std::size_t>(::lseek(file, 0, SEEK_END)), '\0');
    const ssize_t got = ::pread(file, text.data(), text.size(), 0);
    text.resize(std::max<ssize_t>(got, 0));
    (void)::ftruncate(file, 0);
    ::lseek(file, 0, SEEK_SET);
    return text;
  }
  int file;
};

struct Ended {
  int status;
  std::string out, error;
};

Ended called(const Words& words) {
  static const Stream out(STDOUT_FILENO), error(STDERR_FILENO);
  static const bool no_input = std::freopen("/dev/null", "r", stdin);
  (void)no_input;
  std::string name = COMMAND;
  Words copy = words;
  std::vector<char*> arguments{name.data()};
  for (auto& word : copy) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const int status = command_main(static_cast<int>(arguments.size()) - 1, arguments.data());
  return {status, out.take(), error.take()};
}

// As libFuzzer found it, before standard error is taken.
const int console = ::dup(STDERR_FILENO);

void require(bool truth, const char* what, const Ended& ended) {
  if (truth) return;
  ::dprintf(console, "%s: status %d, %s\n%s", COMMAND, ended.status, what, ended.error.c_str());
  std::abort();
}

Words words_of(const std::uint8_t* data, std::size_t size) {
  Words words;
  std::string_view rest(reinterpret_cast<const char*>(data), size);
  while (!rest.empty()) {
    const auto end = std::min(rest.find('\0'), rest.size());
    words.emplace_back(rest.substr(0, end));
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return words;
}

// As many of them as have room.
std::size_t put(const Words& words, std::uint8_t* data, std::size_t most) {
  std::size_t size = 0;
  for (const auto& word : words) {
    if (size + word.size() + 1 > most) break;
    std::copy_n(word.c_str(), word.size() + 1, data + size);
    size += word.size() + 1;
  }
  return size;
}

// -v tells more than a line.
bool asks_for_more(const std::string& word) {
  return word.starts_with('-') && word.find('v') != word.npos;
}

const Words odd{"",
                "-",
                "--",
                "=",
                "-1",
                "0",
                "1",
                "1.5",
                "1e5",
                "1e-400",
                "1e400",
                "nan",
                "inf",
                "0x10",
                "1,2",
                ",",
                "1,,2",
                ":",
                "a=b",
                "\n",
                "\xc3\xa9",
                "%s%n",
                "a:3:pose",
                "POINT:2:landmark",
                "2147483648",
                "9223372036854775808",
                "-9223372036854775809",
                "no-such.g2o",
                "/",
                "x.tsv",
                "x.gz",
                "run-%d.g2o"};

// A word that the command says could stand behind those before it, or an odd one.
std::string likely(const Words& words, std::size_t at, boost::random::mt19937& random) {
  Words asked{"--complete"};
  asked.insert(asked.end(), words.begin(), words.begin() + static_cast<std::ptrdiff_t>(at));
  asked.emplace_back(random() % 2 ? "-" : "");
  const std::string told = called(asked).out;
  Words lines;
  for (std::string_view rest = told; !rest.empty();) lines.emplace_back(sg::text::next_line(rest));
  if (random() % 4 == 0 || lines.empty()) return odd[random() % odd.size()];
  std::string word = lines[random() % lines.size()];
  return word == "*" ? "no-such.g2o" : word;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const Words words = words_of(data, size);
  const Ended ended = called(words);
  const auto lines = std::ranges::count(ended.error, '\n');
  require(ended.status >= 0 && ended.status <= 3, "which is none", ended);
  require(ended.status != 2 || ended.out.empty(), "but there is output", ended);
  require(ended.status == 0 || ended.error.starts_with(COMMAND ":"),
          "without the command's own line", ended);
  require(ended.error.empty() || ended.error.ends_with('\n'), "a line without end", ended);
  require(lines <= 1 || std::ranges::any_of(words, asks_for_more), "more than a line", ended);
  return 0;
}

// Whole words as often as bytes.
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t most, unsigned seed) {
  boost::random::mt19937 random(seed);
  if (random() % 2) return LLVMFuzzerMutate(data, size, most);
  Words words = words_of(data, size);
  const std::size_t at = random() % (words.size() + 1);
  const auto there = words.begin() + static_cast<std::ptrdiff_t>(at);
  switch (at < words.size() ? random() % 4 : 3) {
    case 0:
      words.erase(there);
      break;
    case 1:
      *there = likely(words, at, random);
      break;
    default:
      words.insert(there, likely(words, at, random));
  }
  return put(words, data, most);
}

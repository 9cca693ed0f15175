// Preloaded into a command, it lets the command be called again and again without being loaded every time, which is nearly all
// that a call takes that says no more than what is wrong with it. The process loads, and then serves: a request on the socket
// PREFORK is a call, which the process itself answers, or a fork of it, as the request wants; the answer is the call's process,
// and then its status.
//
// A request is flags (1: no standard input, 2: no standard output, 8: by the process itself) and the words, each ended by a zero;
// with it come what are to be standard input, output and error, whichever there are. tests/prefork.py asks.
#include <dlfcn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <vector>

namespace {

using Main = int (*)(int, char**, char**);
using Start = int (*)(Main, int, char**, void (*)(), void (*)(), void (*)(), void*);

constexpr std::size_t longest = 1 << 17;  // of a call

struct Request {
  std::vector<char> text;
  std::vector<int> streams;
};

// Nothing left to do: empty.
Request next_request(int socket) {
  Request request;
  request.text.resize(longest);
  iovec words{request.text.data(), longest};
  alignas(cmsghdr) std::array<char, CMSG_SPACE(3 * sizeof(int))> ancillary{};
  msghdr message{};
  message.msg_iov = &words;
  message.msg_iovlen = 1;
  message.msg_control = ancillary.data();
  message.msg_controllen = ancillary.size();
  const ssize_t size = ::recvmsg(socket, &message, 0);
  request.text.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
  if (const cmsghdr* const head = CMSG_FIRSTHDR(&message)) {
    request.streams.resize((head->cmsg_len - CMSG_LEN(0)) / sizeof(int));
    std::memcpy(request.streams.data(), CMSG_DATA(head), request.streams.size() * sizeof(int));
  }
  return request;
}

void take_streams(const Request& request) {
  std::size_t next = 0;
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if ((request.text[0] >> stream & 1) != 0)
      ::close(stream);
    else
      ::dup2(request.streams[next++], stream);
  }
}

std::vector<char*> words_of(Request& request) {
  std::vector<char*> words;
  for (std::size_t at = 1; at < request.text.size(); at += std::strlen(&request.text[at]) + 1)
    words.push_back(&request.text[at]);
  words.push_back(nullptr);
  return words;
}

void answer(int socket, int number) {
  if (::send(socket, &number, sizeof number, 0) < 0) ::_exit(1);
}

Main command;

int called(Request& request, char** environment) {
  std::vector<char*> words = words_of(request);
  return command(static_cast<int>(words.size()) - 1, words.data(), environment);
}

int called_by_fork(Request& request, int socket, char** environment) {
  const pid_t child = ::fork();
  if (child == 0) {
    take_streams(request);
    for (const int stream : request.streams) ::close(stream);
    ::close(socket);
    std::exit(called(request, environment));
  }
  answer(socket, child);
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFSIGNALED(status) ? -WTERMSIG(status) : WEXITSTATUS(status);
}

int called_here(Request& request, int socket, char** environment) {
  answer(socket, ::getpid());
  const std::array kept{::dup(STDIN_FILENO), ::dup(STDOUT_FILENO), ::dup(STDERR_FILENO)};
  take_streams(request);
  const int status = called(request, environment);
  std::fflush(nullptr);
  for (int stream = 0; stream < 3; ++stream) {
    ::dup2(kept[stream], stream);
    ::close(kept[stream]);
  }
  return status;
}

int serve(int, char**, char** environment) {
  const int socket = std::atoi(std::getenv("PREFORK"));
  ::unsetenv("PREFORK");
  ::unsetenv("LD_PRELOAD");
  while (true) {
    Request request = next_request(socket);
    if (request.text.empty()) return 0;
    const bool here = (request.text[0] & 8) != 0;
    const int status = (here ? called_here : called_by_fork)(request, socket, environment);
    for (const int stream : request.streams) ::close(stream);
    answer(socket, status);
  }
}

}  // namespace

// NOLINTNEXTLINE(bugprone-reserved-identifier)
extern "C" [[gnu::visibility("default")]] int __libc_start_main(Main main, int count, char** words,
                                                                void (*init)(), void (*fini)(),
                                                                void (*loader)(), void* stack) {
  const auto start = reinterpret_cast<Start>(::dlsym(RTLD_NEXT, "__libc_start_main"));
  command = main;
  return start(std::getenv("PREFORK") ? serve : main, count, words, init, fini, loader, stack);
}

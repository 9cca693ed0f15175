// The one exception type of sgtools. It carries what a person needs to act on it: the file, the
// line and the cause.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>

namespace sg::text {

// What went wrong decides a command's exit status.
enum class Fault {
  input = 1,        // the graph file is wrong
  usage = 2,        // the call is wrong
  computation = 3,  // a singular system, a write that failed
};

struct Error : std::runtime_error {
  // line: 1-based line of `file`, 0 where no line is meant.
  Error(Fault fault_, std::string file_, std::size_t line_, const std::string& cause)
      : std::runtime_error(cause), fault(fault_), file(std::move(file_)), line(line_) {}

  Fault fault;
  std::string file;  // empty where no file is meant
  std::size_t line;
};

// "graph.g2o:17: cause", with what of it is known.
inline std::string message(const Error& error) {
  std::string text = error.file;
  if (error.line > 0) text += ":" + std::to_string(error.line);
  return text.empty() ? error.what() : text + ": " + error.what();
}

inline Error input_error(std::string file, std::size_t line, const std::string& cause) {
  return {Fault::input, std::move(file), line, cause};
}
inline Error usage_error(const std::string& cause) {
  return {Fault::usage, "", 0, cause};
}
inline Error computation_error(const std::string& cause) {
  return {Fault::computation, "", 0, cause};
}

}  // namespace sg::text

// What a shell may complete in a call: asked of the command itself, by its own options.
//
// `sg-ec --complete WORD...` prints what the last of the words could become, a line each; a line * stands for names of
// files. The functions of bash and zsh (cmd/completion) do nothing but ask.
#pragma once

#include <CLI/CLI.hpp>
#include <span>
#include <string>
#include <vector>

namespace sg::cmd {

// A check that lets every value pass and tells the words that it may have: ->check(suggests(names)). one_of (options.h)
// tells them by itself.
CLI::Validator suggests(const std::vector<std::string>& words);
// The validator's check stays, and it tells the words.
CLI::Validator suggesting(CLI::Validator check, const std::vector<std::string>& words);

// `words`: of the call so far, without the command; the last one is to be completed, and may be empty.
std::vector<std::string> completions(CLI::App& app, std::span<const std::string> words);

}  // namespace sg::cmd

// What the verbs share that compute one result for long: they can be interrupted, show how far they are, and write the
// result to files beside what they print.
#pragma once
#include <fmt/format.h>
#include <unistd.h>

#include <cstdint>
#include <deque>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "cli/interruption.h"
#include "cli/output.h"
#include "float_tracer/conduct.h"
#include "float_tracer/tracer.h"

namespace plumbline {

/// The result of work(stop, progress). Ctrl-C sets `stop`; `show` prints a line without an end, only to a terminal.
template <class Work>
auto run_long(const std::function<void(std::uint64_t done, std::uint64_t planned)>& show, Work work) {
  const Interruption interruption;
  const bool terminal = isatty(STDERR_FILENO) != 0;
  const auto result = work(interruption.came(), terminal ? show : nullptr);
  if (terminal) fmt::print(stderr, "\r\x1b[K");  // the progress goes, the result comes
  return result;
}

template <class Result>
struct ResultFile {
  std::string path;
  std::string (*render)(const Result&);
};

/// Opened before the work: better told now than in an hour that one can't be.
template <class Result>
class ResultFiles {
 public:
  explicit ResultFiles(std::vector<ResultFile<Result>> files) : files_(std::move(files)) {
    for (const ResultFile<Result>& file : files_) outputs_.emplace_back(file.path);
  }

  /// Prints `text` behind the files: one that can't be written is better told without it. All of them appear, or none.
  void finish(const Result& result, const std::string& text) {
    for (std::size_t i = 0; i < files_.size(); ++i) {
      outputs_[i].write(files_[i].render(result));
      outputs_[i].flush();
    }
    print(text);
    for (Output& output : outputs_) output.finish();
  }

  /// No file appears, or changes.
  void give_up(const std::string& text) {
    outputs_.clear();
    print(text);
  }

 private:
  static void print(const std::string& text) {
    Output output;
    output.write(text);
    output.finish();
  }

  std::vector<ResultFile<Result>> files_;
  std::deque<Output> outputs_;
};

/// Tells on standard error what else the tracers did, each as complaints() has it.
inline void complain(std::span<const Tracer* const> tracers, std::span<const Conduct> conduct) {
  for (std::size_t i = 0; i < tracers.size(); ++i)
    fmt::print(stderr, "{}", complaints(tracers[i]->info().name, conduct[i]));
}

}  // namespace plumbline

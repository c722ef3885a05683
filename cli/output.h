// Where a verb's data goes: standard output, or a file that appears whole or not at all.
// Every write is checked; throws InputError that names the place and the fix (full disk, closed pipe, no such folder).
#pragma once
#include <string>
#include <string_view>

namespace plumbline {

class Output {
 public:
  /// "-" is standard output. A file is written beside its final place and moved there by finish(); links on the way
  /// there stay. What is there already and is no regular file (a device, a pipe) is written directly.
  explicit Output(std::string path = "-");
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;
  /// Without finish(): standard output gets what was written so far, a file stays as it was.
  ~Output();

  /// Buffered.
  void write(std::string_view text);
  void flush();
  /// Call at the end: only then is it all written.
  void finish();

 private:
  void forget_part();
  [[noreturn]] void fail(const char* what, int error) const;

  std::string path_;    // as given
  std::string target_;  // where its links lead to
  std::string part_;    // the file beside that, until finish()
  std::string buffer_;
  int descriptor_ = -1;
};

}  // namespace plumbline

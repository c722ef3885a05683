// The lines of a file or of standard input. Memory is bounded by the longest line.
// Throws InputError that names the file: not there, not readable, a line beyond 64 MiB.
#pragma once
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace plumbline {

class InputFile {
 public:
  /// "-" is standard input.
  explicit InputFile(const std::string& path);
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;
  ~InputFile();

  /// The next line, without its newline; false at the end. It stays valid until the next call, and the `padding` bytes
  /// behind it may be read as well (the JSON parser does). The last line may lack its newline.
  bool next_line(std::string_view& line);
  /// Whether next_line would answer without waiting for more input.
  bool line_ready();

  const std::string& name() const { return name_; }         ///< for messages
  std::size_t line_number() const { return line_number_; }  ///< of the line given last, from 1

  static constexpr std::size_t padding = 64;

 private:
  std::size_t newline();
  void read_more();

  std::string name_;
  int descriptor_;
  bool at_end_ = false;
  std::size_t line_number_ = 0;
  std::vector<char> buffer_;
  std::size_t begin_ = 0, searched_ = 0, end_ = 0;  // the unread bytes; up to searched_ they hold no newline
};

}  // namespace plumbline

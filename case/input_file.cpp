#include "case/input_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "case/input_error.h"

namespace plumbline {
namespace {

constexpr std::size_t chunk = 1 << 16;
constexpr std::size_t longest_line = std::size_t{1} << 26;

}  // namespace

InputFile::InputFile(const std::string& path)
    : name_(path == "-" ? "<stdin>" : path),
      descriptor_(path == "-" ? STDIN_FILENO : open(path.c_str(), O_RDONLY | O_CLOEXEC)),
      buffer_(chunk + padding) {
  if (descriptor_ < 0) throw InputError(fmt::format("{}: cannot be opened: {}", name_, std::strerror(errno)));
}

InputFile::~InputFile() {
  if (descriptor_ != STDIN_FILENO) close(descriptor_);
}

bool InputFile::next_line(std::string_view& line) {
  std::size_t at = newline();
  while (at == end_ && !at_end_) {
    read_more();
    at = newline();
  }
  if (begin_ == end_) return false;
  line = {buffer_.data() + begin_, at - begin_};
  begin_ = searched_ = std::min(at + 1, end_);
  ++line_number_;
  return true;
}

bool InputFile::line_ready() { return at_end_ || newline() != end_; }

// The place of the first newline among the unread bytes; end_ if there is none.
std::size_t InputFile::newline() {
  const void* found = std::memchr(buffer_.data() + searched_, '\n', end_ - searched_);
  searched_ = found ? static_cast<std::size_t>(static_cast<const char*>(found) - buffer_.data()) : end_;
  return searched_;
}

void InputFile::read_more() {
  std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
  searched_ -= begin_;
  end_ -= begin_;
  begin_ = 0;
  if (end_ > longest_line)
    throw InputError(
        fmt::format("{}:{}: the line is longer than 64 MiB; is this the right file?", name_, line_number_ + 1));
  if (buffer_.size() < end_ + chunk + padding) buffer_.resize(2 * end_ + chunk + padding);

  ssize_t got = 0;
  do got = read(descriptor_, buffer_.data() + end_, buffer_.size() - padding - end_);
  while (got < 0 && errno == EINTR);
  if (got < 0) throw InputError(fmt::format("{}: cannot be read: {}", name_, std::strerror(errno)));
  at_end_ = got == 0;
  end_ += static_cast<std::size_t>(got);
}

}  // namespace plumbline

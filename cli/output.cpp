#include "cli/output.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "case/input_error.h"

namespace plumbline {
namespace {

constexpr std::size_t buffer_size = 1 << 16;

bool exists_as_special_file(const std::string& path) {
  struct stat status {};
  return stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode);
}

}  // namespace

Output::Output(std::string path) : path_(std::move(path)) {
  if (path_ == "-") {
    descriptor_ = STDOUT_FILENO;
    return;
  }
  if (!exists_as_special_file(path_)) part_ = fmt::format("{}.{}.part", path_, getpid());
  const std::string& target = part_.empty() ? path_ : part_;
  descriptor_ = open(target.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (descriptor_ < 0) {
    part_.clear();
    fail("cannot be opened for writing", errno);
  }
}

Output::~Output() {
  if (path_ == "-") {
    try {
      flush();
    } catch (const InputError&) {  // only while another error is on its way, which is the one to tell
    }
    return;
  }
  if (descriptor_ >= 0) close(descriptor_);
  if (!part_.empty()) unlink(part_.c_str());
}

void Output::write(std::string_view text) {
  buffer_ += text;
  if (buffer_.size() >= buffer_size) flush();
}

void Output::flush() {
  std::string_view rest = buffer_;
  while (!rest.empty()) {
    const ssize_t written = ::write(descriptor_, rest.data(), rest.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) {
      const int error = errno;
      buffer_.clear();
      fail("cannot be written", error);
    }
    rest.remove_prefix(static_cast<std::size_t>(written));
  }
  buffer_.clear();
}

void Output::finish() {
  flush();
  if (path_ == "-") return;
  const int descriptor = descriptor_;
  descriptor_ = -1;
  if (close(descriptor) != 0) fail("cannot be written", errno);
  if (part_.empty()) return;
  if (rename(part_.c_str(), path_.c_str()) != 0) fail("cannot be put in place", errno);
  part_.clear();
}

void Output::fail(const char* what, int error) const {
  throw InputError(fmt::format("{}: {}: {}", path_ == "-" ? "standard output" : path_, what, std::strerror(error)));
}

}  // namespace plumbline

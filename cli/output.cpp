#include "cli/output.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "case/input_error.h"
#include "cli/part_files.h"

namespace plumbline {
namespace {

constexpr std::size_t buffer_size = 1 << 16;

// Where the links of `path`, which are no ring, lead to; there need not be anything.
std::filesystem::path without_links(std::filesystem::path path) {
  while (std::filesystem::is_symlink(path)) path = path.parent_path() / std::filesystem::read_symlink(path);
  return path;
}

std::string_view fix(int error) {
  switch (error) {
    case ENOENT:
      return "; make its folder first";
    case EISDIR:
      return "; name a file in it";
    case ENOSPC:
      return "; make room, or write elsewhere";
    case EPIPE:
      return "";
    default:
      return "; write elsewhere";
  }
}

}  // namespace

Output::Output(std::string path) : path_(std::move(path)) {
  if (path_ == "-") {
    descriptor_ = STDOUT_FILENO;
    return;
  }
  struct stat status {};
  const bool exists = stat(path_.c_str(), &status) == 0;
  if (!exists && errno != ENOENT) fail("cannot be opened for writing", errno);
  if (!exists || S_ISREG(status.st_mode)) {
    target_ = without_links(path_);
    part_ = fmt::format("{}.{}.part", target_, getpid());
    remove_on_signal(part_.c_str());
  }
  descriptor_ = open((part_.empty() ? path_ : part_).c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (descriptor_ < 0) {
    const int error = errno;
    forget_part();
    fail("cannot be opened for writing", error);
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
  if (part_.empty()) return;
  unlink(part_.c_str());
  forget_part();
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
  if (rename(part_.c_str(), target_.c_str()) != 0) fail("cannot be put in place", errno);
  forget_part();
}

void Output::forget_part() {
  if (part_.empty()) return;
  keep_on_signal(part_.c_str());
  part_.clear();
}

void Output::fail(const char* what, int error) const {
  throw InputError(
      fmt::format("{}: {}: {}{}", path_ == "-" ? "standard output" : path_, what, std::strerror(error), fix(error)));
}

}  // namespace plumbline

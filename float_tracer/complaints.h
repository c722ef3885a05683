// What a foreign tracer does wrong besides answering wrongly: told on standard error, the first few times.
#pragma once
#include <cstddef>
#include <mutex>
#include <string>
#include <string_view>

namespace plumbline {

/// Thread-safe. When it goes, it tells how many it kept to itself.
class Complaints {
 public:
  explicit Complaints(std::string tracer) : tracer_(std::move(tracer)) {}
  Complaints(const Complaints&) = delete;
  Complaints& operator=(const Complaints&) = delete;
  ~Complaints();

  void add(std::string_view what);
  /// Told in any case.
  void insist(std::string_view what);

 private:
  static constexpr std::size_t told_at_most = 10;

  const std::string tracer_;
  std::mutex mutex_;
  std::size_t count_ = 0;
};

}  // namespace plumbline

// What a tracer does beside answering: what it died of, where it broke its interface, and what it left behind.
#pragma once
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>

namespace plumbline {

struct Conduct {
  bool disturbed = false;  ///< it left the floating-point controls changed
  /// The rays that a tracer in a child process died of, each Outcome::fault, by the cause: "SIGABRT", "exit code 0",
  /// "no answer within 10 s".
  std::map<std::string, std::uint64_t> deaths = {};
  /// What it answered that can't be, by the sentence, and how often. The first dozen sentences are told apart,
  /// further ones are but counted: some name numbers of which there is no end.
  std::map<std::string, std::uint64_t> breaches = {};

  static constexpr std::size_t told_apart = 12;
  void add_breach(const std::string& what, std::uint64_t times = 1);
  Conduct& operator+=(const Conduct& more);
  friend bool operator==(const Conduct&, const Conduct&) = default;
};

/// What there is to tell people of it: a line for the deaths, one for each breach, one for the controls. Empty if
/// there is nothing.
std::string complaints(std::string_view tracer, const Conduct& conduct);

}  // namespace plumbline

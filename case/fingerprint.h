// FNV-1a of 64 bits (Fowler, Noll, Vo): tells contents apart that differ by accident; nothing against intent.
#pragma once
#include <cstdint>

namespace plumbline {

class Fingerprint {
 public:
  /// A byte, or a word as a whole.
  void add(std::uint64_t word) { hash_ = (hash_ ^ word) * 0x100000001b3u; }
  std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325u;
};

}  // namespace plumbline

// An archive as a folder, shared by any number of processes: a file for each elite, its bytes a plain fuzzer input, named
// CELL-SCORE-FINGERPRINT in hex digits. Files are written under another name and renamed, so that none is ever half
// there. The score in a name is a hint: it is computed again on reading. Any other file of the right size is an input as
// well, so that a folder of seeds, or a corpus, can be searched on; the union of two folders is their merge.
#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "fuzz/elites.h"

namespace plumbline {

class ElitesFolder {
 public:
  /// Makes the folder if it isn't there; throws InputError where that can't be.
  explicit ElitesFolder(std::filesystem::path path);

  /// Notes elites that have changed, to be written by the next flush.
  void note(const Elites& elites);
  /// Writes the elites noted. What can't be written (a full disk) stays noted; returns how many.
  std::size_t flush(const Elites& elites);
  /// Calls `take` with the input of every file, the first time; then of every new one that may be worse than what the
  /// archive has.
  void scan(const Elites& elites, const FuzzInput& like, Domain domain, const std::function<void(const FuzzInput&)>& take);

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  std::unordered_set<Cell> dirty_;
  std::unordered_map<Cell, std::vector<std::string>> files_;  // of a cell, to be removed once there is a worse case
  std::unordered_set<std::string> seen_;
};

}  // namespace plumbline

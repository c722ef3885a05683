// The folder of a scan: how far it is, and what it found.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "analysis/scan.h"

namespace plumbline {

class ScanFolder {
 public:
  /// No path: nothing is kept. Made where there is none; throws InputError where it can't be, or another scan is at
  /// work in it.
  ScanFolder(const std::string& path, const ScanPlan& plan, std::uint64_t seed);
  ~ScanFolder();
  ScanFolder(const ScanFolder&) = delete;

  /// What was done before; blank where nothing was. Throws InputError where the folder is another scan's.
  ScanState begin(const ScanPlan& plan) const;

  /// The findings of a tracer that are there: names of files without ".case"; not those made plain.
  std::vector<std::string> words(const std::string& tracer) const;

  void keep(const ScanState& state) const;
  /// By a temporary name and a rename; folders on the way are made.
  void write(const std::filesystem::path& name, const std::string& text) const;

 private:
  std::filesystem::path path_;
  int lock_ = -1;          // the folder, open and locked
  std::string plan_line_;  // of which the state is: mesh, seed, sets of rays, tracers
};

}  // namespace plumbline

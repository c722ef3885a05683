// Which .case files a path means.
#pragma once
#include <string>
#include <vector>

namespace plumbline {

/// A file: itself. A folder: the *.case in it, at any depth, sorted; throws InputError if there is none.
std::vector<std::string> case_files(const std::string& path);

}  // namespace plumbline

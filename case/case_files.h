// Which .case files a path means, and what is in them to be judged.
#pragma once
#include <string>
#include <vector>

#include "case/case_text.h"

namespace plumbline {

/// A file: itself. A folder: the *.case in it, at any depth, sorted; throws InputError if there is none.
std::vector<std::string> case_files(const std::string& path);

/// The cases of a file, of which each is to be judged. Throws InputError as read_cases does, and where there is none,
/// or one has other than one triangle.
std::vector<PlacedCase> cases_to_judge(const std::string& file);

}  // namespace plumbline
